"""Conversions of poses: from user input, to `Pose` records, and to seven numbers."""

from collections.abc import Sequence
from math import isfinite

import numpy as np

from urdfkit.description.urdf.geometry import rpy_of_quaternion
from urdfkit.description.urdf.robot import Pose
from urdfkit.errors import SimulationError
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.sim.state.arguments import check_size


def seven(pose: Pose) -> tuple[float, ...]:
    """Return a pose as x y z [m] and quaternion x y z w."""
    import pinocchio as pin

    return tuple(pin.SE3ToXYZQUAT(pin.SE3(np.array(pose_matrix(pose)))).tolist())


def pose_from(seven: Sequence[float]) -> Pose:
    """Return x y z [m] and a quaternion x y z w as a pose."""
    x, y, z, *q = (float(value) for value in seven)
    return Pose((x, y, z), rpy_of_quaternion(q[0], q[1], q[2], q[3]))


def pose_of(pose: Pose | Sequence[float]) -> Pose:
    """Return a pose from x y z, x y z yaw, x y z roll pitch yaw, or x y z and a quaternion x y z w.

    Raises:
        SimulationError: wrong number of values, a value that is not finite, a position beyond `LARGEST`, or a zero
            quaternion.
    """
    numbers: tuple[float, ...]
    if isinstance(pose, Pose):
        numbers = (*pose.xyz, *pose.rpy)
    else:
        try:
            numbers = tuple(float(number) for number in pose)
        except (TypeError, ValueError):
            numbers = ()
    if len(numbers) not in (3, 4, 6, 7) or not all(map(isfinite, numbers)):
        raise SimulationError(
            f"the pose is {pose!r}; it must be x y z, x y z yaw, x y z roll pitch yaw or x y z and a quaternion x y z w"
        )
    x, y, z, *rest = numbers
    check_size((x, y, z), "the position", "m")
    if len(rest) == 4:
        if not any(rest):
            raise SimulationError("the quaternion of a pose is zero")
        return pose_from(numbers)
    roll, pitch, yaw = rest if len(rest) == 3 else (0.0, 0.0, rest[0] if rest else 0.0)
    return Pose((x, y, z), (roll, pitch, yaw))
