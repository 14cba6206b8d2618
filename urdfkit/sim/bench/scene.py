"""What a scene of the benchmark consists of, said so that each engine can build it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from urdfkit.sim.bench.correctness_checks import Check
    from urdfkit.sim.bench.running_scene import Running

DT = 0.001
"""Step of every scene [s]."""
CALL = 100
"""Steps of one call where many are asked for at once; targets change, and knocks fall, between such calls only."""
GRAVITY = (0.0, 0.0, -9.81)
"""[m/s²]"""


class Servo(NamedTuple):
    """A position servo, stiffness·(target − q) − damping·q̇; [N·m/rad], [N·m·s/rad], [N·m]."""

    stiffness: float
    damping: float
    effort: float


class Motor(NamedTuple):
    """A velocity motor: speed [rad/s] and what it can do [N·m]."""

    speed: float
    effort: float


@dataclass(frozen=True, slots=True)
class Thing:
    """One robot or box of a scene.

    Attributes:
        urdf: its text.
        at: where its root link starts [m].
        bolted: whether the root link cannot move.
        slippery: links without friction; all others have the coefficient 1.
        motors: joint → motor.
        servos: joint → servo.
        poses: targets of the servos, joint → [rad]; where there are several, they take turns.
    """

    urdf: str
    at: tuple[float, float, float]
    bolted: bool = False
    slippery: tuple[str, ...] = ()
    motors: Mapping[str, Motor] = field(default_factory=dict)
    servos: Mapping[str, Servo] = field(default_factory=dict)
    poses: tuple[Mapping[str, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Scene:
    """A scene: what is in it, what happens, and what must come of it.

    Attributes:
        name: on the command line.
        title: for people.
        things: on level ground with friction coefficient 1 or more, no two of a robot's links touching.
        check: runs the scene from its start and tells whether it went as it must.
        targets: peer → how many times its speed ours should be.
        loose: the things are boxes of the world, not robots.
        turn: simulated time between poses of the servos [s]; 0 if they keep the first.
        knock: speed by which the last thing is knocked to and fro every `CALL` steps [m/s], which keeps it awake.
        sleeps: engines that let things at rest sleep are to do so.
    """

    name: str
    title: str
    things: tuple[Thing, ...]
    check: Callable[[Running], tuple[Check, ...]]
    targets: Mapping[str, float] = field(default_factory=dict)
    loose: bool = False
    turn: float = 0.0
    knock: float = 0.0
    sleeps: bool = False
