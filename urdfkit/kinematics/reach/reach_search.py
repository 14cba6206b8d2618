"""Search for configurations that place the tip at the poses of a grid, each from solutions of its neighbours.

Random configurations are sorted into the grid and start the first descents. Each solution starts descents for the same
orientation in the six next cells, and for the most similar orientations in its own cell, until no more poses are
reached. The other poses of cells with any solution or random configuration are tried from random starts; their
solutions spread again.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import KinematicsError
from urdfkit.kinematics.chain import Chain
from urdfkit.kinematics.reach.pose_grid import Indices, PoseGrid
from urdfkit.linear_algebra import Array, rotations

SAMPLES = 400_000
"""Random configurations."""
BLOCK = 50_000
"""Configurations or poses per call of the kernel."""
ATTEMPTS = 5
"""Random starts for each pose that no solution of a neighbour leads to."""
SIMILAR = 2
"""Orientations of the same cell that a solution is tried for."""
MARGIN = 0.05
"""Part of the extent of the samples that the grid is larger by on each side, in addition to two cells."""
MOST_POSES = 30_000_000
"""Poses of the grid at most; each solution is stored."""

Progress = Callable[[str], None]
Filter = Callable[[Array], NDArray[np.bool_]]


class ReachSearch:
    """Search for configurations at the poses of a grid.

    Args:
        chain: the chain.
        resolution: edge of a cell [m].
        orientations: quaternions x y z w; shape (N, 4).
        position_only: ignore the orientation.
        tolerance: distance [m] and angle [rad] within which a pose is reached.
        seed: of all random numbers.
        threads: number of threads; that of the processors when None.
        accepts: returns for configurations (K, n) which of them count; all when None.
        progress: called with the state of the search in words.

    Raises:
        KinematicsError: the grid has too many poses.

    Attributes:
        grid: the poses.
        reached: whether each pose is reached; shape (P,).
        q: a configuration for each pose that is reached; shape (P, n).
    """

    def __init__(
        self,
        chain: Chain,
        resolution: float,
        orientations: Array,
        *,
        position_only: bool,
        tolerance: tuple[float, float],
        seed: int,
        threads: int | None,
        accepts: Filter | None,
        progress: Progress,
    ) -> None:
        self.chain, self._position_only, self._tolerance = chain, position_only, tolerance
        self._seed, self._threads, self._accepts, self._progress = seed, threads, accepts, progress
        samples = self._samples()
        positions = [chain.forward(part)[:, :3, 3] for part in np.array_split(samples, SAMPLES // BLOCK)]
        self.grid = _grid_around(np.concatenate(positions), resolution, orientations)
        self.reached = np.zeros(self.grid.poses, dtype=bool)
        self.q = np.zeros((self.grid.poses, samples.shape[1]))
        self._near = np.zeros(self.grid.cells, dtype=bool)
        self._run(samples)

    def _samples(self) -> Array:
        """Return random configurations within the limits; shape (SAMPLES, n)."""
        limits = np.array(self.chain.serial.limits).reshape(-1, 6)
        start = self.chain.configuration()
        offset = np.where(limits[:, 4] > 0.0, start, 0.0)  # the range is relative to the start
        random = np.random.default_rng(self._seed)
        return random.uniform(limits[:, 2] + offset, limits[:, 3] + offset, (SAMPLES, len(start)))

    def _run(self, samples: Array) -> None:
        self._progress("sorting random configurations")
        poses, rows = self._nearest_samples(samples)
        self._spread(self._solve(poses, samples[rows]))
        count = len(self.grid.orientations)
        random = np.random.default_rng([self._seed, 1])
        for attempt in range(ATTEMPTS):
            near = np.repeat(self._near | self.reached.reshape(-1, count).any(axis=1), count)
            rest = np.flatnonzero(near & ~self.reached)
            starts = random.integers(0, len(samples), len(rest))
            found = [rest[:0]]
            for first in range(0, len(rest), BLOCK):
                self._progress(f"attempt {attempt + 1} of {ATTEMPTS}: {len(rest) - first:,} poses left to try")
                part = slice(first, first + BLOCK)
                found.append(self._solve(rest[part], samples[starts[part]]))
            self._spread(np.concatenate(found))

    def _nearest_samples(self, samples: Array) -> tuple[Indices, Indices]:
        """Return the poses that are the most similar of their cell to any sample, and the best sample of each."""
        grid, found = self.grid, []
        turns = rotations(grid.orientations).reshape(-1, 9)
        for first in range(0, len(samples), BLOCK):
            tips = self.chain.forward(samples[first : first + BLOCK])
            cells = grid.cell_of(tips[:, :3, 3])
            self._near[cells] = True
            traces = np.einsum("ki,oi->ko", np.ascontiguousarray(tips[:, :3, :3]).reshape(-1, 9), turns)
            best = np.argmax(traces, axis=1)
            angles = np.arccos(np.clip(0.5 * (traces[np.arange(len(tips)), best] - 1.0), -1.0, 1.0))
            offsets = np.sqrt(np.sum((tips[:, :3, 3] - grid.centres(cells)) ** 2, axis=1))
            found.append((cells * len(turns) + best, angles + 2.0 * offsets))
        poses, costs = (np.concatenate(part) for part in zip(*found, strict=True))
        order = np.lexsort((costs, poses))
        kept = order[np.diff(poses[order], prepend=-1) > 0]
        return poses[kept], kept

    def _spread(self, new: Indices) -> None:
        """Start from each new solution for its neighbours, then from theirs, until no more poses are reached."""
        grid = self.grid
        similar = _similar(grid.orientations)
        while len(new):
            self._progress(f"{self.reached.sum():,} poses reached")
            found = []
            for side in range(6 + similar.shape[1]):
                if side < 6:
                    sources, poses = grid.neighbours(new, side)
                else:
                    cells, turns = np.divmod(new, len(grid.orientations))
                    sources, poses = np.arange(len(new)), cells * len(grid.orientations) + similar[turns, side - 6]
                left = np.flatnonzero(~self.reached[poses])
                unique, index = np.unique(poses[left], return_index=True)
                found.append(self._solve(unique, self.q[new[sources[left[index]]]]))
            new = np.concatenate(found)

    def _solve(self, poses: Indices, seeds: Array) -> Indices:
        """Solve poses, store the solutions, and return the poses that are reached."""
        reached = []
        for first in range(0, len(poses), BLOCK):
            part = poses[first : first + BLOCK]
            solutions = self.chain.solve(
                self.grid.targets(part),
                seeds[first : first + BLOCK],
                position_only=self._position_only,
                tolerance=self._tolerance,
                restarts=0,
                seed=self._seed,
                threads=self._threads,
                approach=False,
            )
            hits = np.flatnonzero(solutions.reached)
            if self._accepts is not None and len(hits):
                hits = hits[self._accepts(solutions.q[hits])]
            self.q[part[hits]] = solutions.q[hits]
            self.reached[part[hits]] = True
            reached.append(part[hits])
        return np.concatenate(reached) if reached else poses[:0]


def _grid_around(positions: Array, resolution: float, orientations: Array) -> PoseGrid:
    """Return the grid around the positions of samples."""
    low, high = positions.min(axis=0), positions.max(axis=0)
    margin = 2.0 * resolution + MARGIN * (high - low)
    ends = [np.floor((low - margin) / resolution), np.ceil((high + margin) / resolution)]
    counts = ends[1] - ends[0]
    poses = float(np.prod(counts)) * len(orientations)
    if poses > MOST_POSES:
        raise KinematicsError(
            f"a map of {poses:.2g} poses ({' × '.join(f'{count:.0f}' for count in counts)} cells × {len(orientations)} "
            f"orientations) exceeds {MOST_POSES:.2g}; use a coarser resolution than {resolution:g} m"
        )
    x, y, z = (int(count) for count in counts)
    return PoseGrid(ends[0].astype(np.int64), (x, y, z), resolution, orientations)


def _similar(orientations: Array) -> NDArray[np.intp]:
    """Return the indices of the most similar other orientations of each; shape (N, at most SIMILAR)."""
    similarity = np.abs(np.einsum("ik,jk->ij", orientations, orientations))
    np.fill_diagonal(similarity, -1.0)
    return np.argsort(-similarity, axis=1, kind="stable")[:, : min(SIMILAR, len(orientations) - 1)]
