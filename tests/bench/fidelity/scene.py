"""What every engine is asked to simulate, and what it answers: one description for all."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

MODELS = Path(__file__).parents[2] / "sim" / "fidelity_models"
G = 9.81
Vector = Sequence[float]


@dataclass(frozen=True)
class Thing:
    """A box or ball of a world; one with no mass stands still.

    Attributes:
        name: of it.
        size: three edges of a box, or one radius [m].
        position: of its centre [m].
        mass: [kg].
        mu: friction coefficient.
    """

    name: str
    size: Vector
    position: Vector
    mass: float
    mu: float = 1.0

    @property
    def inertia(self) -> tuple[float, float, float]:
        """Its moments of inertia, as a solid [kg·m²]."""
        if len(self.size) == 1:
            return (0.4 * self.mass * self.size[0] ** 2,) * 3
        x, y, z = self.size
        m = self.mass / 12
        return m * (y * y + z * z), m * (x * x + z * z), m * (x * x + y * y)


@dataclass(frozen=True)
class Scene:
    """A model in a world, how it starts and what acts on it.

    Attributes:
        model: name of a URDF in tests/sim/fidelity_models.
        seconds: how long [s].
        ground: whether there is one, at z = 0.
        gravity: [m/s²]; an incline is gravity that leans.
        spawn: x y z [m], roll pitch yaw [rad].
        twist: of the root link, along the world's axes [m/s, rad/s].
        joints: joint → position and velocity at the start.
        command: vx [m/s] and wz [rad/s] of a robot on wheels, …
        ramp: … reached evenly within so many seconds, …
        wheels: … which is these wheel speeds [rad/s].
        efforts: joint → constant effort [N·m].
        servos: joint → P, I and D gains and target; ours reads the same from the model.
        things: what else is in the world.
        push: a thing, and a force on it along x [N].
        every: how often to look [s]; None: only at the end.
        weighed: whether looks have the force of the ground on the robot.
    """

    model: str
    seconds: float
    ground: bool = True
    gravity: Vector = (0.0, 0.0, -G)
    spawn: Vector = (0.0,) * 6
    twist: Vector = (0.0,) * 6
    joints: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    command: tuple[float, float] | None = None
    ramp: float = 0.0
    wheels: Mapping[str, float] = field(default_factory=dict)
    efforts: Mapping[str, float] = field(default_factory=dict)
    servos: Mapping[str, tuple[float, float, float, float]] = field(default_factory=dict)
    things: tuple[Thing, ...] = ()
    push: tuple[str, float] | None = None
    every: float | None = None
    weighed: bool = False

    @property
    def file(self) -> Path:
        """Where the model is."""
        return MODELS / f"{self.model}.urdf"

    @property
    def bolted(self) -> bool:
        """Whether the root link does not move."""
        return '<link name="world"' in self.file.read_text(encoding="utf-8")


@dataclass(frozen=True)
class Pose:
    """Of something free: position [m], quaternion x y z w, velocity [m/s], angular velocity [rad/s], world axes."""

    position: Vector
    quaternion: Vector
    linear: Vector = (0.0,) * 3
    angular: Vector = (0.0,) * 3

    @property
    def yaw(self) -> float:
        """Heading [rad]."""
        x, y, z, w = self.quaternion
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


@dataclass(frozen=True)
class Ground:
    """What the ground does to a robot: its force [N] in world axes, and the centre of pressure x, y [m]."""

    force: Vector
    centre: Vector

    @classmethod
    def of(cls, contacts: Iterable[tuple[Vector, Vector]]) -> Ground:
        """Return the sum of contacts, each a position [m] and the force on the robot [N]."""
        pairs = [(tuple(position), tuple(force)) for position, force in contacts]
        force = [sum(each[1][k] for each in pairs) for k in range(3)]
        return cls(force, [sum(each[0][k] * each[1][2] for each in pairs) / (force[2] or math.nan) for k in range(2)])


@dataclass(frozen=True)
class Look:
    """What is seen at a time.

    Attributes:
        t: [s].
        base: the root link.
        joints: joint → position and velocity.
        things: name → pose.
        odometry: where the wheels say the robot is: x, y [m], yaw [rad].
        ground: what the ground does to the robot, in scenes that weigh it.
    """

    t: float
    base: Pose
    joints: Mapping[str, tuple[float, float]]
    things: Mapping[str, Pose] = field(default_factory=dict)
    odometry: tuple[float, float, float] | None = None
    ground: Ground | None = None


Run = Callable[[Scene], list[Look]]
"""An engine with a step and settings: simulates a scene; the last look is the end."""


def tilted(angle: float, scene: Scene) -> Scene:
    """Return the scene on an incline that falls towards +x."""
    return replace(scene, gravity=(G * math.sin(angle), 0.0, -G * math.cos(angle)))
