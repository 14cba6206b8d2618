"""Axes of consecutive joints: the lines that they turn about."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from math import dist

from urdfkit.description.urdf.geometry import product, rotate, unit
from urdfkit.description.urdf.robot import Joint, Pose, Vector
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Frame

_TURNING = ("revolute", "continuous")

_PARALLEL = 0.99999
"""Smallest cosine of the angle between axes on one line."""

_DISTANCE = 1e-4
"""Largest distance between two axes on one line [m]."""


def turning_joint_above(joint: Joint, model: Model) -> tuple[Joint, Frame] | None:
    """Return the moving joint that carries a joint, and the frame of the joint in it; None if it does not turn."""
    frame, parent = Frame().moved(joint.origin), joint.parent
    for _ in model.robot.joints:
        above = model.robot.parents_of.get(parent or "", [])
        if len(above) != 1:
            return None
        if above[0].is_movable:
            return (above[0], frame) if above[0].type in _TURNING else None
        outer = Frame().moved(above[0].origin)
        place = outer.moved(Pose(frame.translation)).translation
        frame = Frame(product(outer.rotation, frame.rotation), place)
        parent = above[0].parent
    return None


def on_one_line(model: Model) -> Iterator[tuple[Joint, Joint]]:
    """Yield each joint that turns about the same line as the moving joint that carries it: upper joint, lower joint.

    A joint that carries several moving joints, such as the waist of a humanoid, has an effect of its own. Joints
    without <origin> are not placed yet, and the place of one with an undefined property is unknown.
    """
    carriers = [(joint, turning_joint_above(joint, model)) for joint in model.robot.joints if joint.is_movable]
    counts = Counter(above[0].name for _, above in carriers if above is not None)
    for joint, above in carriers:
        axis, origin = unit(joint.axis), joint.element.find("origin")
        if joint.type not in _TURNING or joint.mimic is not None or axis is None or origin is None:
            continue
        if above is None or above[0].mimic is not None or counts[above[0].name] > 1:
            continue
        carrier, frame = above
        other = unit(carrier.axis)
        if other is None:
            continue
        turned = rotate(frame.rotation, axis)
        along = sum(a * b for a, b in zip(frame.translation, other, strict=True))
        nearest: Vector = (along * other[0], along * other[1], along * other[2])
        cosine = abs(sum(a * b for a, b in zip(turned, other, strict=True)))
        is_on_line = cosine > _PARALLEL and dist(nearest, frame.translation) < _DISTANCE
        if is_on_line and not (model.is_unresolved(origin, "xyz") or model.is_unresolved(origin, "rpy")):
            yield carrier, joint
