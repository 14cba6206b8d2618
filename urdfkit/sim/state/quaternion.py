"""Unit quaternions x y z w on plain floats, which are faster than numpy for single poses."""

from math import asin, atan2, cos, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

NOWHERE = np.zeros(3)
"""Placeholder for the translation of a pose of which only the rotation is used."""


def rotate(quaternion: Any, vector: Any) -> tuple[float, float, float]:
    """Return v + 2w(u × v) + 2u × (u × v), the vector rotated by the unit quaternion (u, w)."""
    x, y, z, w = map(float, quaternion)
    a, b, c = map(float, vector)
    tx, ty, tz = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
    return a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx


def product(first: Any, second: Any) -> tuple[float, float, float, float]:
    """Return the Hamilton product of two quaternions x y z w."""
    ax, ay, az, aw = map(float, first)
    bx, by, bz, bw = map(float, second)
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def from_rpy(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """Return the quaternion x y z w of fixed-axis roll, pitch, yaw [rad]."""
    about_x = (sin(roll / 2), 0.0, 0.0, cos(roll / 2))
    about_y = (0.0, sin(pitch / 2), 0.0, cos(pitch / 2))
    about_z = (0.0, 0.0, sin(yaw / 2), cos(yaw / 2))
    return product(about_z, product(about_y, about_x))


def from_matrix(R: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the quaternion x y z w of a rotation matrix, shape (4,).

    ``pin.Quaternion(R)`` leaks 80 bytes per call (Pinocchio 4.1), so it must not run in every step or message.
    """
    import pinocchio as pin

    return np.array(pin.SE3ToXYZQUAT(pin.SE3(np.ascontiguousarray(R), NOWHERE))[3:])


def to_rpy(quaternion: Any) -> tuple[float, float, float]:
    """Return fixed-axis roll, pitch, yaw [rad] of a unit quaternion x y z w."""
    x, y, z, w = map(float, quaternion)
    roll = atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    return roll, pitch, yaw_of((x, y, z, w))


def yaw_of(quaternion: Any) -> float:
    """Return the yaw [rad] of a unit quaternion x y z w, as in fixed-axis roll, pitch, yaw."""
    x, y, z, w = quaternion
    return atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
