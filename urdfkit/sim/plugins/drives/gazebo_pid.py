"""The PID law of Gazebo's drives (gazebo::common::PID and gz::math::PID, which agree but for the command's bounds)."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf


@dataclass(slots=True)
class Pid:
    """A PID controller on an error that is what is minus what should be.

    Attributes:
        p: proportional gain.
        i: integral gain [1/s].
        d: derivative gain [s].
        least: lower bound of the integral's part.
        most: upper bound of the integral's part.
        bounds: of the command.
        offset: added to the command before it is bounded.
        integral: the integral's part of the command so far.
        before: the last error.
    """

    p: float
    i: float
    d: float
    least: float = 0.0
    most: float = 0.0
    bounds: tuple[float, float] = (-inf, inf)
    offset: float = 0.0
    integral: float = 0.0
    before: float = 0.0

    @property
    def idle(self) -> bool:
        """Whether no error ever makes a command."""
        return self.p == self.i == self.d == self.offset == 0.0

    def update(self, error: float, dt: float) -> float:
        """Return the command `dt` [s] after the last one."""
        self.integral = max(self.least, min(self.most, self.integral + self.i * dt * error))
        slope = (error - self.before) / dt
        self.before = error
        command = self.offset - self.p * error - self.integral - self.d * slope
        return max(self.bounds[0], min(self.bounds[1], command))

    def reset(self) -> None:
        """Forget the errors so far."""
        self.integral = self.before = 0.0
