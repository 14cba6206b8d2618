"""The scenes: robots that stand, lie and walk, grasps, and heaps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from tests.bench.contact_rich import models
from tests.bench.peers import urdf_models
from tests.bench.peers.scene import Check, Running, Scene, Servo, Thing

Inspection = Callable[[Running], tuple[Check, ...]]


@dataclass(frozen=True, slots=True)
class Case:
    """A scene and when it is measured.

    Attributes:
        scene: its check inspects the state and does not advance.
        settle: simulated time before the measurement [s].
        span: simulated time of the measurement [s].
        target: how many times MuJoCo's speed ours should be.
        sleep: whether bodies and robots at rest may sleep.
        push: speed of every box at the start of the measurement [m/s], along x in alternating directions.
    """

    scene: Scene
    settle: float
    span: float
    target: float
    sleep: bool = False
    push: float = 0.0


def between(low: float, high: float, which: int = 0) -> Inspection:
    """Return a check that the base of a robot or box is at a height in these bounds [m]."""

    def check(running: Running) -> tuple[Check, ...]:
        middle = 0.5 * (low + high)
        return (Check("height", running.base(which)[2], middle, high - middle, "m"),)

    return check


def _robot(urdf: str, z: float, servos: Mapping[str, Servo], *poses: Mapping[str, float]) -> Thing:
    """Return a free robot with the root link at a height [m], its servos at the first pose."""
    return Thing(urdf, (0.0, 0.0, z), servos=servos, poses=poses or ({},))


def _leg_pose(abduction: float, pitch: float, knee: float, leg: str) -> dict[str, float]:
    return {f"{leg}_abduction": abduction, f"{leg}_pitch": pitch, f"{leg}_knee": knee}


STANCE = {name: angle for leg in models.LEGS for name, angle in _leg_pose(0.0, 0.7, -1.4, leg).items()}
LEG_SERVOS = dict.fromkeys(STANCE, Servo(200.0, 5.0, 100.0))
FOLDED = {name: angle for leg in models.LEGS for name, angle in _leg_pose(0.0, 1.3, -2.6, leg).items()}


def _trot() -> tuple[dict[str, float], ...]:
    """Return the poses of a trot of 2 Hz, one each 20 ms; diagonal legs swing together."""
    poses = []
    for k in range(25):
        pose = {}
        for leg in models.LEGS:
            phase = 2.0 * pi * (k / 25 + (0.0 if leg in ("front_left", "rear_right") else 0.5))
            lift, swing = max(0.0, sin(phase)), 0.15 * cos(phase)
            pose.update(_leg_pose(0.0, 0.7 + 0.3 * lift + swing, -1.4 - 0.6 * lift, leg))
        poses.append(pose)
    return tuple(poses)


def _upright(joints: int) -> Mapping[str, Servo]:
    """Return servos that keep a humanoid upright, weaker in the arms."""
    urdf = models.humanoid(joints)
    names = [part.split('"')[0] for part in urdf.split('<joint name="')[1:]]
    strong = ("hip", "knee", "ankle", "waist")
    return {
        name: Servo(4000.0, 60.0, 400.0) if any(k in name for k in strong) else Servo(100.0, 2.0, 50.0)
        for name in names
    }


def _standing(joints: int) -> Thing:
    servos = _upright(joints)
    return _robot(models.humanoid(joints), 0.961, servos, dict.fromkeys(servos, 0.0))


def _gripped() -> tuple[Thing, ...]:
    servos = {"lift": Servo(5000.0, 100.0, 200.0)} | dict.fromkeys(
        ("left_slide", "right_slide"), Servo(5000.0, 50.0, 50.0)
    )
    pose = {"lift": 0.1, "left_slide": 0.03, "right_slide": 0.03}
    start = {"lift": 0.1, "left_slide": 0.025, "right_slide": 0.025}
    hand = Thing(models.gripper(), (0.0, 0.0, 0.3), bolted=True, servos=servos, poses=(start, *[pose] * 300))
    return hand, Thing(models.brick(0.05, 0.2), (0.0, 0.0, 0.4))


TABLE = 0.5
"""Height of the table [m]."""


def _swept() -> tuple[Thing, ...]:
    joints = [f"joint{k}" for k in range(7)]
    poses = []
    for k in range(41):
        yaw = -0.9 + 1.9 * (0.5 - 0.5 * cos(2.0 * pi * k / 40))
        poses.append(dict.fromkeys(joints, 0.0) | {"joint0": yaw, "joint1": pi / 2.0})
    servos = dict.fromkeys(joints, Servo(2000.0, 60.0, 300.0))
    arm = Thing(urdf_models.arm(), (0.0, 0.0, TABLE - 0.15), bolted=True, servos=servos, poses=tuple(poses))
    top = Thing(models.table(1.2, 1.0), (0.85, 0.1, TABLE - 0.025), bolted=True)
    boxes = [
        Thing(models.brick(0.1, 0.3), (0.45 + 0.17 * (k % 5), -0.05 + 0.2 * (k // 5), TABLE + 0.05)) for k in range(10)
    ]
    return (arm, top, *boxes)


def _fell(running: Running) -> tuple[Check, ...]:
    """Check that at least five boxes fell off the table and none into the ground."""
    heights = [running.base(k)[2] for k in range(2, 12)]
    fallen = sum(z < TABLE - 0.2 for z in heights)
    lowest = Check("lowest box", min(heights), 0.3, 0.28, "m")
    return lowest, Check("fallen boxes", float(fallen), 7.5, 2.5, "boxes")


def _boxes(count: int, columns: int, pitch: float, layer: float) -> tuple[Thing, ...]:
    """Return boxes of 0.1 m in layers, each shifted a little so that they tumble."""
    rng = np.random.default_rng(7)
    brick = models.brick(0.1, 1.0)
    boxes = []
    for k in range(count):
        row, column, level = k % columns, k // columns % columns, k // columns**2
        x, y = (pitch * (n - 0.5 * columns) + 0.02 * rng.uniform(-1.0, 1.0) for n in (row, column))
        boxes.append(Thing(brick, (float(x), float(y), 0.0501 + layer * level)))
    return tuple(boxes)


def _above_ground(running: Running) -> tuple[Check, ...]:
    """Check that no box sank into the ground or flew away."""
    heights = [running.base(k)[2] for k in range(len(running.scene.things))]
    lowest = Check("lowest box", min(heights), 0.05, 0.01, "m")
    return lowest, Check("highest box", max(heights), 0.5, 0.5, "m")


def cases() -> tuple[Case, ...]:
    """Return all scenes."""
    quadruped, limp = models.quadruped(), models.quadruped(0.1)
    folded, collapsing = (_robot(limp, z, {}, pose) for z, pose in ((0.1, FOLDED), (0.33, STANCE)))
    belly, standing = between(0.03, 0.12), between(0.25, 0.4)
    stance, trot = (_robot(quadruped, 0.326, LEG_SERVOS, *poses) for poses in ((STANCE,), _trot()))
    result = [
        Case(Scene("quadruped-limp", "on its belly with folded legs, awake", (folded,), belly), 7.0, 1.0, 1.0),
        Case(Scene("quadruped-limp-sleep", "the same, may sleep", (folded,), belly), 7.0, 1.0, 1.0, sleep=True),
        Case(Scene("quadruped-collapse", "collapsing", (collapsing,), between(0.03, 0.2)), 0.0, 1.5, 1.0),
        Case(Scene("quadruped-standing", "standing under servos", (stance,), standing), 1.0, 1.0, 2.0),
        Case(Scene("quadruped-trotting", "trotting under servos", (trot,), standing, turn=0.02), 1.0, 2.0, 1.0),
    ]
    for joints in (25, 42):
        name, upright, low = f"humanoid{joints}", between(0.9, 1.0), between(0.02, 0.6)
        limp = _robot(models.humanoid(joints, 1.0), 0.961, {}, {"left_hip_pitch": 0.3, "right_knee": 0.4})
        result += [
            Case(Scene(f"{name}-standing", "standing under servos", (_standing(joints),), upright), 1.0, 1.0, 1.0),
            Case(Scene(f"{name}-falling", "collapsing", (limp,), low), 0.0, 2.0, 0.7),
            Case(Scene(f"{name}-fallen", "lying, awake", (limp,), low), 4.0, 1.0, 0.7),
        ]
    held, scattered = between(0.38, 0.42, 1), _boxes(1000, 32, 0.2, 0.12)
    heap = Scene("heap-200", "200 boxes falling into a heap", _boxes(200, 5, 0.13, 0.12), _above_ground, loose=True)
    at_rest = Scene("scattered-1000", "1,000 boxes scattered at rest", scattered, _above_ground, loose=True)
    knocked = Scene("knocked-1000", "1,000 boxes, all pushed", scattered, _above_ground, loose=True)
    return (
        *result,
        Case(Scene("gripper", "gripper holding a box", _gripped(), held, turn=0.01), 0.5, 1.0, 1.0),
        Case(Scene("sweep", "arm sweeping ten boxes off a table", _swept(), _fell, turn=0.05), 0.0, 2.0, 1.0),
        Case(heap, 0.0, 3.0, 1.0, sleep=True),
        Case(at_rest, 1.0, 1.0, 1.0, sleep=True),
        Case(knocked, 0.2, 1.0, 0.7, sleep=True, push=0.5),
    )
