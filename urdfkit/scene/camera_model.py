"""The camera model: the direction of each pixel, with Brown's distortion."""

from dataclasses import dataclass
from functools import cached_property
from math import tan

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array

TILE = 4
"""Neighbouring pixels are neighbours among the rays: tiles of 4 × 4."""

AT_ONCE = 2**14
"""Number of directions that are computed at once."""


@dataclass(frozen=True)
class Distortion:
    """Radial (k) and tangential (p) coefficients (Brown, *Decentering Distortion of Lenses*, 1966), as OpenCV's."""

    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0

    def __bool__(self) -> bool:
        return any((self.k1, self.k2, self.p1, self.p2, self.k3))

    def distort(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Distort points of the image, in units of the focal length."""
        r2 = x * x + y * y
        radial = 1 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        return (
            x * radial + 2 * self.p1 * x * y + self.p2 * (r2 + 2 * x * x),
            y * radial + self.p1 * (r2 + 2 * y * y) + 2 * self.p2 * x * y,
        )

    def undistort(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Undistort points of the image; NaN for points to which nothing is projected."""
        a, b = x.copy(), y.copy()
        with np.errstate(over="ignore", invalid="ignore"):
            for _ in range(60):
                u, v = self.distort(a, b)
                if (np.abs(x - u) + np.abs(y - v)).max(initial=0.0) < 1e-12:
                    break
                a, b = a + (x - u), b + (y - v)
            u, v = self.distort(a, b)
            lost = ~(np.hypot(u - x, v - y) < 1e-6)
        a[lost] = b[lost] = np.nan
        return a, b


@dataclass(frozen=True)
class Lens:
    """A pinhole camera that looks along x, with z up and y to the left.

    Attributes:
        width: width of the image [px].
        height: height of the image [px].
        field_of_view: horizontal [rad].
        distortion: distortion of the lens.
    """

    width: int
    height: int
    field_of_view: float
    distortion: Distortion = Distortion()

    @property
    def focal_length(self) -> float:
        """Focal length [px]."""
        return self.width / (2.0 * tan(self.field_of_view / 2.0))

    @cached_property
    def order(self) -> NDArray[np.int64]:
        """Index of the pixel of each ray, in row-major order; shape (width · height,)."""
        found, start = np.empty(self.width * self.height, dtype=np.int64), 0
        whole = self.width - self.width % TILE
        for first in range(0, self.height, TILE):
            rows = np.arange(first, min(first + TILE, self.height))[:, None] * self.width + np.arange(self.width)
            tiles = rows[:, :whole].reshape(len(rows), -1, TILE).transpose(1, 0, 2)
            for part in (tiles.ravel(), rows[:, whole:].ravel()):
                found[start : start + len(part)] = part
                start += len(part)
        return found

    @cached_property
    def directions(self) -> Array:
        """A unit vector per ray in the camera's frame, tile by tile; shape (width · height, 3).

        The directions of pixels to which nothing is projected point backwards along x, so they see nothing.
        """
        found = np.empty((self.width * self.height, 3))
        for first in range(0, len(found), AT_ONCE):  # in blocks, because temporary arrays need several times the memory
            row, column = np.divmod(self.order[first : first + AT_ONCE], self.width)
            found[first : first + AT_ONCE] = self.towards(column.astype(float), row.astype(float))
        return found

    @property
    def lost(self) -> float:
        """Fraction of the image to which nothing is projected, 0..1, estimated from some hundreds of pixels."""
        column, row = np.meshgrid(np.linspace(0, self.width - 1, 32), np.linspace(0, self.height - 1, 32))
        return float((self.towards(column.ravel(), row.ravel())[:, 0] < 0).mean()) if self.distortion else 0.0

    def towards(self, column: Array, row: Array) -> Array:
        """Return the unit vectors towards points of the image, as `directions`; shape (n, 3).

        Args:
            column: to the right, 0 in the middle of the first pixel [px].
            row: downwards, likewise [px].
        """
        x = (column - (self.width - 1) / 2) / self.focal_length
        y = (row - (self.height - 1) / 2) / self.focal_length
        if self.distortion:
            x, y = self.distortion.undistort(x, y)
        found = np.column_stack([np.ones_like(x), -x, -y])
        found /= np.linalg.norm(found, axis=1, keepdims=True)
        found[np.isnan(found).any(axis=1)] = (-1.0, 0.0, 0.0)
        return np.ascontiguousarray(found)


def spread(samples: int) -> Array:
    """Return evenly distributed sample positions relative to the centre of a pixel [px]; shape (samples, 2).

    Source: Roberts, *The unreasonable effectiveness of quasirandom sequences* (2018), the sequence R2.
    """
    turns = np.arange(1.0, samples + 1)[:, None] * np.array((0.7548776662466927, 0.5698402909980532))
    within = turns % 1.0
    found: Array = within - within.mean(axis=0)
    return found
