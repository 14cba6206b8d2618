"""Path and goal tolerances of a trajectory: joint_trajectory_controller's ``constraints`` and tolerances of goals.

Sources: ros_controllers noetic and ros2_controllers, joint_trajectory_controller, tolerances.h(pp). A tolerance of zero
disables the check.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from urdfkit.description.control import Settings
from urdfkit.linear_algebra import Array

STOPPED = 0.01
"""Default ``stopped_velocity_tolerance`` [rad/s] or [m/s]."""


@dataclass(frozen=True)
class Tolerances:
    """Tolerances of one trajectory.

    Attributes:
        names: names of the joints.
        path: greatest position error during the trajectory [rad] or [m]; shape (n,).
        goal: greatest position error at the end [rad] or [m]; shape (n,).
        stopped: greatest velocity at the end [rad/s] or [m/s]; shape (n,).
        time: time allowed after the end to reach the goal [s].
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
            DescriptionError: a tolerance is not a finite number.
        """
        group = settings.group("constraints")

        def each(which: str) -> Array:
            return np.array([group.number(f"{name}/{which}", 0.0) for name in names])

        stopped = group.number("stopped_velocity_tolerance", STOPPED)
        return cls(
            names, each("trajectory"), each("goal"), np.full(len(names), stopped), group.number("goal_time", 0.0)
        )

    def of(self, goal: Any) -> Tolerances:
        """Return the tolerances for a FollowJointTrajectoryGoal.

        Values of the goal other than zero override these tolerances; a negative value disables the check.

        Raises:
            ValueError: the goal names an unknown joint.
        """
        path, end, stopped = self.path.copy(), self.goal.copy(), self.stopped.copy()
        for written, place, pace in ((goal.path_tolerance, path, None), (goal.goal_tolerance, end, stopped)):
            for entry in written:
                if entry.name not in self.names:
                    raise ValueError(f"unknown joint `{entry.name}` in the tolerances")
                at = list(self.names).index(entry.name)
                for value, array in ((entry.position, place), (entry.velocity, pace)):
                    if array is not None and value != 0.0:
                        array[at] = max(0.0, value)
        time = goal.goal_time_tolerance.sec + 1e-9 * goal.goal_time_tolerance.nanosec
        return replace(self, path=path, goal=end, stopped=stopped, time=max(0.0, time) if time else self.time)

    def strays(self, off: Array) -> str | None:
        """Return a description of the first violation of the path tolerances; None without one."""
        return self._first(off, self.path)

    def misses(self, off: Array, speed: Array) -> str | None:
        """Return a description of the first violation of the goal tolerances; None without one."""
        return self._first(off, self.goal) or self._first(speed, self.stopped)

    def _first(self, off: Array, most: Array) -> str | None:
        for name, value, allowed in zip(self.names, np.abs(off).tolist(), most.tolist(), strict=True):
            if allowed > 0.0 and value > allowed:
                return f"joint `{name}` is off by {value:.3g}, more than {allowed:g}"
        return None
