"""Rows of joints and of robots on wheels."""

from __future__ import annotations

import itertools
import math

import numpy as np

from fidelity.row import Row, distance
from fidelity.scene import G, Look, Run, Scene, tilted

LEFT, RIGHT = ("front_left_joint", "rear_left_joint"), ("front_right_joint", "rear_right_joint")
ARM = {"j0": 0.6, "j1": -0.4, "j2": 0.9}
SKID_MU, SKID_A, SKID_B, SKID_R = 0.6, 0.2, 0.3, 0.1
ROVER, SKID = (0.0, 0.0, 0.06, 0.0, 0.0, 0.0), (0.0, 0.0, 0.1, 0.0, 0.0, 0.0)


def limit_at_speed(run: Run) -> float:
    """Return how far a lever gets beyond its limits when it runs into them at 3 rad/s [rad]."""
    looks = run(Scene("stop", 1.0, ground=False, joints={"hinge": (0.0, 3.0)}, every=0.005))
    return max(0.0, *(abs(look.joints["hinge"][0]) - 0.5 for look in looks))


def limit_at_rest(run: Run) -> float:
    """Return how far a carriage of 2 kg hangs below its lower limit [m]."""
    end = run(Scene("lift", 2.0, ground=False))[-1]
    return max(0.0, -0.2 - end.joints["slide"][0])


def dry_hold(run: Run) -> float:
    """Return how far the end of a lever sinks that dry friction holds, in 1 s [m]."""
    end = run(Scene("lever", 1.0, ground=False))[-1]
    return 0.5 * abs(end.joints["hinge"][0])


def dry_stop(run: Run) -> float:
    """Return how far from the closed form a flywheel stops [rad]."""
    end = run(Scene("dry_flywheel", 3.0, ground=False, joints={"axle": (0.0, 5.0)}))[-1]
    return abs(end.joints["axle"][0] - 0.5 * 0.02 * 25.0 / 0.05)


def damped(run: Run) -> float:
    """Return the relative error of a flywheel's speed after 1.5 time constants."""
    end = run(Scene("damped_flywheel", 1.0, ground=False, joints={"axle": (0.0, 5.0)}))[-1]
    return abs(end.joints["axle"][1] / (5.0 * math.exp(-1.5)) - 1.0)


def gears(run: Run) -> float:
    """Return the relative error of two coupled wheels' angle under a constant torque."""
    end = run(Scene("gears", 1.0, ground=False, efforts={"first": 0.1}))[-1]
    return abs(end.joints["first"][0] / (0.5 * 0.1 / (0.03 + 4.0 * 0.05)) - 1.0)


def arm(run: Run) -> float:
    """Return the largest error of an arm's joints after 10 s [rad]."""
    servos = {name: (300.0, 900.0, 30.0, target) for name, target in ARM.items()}
    end = run(Scene("arm", 10.0, ground=False, servos=servos))[-1]
    return max(abs(end.joints[name][0] - target) for name, target in ARM.items())


def _drive(run: Run) -> list[Look]:
    wheels = {"left_joint": (0.5 - 0.15 * 0.5) / 0.06, "right_joint": (0.5 + 0.15 * 0.5) / 0.06}
    return run(Scene("rover", 10.0, spawn=ROVER, command=(0.5, 0.5), ramp=0.5, wheels=wheels))


def diff_drive(run: Run) -> float:
    """Return how far a rover is from where the ramped unicycle gets in 10 s [m]."""
    path, turn = 0.5 * 9.75, 0.5 * 9.75
    end = _drive(run)[-1].base.position
    return distance(end[:2], (path / turn * math.sin(turn), path / turn * (1.0 - math.cos(turn))))


def odometry(run: Run) -> float:
    """Return how far wheel odometry is from the truth after 10 s [m]; of peers, the arcs their wheels turned."""
    looks = _drive(run)
    end = looks[-1]
    if end.odometry is not None:
        return distance(end.odometry[:2], end.base.position[:2])
    x = y = yaw = 0.0
    for before, after in itertools.pairwise(looks):
        left, right = (
            0.06 * (after.joints[name][0] - before.joints[name][0]) for name in ("left_joint", "right_joint")
        )
        turn, way = (right - left) / 0.3, (left + right) / 2
        half = turn / 2
        chord = way * (math.sin(half) / half if half else 1.0)
        x, y, yaw = x + chord * math.cos(yaw + half), y + chord * math.sin(yaw + half), yaw + turn
    return distance((x, y), end.base.position[:2])


