"""What a scene of the benchmark consists of, and what every engine does with one."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import inf, isfinite
from typing import NamedTuple

DT = 0.001
"""Step of every scene [s]."""
CALL = 100
"""Steps of one call where many are asked for at once; targets change, and knocks fall, between such calls only."""
GRAVITY = (0.0, 0.0, -9.81)
"""[m/s²]"""

Pose = tuple[float, ...]
"""x y z [m] and quaternion x y z w."""


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
class Check:
    """One thing that must be so.

    Attributes:
        what: is looked at.
        value: as found; of several robots the one that is furthest off.
        ideal: as it must be.
        tolerance: by which it may be off.
        unit: of the three.
    """

    what: str
    value: float
    ideal: float
    tolerance: float
    unit: str

    @property
    def ok(self) -> bool:
        """Whether it is so."""
        return isfinite(self.value) and abs(self.value - self.ideal) <= self.tolerance


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


class Running(ABC):
    """A scene at work in one engine.

    Subclasses build the scene, with the first pose as the servos' target, and step it.

    Args:
        scene: what to run.

    Attributes:
        scene: what is run.
        steps: done so far.
        servo_yields: whether the servos give way to a load by load / stiffness, as a spring does.
    """

    servo_yields = True

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.steps = 0
        self._turn = round(scene.turn / DT)
        self._next_turn: float = self._turn or inf
        self._next_knock: float = CALL if scene.knock else inf

    def advance(self, steps: int, *, at_once: bool = True) -> None:
        """Advance by `steps`, many in a call or one by one."""
        go = self.many if at_once else self.one_by_one
        end = self.steps + steps
        while self.steps < end:
            n = min(CALL, end - self.steps, self._next_turn - self.steps, self._next_knock - self.steps)
            go(int(n))
            self.steps += int(n)
            if self.steps >= self._next_turn:
                self._next_turn += self._turn
                self.pose(int(self.steps // self._turn))
            if self.steps >= self._next_knock:
                self._next_knock += CALL
                self.knock(len(self.scene.things) - 1, self.scene.knock * (-1) ** (self.steps // CALL))

    def pose(self, number: int) -> None:
        """Give the servos of all things their targets of this turn."""
        for k, thing in enumerate(self.scene.things):
            if thing.poses:
                self.set_targets(k, number % len(thing.poses))

    def hold(self, number: int) -> None:
        """Give the servos these targets, and no others until `swing`."""
        self._next_turn = inf
        self.pose(number)

    def swing(self) -> None:
        """Let the targets of the servos take turns again, as they do from the start."""
        if self._turn:
            self._next_turn = self.steps + self._turn

    @abstractmethod
    def many(self, steps: int) -> None:
        """Advance by `steps` in one call, or as nearly so as the engine can."""

    @abstractmethod
    def one_by_one(self, steps: int) -> None:
        """Advance by `steps`, each a call."""

    @abstractmethod
    def base(self, k: int) -> Pose:
        """Return where the root link of a thing is."""

    @abstractmethod
    def position(self, k: int, joint: str) -> float:
        """Return a joint's position [rad]."""

    @abstractmethod
    def set_targets(self, k: int, number: int) -> None:
        """Set the targets of a thing's servos to one of its poses."""

    @abstractmethod
    def knock(self, k: int, speed: float) -> None:
        """Give a thing a speed along x [m/s], at once."""

    @abstractmethod
    def asleep(self) -> int | None:
        """Return how many things sleep; None where the engine does not tell."""

    def close(self) -> None:  # noqa: B027 - most have nothing to let go
        """Let go what the engine holds."""
