"""Variables: the numbers of a configuration by name, and the index of each in q."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin

from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics.variable_names import PARTS
from urdfkit.linear_algebra import Array, matmul, vector_norm


@dataclass(frozen=True, slots=True)
class Variable:
    """One number of a configuration.

    Attributes:
        joint: the joint it belongs to.
        index: its index in q.
        is_angle: whether q holds its cosine (at `index`) and sine (at `index` + 1).
        zero: its value in the neutral configuration.
    """

    joint: str
    index: int
    is_angle: bool
    zero: float

    def get(self, q: Array) -> float:
        """Return the value [rad] or [m]; an angle in (-π, π]."""
        return math.atan2(q[self.index + 1], q[self.index]) if self.is_angle else float(q[self.index])

    def put(self, q: Array, value: float) -> None:
        """Write the value [rad] or [m] into q."""
        if self.is_angle:
            q[self.index], q[self.index + 1] = math.cos(value), math.sin(value)
        else:
            q[self.index] = value


def index_variables(robot: Robot, model: Any, joint_ids: Mapping[str, int]) -> dict[str, Variable]:
    """Return the variables of all movable joints, by name in the order of q.

    Args:
        robot: provides the joint types.
        model: ``pin.Model``, provides the indices.
        joint_ids: joint name → index in the model.
    """
    found: dict[str, Variable] = {}
    for name, i in joint_ids.items():
        kind = robot.joint_by_name[name].type
        start = int(model.idx_qs[i])
        if kind not in PARTS:
            found[name] = Variable(name, start, kind == "continuous", 0.0)
            continue
        for k, part in enumerate(PARTS[kind]):
            found[f"{name}/{part}"] = Variable(name, start + k, part == "theta", float(part == "rot_w"))
    return found


def rates(joint_type: str, q: Array, along: Mapping[str, float]) -> Array:
    """Return a planar or floating joint's part of v, in the child's axes, from the rates of its variables.

    Args:
        joint_type: ``planar`` or ``floating``.
        q: the joint's part of the configuration.
        along: last part of a variable's name → rate [m/s] or [rad/s]; those left out do not change.
    """
    if joint_type == "planar":
        c, s = q[2], q[3]
        x, y = along.get("x", 0.0), along.get("y", 0.0)
        return np.array([c * x + s * y, c * y - s * x, along.get("theta", 0.0)])
    linear = np.array([along.get(part, 0.0) for part in PARTS["floating"][:3]])
    return np.concatenate([matmul(pin.Quaternion(q[3:7].copy()).matrix().T, linear), np.zeros(3)])


def finite(name: str, value: float, *, quantity: str = "position") -> float:
    """Return a joint value as a float.

    Raises:
        KinematicsError: it is not a finite number.
    """
    if not math.isfinite(value):
        raise KinematicsError(f"{quantity} of joint `{name}` is {value}; it must be a finite number")
    return float(value)


def unit_pose(pose: Array) -> Array:
    """Return x y z and quaternion x y z w with the quaternion normalised; shape (7,).

    Raises:
        KinematicsError: not seven finite numbers, or a quaternion that is zero.
    """
    pose = np.array(pose, dtype=float)
    if pose.shape != (7,) or not np.isfinite(pose).all() or vector_norm(pose[3:]) < 1e-9:
        raise KinematicsError("a pose is seven finite numbers: x y z and a quaternion x y z w that is not zero")
    pose[3:] /= vector_norm(pose[3:])
    return pose
