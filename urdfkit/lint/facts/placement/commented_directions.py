"""Directions that comments state for the positive direction of a joint: ``<!-- boom, positive = upwards -->``."""

from __future__ import annotations

import re
from collections.abc import Mapping

from urdfkit.description.urdf.geometry import unit
from urdfkit.description.urdf.robot import Joint, Vector
from urdfkit.lint.facts.placement.joint_axes import axis_in_root
from urdfkit.lint.model.model import Model

_STATED = re.compile(
    r"(?i)\b(positive|negative)\b[^.;,]{0,40}?\b"
    r"(?:(up(?:wards?)?|lifts?(?!\s*(?:[=:]|means\b|is\b))|raises?)|(down(?:wards?)?|lowers?)|(forwards?)|(backwards?|rearwards?))\b"
)
_SIGN = re.compile(r"(?i)<!--[^<>]*\b(?:positive|negative)\b")
_LOOKS = re.compile(r"(?i)\blooks?\b")
"""Comments on a sign, and words of a view, whose direction is not that of the centre of its load."""

_DIRECTIONS: tuple[Vector, ...] = ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0))

_OPPOSITE = -0.5
"""Cosine of the smallest angle between the stated direction and an opposite motion."""


def stated_directions(model: Model) -> dict[tuple[str, int], re.Match[str]]:
    """Return the file and the place of each tag directly after a comment on a direction, and the words of the comment.

    Between the comment and the tag there is only white space.
    """
    stated = {}
    for file, source in model.expanded.sources.items():
        for _, end, text in model.document(file).comments if _SIGN.search(source.text) else ():
            if (found := _STATED.search(text)) is not None:
                stated[file, end + len(source.text[end:]) - len(source.text[end:].lstrip())] = found
    return stated


def contradicted_comment(joint: Joint, model: Model, stated: Mapping[tuple[str, int], re.Match[str]]) -> str:
    """Return the words of the comment before a joint that its motion contradicts; empty if it contradicts none.

    The comment is the last one before the joint, or before the macro call that makes the joint. The motion is that of
    the centre of the shapes that the joint carries, with every joint at zero.

    Args:
        joint: a joint of the robot.
        model: the robot.
        stated: the result of `stated_directions`.
    """
    origin = joint.element.origin
    positions = (origin.position, *(call.position for call in origin.expansions[:1]))
    places = [(at.file, tag.start) for at in positions if (tag := model.tag(at)) is not None]
    words = next((stated[place] for place in places if place in stated), None)
    motion = _motion(joint, model) if words is not None and not _LOOKS.search(words[0]) else None
    if words is None or motion is None:
        return ""
    direction = next(each for each, word in zip(_DIRECTIONS, words.groups()[1:], strict=True) if word)
    sign = -1.0 if words[1].lower() == "negative" else 1.0
    along = sign * sum(a * b for a, b in zip(motion, direction, strict=True))
    return " ".join(words[0].split()) if along < _OPPOSITE else ""


def _motion(joint: Joint, model: Model) -> Vector | None:
    """Return the direction in which a joint moves the centre of its load; None if it is unknown."""
    axis, frame = axis_in_root(joint, model), model.frames.get(joint.child or "")
    if axis is None or frame is None or joint.type == "prismatic":
        return axis
    below = [joint.child]
    for name in below:  # The list grows during the iteration.
        below += [each.child for each in model.robot.joints if each.parent == name and each.child not in below]
    corners = [
        corner
        for name in below
        if name is not None and name in model.extents and name in model.frames
        for corner in model.extents[name].corners_in(model.frames[name])
    ]
    if not corners:
        return None
    x, y, z = (sum(corner[k] for corner in corners) / len(corners) - frame.translation[k] for k in range(3))
    a, b, c = axis
    return unit((b * z - c * y, c * x - a * z, a * y - b * x))
