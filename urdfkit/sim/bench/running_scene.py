"""A scene in one engine: what all engines have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import inf

from urdfkit.sim.bench.scene import CALL, DT, Scene

Pose = tuple[float, ...]
"""x y z [m] and quaternion x y z w."""


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
