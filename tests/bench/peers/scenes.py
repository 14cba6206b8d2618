"""The scenes of the benchmark."""

from __future__ import annotations

from math import atan, cos, pi

from tests.bench.peers import urdf_models
from tests.bench.peers.correctness_checks import drives, drives_and_holds, holds, skid_rate, stands, turns_on_the_spot
from tests.bench.peers.scene import Motor, Scene, Servo, Thing

DIFF_SPEEDS = (7.0, 9.0)
"""Of the left and the right wheel [rad/s]."""
DIFF_MOTION = (0.06 * 8.0, 0.06 * 2.0 / 0.3)
"""What they come to [m/s, rad/s]."""
MANIPULATOR_SPEEDS = (4.0, 5.0)
MANIPULATOR_MOTION = (0.1 * 4.5, 0.1 * 1.0 / 0.5)
SKID_SPEED = 3.0
"""Of the wheels on the right [rad/s]; those on the left turn backwards."""
CAR_SPEED, CAR_RADIUS = 1.0, 2.0
"""Of the middle of the rear axle [m/s], and of the circle it drives [m]."""
ARM_SERVO, CARRIED_ARM_SERVO = Servo(2000.0, 60.0, 200.0), Servo(1000.0, 40.0, 100.0)
ARM_ENDS = ((0.3, 0.8, -0.4, 1.0, 0.2, -0.7, 0.5), (-0.3, 0.3, 0.5, 1.3, -0.4, -0.2, -0.6))
"""Positions between which arms swing [rad]."""
ARM_JOINTS = tuple(f"joint{k}" for k in range(7))
UPDATE = 0.1
"""Simulated time between targets of arms [s]."""
MUJOCO_AND_PYBULLET_ARM = {"mujoco": 2.0, "pybullet": 5.0}


def diff_drive(at: tuple[float, float, float] = (0.0, 0.0, 0.06)) -> Thing:
    """Return the diff drive with its motors running."""
    motors = {f"{side}_wheel_joint": Motor(w, 1.0) for side, w in zip(("left", "right"), DIFF_SPEEDS, strict=True)}
    return Thing(urdf_models.diff_drive(), at, slippery=("base",), motors=motors)


def robots(count: int) -> Scene:
    """Return a scene of so many diff drives, 1.5 m apart, each driving its circle."""
    columns = 10 if count > 10 else 5
    things = tuple(diff_drive((1.5 * (k % columns), 1.5 * (k // columns), 0.06)) for k in range(count))
    name = {10: "ten-robots"}.get(count, f"{count}-robots")
    return Scene(name, f"{count} diff drives in one world", things, drives(*DIFF_MOTION), {"pybullet": 5.0})


def _skid() -> Thing:
    motors = {
        f"{end}_{side}_wheel_joint": Motor(sign * SKID_SPEED, 10.0)
        for end in ("front", "rear")
        for side, sign in (("left", -1.0), ("right", 1.0))
    }
    return Thing(urdf_models.skid_steer(), (0.0, 0.0, 0.08), motors=motors)


def _car() -> Thing:
    motors = {
        f"rear_{side}_wheel_joint": Motor(CAR_SPEED / 0.1 * (1.0 + away * 0.25 / CAR_RADIUS), 10.0)
        for side, away in (("left", -1.0), ("right", 1.0))
    }
    angles = {
        f"{side}_steering": atan(0.6 / (CAR_RADIUS + away * 0.25)) for side, away in (("left", -1.0), ("right", 1.0))
    }
    servos = dict.fromkeys(angles, Servo(500.0, 10.0, 50.0))
    return Thing(urdf_models.car(), (0.0, 0.0, 0.1), motors=motors, servos=servos, poses=(angles,))


def _swing(period: float) -> tuple[dict[str, float], ...]:
    """Return the targets of a swing to and fro, a cosine over `period` [s] sampled every `UPDATE`."""
    count = round(period / UPDATE)
    shares = [0.5 - 0.5 * cos(2.0 * pi * k / count) for k in range(count)]
    start, end = ARM_ENDS
    return tuple(
        {joint: a + share * (b - a) for joint, a, b in zip(ARM_JOINTS, start, end, strict=True)} for share in shares
    )


def _arm() -> Thing:
    servos = dict.fromkeys(ARM_JOINTS, ARM_SERVO)
    return Thing(urdf_models.arm(), (0.0, 0.0, 0.0), bolted=True, servos=servos, poses=_swing(2.0))


def _manipulator() -> Thing:
    motors = {
        f"{side}_wheel_joint": Motor(w, 10.0) for side, w in zip(("left", "right"), MANIPULATOR_SPEEDS, strict=True)
    }
    servos = dict.fromkeys(ARM_JOINTS, CARRIED_ARM_SERVO)
    urdf = urdf_models.mobile_manipulator()
    return Thing(urdf, (0.0, 0.0, 0.1), slippery=("base",), motors=motors, servos=servos, poses=_swing(4.0))


BOXES = tuple(Thing(urdf_models.box(), (0.0, 0.0, 0.1 + 0.2 * k)) for k in range(5))

SCENES = (
    Scene(
        "diff-drive",
        "diff drive driving a circle",
        (diff_drive(),),
        drives(*DIFF_MOTION),
        {"mujoco": 3.0, "pybullet": 5.0},
    ),
    Scene(
        "skid-steer",
        "skid steer turning on the spot",
        (_skid(),),
        turns_on_the_spot(skid_rate(SKID_SPEED, 0.08, 0.2, 0.2)),
        {"mujoco": 1.2, "pybullet": 5.0},
    ),
    Scene(
        "ackermann",
        "Ackermann car driving a circle",
        (_car(),),
        drives(CAR_SPEED, CAR_SPEED / CAR_RADIUS),
        {"pybullet": 5.0},
    ),
    Scene("arm", "7-dof arm swinging between two poses", (_arm(),), holds, MUJOCO_AND_PYBULLET_ARM, turn=UPDATE),
    Scene(
        "mobile-manipulator",
        "diff drive with a 7-dof arm, both moving",
        (_manipulator(),),
        drives_and_holds(*MANIPULATOR_MOTION),
        MUJOCO_AND_PYBULLET_ARM,
        turn=UPDATE,
    ),
    Scene("stack-awake", "stack of five boxes, kept awake", BOXES, stands, {"mujoco": 1.2}, loose=True, knock=0.02),
    Scene("stack-asleep", "stack of five boxes at rest", BOXES, stands, {"mujoco": 1.0}, loose=True, sleeps=True),
    robots(10),
)
"""What is measured, in this order."""
