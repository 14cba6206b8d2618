"""Values of a recording over time: transforms of frames, joint positions, and odometry."""

from bisect import bisect_right

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Timeline:
    """Values at increasing times.

    Args:
        length: number of values that are kept; None for all.
    """

    def __init__(self, length: int | None = None) -> None:
        self._length = length
        self._times: list[float] = []
        self._values: list[tuple[float, ...]] = []

    def add(self, time: float, value: tuple[float, ...]) -> None:
        """Add a value in the order of times; it replaces a value of the same time."""
        k = len(self._times)
        if k and time <= self._times[-1]:
            k = bisect_right(self._times, time)
            if self._times[k - 1] == time and k:
                self._values[k - 1] = value
                return
        self._times.insert(k, time)
        self._values.insert(k, value)
        if self._length is not None and len(self._times) > self._length:
            del self._times[0], self._values[0]

    def at(self, time: float) -> Array:
        """Return the value at a time, linear between the neighbours; the first one before it, the last one after it."""
        k = bisect_right(self._times, time)
        if k == 0:
            return np.array(self._values[0])
        before = np.array(self._values[k - 1])
        if k == len(self._times) or time == self._times[k - 1]:
            return before
        after = np.array(self._values[k])
        begin, end = self._times[k - 1], self._times[k]
        part = (time - begin) / (end - begin)
        if len(before) == 7 and before[3:] @ after[3:] < 0.0:
            after[3:] = -after[3:]  # the shorter rotation
        return np.asarray(before + part * (after - before))


class PoseTimeline(Timeline):
    """Poses x y z [m] and quaternions x y z w; between two of them, quaternions are interpolated and normalized."""

    def at(self, time: float) -> Array:
        """Return the pose at a time; shape (7,)."""
        pose = super().at(time)
        size = float(np.sqrt(np.square(pose[3:]).sum()))
        pose[3:] = pose[3:] / size if size > 0.0 else (0.0, 0.0, 0.0, 1.0)
        return pose
