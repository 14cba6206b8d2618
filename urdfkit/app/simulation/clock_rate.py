"""Relation of simulated time to the clock: real time, a factor of it, or as fast as possible."""

from collections import deque
from collections.abc import Callable
from math import inf

FRAME = 1 / 60
"""Seconds between two iterations of the loop and two pose messages."""
BEHIND = 0.1
"""Maximum delay of the simulation behind the clock that it catches up [s]."""
BUSY = 0.75
"""Share of an iteration that is spent on steps without a real-time limit."""
MARKS = 10
"""Status messages over which the real-time factor is measured."""


class ClockRate:
    """Computes the number of steps per iteration.

    Args:
        dt: length of a step [s].
        clock: wall clock [s].

    Attributes:
        factor: simulated seconds per second; infinite for as fast as possible.
        looked: seconds of the last iteration that were spent on sensor views; steps may catch them up.
    """

    def __init__(self, dt: float, clock: Callable[[], float]) -> None:
        self._dt, self._clock = dt, clock
        self.factor = 1.0
        self.looked = 0.0
        self._start = (0.0, 0.0)
        self._cost = 0.0
        self._marks: deque[tuple[float, float]] = deque(maxlen=MARKS)

    def begin(self, t: float) -> None:
        """Synchronize with the clock from simulated time `t` [s] on."""
        self._start = self._clock(), t

    def restart(self, t: float) -> None:
        """Synchronize from `t` [s] on, and restart the measurement of the factor."""
        self._marks.clear()
        self.begin(t)

    def steps(self, t: float) -> int:
        """Return the number of steps to take now, at simulated time `t` [s]."""
        if self.factor == inf:
            return max(1, round(BUSY * FRAME / self._cost)) if self._cost > 0 else 1
        wall, begun = self._start
        behind = (self._clock() - wall) * self.factor - (t - begun)
        limit = (BEHIND + self.looked) * self.factor  # the time of sensor views may be caught up
        steps = round(min(behind, limit) / self._dt)
        if self._cost > 0:
            steps = min(steps, max(1, round(BEHIND / self._cost)))
        self._late = behind > limit
        return max(0, steps)

    def wait(self, t: float) -> float:
        """Return the seconds until the next step is due, at simulated time `t` [s]; zero without a real-time limit."""
        wall, begun = self._start
        return 0.0 if self.factor == inf else (t - begun + 0.5 * self._dt) / self.factor - (self._clock() - wall)

    def took(self, steps: int, seconds: float, t: float) -> None:
        """Record the duration of steps; synchronize again where they took too long."""
        if steps > 0:
            self._cost = seconds / steps
        if self.factor != inf and self._late:
            self.begin(t)

    def mark(self, t: float) -> None:
        """Record simulated time [s] for the real-time factor."""
        self._marks.append((self._clock(), t))

    @property
    def real_time_factor(self) -> float:
        """Measured simulated seconds per second."""
        if not self._marks:
            return 1.0
        (wall, t), (now, reached) = self._marks[0], self._marks[-1]
        return max(0.0, (reached - t) / (now - wall)) if now > wall else 1.0
