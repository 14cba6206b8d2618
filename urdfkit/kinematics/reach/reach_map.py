"""ReachMap: the share of orientations that the tip of a chain reaches, by cell of a grid."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.errors import KinematicsError
from urdfkit.kinematics.chain import TOLERANCE, Chain
from urdfkit.kinematics.reach.orientations import uniform_orientations
from urdfkit.kinematics.reach.reach_search import BLOCK, Progress, ReachSearch
from urdfkit.kinematics.self_collision.configuration_check import ConfigurationCheck
from urdfkit.linear_algebra import Array

ORIENTATIONS = 50
RESOLUTION = 0.05


@dataclass(frozen=True)
class ReachMap:
    """Share of the orientations that a tip reaches at the centre of each cell of a grid.

    Attributes:
        base: name of the base link, in whose axes the grid lies.
        tip: name of the link whose poses are reached.
        joint_names: see `Chain`.
        origin: corner of the grid with the smallest coordinates [m]; shape (3,).
        resolution: edge of a cell [m]; the centre of the cell (i, j, k) is at ``origin + resolution * (i + ½, …)``.
        orientations: quaternions x y z w of the tip in the base; shape (N, 4).
        score: share of the orientations that are reached; shape (nx, ny, nz).
        manipulability: largest √det(J·Jᵀ) of the configurations in `q`, 0 without any; shape (nx, ny, nz).
        reached: whether each orientation is reached; shape (nx, ny, nz, N).
        q: a configuration for each pose that is reached, zeros elsewhere; shape (nx, ny, nz, N, n).

    Examples:
        >>> from urdfkit.kinematics import Chain, reach_map
        >>> found = reach_map(Chain("seven_dof_arm", None, "grasping_frame"), resolution=0.3, orientations=4)
        >>> found.score.shape == found.centres().shape[:3], float(found.score.max())
        (True, 0.5)
    """

    base: str
    tip: str
    joint_names: tuple[str, ...]
    origin: Array
    resolution: float
    orientations: Array
    score: Array
    manipulability: Array
    reached: NDArray[np.bool_] = field(repr=False)
    q: Array = field(repr=False)

    def centres(self) -> Array:
        """Return the centres of the cells [m]; shape (nx, ny, nz, 3)."""
        place = np.moveaxis(np.indices(self.score.shape), 0, -1)
        return np.asarray(self.origin + self.resolution * (place + 0.5))


def reach_map(
    chain: Chain,
    *,
    resolution: float = RESOLUTION,
    orientations: int | ArrayLike = ORIENTATIONS,
    position_only: bool = False,
    collision_free: bool = False,
    tolerance: tuple[float, float] = TOLERANCE,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress = lambda text: None,
) -> ReachMap:
    """Return which share of orientations the tip of a chain reaches, by cell of a grid around all it reaches.

    The map is the same for any number of threads.

    Args:
        chain: the chain.
        resolution: edge of a cell [m].
        orientations: a number of orientations spread evenly over all rotations, or quaternions x y z w, shape (N, 4).
        position_only: ignore the orientation; the score is 1 where the position is reached, else 0.
        collision_free: count configurations only in which no links collide; see `ConfigurationCheck` for the pairs that
            are checked.
        tolerance: distance [m] and angle [rad] within which a pose is reached.
        seed: of all random numbers.
        threads: number of threads; that of the processors when None.
        progress: called with the state of the search in words.

    Raises:
        KinematicsError: a resolution that is not above zero, invalid orientations, or a map that is too large.
        ResourceError: `collision_free` is set, and a mesh cannot be read.

    Examples:
        >>> from urdfkit.kinematics import Chain, reach_map
        >>> arm = Chain("seven_dof_arm", None, "grasping_frame")
        >>> found = reach_map(arm, resolution=0.3, position_only=True)
        >>> float(found.score.max())
        1.0
    """
    if not 0.0 < resolution < np.inf:
        raise KinematicsError(f"the resolution is {resolution:g} m; it must be above zero")
    turns = _quaternions(1 if position_only else orientations)
    accepts = None
    if collision_free:
        accepts = ConfigurationCheck(chain.robot, chain.joint_names, chain.serial.hold).free
    search = ReachSearch(
        chain,
        resolution,
        turns,
        position_only=position_only,
        tolerance=tolerance,
        seed=seed,
        threads=threads,
        accepts=accepts,
        progress=progress,
    )
    grid, count = search.grid, len(turns)
    reached = search.reached.reshape(*grid.shape, count)
    box = _box(np.asarray(reached.any(axis=-1)))
    return ReachMap(
        chain.base,
        chain.tip,
        chain.joint_names,
        (grid.origin + resolution * np.array([part.start for part in box])).round(12),
        resolution,
        turns,
        reached[box].mean(axis=-1),
        _manipulability(search, position_only=position_only).reshape(grid.shape)[box].copy(),
        reached[box].copy(),
        search.q.reshape(*grid.shape, count, -1)[box],
    )


def _quaternions(orientations: int | ArrayLike) -> Array:
    """Return unit quaternions; shape (N, 4)."""
    if isinstance(orientations, int):
        return uniform_orientations(orientations)
    turns = np.array(orientations, dtype=float)
    if turns.ndim != 2 or turns.shape[1] != 4 or not len(turns):
        raise KinematicsError(f"orientations have the shape (N, 4); got {turns.shape}")
    lengths = np.sqrt(np.einsum("ni,ni->n", turns, turns))
    if not (np.isfinite(lengths) & (lengths > 1e-9)).all():
        raise KinematicsError("orientations are finite quaternions x y z w, not zero")
    return np.asarray(turns / lengths[:, None])


def _box(cells: NDArray[np.bool_]) -> tuple[slice, ...]:
    """Return the smallest box around marked cells; the first cell if no cell is marked."""
    box = []
    for axis in range(3):
        marked = np.flatnonzero(cells.any(axis=tuple({0, 1, 2} - {axis})))
        box.append(slice(int(marked[0]), int(marked[-1]) + 1) if len(marked) else slice(0, 1))
    return tuple(box)


def _manipulability(search: ReachSearch, *, position_only: bool) -> Array:
    """Return the largest manipulability of each cell; shape (cells,)."""
    poses = np.flatnonzero(search.reached)
    values = np.zeros(search.grid.cells)
    for first in range(0, len(poses), BLOCK):
        part = poses[first : first + BLOCK]
        found = search.chain.manipulability(search.q[part], position_only=position_only)
        np.maximum.at(values, part // len(search.grid.orientations), found)
    return values
