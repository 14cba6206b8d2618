"""Trajectories through waypoints: linear, cubic or quintic splines.

The degree depends on the waypoints, as in joint_trajectory_controller: linear for positions only, cubic for positions
and velocities, quintic for positions, velocities and accelerations (ros_controllers noetic,
trajectory_interface/quintic_spline_segment.h).
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from urdfkit.linear_algebra import Array, matmul

ROUNDING = 1e-9
"""Tolerance within which two times are equal [s]."""


@dataclass(frozen=True)
class Waypoint:
    """Desired state of the joints at a time.

    Attributes:
        t: simulated time [s].
        positions: [rad] or [m]; shape (n,).
        velocities: [rad/s] or [m/s]; None if not specified.
        accelerations: [rad/s²] or [m/s²]; None if not specified.
    """

    t: float
    positions: Array
    velocities: Array | None = None
    accelerations: Array | None = None


class Trajectory:
    """Spline through waypoints.

    Args:
        waypoints: at least one, in the order of their times; the first one is the start.
        before: trajectory before the first waypoint; None to rest at the first waypoint.
    """

    def __init__(self, waypoints: list[Waypoint], before: Trajectory | None = None) -> None:
        self.waypoints = waypoints
        self.before = before
        self._times = [point.t for point in waypoints]
        self._segments = [_coefficients(start, end) for start, end in pairwise(waypoints)]

    @property
    def end(self) -> float:
        """Time of the last waypoint [s]."""
        return self._times[-1]

    def at(self, t: float) -> tuple[Array, Array, Array]:
        """Return positions, velocities and accelerations at a time [s]; at rest after the end."""
        if self.before is not None and t < self._times[0]:
            return self.before.at(t)
        if t < self._times[0] or t > self.end + ROUNDING or not self._segments:
            point = self.waypoints[0] if t < self._times[0] else self.waypoints[-1]
            rest = np.zeros_like(point.positions)
            return point.positions, rest, rest
        k = min(bisect_right(self._times, t), len(self._segments)) - 1
        coefficients, s = self._segments[k], min(t, self.end) - self._times[k]
        powers = s ** np.arange(6)
        order = np.arange(1, 6)
        first = coefficients[1:] * order[:, None]
        second = first[1:] * order[:4, None]
        return matmul(powers, coefficients), matmul(powers[:5], first), matmul(powers[:4], second)


def _coefficients(start: Waypoint, end: Waypoint) -> Array:
    """Return the coefficients of the polynomial, lowest power first; shape (6, n)."""
    T = end.t - start.t
    found = np.zeros((6, len(start.positions)))
    found[0] = start.positions
    distance = end.positions - start.positions
    if T <= 0.0:
        return found
    if start.velocities is None or end.velocities is None:
        found[1] = distance / T
        return found
    v0, v1 = start.velocities, end.velocities
    found[1] = v0
    if start.accelerations is None or end.accelerations is None:
        found[2] = (3 * distance - (2 * v0 + v1) * T) / T**2
        found[3] = (-2 * distance + (v0 + v1) * T) / T**3
        return found
    a0, a1 = start.accelerations, end.accelerations
    found[2] = a0 / 2
    found[3] = (20 * distance - (8 * v1 + 12 * v0) * T - (3 * a0 - a1) * T**2) / (2 * T**3)
    found[4] = (-30 * distance + (14 * v1 + 16 * v0) * T + (3 * a0 - 2 * a1) * T**2) / (2 * T**4)
    found[5] = (12 * distance - 6 * (v1 + v0) * T + (a1 - a0) * T**2) / (2 * T**5)
    return found
