"""One rigid body of a simulation's world, as its user holds it: it stays valid whatever comes and goes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from urdfkit.description.urdf.robot import Pose
from urdfkit.sim.state.poses import pose_of

if TYPE_CHECKING:
    from urdfkit.sim.engine import Body
    from urdfkit.sim.world.live_world import Stage

ZERO = (0.0, 0.0, 0.0)


class Population(Protocol):
    """What bodies are in, see `urdfkit.sim.world.entities.Population`."""

    _stage: Stage

    def push(
        self,
        name: str,
        force: Sequence[float] = ZERO,
        torque: Sequence[float] = ZERO,
        *,
        at: Sequence[float] = ZERO,
        for_seconds: float | None = None,
    ) -> None:
        """Push a body."""

    def release(self, name: str) -> None:
        """End all pushes on a body."""


class Thing:
    """A rigid body of the world.

    Args:
        population: what it is in.
        name: what it is called there.
    """

    def __init__(self, population: Population, name: str) -> None:
        self._population = population
        self.name = name

    @property
    def body(self) -> Body:
        """It as the engine was given it: mass, inertia and shapes, and where it was put first.

        Raises:
            SimulationError: it is no longer there.
        """
        return self._population._stage.body(self.name)

    @property
    def pose(self) -> tuple[float, ...]:
        """Where it is: x y z [m] and quaternion x y z w."""
        loose = self._population._stage.loose
        return loose[self.name].pose if self.name in loose else tuple(self.body.pose)

    @property
    def twist(self) -> tuple[float, ...]:
        """Velocity of its origin [m/s] and angular velocity [rad/s], along the world's axes."""
        loose = self._population._stage.loose
        if self.name in loose:
            return loose[self.name].twist
        self.body  # noqa: B018 - raises where it is gone
        return (0.0,) * 6

    @property
    def asleep(self) -> bool:
        """Whether it is free to move, but at rest and left alone until something happens to it."""
        loose = self._population._stage.loose
        return self.name in loose and loose[self.name].asleep

    def place(self, pose: Pose | Sequence[float], twist: Sequence[float] = (0.0,) * 6) -> None:
        """Put it somewhere, see `Population.place`."""
        self._population._stage.move_body(self.name, pose_of(pose), twist)

    def push(
        self,
        force: Sequence[float] = ZERO,
        torque: Sequence[float] = ZERO,
        *,
        at: Sequence[float] = ZERO,
        for_seconds: float | None = None,
    ) -> None:
        """Push it, see `Population.push`."""
        self._population.push(self.name, force, torque, at=at, for_seconds=for_seconds)

    def release(self) -> None:
        """End all pushes on it."""
        self._population.release(self.name)
