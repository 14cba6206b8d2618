"""PoseGrid: poses of a tip at the centres of the cells of a grid, each in every orientation."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array

Indices = NDArray[np.intp]


@dataclass(frozen=True)
class PoseGrid:
    """Poses by index: cell after cell in C order, in each cell one orientation after the other.

    Attributes:
        first: number of the first cell by axis; cell zero begins at the origin of the base; shape (3,).
        shape: number of cells by axis.
        resolution: edge of a cell [m].
        orientations: quaternions x y z w; shape (N, 4).
    """

    first: NDArray[np.int64]
    shape: tuple[int, int, int]
    resolution: float
    orientations: Array

    @property
    def cells(self) -> int:
        """Number of cells."""
        return int(np.prod(self.shape))

    @property
    def poses(self) -> int:
        """Number of poses."""
        return self.cells * len(self.orientations)

    @property
    def origin(self) -> Array:
        """Corner with the smallest coordinates [m]; shape (3,)."""
        return np.asarray((self.resolution * self.first).round(12))

    def centres(self, cells: Indices) -> Array:
        """Return the centres of cells [m]; shape (K, 3)."""
        place = np.stack(np.unravel_index(cells, self.shape), axis=1)
        return np.asarray(self.resolution * (place + self.first + 0.5))

    def targets(self, poses: Indices) -> Array:
        """Return poses as x y z and quaternion x y z w; shape (K, 7)."""
        cells, turns = np.divmod(poses, len(self.orientations))
        return np.concatenate([self.centres(cells), self.orientations[turns]], axis=1)

    def cell_of(self, positions: Array) -> Indices:
        """Return the cells that contain positions within the grid; shape (K,)."""
        place = np.floor(positions / self.resolution).astype(np.int64) - self.first
        return np.asarray(np.ravel_multi_index(tuple(place.T), self.shape), dtype=np.intp)

    def neighbours(self, poses: Indices, side: int) -> tuple[Indices, Indices]:
        """Return which of these poses have a neighbour of the same orientation on a side, and the neighbours.

        Args:
            poses: their indices; shape (K,).
            side: 0 to 5: behind and before along x, along y, along z.
        """
        cells, turns = np.divmod(poses, len(self.orientations))
        place = np.stack(np.unravel_index(cells, self.shape), axis=1)
        axis, step = side // 2, 1 - 2 * (side % 2)
        place[:, axis] += step
        inside = np.flatnonzero((place[:, axis] >= 0) & (place[:, axis] < self.shape[axis]))
        moved = np.ravel_multi_index(tuple(place[inside].T), self.shape)
        return inside, (moved * len(self.orientations) + turns[inside]).astype(np.intp)
