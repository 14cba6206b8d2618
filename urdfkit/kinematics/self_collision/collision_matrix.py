"""Pairs of links that need no check for collisions: neighbours, and pairs that always or never collide.

Each pair is checked in random configurations. The boxes around two links decide most of them, coal the others. A pair
without any collision is called ``Never`` only after a search for its closest approach has found none either.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import sqrt
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from urdfkit.description import Robot, load
from urdfkit.kinematics.self_collision.box_overlap import overlapping
from urdfkit.kinematics.self_collision.closest_approach import chain_between, closest_approach
from urdfkit.kinematics.self_collision.collision_shapes import (
    CollisionShape,
    box_around,
    incomplete_links,
    neighbours,
    shapes_by_link,
)
from urdfkit.kinematics.self_collision.pair_check import PairCheck
from urdfkit.kinematics.self_collision.random_configurations import default, draw, link_poses, ranges
from urdfkit.linear_algebra import Array

ENOUGH = 200
"""Collisions after which the rate of a pair is known well enough."""
ALWAYS = 3000
"""Samples without an exception after which a pair counts as always colliding: fewer than 0.1 % at 95 % confidence."""
MOST_EXACT = 3000
"""Checks of triangle meshes per pair."""
STARTS = 12
"""Samples of a pair from which its closest approach is searched for."""
QUANTILE = 1.645
"""Of the normal distribution, at 95 %."""


@dataclass(frozen=True)
class Pair:
    """Collisions of two links.

    Attributes:
        first: name of a link.
        second: name of a link.
        reason: ``Adjacent``, ``Default``, ``Always`` or ``Never``; None for a pair that has to be checked.
        samples: number of configurations in which the pair was checked.
        hits: number of collisions among them.
        rate_bound: upper bound of the rate of collisions at 95 % confidence.
        distance: closest approach that was found [m]; None if it was not searched for.
        collision: joint → position [rad] or [m] in a configuration with a collision; None without one.
    """

    first: str
    second: str
    reason: str | None
    samples: int
    hits: int
    rate_bound: float
    distance: float | None = None
    collision: dict[str, float] | None = field(default=None, repr=False)


@dataclass(frozen=True)
class CollisionMatrix:
    """Collisions of all pairs of links with collision shapes.

    Attributes:
        links: names of the links, in document order.
        pairs: all pairs of links.
        incomplete: links with shapes that cannot be read; their pairs are never called ``Never``.
    """

    links: tuple[str, ...]
    pairs: tuple[Pair, ...]
    incomplete: frozenset[str] = frozenset()

    @property
    def disabled(self) -> tuple[Pair, ...]:
        """The pairs that need no check."""
        return tuple(pair for pair in self.pairs if pair.reason is not None)


def collision_matrix(
    robot: Robot | str | Path,
    *,
    samples: int = 100_000,
    seed: int = 0,
    note: Callable[[str], None] = lambda text: None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> CollisionMatrix:
    """Return the collisions between the links of a robot.

    Args:
        robot: a loaded robot, a file, a package folder or the name of a bundled robot; see `urdfkit.load`.
        samples: random configurations within the limits of the joints.
        seed: of the random numbers; the same seed gives the same matrix.
        note: called with a message for a mesh that cannot be read; its shape is ignored.
        progress: called with the number of finished pairs and of all pairs.

    Raises:
        UrdfkitError: the robot cannot be loaded.

    Examples:
        >>> from urdfkit.kinematics import collision_matrix
        >>> found = collision_matrix("seven_dof_arm", samples=1000)
        >>> found.pairs[0].first, found.pairs[0].second, found.pairs[0].reason
        ('bottom_link', 'base_link', 'Adjacent')
    """
    robot = load(robot)
    shapes = shapes_by_link(robot, note)
    positions = draw(robot, samples, np.random.default_rng(seed))
    poses = link_poses(robot, {name: values.astype(float) for name, values in positions.items()})
    rest = link_poses(robot, default(robot))
    adjacent, incomplete = neighbours(robot, shapes), incomplete_links(robot, shapes)
    boxes = {name: box_around(parts) for name, parts in shapes.items()}
    centres = {name: poses[name][0] @ centre + poses[name][1] for name, (centre, _) in boxes.items()}
    pairs = list(combinations(shapes, 2))
    found = []
    for k, (first, second) in enumerate(pairs):
        spheres = [(centres[name], float(np.linalg.norm(boxes[name][1]))) for name in (first, second)]
        pair = _PairSearch(robot, (first, second), shapes, poses, rest, positions, spheres, [seed, k])
        result = pair.result(adjacent=(first, second) in adjacent)
        if result.reason == "Never" and not {first, second}.isdisjoint(incomplete):
            result = replace(result, reason=None)
        found.append(result)
        progress(k + 1, len(pairs))
    return CollisionMatrix(tuple(shapes), tuple(found), frozenset(incomplete))


class _PairSearch:
    """Samples of one pair of links."""

    def __init__(
        self,
        robot: Robot,
        names: tuple[str, str],
        shapes: dict[str, tuple[CollisionShape, ...]],
        poses: dict[str, tuple[Array, Array]],
        rest: dict[str, tuple[Array, Array]],
        positions: dict[str, Array],
        spheres: list[tuple[Array, float]],
        seed: list[int],
    ) -> None:
        self.robot, self.names, self.positions, self.seed = robot, names, positions, seed
        self.poses, self.rest = poses, rest
        first, second = (shapes[name] for name in names)
        self.check = PairCheck(first, second)
        self.boxes = [box_around(first), box_around(second)]
        self.spheres = spheres
        self.count = len(poses[names[0]][1])

    def result(self, *, adjacent: bool) -> Pair:
        """Return the collisions of the pair."""
        (centre, half), (other, other_half) = self.boxes
        rotation, translation = self.relative(np.arange(1), self.rest)
        at_rest = self.check.collides(rotation[0], translation[0])
        gaps = self.gaps()
        near = np.flatnonzero(gaps <= 0.0)
        rotation, translation = self.relative(near)
        between = translation + rotation @ other - centre
        near_kept = overlapping(rotation, between, half, other_half)
        hits, misses, last, hit = 0, self.count - len(near_kept), -1, -1
        self.check.checks = 0
        for i in near_kept.tolist():
            last = int(near[i])
            if self.check.collides(rotation[i], translation[i]):
                hits, hit = hits + 1, last if hit < 0 else hit
            else:
                misses += 1
            if (hits >= ENOUGH and misses) or hits >= ALWAYS or self.check.checks >= MOST_EXACT:
                break
        else:
            last = self.count - 1
        checked = last + 1
        reason = self.reason(adjacent, at_rest, hits, checked)
        distance = None
        configuration = self.configuration(hit) if hit >= 0 else None
        if reason == "Never":
            chain = chain_between(self.robot, *self.names)
            starts = [self.configuration(k) for k in self.starts(gaps)]
            joints = ranges(self.robot)
            limits = [joints.get(name, (0.0, 0.0)) for name in chain.joint_names] if chain is not None else []
            lower, upper = np.array(limits).reshape(-1, 2).T
            random = np.random.default_rng(self.seed)
            approach = closest_approach(chain, self.check, starts, (lower, upper), random)
            distance = approach.distance
            if chain is None:
                distance = self.check.distance(*self.relative_pose(), convex=False)[0]
            elif distance <= 0.0:
                reason, configuration = None, approach.positions
        return Pair(*self.names, reason, checked, hits, _bound(hits, checked), distance, configuration)

    @staticmethod
    def reason(adjacent: bool, at_rest: bool, hits: int, checked: int) -> str | None:
        """Return why a pair needs no check; None if it does."""
        if adjacent:
            return "Adjacent"
        if hits and hits == checked:
            return "Always"
        if at_rest:
            return "Default"
        return None if hits else "Never"

    def relative(
        self, rows: NDArray[np.intp], poses: dict[str, tuple[Array, Array]] | None = None
    ) -> tuple[Array, Array]:
        """Return the placements of the second link in the first; shapes (N, 3, 3) and (N, 3)."""
        (a, p), (b, q) = (((poses or self.poses)[name]) for name in self.names)
        turned = np.swapaxes(a[rows], 1, 2)
        return turned @ b[rows], np.einsum("nij,nj->ni", turned, q[rows] - p[rows])

    def relative_pose(self) -> tuple[Array, Array]:
        """Return the placement of the second link in the first in the default configuration."""
        rotation, translation = self.relative(np.arange(1), self.rest)
        return rotation[0], translation[0]

    def gaps(self) -> Array:
        """Return the distances of the spheres around the boxes of both links [m]; shape (N,)."""
        (centre, radius), (other, other_radius) = self.spheres
        between = other - centre
        return np.asarray(np.sqrt(np.einsum("ni,ni->n", between, between)) - (radius + other_radius))

    def starts(self, gaps: Array) -> list[int]:
        """Return the samples with the smallest gap, one from each of some equal parts of all samples."""
        parts = np.array_split(np.arange(self.count), STARTS)
        return [int(part[np.argmin(gaps[part])]) for part in parts if len(part)]

    def configuration(self, k: int) -> dict[str, float]:
        """Return a sample: joint → position [rad] or [m]."""
        return {name: float(values[k]) for name, values in self.positions.items()}


def _bound(hits: int, samples: int) -> float:
    """Return the upper bound of a rate at 95 % confidence: Wilson's, and 3/n without hits."""
    if hits == 0:
        return min(1.0, 3.0 / samples)
    rate, z = hits / samples, QUANTILE
    centre = rate + z * z / (2.0 * samples)
    width = z * sqrt(rate * (1.0 - rate) / samples + z * z / (4.0 * samples**2))
    return min(1.0, (centre + width) / (1.0 + z * z / samples))
