"""Whether a scene went as it must: speed of a wrong answer counts for nothing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import atan2, cos, hypot, pi, sin, sqrt

from tests.bench.peers.scene import DT, Check, Running, Thing

Checks = tuple[Check, ...]

MOTION, SKIDDING = 0.05, 0.1
"""Share of speed or turning rate by which a robot may be off that rolls, or that skids."""
POSE = 1e-3
"""By how much a joint may be off the pose its servo must hold [rad]."""
STANDING = 5e-3
"""By how much a box of a stack may be out of its place [m]; soft contacts let the topmost sink by 2 mm."""
START, COURSE = 1.0, 2.0
"""Simulated seconds a robot has to reach its speed, and those over which it is measured then."""
HOLD = 1.0
"""Simulated seconds an arm has to come to rest."""
SETTLE = 2.0
"""Simulated seconds a stack is watched."""


def drives(speed: float, rate: float) -> Callable[[Running], Checks]:
    """Return a check that everything drives at `speed` [m/s] and turns at `rate` [rad/s] in its steady state.

    The speed is that of the root link's origin along the way from start to end, turned back by half the turn.
    """

    def check(running: Running) -> Checks:
        running.advance(round(START / DT))
        things = range(len(running.scene.things))
        before = [running.base(k) for k in things]
        running.advance(round(COURSE / DT))
        found = [arc_motion(a, running.base(k)) for k, a in enumerate(before)]
        v = max((each[0] for each in found), key=lambda value: abs(value - speed))
        w = max((each[1] for each in found), key=lambda value: abs(value - rate))
        turns = Check("turning rate", w, rate, (MOTION if speed else SKIDDING) * abs(rate), "rad/s")
        if speed == 0.0:
            return (turns,)
        return Check("speed", v, speed, MOTION * speed, "m/s"), turns

    return check


def arc_motion(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[float, float]:
    """Return speed [m/s] and turning rate [rad/s] of the circular arc between two poses."""
    turn = (yaw(b) - yaw(a) + pi) % (2.0 * pi) - pi
    chord = hypot(b[0] - a[0], b[1] - a[1])
    arc = chord * (0.5 * turn / sin(0.5 * turn)) if abs(turn) > 1e-9 else chord
    ahead = (b[0] - a[0]) * cos(yaw(a) + 0.5 * turn) + (b[1] - a[1]) * sin(yaw(a) + 0.5 * turn)
    return (arc if ahead >= 0.0 else -arc) / COURSE, turn / COURSE


def yaw(pose: tuple[float, ...]) -> float:
    """Return the heading of a pose [rad]."""
    x, y, z, w = pose[3:]
    return atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def turns_on_the_spot(rate: float) -> Callable[[Running], Checks]:
    """Return a check that a robot turns at `rate` [rad/s]."""
    return drives(0.0, rate)


def skid_rate(speed: float, radius: float, x: float, y: float) -> float:
    """Return the rate at which wheels at (±x, ±y) turn a robot on the spot under Coulomb friction [rad/s].

    Friction opposes slip, which at each wheel is (radius·speed − rate·y, rate·x); its moment about the centre vanishes
    where (radius·speed − rate·y)·y = rate·x², whatever the load and the coefficient.
    """
    return radius * speed * y / (x * x + y * y)


def holds(running: Running) -> Checks:
    """Check that the arms come to rest where their servos must hold them against gravity."""
    worst = 0.0
    for number in _extremes(running):
        running.hold(number)
        running.advance(round(HOLD / DT))
        for k, thing in enumerate(running.scene.things):
            goal = thing.poses[number % len(thing.poses)]
            rest = resting_pose(thing, goal) if running.servo_yields else goal
            worst = max(worst, *(abs(running.position(k, joint) - angle) for joint, angle in rest.items()))
    running.swing()
    return (Check("off the pose", worst, 0.0, POSE, "rad"),)


def _extremes(running: Running) -> tuple[int, int]:
    """Return the numbers of the first pose and of the one half a cycle on."""
    count = max(len(thing.poses) for thing in running.scene.things)
    return 0, count // 2


def resting_pose(thing: Thing, goal: Mapping[str, float]) -> dict[str, float]:
    """Return where servos hold a thing that stands level: where stiffness·(goal − q) is what gravity demands."""
    from tests.bench.peers.parsed_urdf import Weight

    weight = Weight(thing.urdf)
    rest = dict(goal)
    for _ in range(20):  # a servo gives way by a hundredth, so each round gains two digits
        demanded = weight(rest)
        rest = {joint: goal[joint] - demanded[joint] / thing.servos[joint].stiffness for joint in goal}
    return rest


def drives_and_holds(speed: float, rate: float) -> Callable[[Running], Checks]:
    """Return a check that a mobile manipulator drives as it must and its arm is where its servos must hold it."""
    motion = drives(speed, rate)

    def check(running: Running) -> Checks:
        return (*motion(running), *holds(running))

    return check


def stands(running: Running) -> Checks:
    """Check that every box of a stack is where it was, and awake where it is kept awake."""
    running.advance(round(SETTLE / DT))
    off = 0.0
    for k, thing in enumerate(running.scene.things):
        off = max(off, sqrt(sum((a - b) ** 2 for a, b in zip(running.base(k)[:3], thing.at, strict=True))))
    place = Check("out of place", off, 0.0, STANDING, "m")
    asleep = running.asleep()
    if asleep is None or running.scene.sleeps:
        return (place,)
    return place, Check("asleep", float(asleep), 0.0, 0.0, "boxes")
