"""PID gains for joints with effort interfaces, from the inertia and weight that the joint moves."""

from dataclasses import dataclass
from math import sqrt

from urdfkit.description.urdf.geometry import compose, link_poses, rotate, rotation_of, transpose, unit
from urdfkit.description.urdf.robot import Inertia, Joint, Robot, Vector

_GRAVITY = 9.81
_FREQUENCY = 20.0
"""Minimum natural frequency of a controlled joint [rad/s]."""
_DEFLECTION = 0.01
"""Deflection of a rotary joint under the weight that it carries [rad], as for the template's arms."""
_PRISMATIC_DEFLECTION = 0.001
"""Deflection of a prismatic joint under the weight that it carries [m]."""


@dataclass(frozen=True, slots=True)
class ControllerGains:
    """PID gains: p, i, d, and the limit of the integral term, which holds the weight."""

    p: float
    i: float
    d: float
    clamp: float


def gains(robot: Robot, joint: Joint) -> ControllerGains:
    """Return the gains of a joint: p = max(I ω², weight / deflection), d = 2 · 0.9 · √(p I), in the zero position.

    Args:
        robot: a robot whose joints form a tree.
        joint: a joint of the robot.
    """
    inertia, weight = _carried(robot, joint)
    deflection = _PRISMATIC_DEFLECTION if joint.type == "prismatic" else _DEFLECTION
    p = max(inertia * _FREQUENCY**2, weight / deflection)
    return ControllerGains(p, p, 1.8 * sqrt(p * inertia), weight)


def _carried(robot: Robot, joint: Joint) -> tuple[float, float]:
    """Return the carried inertia [kg m²] and moment of weight [N m]; for prismatic joints mass [kg] and weight [N]."""
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
    """Return the moment of inertia about an axis of unit length."""
    if tensor is None:
        return 0.0
    x, y, z = axis
    mixed = tensor.ixy * x * y + tensor.ixz * x * z + tensor.iyz * y * z
    return tensor.ixx * x * x + tensor.iyy * y * y + tensor.izz * z * z + 2 * mixed
