"""Orientations of a tip: spread evenly over all rotations, or with an axis of the tip within a cone."""

import math

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.errors import KinematicsError
from urdfkit.linear_algebra import Array, vector_norm

PSI = 1.533751168755204288118041
"""Irrational number of the spiral: the real root of ψ⁴ = ψ + 4."""
GOLDEN = 0.5 * (1.0 + math.sqrt(5.0))


def uniform_orientations(number: int) -> Array:
    """Return quaternions x y z w spread evenly over all rotations; shape (N, 4).

    Source: Alexa, Super-Fibonacci spirals: fast, low-discrepancy sampling of SO(3), 2022.
    """
    s = np.arange(_checked(number)) + 0.5
    inner, outer = np.sqrt(s / number), np.sqrt(1.0 - s / number)
    first, second = 2.0 * np.pi * s / math.sqrt(2.0), 2.0 * np.pi * s / PSI
    parts = (inner * np.sin(first), inner * np.cos(first), outer * np.sin(second), outer * np.cos(second))
    return np.stack(parts, axis=1)


def cone_orientations(number: int, axis: ArrayLike, degrees: float, tool_axis: ArrayLike = (0.0, 0.0, 1.0)) -> Array:
    """Return quaternions x y z w that turn the tool axis into a cone, about which they turn evenly; shape (N, 4).

    Args:
        number: N.
        axis: of the cone, in the base; shape (3,).
        degrees: half of the opening angle of the cone [°], 0 to 180.
        tool_axis: axis of the tip; shape (3,).

    Raises:
        KinematicsError: an axis is zero, or the angle is not between 0 and 180°.
    """
    if not 0.0 <= degrees <= 180.0:
        raise KinematicsError(f"a cone of {degrees:g}°: the angle must be between 0 and 180")
    index = np.arange(_checked(number))
    # Fibonacci's lattice on the cap, and a second irrational number for the turn about the tool axis.
    height = 1.0 - (1.0 - math.cos(math.radians(degrees))) * (index + 0.5) / number
    around = 2.0 * np.pi * index / GOLDEN
    ring = np.sqrt(np.maximum(0.0, 1.0 - height * height))
    local = np.stack([ring * np.cos(around), ring * np.sin(around), height], axis=1)
    turn = 2.0 * np.pi * (index / number if degrees == 0.0 else index / PSI)
    forward = np.array([0.0, 0.0, 1.0])
    rolls = np.stack([0.0 * turn, 0.0 * turn, np.sin(0.5 * turn), np.cos(0.5 * turn)], axis=1)
    tilts = np.array([_between(forward, direction) for direction in local])
    towards, from_tool = _between(forward, _unit(axis)), _between(_unit(tool_axis), forward)
    return _product(_product(_product(towards[None], tilts), rolls), from_tool[None])


def down_orientations(number: int, tool_axis: ArrayLike = (0.0, 0.0, 1.0)) -> Array:
    """Return quaternions x y z w that turn the tool axis to -z of the base, in even turns about it; shape (N, 4)."""
    return cone_orientations(number, (0.0, 0.0, -1.0), 0.0, tool_axis)


def _checked(number: int) -> int:
    if number < 1:
        raise KinematicsError(f"{number} orientations: at least one is needed")
    return number


def _unit(axis: ArrayLike) -> Array:
    vector = np.asarray(axis, dtype=float)
    if vector.shape != (3,) or not np.isfinite(vector).all() or not vector.any():
        raise KinematicsError(f"the axis {np.asarray(axis).tolist()} must have three finite numbers, not all zero")
    return np.asarray(vector / vector_norm(vector))


def _between(first: Array, second: Array) -> Array:
    """Return the quaternion of the smallest turn from one unit vector to another."""
    cosine = float(np.einsum("i,i->", first, second))
    if cosine < -1.0 + 1e-12:  # half a turn about any normal
        normal = np.cross(first, np.eye(3)[int(np.argmin(np.abs(first)))])
        return np.array([*normal / vector_norm(normal), 0.0])
    numbers = np.array([*np.cross(first, second), 1.0 + cosine])
    return np.asarray(numbers / vector_norm(numbers))


def _product(first: Array, second: Array) -> Array:
    """Return products of quaternions x y z w; shape (N, 4)."""
    x, y, z, w = first.T
    a, b, c, d = second.T
    return np.stack(
        [
            w * a + x * d + y * c - z * b,
            w * b - x * c + y * d + z * a,
            w * c + x * b - y * a + z * d,
            w * d - x * a - y * b - z * c,
        ],
        axis=1,
    )
