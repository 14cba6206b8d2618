"""Pace: how simulated time keeps up with the clock, slower, faster or as fast as it can."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from math import inf

FRAME = 1 / 60
"""Seconds between looks at the driver and pose frames."""
BEHIND = 0.1
"""Seconds the simulation may lag behind the clock before it gives up catching up."""
BUSY = 0.75
"""Part of a round that is stepped through when it is to go as fast as it can."""
MARKS = 10
"""Status lines over which the real-time factor is measured."""


class Pace:
    """Says how many steps to take.

    Args:
        dt: length of a step [s].
        clock: wall clock [s].

    Attributes:
        factor: simulated seconds in a second, infinite for as fast as it can.
        looked: seconds that were spent on other things than steps in the last round, which may be made up for.
    """

    def __init__(self, dt: float, clock: Callable[[], float]) -> None:
        self._dt, self._clock = dt, clock
        self.factor = 1.0
        self.looked = 0.0
        self._start = (0.0, 0.0)
        self._cost = 0.0
        self._marks: deque[tuple[float, float]] = deque(maxlen=MARKS)

    def begin(self, t: float) -> None:
        """Keep pace from simulated time `t` [s] on."""
        self._start = self._clock(), t

    def restart(self, t: float) -> None:
        """Keep pace from `t` [s] on, and measure the factor anew."""
        self._marks.clear()
        self.begin(t)

    def steps(self, t: float) -> int:
        """Return how many steps to take now, where simulated time is `t` [s]."""
        if self.factor == inf:
            return max(1, round(BUSY * FRAME / self._cost)) if self._cost > 0 else 1
        wall, begun = self._start
        behind = (self._clock() - wall) * self.factor - (t - begun)
        limit = (BEHIND + self.looked) * self.factor  # looking took its time, which can be made up for
        steps = round(min(behind, limit) / self._dt)
        if self._cost > 0:
            steps = min(steps, max(1, round(BEHIND / self._cost)))
        self._late = behind > limit
        return max(0, steps)

    def took(self, steps: int, seconds: float, t: float) -> None:
        """Take note of what steps took; where that is too long, let the clock go."""
        if steps > 0:
            self._cost = seconds / steps
        if self.factor != inf and self._late:
            self.begin(t)

    def mark(self, t: float) -> None:
        """Take note of simulated time [s] for the real-time factor."""
        self._marks.append((self._clock(), t))

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds in a second, as measured."""
        if not self._marks:
            return 1.0
        (wall, t), (now, reached) = self._marks[0], self._marks[-1]
        return max(0.0, (reached - t) / (now - wall)) if now > wall else 1.0
