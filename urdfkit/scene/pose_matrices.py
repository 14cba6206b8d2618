"""Placements as homogeneous matrices."""

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.description.urdf.robot import Pose
from urdfkit.linear_algebra import Array


def pose_matrix(pose: Pose) -> Array:
    """Return an ``<origin>`` as a matrix: translation and Rz(yaw)·Ry(pitch)·Rx(roll); shape (4, 4), read-only."""
    roll, pitch, yaw = pose.rpy
    cr, sr, cp, sp = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    matrix = np.eye(4)
    matrix[:3, :3] = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    matrix[:3, 3] = pose.xyz
    matrix.flags.writeable = False
    return matrix


def pose_matrices(poses: ArrayLike) -> Array:
    """Return matrices, shape (n, 4, 4), for poses x y z [m] and quaternion x y z w, shape (n, 7)."""
    poses = np.asarray(poses, dtype=float).reshape(-1, 7)
    x, y, z, w = poses[:, 3:].T / np.linalg.norm(poses[:, 3:], axis=1)
    matrices = np.zeros((len(poses), 4, 4))
    matrices[:, 0, 0] = 1 - 2 * (y * y + z * z)
    matrices[:, 0, 1] = 2 * (x * y - z * w)
    matrices[:, 0, 2] = 2 * (x * z + y * w)
    matrices[:, 1, 0] = 2 * (x * y + z * w)
    matrices[:, 1, 1] = 1 - 2 * (x * x + z * z)
    matrices[:, 1, 2] = 2 * (y * z - x * w)
    matrices[:, 2, 0] = 2 * (x * z - y * w)
    matrices[:, 2, 1] = 2 * (y * z + x * w)
    matrices[:, 2, 2] = 1 - 2 * (x * x + y * y)
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
