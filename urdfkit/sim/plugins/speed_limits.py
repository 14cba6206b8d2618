"""Limits of velocity, acceleration and jerk.

They follow the drives of gz sim (gz-math, SpeedLimiter.cc) and ROS 2's diff_drive_controller
(control_toolbox, rate_limiter.hpp).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from urdfkit.sim.plugins.parameters import Parameters


@dataclass(slots=True)
class SpeedLimiter:
    """Limits a velocity and its derivatives, in the order jerk, acceleration, velocity, as in gz-math.

    Attributes:
        velocity: lowest and highest [m/s] or [rad/s].
        acceleration: lowest and highest [m/s²] or [rad/s²].
        jerk: lowest and highest [m/s³] or [rad/s³].
        last: last granted velocity.
        before: granted velocity before the last one.
        backward: lowest and highest acceleration while driving backwards, if different.
        jerk_when_slowing: limit the jerk of slowing down too.
    """

    velocity: tuple[float, float] = (-inf, inf)
    acceleration: tuple[float, float] = (-inf, inf)
    jerk: tuple[float, float] = (-inf, inf)
    last: float = 0.0
    before: float = 0.0
    backward: tuple[float, float] | None = None
    jerk_when_slowing: bool = True

    def limit(self, target: float, dt: float) -> float:
        """Return the velocity granted `dt` [s] after the last one."""
        granted = target
        acceleration = (self.last - self.before) / dt
        needed = (granted - self.last) / dt
        if self.jerk_when_slowing or (needed - acceleration) * needed > 0.0:
            granted = self.last + (acceleration + _clamp((needed - acceleration) / dt, self.jerk) * dt) * dt
        granted = self.last + _clamp((granted - self.last) / dt, self._accelerations()) * dt
        granted = _clamp(granted, self.velocity)
        if abs(granted - target) < 1e-12:
            granted = target
        self.before, self.last = self.last, granted
        return granted

    def _accelerations(self) -> tuple[float, float]:
        if self.backward is None or self.last > 0.0:
            return self.acceleration
        return self.backward if self.last < 0.0 else (self.backward[0], self.acceleration[1])

    def settled(self, target: float) -> bool:
        """Whether the granted velocity stays the same while the target does."""
        return self.last == self.before == _clamp(target, self.velocity)

    def reset(self) -> None:
        """Return to velocity zero."""
        self.last = self.before = 0.0


class SpeedLimits:
    """Limiters of several velocities, each with its own state.

    Args:
        limiters: one per velocity.
    """

    def __init__(self, *limiters: SpeedLimiter) -> None:
        self._limiters = limiters

    def limit(self, targets: Sequence[float], dt: float) -> list[float]:
        """Return the velocities granted `dt` [s] after the last ones."""
        return [limiter.limit(target, dt) for limiter, target in zip(self._limiters, targets, strict=True)]

    def settled(self, targets: Sequence[float]) -> bool:
        """Whether the granted velocities stay the same while the targets do."""
        return all(limiter.settled(target) for limiter, target in zip(self._limiters, targets, strict=True))

    def reset(self) -> None:
        """Return to velocity zero."""
        for limiter in self._limiters:
            limiter.reset()


def _clamp(value: float, bounds: tuple[float, float]) -> float:
    return max(bounds[0], min(bounds[1], value))


def limiter(read: Parameters, which: str) -> SpeedLimiter:
    """Read the limits of the ``linear`` or ``angular`` velocity: its own if they are written, else the common ones.

    Raises:
        SimulationError: a limit is not a finite number.
    """

    def bound(end: str, quantity: str, unlimited: float) -> float:
        return read.number(f"{end}_{which}_{quantity}", read.number(f"{end}_{quantity}", unlimited))

    def bounds(quantity: str) -> tuple[float, float]:
        return bound("min", quantity, -inf), bound("max", quantity, inf)

    return SpeedLimiter(bounds("velocity"), bounds("acceleration"), bounds("jerk"))
