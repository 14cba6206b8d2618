"""When something with a rate is due, counted in whole simulation steps so that nothing drifts."""

from __future__ import annotations

from math import ceil, floor

NEVER = 1 << 62
"""A step that is not reached."""

_ROUNDING = 1e-6
"""Steps within this fraction of a tick count as the tick: 0.01 / 0.001 is not quite 10."""


class Ticks:
    """The steps at which a rate falls due: the n-th is the first at or after n periods.

    Args:
        rate: [Hz] of simulated time; zero or less, or faster than the steps, means every step.
        dt: the simulation's step [s].
    """

    def __init__(self, rate: float, dt: float) -> None:
        self.steps = max(1.0, 1.0 / (rate * dt)) if rate > 0 else 1.0
        self.period = self.steps * dt
        nearest = round(self.steps)
        self._whole = nearest if abs(self.steps - nearest) < 1e-9 * nearest else 0

    def at(self, n: int) -> int:
        """Return the step of the n-th tick (the zeroth is at step 0)."""
        return n * self._whole if self._whole else ceil(n * self.steps - _ROUNDING)

    def until(self, step: int) -> int:
        """Return how many ticks lie in 1..step."""
        return step // self._whole if self._whole else floor((step + _ROUNDING) / self.steps)

    def falls_on(self, step: int) -> bool:
        """Whether a tick falls on `step`; the zeroth falls on step 0."""
        return step % self._whole == 0 if self._whole else self.at(self.until(step)) == step

    def after(self, step: int) -> int:
        """Return the step of the first tick later than `step`."""
        whole = self._whole
        return (step // whole + 1) * whole if whole else self.at(self.until(step) + 1)
