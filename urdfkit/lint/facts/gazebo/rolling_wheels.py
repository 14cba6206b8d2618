"""Wheels of a robot by their joints and shapes, without a drive that names them."""

import re
from collections.abc import Iterator
from math import hypot

from urdfkit.description.urdf.geometry import rotate, unit
from urdfkit.description.urdf.robot import Cylinder, Joint, Sphere
from urdfkit.lint.facts.gazebo.drive_wheels import Wheel, drives, wheel_of
from urdfkit.lint.facts.twins import mirrored, side_of
from urdfkit.lint.model.model import Model
from urdfkit.record import record

CASTER = re.compile(r"cast[eo]r|ball|omni|swivel|roller", re.IGNORECASE)
"""Names of wheels that carry the robot without driving it."""

_LEVEL = 0.1
"""Largest vertical component of the axis of a wheel."""

_ALONG = 0.985
"""Smallest cosine of the angle between a cylinder and the axis of its wheel."""


@record(eq=False)
class WheelPairs:
    """The wheels that drive a robot, in pairs."""

    left: tuple[Wheel, ...]
    right: tuple[Wheel, ...]


def rolling_wheels(model: Model) -> list[Wheel]:
    """Return the wheels of the robot: named as wheels, on a level axis, round, and neither raised nor lowered."""
    return list(_rolling(model))


def pairs_of_wheels(model: Model) -> list[WheelPairs]:
    """Return the drives of the Gazebo plugins; without any, the wheels with a counterpart on the other side."""
    found = [WheelPairs(drive.left, drive.right) for drive in drives(model)]
    if found:
        return found
    wheels = {wheel.joint.name: wheel for wheel in rolling_wheels(model)}
    left_wheels = [wheel for name, wheel in wheels.items() if side_of(name) == "left"]
    pairs = [(wheel, wheels.get(name)) for wheel in left_wheels for name in mirrored(wheel.joint.name)]
    sides = [(left, right) for left, right in pairs if right is not None]
    return [WheelPairs(tuple(left for left, _ in sides), tuple(right for _, right in sides))] if sides else []


def _rolling(model: Model) -> Iterator[Wheel]:
    parents = {joint.child: joint for joint in model.robot.joints}
    for joint in model.robot.joints:
        name = f"{joint.name} {joint.child}"
        if joint.type != "continuous" or "wheel" not in name.lower() or CASTER.search(name):
            continue
        radius = _radius(joint, model)
        wheel = wheel_of(model, joint, None) if radius is not None and not is_lifted(joint, parents, model) else None
        if radius is not None and wheel is not None and abs(wheel.axis[2]) < _LEVEL * max(hypot(*wheel.axis), 1e-9):
            yield Wheel(joint, None, joint.name, wheel.place, wheel.axis, (radius,), wheel.middles)


def is_lifted(joint: Joint, parents: dict[str | None, Joint], model: Model) -> bool:
    """Return whether a joint above this one can move it up or down; a steering joint, with a vertical axis, cannot."""
    seen: set[str | None] = set()
    while joint.parent in parents and joint.parent not in seen:
        seen.add(joint.parent)
        joint = parents[joint.parent]
        if joint.is_movable and joint.type != "continuous" and not _steers(joint, model):
            return True
    return False


def _steers(joint: Joint, model: Model) -> bool:
    frame, axis = model.frames.get(joint.child or ""), unit(joint.axis)
    if joint.type != "revolute" or frame is None or axis is None:
        return False
    return abs(rotate(frame.rotation, axis)[2]) > _ALONG


def _radius(joint: Joint, model: Model) -> float | None:
    """Return the radius of a wheel that is one cylinder along the axis, or one sphere, at the origin of its link."""
    link = model.robot.link_by_name.get(joint.child or "")
    shapes = (link.collisions or link.visuals) if link is not None else ()
    axis = unit(joint.axis)
    if len(shapes) != 1 or axis is None:
        return None
    shape, origin = shapes[0].geometry, shapes[0].origin
    if not isinstance(shape, (Cylinder, Sphere)) or shape.radius <= 0.0:
        return None
    offset = sum(a * b for a, b in zip(axis, origin.xyz, strict=True))
    if max(hypot(*origin.xyz) ** 2 - offset**2, 0.0) ** 0.5 > 0.1 * shape.radius:
        return None
    if isinstance(shape, Cylinder):
        from urdfkit.description.urdf.geometry import rotation_of

        along = rotate(rotation_of(origin.rpy), (0.0, 0.0, 1.0))
        if abs(sum(a * b for a, b in zip(along, axis, strict=True))) < _ALONG:
            return None
    return shape.radius