def skid_turn(run: Run) -> float:
    """Return the relative error of the rate at which four skidding wheels turn a robot."""
    speed = 1.0 * SKID_B / SKID_R
    wheels = dict.fromkeys(LEFT, -speed) | dict.fromkeys(RIGHT, speed)
    end = run(Scene("skid", 4.0, spawn=SKID, command=(0.0, 1.0), ramp=0.5, wheels=wheels))[-1]
    return abs(end.base.angular[2] / (SKID_B**2 / (SKID_A**2 + SKID_B**2)) - 1.0)


def locked(run: Run) -> float:
    """Return how far from the closed form a robot stops that brakes with locked wheels, sliding obliquely [m]."""
    twist = (2.0 * math.cos(0.5), 2.0 * math.sin(0.5), 0, 0, 0, 0)
    wheels = dict.fromkeys((*LEFT, *RIGHT), 0.0)
    end = run(Scene("skid", 2.0, spawn=SKID, twist=twist, command=(0.0, 0.0), wheels=wheels))[-1].base.position
    way = 4.0 / (2.0 * SKID_MU * G)
    return distance(end[:2], (way * math.cos(0.5), way * math.sin(0.5)))


def traction(run: Run) -> float:
    """Return the relative error of the way of a cart whose wheels are driven by known torques."""
    end = run(Scene("cart", 1.0, spawn=SKID, efforts=dict.fromkeys((*LEFT, *RIGHT), 0.2)))[-1].base.position
    wheel, mass = 0.5 * 0.4 * SKID_R**2, 5.0 + 4 * 0.4
    return abs(end[0] / (0.5 * 4 * 0.2 / SKID_R / (mass + 4 * wheel / SKID_R**2)) - 1.0)


def parked(run: Run) -> float:
    """Return how far a rover with its brakes on gets on a slope in 10 s [m]."""
    wheels = {"left_joint": 0.0, "right_joint": 0.0}
    end = run(tilted(0.15, Scene("rover", 10.0, spawn=ROVER, command=(0.0, 0.0), wheels=wheels)))[-1].base.position
    return distance(end, ROVER[:3]) if np.isfinite(end).all() else math.inf


ROWS = (
    Row("lever into its limit at 3 rad/s: limit violation", "0", "rad", limit_at_speed, 1e-9, 1e-9),
    Row("carriage of 2 kg on its limit: limit violation", "0", "m", limit_at_rest, 1e-9, 1e-9),
    Row("lever held by dry friction, 1 s", "0", "m", dry_hold, 1e-9, 1e-9),
    Row("flywheel stopped by dry friction: stopping angle", "I·ω²/2τ = 5 rad", "rad", dry_stop, 1e-9, 1e-9),
    Row("flywheel slowed by damping, 1 s", "ω·exp(−d·t/I)", "", damped, 1e-9, 1e-9),
    Row("two wheels coupled by <mimic>, driven", "½·τ·t²/(I + n²·J)", "", gears, 1e-9, 1e-9, bullet=False),
    Row("stretched arm held by PID, 10 s", "the target", "rad", arm, 1e-9, 1e-9, 1e-7),
    Row(
        "differential drive, ramped, 10 s: final position", "the ideal unicycle", "m", diff_drive, 0.0003, 0.0015, 1e-7
    ),
    Row("differential drive: odometry compared with the true pose", "0", "m", odometry, 1e-6, 1e-5, 1e-7),
    Row("skid steer on the spot: yaw rate", "ω·b²/(a² + b²)", "", skid_turn, 1e-9, 1e-9),
    Row("locked wheels, sliding obliquely: stopping distance", "v²/2μg = 0.3398 m", "m", locked, 1e-6, 1e-5, 1e-7),
    Row("four wheels driven by 0.2 N·m", "4τ/r/(m + 4I/r²)", "", traction, 1e-9, 1e-9),
    Row("parked on a slope with its brakes on, 10 s", "0", "m", parked, 1e-9, 1e-9),
)
