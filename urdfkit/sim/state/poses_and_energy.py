"""Functions of configuration and velocity: poses of links and joints, velocities in the world frame, energy."""

from collections.abc import Sequence
from math import atan2, cos, sin
from typing import Any

import numpy as np

from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array, matmul
from urdfkit.sim.state.quaternion import product, rotate

NONE = np.zeros(0), np.zeros((0, 3))
"""Default of `energy_of`: no weightless bodies."""


def link_poses(kinematics: Kinematics, q: Array, base: Array | None) -> Array:
    """Return x y z [m] and quaternion x y z w of every link in the world; shape (n_links, 7).

    Args:
        kinematics: the robot's model.
        q: configuration; shape (nq,).
        base: pose of the root link of a robot with a fixed base; None for a floating base.
    """
    poses = kinematics.link_poses(q)
    if base is not None:
        for row in poses:
            row[:3] = base[:3] + rotate(base[3:], row[:3])
            row[3:] = product(base[3:], row[3:])
    return poses


def in_the_world(pose: tuple[float, ...], twist: tuple[float, ...]) -> tuple[float, ...]:
    """Transform a twist from the link frame to the axes of the world [m/s, rad/s].

    Args:
        pose: pose of the link, x y z [m] and quaternion x y z w.
        twist: twist in the link frame, linear first.
    """
    return (*rotate(pose[3:], twist[:3]), *rotate(pose[3:], twist[3:]))


def pose_and_twist(
    joint_type: str, q: Sequence[float], v: Sequence[float]
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the pose of the child link of a planar or floating joint, and its velocity along the same axes.

    Args:
        joint_type: ``planar`` or ``floating``.
        q: configuration from the joint's first coordinate on.
        v: velocity from the joint's first coordinate on.
    """
    if joint_type == "planar":
        half = 0.5 * atan2(q[3], q[2])
        pose = (q[0], q[1], 0.0, 0.0, 0.0, sin(half), cos(half))
        return pose, in_the_world(pose, (v[0], v[1], 0.0, 0.0, 0.0, v[2]))
    return tuple(q[:7]), in_the_world(tuple(q[:7]), tuple(v[:6]))


def energy_of(
    kinematics: Kinematics,
    q: Array,
    v: Array,
    base: Array | None,
    gravity: Array,
    weightless: tuple[Array, Array] = NONE,
) -> tuple[float, float]:
    """Return kinetic and potential energy of a robot [J]; the potential energy is zero at the world's origin.

    Args:
        kinematics: the robot's model.
        q: configuration; shape (nq,).
        v: velocity; shape (nv,).
        base: pose of the root link of a robot with a fixed base; None for a floating base.
        gravity: [m/s²]; shape (3,).
        weightless: see `Articulation.weightless`.
    """
    import pinocchio

    pin: Any = pinocchio
    model, data = kinematics.model, kinematics.data
    kinetic = pin.computeKineticEnergy(model, data, q, v)
    centre = pin.centerOfMass(model, data, q)
    mass = data.mass[0]
    moment = mass * centre
    for k, (light, at) in enumerate(zip(*weightless, strict=True), 1):
        moment = moment - light * data.oMi[k].act(at)
        mass -= light
    if base is not None:
        moment = mass * base[:3] + rotate(base[3:], moment)
    return float(kinetic), matmul(-gravity, moment)
