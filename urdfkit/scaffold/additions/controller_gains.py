"""Gains for joints that are moved by efforts: as stiff as the weight they carry asks for, and well damped."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from urdfkit.description.urdf.geometry import compose, link_poses, rotate, rotation_of, transpose, unit
from urdfkit.description.urdf.robot import Inertia, Joint, Robot, Vector

_GRAVITY = 9.81
_PULL = 20.0
"""How fast a joint follows [rad/s], where its weight does not ask for more."""
_SAG = 0.01
"""What a joint gives way under the weight it carries [rad]; that of the template's arms."""
_SINK = 0.001
"""The same of one that slides [m]."""


@dataclass(frozen=True, slots=True)
class Gains:
    """Of a PID: p, i and d, and the most that i adds (what holds the weight)."""

    p: float
    i: float
    d: float
    clamp: float


def gains(robot: Robot, joint: Joint) -> Gains:
    """Return the gains of a joint; p = max(I ω², weight / sag), d = 2 · 0.9 · √(p I), with the robot as it is at zero.

    Args:
        robot: a tree.
        joint: of it.
    """
    moved, weight = _carried(robot, joint)
    sag = _SINK if joint.type == "prismatic" else _SAG
    p = max(moved * _PULL**2, weight / sag)
    return Gains(p, p, 1.8 * sqrt(p * moved), weight)


def _carried(robot: Robot, joint: Joint) -> tuple[float, float]:
    """Return the inertia about the axis [kg m²] and the greatest moment of the weight [N m]; of slides in kg and N."""
    places = link_poses(robot, joint.child) if joint.child is not None else {}
    axis = unit(joint.axis) or joint.axis
    inertia = weight = 0.0
    for link in (robot.link_by_name[name] for name in places):
        if link.inertial is None or not (mass := link.inertial.mass or 0.0):
            continue
        if joint.type == "prismatic":
            inertia, weight = inertia + mass, weight + mass * _GRAVITY
            continue
        middle = compose(places[link.name], link.inertial.origin)
        along = sum(a * b for a, b in zip(axis, middle.xyz, strict=True))
        arm = max(sum(part * part for part in middle.xyz) - along * along, 0.0)
        own = rotate(transpose(rotation_of(middle.rpy)), axis)
        inertia += mass * arm + _about(own, link.inertial.inertia)
        weight += mass * _GRAVITY * sqrt(arm)
    return inertia, weight


def _about(axis: Vector, tensor: Inertia | None) -> float:
    """Return the moment about an axis of length 1."""
    if tensor is None:
        return 0.0
    x, y, z = axis
    mixed = tensor.ixy * x * y + tensor.ixz * x * z + tensor.iyz * y * z
    return tensor.ixx * x * x + tensor.iyy * y * y + tensor.izz * z * z + 2 * mixed
