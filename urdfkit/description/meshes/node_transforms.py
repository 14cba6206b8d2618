"""Transforms of the nodes of a mesh file."""

from __future__ import annotations

from math import cos, radians, sin, sqrt
from typing import NamedTuple

from urdfkit.description.meshes.points import UnusualFileError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.description.meshes.points import Corners

_ZERO = 1e-6
"""Largest magnitude of an entry, relative to the largest of its row, that is a rounding error."""
_UNIT = 1e-4
"""Largest deviation of the length of a unit vector in a file."""


class AffineTransform(NamedTuple):
    """An affine transform: three rows of a 3 × 3 matrix and an offset."""

    rows: tuple[tuple[float, ...], ...]

    @classmethod
    def identity(cls) -> AffineTransform:
        """Return the transform that changes nothing."""
        return cls(((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0)))

    @classmethod
    def of_rows(cls, rows: Sequence[Sequence[float]]) -> AffineTransform:
        """Return a transform from its three rows of four numbers."""
        return cls(tuple(tuple(row) for row in rows))

    @classmethod
    def turned(cls, axis: Sequence[float], degrees: float) -> AffineTransform:
        """Return a rotation about an axis by an angle [°].

        Raises:
            UnusualFileError: the axis is not a unit vector; readers differ in what they do then.
        """
        if abs(sqrt(sum(part * part for part in axis)) - 1.0) > _UNIT:
            raise UnusualFileError
        x, y, z = axis
        c, s = cos(radians(degrees)), sin(radians(degrees))
        t = 1.0 - c
        return cls(
            (
                (t * x * x + c, t * x * y - s * z, t * x * z + s * y, 0.0),
                (t * x * y + s * z, t * y * y + c, t * y * z - s * x, 0.0),
                (t * x * z - s * y, t * y * z + s * x, t * z * z + c, 0.0),
            )
        )

    def __matmul__(self, inner: AffineTransform) -> AffineTransform:
        return AffineTransform(
            tuple(
                tuple(
                    sum(row[k] * inner.rows[k][column] for k in range(3)) + (row[3] if column == 3 else 0.0)
                    for column in range(4)
                )
                for row in self.rows
            )
        )


def moved(box: Corners, transform: AffineTransform) -> Corners:
    """Return a bounding box after a transform.

    Raises:
        UnusualFileError: the transform turns it by an angle that is not a multiple of 90°; the box is not enough then.
    """
    low, high = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for axis, row in enumerate(transform.rows):
        largest = max(abs(part) for part in row[:3])
        used = [k for k in range(3) if abs(row[k]) > _ZERO * largest]
        if len(used) > 1:
            raise UnusualFileError
        ends = [sum(row[k] * corner[k] for k in range(3)) + row[3] for corner in box]
        low[axis], high[axis] = min(ends), max(ends)
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])
