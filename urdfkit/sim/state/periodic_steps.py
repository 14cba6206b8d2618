"""Steps at which periodic work is due, as integers, so that periods do not drift."""

from math import ceil, floor

NEVER = 1 << 62
"""A step that is never reached."""

_ROUNDING = 1e-6
"""Tolerance of rounding, as a fraction of a tick: 0.01 / 0.001 is not exactly 10 in floating point."""


class PeriodicSteps:
    """The steps at which work with a rate is due: the n-th tick is the first step at or after n periods.

    Args:
        rate: rate in simulated time [Hz]. Zero, a negative rate or a rate above 1/dt means every step.
        dt: time step of the simulation [s].
    """

    def __init__(self, rate: float, dt: float) -> None:
        self.steps = max(1.0, 1.0 / (rate * dt)) if rate > 0 else 1.0
        self.period = self.steps * dt
        nearest = round(self.steps)
        self._whole = nearest if abs(self.steps - nearest) < 1e-9 * nearest else 0

    def at(self, n: int) -> int:
        """Return the step of the n-th tick; tick 0 is at step 0."""
        return n * self._whole if self._whole else ceil(n * self.steps - _ROUNDING)

    def until(self, step: int) -> int:
        """Return the number of ticks in the steps 1..step."""
        return step // self._whole if self._whole else floor((step + _ROUNDING) / self.steps)

    def next(self, step: int) -> int:
        """Return the step of the first tick at or after `step`; tick 0 is at step 0."""
        whole = self._whole
        return step + -step % whole if whole else self.at(self.until(step - 1) + 1)

    def after(self, step: int) -> int:
        """Return the step of the first tick later than `step`."""
        whole = self._whole
        return (step // whole + 1) * whole if whole else self.at(self.until(step) + 1)
