"""Tools at the ends of arms: frames of tools, fingers and cameras that are fixed to the last link."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import hypot

from urdfkit.description.urdf.geometry import unit
from urdfkit.description.urdf.robot import Box, Cylinder, Joint, Vector
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Frame, shapes_of

_TOOL = re.compile(r"(?<![a-z])(tcp|tool\d?|grasp\w*|grip_?point|eef?|end_?effector|tip)(?![a-z])", re.IGNORECASE)
_FINGER = re.compile(r"finger|jaw|claw|thumb|pad", re.IGNORECASE)
_CAMERA = re.compile(r"camera|realsense|kinect", re.IGNORECASE)

_DEPTH = 0.002
"""Smallest depth of the frame of a tool below the surface of a body [m]."""

_PART = 0.05
"""Smallest part of the size of the body that this depth is."""

_BACK, _BESIDE = -0.7, 0.5
"""Cosines of the smallest angles to the direction of the tool or the fingers that are backwards and to the side."""


def tools_inside(model: Model) -> Iterator[tuple[Joint, float]]:
    """Yield the fixed joints of frames of tools that are inside of the body with the fingers, and their depth [m]."""
    for joint in model.robot.joints:
        body, frame = (model.robot.link_by_name.get(name or "") for name in (joint.parent, joint.child))
        if joint.type != "fixed" or body is None or frame is None or shapes_of(frame):
            continue
        if not _TOOL.search(f"{joint.name} {frame.name}") or not any(_fingers(body.name, model)):
            continue
        depths = [
            (_depth(shape.geometry, shape.origin.xyz, joint.origin.xyz), _size(shape.geometry))
            for shape in shapes_of(body)
            if isinstance(shape.geometry, (Box, Cylinder)) and not any(shape.origin.rpy)
        ]
        depth, size = max(depths, default=(0.0, 0.0))
        if depth > max(_DEPTH, _PART * size):
            yield joint, depth


def tools_behind(model: Model) -> Iterator[tuple[Joint, bool]]:
    """Yield the fixed joints of frames of tools that are not in front of the fingers, and whether they are behind."""
    for joint in model.robot.joints:
        frame, fingers = model.robot.link_by_name.get(joint.child or ""), list(_fingers(joint.parent or "", model))
        if joint.type != "fixed" or frame is None or shapes_of(frame) or not fingers:
            continue
        x, y, z = (sum(finger.origin.xyz[k] for finger in fingers) for k in range(3))
        direction, offset = unit((x, y, z)), unit(joint.origin.xyz)
        if direction is None or offset is None or not _TOOL.search(f"{joint.name} {frame.name}"):
            continue
        along = sum(a * b for a, b in zip(direction, offset, strict=True))
        if along < _BESIDE:
            yield joint, along < _BACK


def cameras_looking_back(model: Model) -> Iterator[tuple[Joint, str]]:
    """Yield the joints that mount cameras next to tools, whose view is opposite to the direction of the tool.

    The second value is the optical frame.
    """
    fixed: dict[str, list[Joint]] = {}
    for joint in model.robot.joints:
        if joint.type == "fixed" and joint.parent and joint.child:
            fixed.setdefault(joint.parent, []).append(joint)
    for carrier in model.robot.joints:
        if carrier.type not in ("revolute", "continuous") or carrier.child is None:
            continue
        frames, mounts = {carrier.child: Frame()}, dict[str, Joint]()
        pending = [carrier.child]
        for name in pending:  # The list grows during the iteration.
            for joint in fixed.get(name, ()):
                child = joint.child or ""
                if child not in frames:
                    frames[child] = frames[name].moved(joint.origin)
                    mounts[child] = mounts[name] if _CAMERA.search(name) and name in mounts else joint
                    pending.append(child)
        points = [
            frames[name].moved(joint.origin).translation for name in frames for joint in _fingers(name, model)
        ] or [frame.translation for name, frame in frames.items() if _TOOL.search(name)]
        x, y, z = (sum(parts) / len(points) for parts in zip(*points, strict=True)) if points else (0.0, 0.0, 0.0)
        direction = unit((x, y, z))
        for name, frame in frames.items() if direction is not None else ():
            if name in mounts and _CAMERA.search(name) and "optical" in name.lower():
                view = [row[2] for row in frame.rotation]
                if sum(a * b for a, b in zip(view, direction or (0.0, 0.0, 0.0), strict=True)) < _BACK:
                    yield mounts[name], name
                    break


def _fingers(link: str, model: Model) -> Iterator[Joint]:
    for joint in model.robot.children_of.get(link, ()):
        if joint.is_movable and _FINGER.search(f"{joint.name} {joint.child}"):
            yield joint


def _size(shape: Box | Cylinder) -> float:
    return min(shape.size) if isinstance(shape, Box) else min(2.0 * shape.radius, shape.length)


def _depth(shape: Box | Cylinder, centre: Vector, point: Vector) -> float:
    x, y, z = (a - b for a, b in zip(point, centre, strict=True))
    if isinstance(shape, Box):
        return min(size / 2.0 - abs(part) for size, part in zip(shape.size, (x, y, z), strict=True))
    return min(shape.radius - hypot(x, y), shape.length / 2.0 - abs(z))
