"""Collisions between the links of a robot in one configuration."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from itertools import combinations
from math import dist

import numpy as np

from urdfkit.description.urdf.robot import Robot
from urdfkit.kinematics.mimic import couplings
from urdfkit.kinematics.model import Kinematics
from urdfkit.kinematics.self_collision.collision_shapes import box_around, neighbours, shapes_by_link
from urdfkit.kinematics.self_collision.pair_check import PairCheck
from urdfkit.kinematics.self_collision.random_configurations import default, joints_from_root
from urdfkit.linear_algebra import Array


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
        self._kinematics = Kinematics(robot)
        rest = {name: float(values[0]) for name, values in default(robot).items()}
        self._others = {**rest, **(hold or {})}
        self._frames = {name: self._kinematics.frame(name) for name in shapes}
        self._centres = {name: box_around(each)[0] for name, each in shapes.items()}
        radii = {name: float(np.linalg.norm(box_around(each)[1])) for name, each in shapes.items()}
        moved = _moving_joints(robot, variables)
        adjacent = neighbours(robot, shapes)
        self.pairs: list[tuple[str, str]] = []
        self._checks: list[tuple[float, PairCheck]] = []
        placements = self._placements(rest)
        for first, second in combinations(shapes, 2):
            if (first, second) in adjacent or moved[first] == moved[second]:
                continue
            check = PairCheck(shapes[first], shapes[second])
            if not check.collides(*_relative(placements[first], placements[second])):
                self.pairs.append((first, second))
                self._checks.append((radii[first] + radii[second], check))

    def collisions(self, positions: Mapping[str, float]) -> tuple[tuple[str, str], ...]:
        """Return the pairs of links that collide at these positions of the variables [rad] or [m]."""
        placements = self._placements({**self._others, **positions})
        centres = {name: rotation @ self._centres[name] + at for name, (rotation, at) in placements.items()}
        return tuple(
            [
                (first, second)
                for (first, second), (reach, check) in zip(self.pairs, self._checks, strict=True)
                if dist(centres[first], centres[second]) <= reach
                and check.collides(*_relative(placements[first], placements[second]))
            ]
        )

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
    for joint in joints_from_root(robot, root):
        leader = coupled[joint.name].master if joint.name in coupled else joint.name
        above = found[joint.parent or ""]
        found[joint.child or ""] = above | {joint.name} if leader in moving else above
    return found
