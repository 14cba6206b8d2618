"""Collisions between the links of a robot in one configuration, or in many."""

from collections.abc import Collection, Iterator, Mapping
from itertools import combinations
from math import dist

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Robot
from urdfkit.kinematics.mimic import couplings
from urdfkit.kinematics.model import Kinematics
from urdfkit.kinematics.self_collision.box_overlap import overlapping
from urdfkit.kinematics.self_collision.collision_shapes import box_around, neighbours, shapes_by_link
from urdfkit.kinematics.self_collision.pair_check import PairCheck
from urdfkit.kinematics.self_collision.random_configurations import default, link_poses, ranges
from urdfkit.linear_algebra import Array

BLOCK = 10_000
"""Configurations whose poses are stored at once."""


class ConfigurationCheck:
    """Checks the pairs of links whose relative placement some variables change.

    Left out are the pairs that `urdfkit srdf` calls ``Adjacent`` or ``Default``: links that a joint connects, and pairs
    that collide while all joints are at zero, or at the position within their limits that is nearest to it. A pair that
    always collides is one of the latter.

    Args:
        robot: one tree.
        variables: names of the joints that move, or of the numbers of a planar joint.
        hold: position of other joints [rad] or [m]; those without one are at zero, or nearest to it.

    Raises:
        ResourceError: a mesh of a collision shape cannot be read.

    Attributes:
        pairs: the pairs that are checked.
    """

    def __init__(self, robot: Robot, variables: Collection[str], hold: Mapping[str, float] | None = None) -> None:
        shapes = shapes_by_link(robot)
        self._robot, self._variables = robot, tuple(variables)
        self._kinematics = Kinematics(robot)
        rest = {name: float(values[0]) for name, values in default(robot).items()}
        self._others = {**rest, **(hold or {})}
        self._frames = {name: self._kinematics.frame(name) for name in shapes}
        self._boxes = {name: box_around(each) for name, each in shapes.items()}
        radii = {name: float(np.linalg.norm(half)) for name, (_, half) in self._boxes.items()}
        moved = _moving_joints(robot, variables)
        adjacent = neighbours(robot, shapes)
        self.pairs: list[tuple[str, str]] = []
        self._checks: list[tuple[float, PairCheck]] = []
        self._in_blocks = {*self._others, *self._variables} <= set(rest)  # without planar and floating joints
        placements = self._placements(rest)
        for first, second in combinations(shapes, 2):
            if (first, second) in adjacent or moved[first] == moved[second]:
                continue
            check = PairCheck(shapes[first], shapes[second])
            if not check.collides(*_relative(placements[first], placements[second])):
                self.pairs.append((first, second))
                self._checks.append((radii[first] + radii[second], check))

    def hold(self, positions: Mapping[str, float]) -> None:
        """Put other joints at these positions [rad] or [m]; the pairs that are checked stay the same."""
        self._others.update(positions)
        self._in_blocks = self._in_blocks and set(positions) <= set(ranges(self._robot))

    def collisions(self, positions: Mapping[str, float]) -> tuple[tuple[str, str], ...]:
        """Return the pairs of links that collide at these positions of the variables [rad] or [m]."""
        placements = self._placements({**self._others, **positions})
        centres = {name: rotation @ self._boxes[name][0] + at for name, (rotation, at) in placements.items()}
        return tuple(
            [
                (first, second)
                for (first, second), (reach, check) in zip(self.pairs, self._checks, strict=True)
                if dist(centres[first], centres[second]) <= reach
                and check.collides(*_relative(placements[first], placements[second]))
            ]
        )

    def free(self, q: Array) -> NDArray[np.bool_]:
        """Return which configurations have no collision; shape (K,). `collisions` takes ten times as long for each.

        Args:
            q: positions of the variables [rad] or [m]; shape (K, n).
        """
        if not self._in_blocks:
            rows = (dict(zip(self._variables, row, strict=True)) for row in q.tolist())
            return np.array([not self.collisions(row) for row in rows], dtype=bool)
        result = np.ones(len(q), dtype=bool)
        for first in range(0, len(q), BLOCK):
            part = q[first : first + BLOCK]
            others = {name: np.full(len(part), value) for name, value in self._others.items()}
            poses = link_poses(self._robot, others | dict(zip(self._variables, part.T, strict=True)))
            left = result[first : first + BLOCK]
            for names, (reach, check) in zip(self.pairs, self._checks, strict=True):
                for k, rotation, translation in self._near(names, reach, poses, np.flatnonzero(left)):
                    left[k] = not check.collides(rotation, translation)
        return result

    def _near(
        self, names: tuple[str, str], reach: float, poses: dict[str, tuple[Array, Array]], rows: NDArray[np.intp]
    ) -> Iterator[tuple[int, Array, Array]]:
        """Yield the rows in which the boxes around two links overlap, with the placement of the second in the first."""
        (a, p), (b, q) = ((poses[name][0][rows], poses[name][1][rows]) for name in names)
        (centre, half), (other, other_half) = (self._boxes[name] for name in names)
        between = q + np.einsum("nij,j->ni", b, other) - p - np.einsum("nij,j->ni", a, centre)
        near = np.flatnonzero(np.einsum("ni,ni->n", between, between) <= reach**2)
        turned = np.swapaxes(a[near], 1, 2)
        rotation = turned @ b[near]
        translation = np.einsum("nij,nj->ni", turned, q[near] - p[near])
        offset = np.einsum("nij,nj->ni", turned, between[near])
        for i in overlapping(rotation, offset, half, other_half).tolist():
            yield int(rows[near[i]]), rotation[i], translation[i]

    def _placements(self, positions: Mapping[str, float]) -> dict[str, tuple[Array, Array]]:
        """Return link → rotation (3, 3) and translation (3,) [m] in the root link, of links with shapes."""
        placements = self._kinematics.placements(self._kinematics.configuration(positions))
        return {
            name: (np.array(placements[frame].rotation), np.array(placements[frame].translation))
            for name, frame in self._frames.items()
        }


def _relative(first: tuple[Array, Array], second: tuple[Array, Array]) -> tuple[Array, Array]:
    """Return the placement of the second link in the first."""
    (a, p), (b, q) = first, second
    return a.T @ b, a.T @ (q - p)


def _moving_joints(robot: Robot, variables: Collection[str]) -> dict[str, frozenset[str]]:
    """Return link → the joints above it that the variables move."""
    coupled = couplings(robot)
    moving = {name.partition("/")[0] if name not in robot.joint_by_name else name for name in variables}
    root = robot.roots()[0].name
    found: dict[str, frozenset[str]] = {root: frozenset()}
    for joint in tree_order(robot):
        leader = coupled[joint.name].master if joint.name in coupled else joint.name
        above = found[joint.parent or ""]
        found[joint.child or ""] = above | {joint.name} if leader in moving else above
    return found
