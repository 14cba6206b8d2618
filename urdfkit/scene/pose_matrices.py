"""Placements as homogeneous matrices."""

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.description.urdf.geometry import rotation_of
from urdfkit.description.urdf.robot import Pose
from urdfkit.linear_algebra import Array, rotations


def pose_matrix(pose: Pose) -> Array:
    """Return an ``<origin>`` as a matrix: translation and Rz(yaw)·Ry(pitch)·Rx(roll); shape (4, 4), read-only."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_of(pose.rpy)
    matrix[:3, 3] = pose.xyz
    matrix.flags.writeable = False
    return matrix


def pose_matrices(poses: ArrayLike) -> Array:
    """Return matrices, shape (n, 4, 4), for poses x y z [m] and quaternion x y z w, shape (n, 7)."""
    poses = np.asarray(poses, dtype=float).reshape(-1, 7)
    matrices = np.zeros((len(poses), 4, 4))
    matrices[:, :3, :3] = rotations(poses[:, 3:] / np.linalg.norm(poses[:, 3:], axis=1, keepdims=True))
    matrices[:, :3, 3] = poses[:, :3]
    matrices[:, 3, 3] = 1.0
    return matrices


def upright(normal: ArrayLike) -> Array:
    """Return the smallest rotation that takes z to a unit vector, as Gazebo turns planes; shape (3, 3)."""
    x, y, z = np.asarray(normal, dtype=float)
    across = x * x + y * y
    if z < 0.0 and across == 0.0:  # opposite to z: half a turn about x
        return np.diag([1.0, -1.0, -1.0])
    part = (1.0 - z) / across if z < 0.0 else 1.0 / (1.0 + z)  # equal; each is accurate on its side
    return np.array([[1.0 - part * x * x, -part * x * y, x], [-part * x * y, 1.0 - part * y * y, y], [-x, -y, z]])
