"""How far joints may be off a trajectory and its end: joint_trajectory_controller's ``constraints`` and those of goals.

Sources: ros_controllers noetic and ros2_controllers, joint_trajectory_controller, tolerances.h(pp). Zero is no check.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from urdfkit.description.control import Settings

Array = NDArray[np.float64]

STOPPED = 0.01
"""Default ``stopped_velocity_tolerance`` [rad/s] or [m/s]."""


@dataclass(frozen=True)
class Tolerances:
    """Of one trajectory.

    Attributes:
        names: the joints.
        path: how far each may be off on the way [rad] or [m]; shape (n,).
        goal: how far each may be off at the end; shape (n,).
        stopped: how fast each may be at the end [rad/s] or [m/s]; shape (n,).
        time: how long after the end it may take to be there [s].
    """

    names: Sequence[str]
    path: Array
    goal: Array
    stopped: Array
    time: float

    @classmethod
    def read(cls, settings: Settings, names: Sequence[str]) -> Tolerances:
        """Read a controller's ``constraints``.

        Raises:
            DescriptionError: one is no finite number.
        """
        group = settings.group("constraints")

        def each(which: str) -> Array:
            return np.array([group.number(f"{name}/{which}", 0.0) for name in names])

        stopped = group.number("stopped_velocity_tolerance", STOPPED)
        return cls(
            names, each("trajectory"), each("goal"), np.full(len(names), stopped), group.number("goal_time", 0.0)
        )

    def of(self, goal: Any) -> Tolerances:
        """Return those of a goal (FollowJointTrajectoryGoal): what it says is greater or (negative) lifted, else these.

        Raises:
            ValueError: it names a joint that is not there.
        """
        path, end, stopped = self.path.copy(), self.goal.copy(), self.stopped.copy()
        for written, place, pace in ((goal.path_tolerance, path, None), (goal.goal_tolerance, end, stopped)):
            for entry in written:
                if entry.name not in self.names:
                    raise ValueError(f"no joint `{entry.name}` here to be off by a tolerance")
                at = list(self.names).index(entry.name)
                for value, array in ((entry.position, place), (entry.velocity, pace)):
                    if array is not None and value != 0.0:
                        array[at] = max(0.0, value)
        given = goal.goal_time_tolerance.sec + 1e-9 * goal.goal_time_tolerance.nanosec
        return replace(self, path=path, goal=end, stopped=stopped, time=max(0.0, given) if given else self.time)

    def strays(self, off: Array) -> str | None:
        """Return the first joint that is too far off its way, and by how much; None for none."""
        return self._first(off, self.path)

    def misses(self, off: Array, speed: Array) -> str | None:
        """Return the first joint that is not at the end, or not at rest there; None for none."""
        return self._first(off, self.goal) or self._first(speed, self.stopped)

    def _first(self, off: Array, most: Array) -> str | None:
        for name, value, allowed in zip(self.names, np.abs(off).tolist(), most.tolist(), strict=True):
            if allowed > 0.0 and value > allowed:
                return f"joint `{name}` is off by {value:.3g}, more than {allowed:g}"
        return None
