"""Random configurations of a whole robot, and the poses of its links in them."""

from collections.abc import Mapping
from math import pi

import numpy as np

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Robot
from urdfkit.kinematics.joint_limits import position_limits
from urdfkit.kinematics.mimic import couplings
from urdfkit.kinematics.self_collision.collision_shapes import placement
from urdfkit.linear_algebra import Array

UNLIMITED = {"revolute": pi, "continuous": pi, "prismatic": 0.0}
"""Range of a joint without limits: a whole turn, or none [rad] or [m]."""


def ranges(robot: Robot) -> dict[str, tuple[float, float]]:
    """Return independent joint → lowest and highest position [rad] or [m]; planar and floating joints do not move."""
    found = {}
    for joint in robot.joints:
        if joint.type in UNLIMITED and joint.mimic is None:
            low, high = position_limits(joint)
            most = UNLIMITED[joint.type]
            found[joint.name] = (max(low, -most), min(high, most)) if high - low == np.inf else (low, high)
    return found


def draw(robot: Robot, count: int, random: np.random.Generator) -> dict[str, Array]:
    """Return independent joint → random positions within its limits [rad] or [m]; each of the shape (count,)."""
    return {name: random.uniform(low, high, count) for name, (low, high) in ranges(robot).items()}


def default(robot: Robot) -> dict[str, Array]:
    """Return independent joint → zero, or the nearest position within its limits; each of the shape (1,)."""
    return {name: np.array([min(high, max(low, 0.0))]) for name, (low, high) in ranges(robot).items()}


def link_poses(robot: Robot, positions: Mapping[str, Array]) -> dict[str, tuple[Array, Array]]:
    """Return link → rotations (N, 3, 3) and translations (N, 3) [m] in the frame of the root link.

    Args:
        robot: one tree.
        positions: independent joint → positions [rad] or [m]; shape (N,).
    """
    count = len(next(iter(positions.values()), np.zeros(1)))
    followed = dict(positions)
    for name, coupling in couplings(robot).items():
        master = positions.get(coupling.master or "", np.zeros(count))
        followed[name] = coupling.multiplier * master + coupling.offset
    root = robot.roots()[0].name
    poses = {root: (np.broadcast_to(np.eye(3), (count, 3, 3)), np.zeros((count, 3)))}
    for joint in tree_order(robot):
        assert joint.parent is not None
        assert joint.child is not None
        rotation, translation = poses[joint.parent]
        own, offset = placement(joint.origin)
        placed = rotation @ own
        translation = translation + rotation @ offset
        values = followed.get(joint.name)
        if values is not None:
            axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
            if joint.type == "prismatic":
                translation = translation + values[:, None] * (placed @ axis)
            else:
                placed = placed @ _turns(axis, values)
        poses[joint.child] = placed, translation
    return poses


def _turns(axis: Array, angles: Array) -> Array:
    """Return rotations about an axis by angles [rad]; shape (N, 3, 3)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    sine, cosine = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.asarray(np.eye(3) + sine * cross + (1.0 - cosine) * (cross @ cross))
