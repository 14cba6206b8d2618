"""Where to put a robot, upright on the floor, so that its tip reaches poses: by its reach map, then by solving."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.errors import KinematicsError
from urdfkit.kinematics.chain import TOLERANCE, Chain
from urdfkit.kinematics.reach.reach_map import ReachMap
from urdfkit.linear_algebra import Array, rotations

TURNS = 36
"""Yaw angles of the first candidates."""
SOLVED = 30_000
"""Poses that are solved for the candidates of the map, which are then as many as this over the number of poses."""
FEWEST, MOST = 100, 2000
"""Candidates at least and at most."""
REFINED = 8
"""Candidates around which better places are searched for."""
ROUNDS = 10
"""Steps of these searches; where none of the six next places is better, the steps are halved."""
SIDE = 120
"""Places along each axis at most."""
RESTARTS = 50
"""Random starts per pose."""
MOST_POSES = 10_000


@dataclass(frozen=True)
class BasePlacement:
    """A place of the base link on the floor, and the poses that the tip reaches from there.

    Attributes:
        x: position of the base link in the frame of the poses [m].
        y: position of the base link in the frame of the poses [m].
        yaw: angle of the base link about z [rad].
        reached: whether each pose is reached; shape (N,).
        q: configurations; shape (N, n).
        manipulability: mean √det(J·Jᵀ) of the poses that are reached.
    """

    x: float
    y: float
    yaw: float
    reached: NDArray[np.bool_]
    q: Array
    manipulability: float

    @property
    def rank(self) -> tuple[int, float]:
        """The number of poses that are reached, then the manipulability: the largest is the best."""
        return int(self.reached.sum()), self.manipulability


def base_placement(
    chain: Chain,
    found: ReachMap,
    poses: ArrayLike,
    *,
    position_only: bool = False,
    collision_free: bool = False,
    tolerance: tuple[float, float] = TOLERANCE,
    seed: int = 0,
    progress: Callable[[str], None] = lambda text: None,
) -> BasePlacement:
    """Return the place of the base from which the tip reaches the most poses, with the largest manipulability.

    The base link stands upright at z = 0 of the frame of the poses. Candidates are places of a grid in several turns,
    by the number of poses whose cell and nearest orientation the map has; the poses are solved from the best of them.

    Args:
        chain: the chain of the map.
        found: the reach map.
        poses: poses of the tip in a frame with z up: x y z [m] and quaternion x y z w, shape (N, 7), or homogeneous
            matrices, shape (N, 4, 4).
        position_only: ignore the orientation.
        collision_free: count only poses that are reached without collisions between links.
        tolerance: distance [m] and angle [rad] within which a pose is reached.
        seed: of all random numbers.
        progress: called with the state of the search in words.

    Raises:
        KinematicsError: no poses, too many, or numbers that are no pose.

    Examples:
        >>> from urdfkit.kinematics import Chain, base_placement, reach_map
        >>> arm = Chain("seven_dof_arm", None, "grasping_frame")
        >>> found = reach_map(arm, resolution=0.2, orientations=10)
        >>> place = base_placement(arm, found, [[2.0, 1.0, 0.5, 0.0, 0.0, 0.0, 1.0]])
        >>> place.reached
        array([ True])
    """
    targets = _matrices(poses)
    turns = rotations(found.orientations)

    def solved(x: float, y: float, yaw: float) -> BasePlacement:
        inverse = np.linalg.inv(_base(x, y, yaw))
        solutions = chain.solve(
            inverse @ targets,
            position_only=position_only,
            tolerance=tolerance,
            restarts=RESTARTS,
            seed=seed,
            approach=False,
            collision_free=collision_free,
        )
        values = chain.manipulability(solutions.q[solutions.reached], position_only=position_only)
        mean = float(values.mean()) if len(values) else 0.0
        return BasePlacement(x, y, yaw, solutions.reached, solutions.q, mean)

    count = min(max(SOLVED // len(targets), FEWEST), MOST)
    candidates = sorted(_candidates(found, targets, turns, count), key=lambda one: -one[0])[:count]
    tried = []
    for k, (_, *place) in enumerate(candidates):
        progress(f"{k} of {len(candidates)} places tried")
        tried.append(solved(*place))
    tried.sort(key=lambda one: one.rank, reverse=True)
    step, turn = 0.5 * found.resolution, np.pi / TURNS
    return max((_refined(one, solved, step, turn) for one in tried[:REFINED]), key=lambda one: one.rank)


def _refined(
    best: BasePlacement, solved: Callable[[float, float, float], BasePlacement], step: float, turn: float
) -> BasePlacement:
    """Return the best place around one [m and rad]."""
    for _ in range(ROUNDS):
        at = best
        for dx, dy, dyaw in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)):
            one = solved(at.x + dx * step, at.y + dy * step, at.yaw + dyaw * turn)
            best = one if one.rank > best.rank else best
        if best is at:
            step, turn = 0.5 * step, 0.5 * turn
    return best


def _candidates(
    found: ReachMap, targets: Array, turns: Array, count: int
) -> Iterator[tuple[float, float, float, float]]:
    """Yield places x, y, yaw of the base after their value: poses that the map has, and their scores."""
    low = found.origin[:2]
    high = low + found.resolution * np.array(found.score.shape[:2])
    radius = float(np.abs([low, high]).max()) * np.sqrt(2.0)
    corners = targets[:, :2, 3].min(axis=0) - radius, targets[:, :2, 3].max(axis=0) + radius
    edge = max(found.resolution, float((corners[1] - corners[0]).max()) / SIDE)
    xs, ys = (np.arange(a, b + edge, edge) for a, b in zip(*corners, strict=True))
    places = np.stack(np.meshgrid(xs, ys, indexing="ij"), axis=-1).reshape(-1, 2)
    shape = np.array(found.score.shape)
    for yaw in np.arange(TURNS) * (2.0 * np.pi / TURNS):
        back = _base(0.0, 0.0, yaw)[:3, :3].T
        similarity = np.einsum("oij,nij->no", turns, back @ targets[:, :3, :3])
        values = np.zeros(len(places))
        for target, best in zip(targets, np.argmax(similarity, axis=1), strict=True):
            local = np.concatenate([target[:2, 3] - places, np.full((len(places), 1), target[2, 3])], axis=1) @ back.T
            cells = np.floor((local - found.origin) / found.resolution).astype(np.intp)
            inside = ((cells >= 0) & (cells < shape)).all(axis=1)
            there = tuple(cells[inside].T)
            values[inside] += found.reached[..., best][there] + found.score[there]
        for k in np.argsort(-values, kind="stable")[: 1 + count // 8]:
            yield float(values[k]), float(places[k, 0]), float(places[k, 1]), float(yaw)


def _base(x: float, y: float, yaw: float) -> Array:
    """Return the pose of the base; shape (4, 4)."""
    pose = np.eye(4)
    pose[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    pose[:2, 3] = x, y
    return pose


def _matrices(poses: ArrayLike) -> Array:
    """Return poses as matrices; shape (N, 4, 4)."""
    poses = np.asarray(poses, dtype=float)
    if poses.ndim < 2 or poses.shape[1:] not in ((7,), (4, 4)) or not 0 < len(poses) <= MOST_POSES:
        raise KinematicsError(
            f"the poses to reach have the shape (N, 7) or (N, 4, 4) with 1 to {MOST_POSES} poses; got {poses.shape}"
        )
    if not np.isfinite(poses).all():
        raise KinematicsError("the poses to reach have numbers that are not finite")
    if poses.shape[1:] == (4, 4):
        return poses
    lengths = np.sqrt(np.einsum("ni,ni->n", poses[:, 3:], poses[:, 3:]))
    if not lengths.all():
        raise KinematicsError(f"the quaternion of pose {int(np.argmin(lengths))} is zero")
    matrices = np.tile(np.eye(4), (len(poses), 1, 1))
    matrices[:, :3, :3] = rotations(poses[:, 3:] / lengths[:, None])
    matrices[:, :3, 3] = poses[:, :3]
    return matrices
