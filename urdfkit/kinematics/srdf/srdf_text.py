"""The text of an SRDF."""

import re
from collections.abc import Iterable, Sequence
from xml.sax.saxutils import quoteattr

from urdfkit.errors import DescriptionError
from urdfkit.kinematics.self_collision import CollisionMatrix
from urdfkit.kinematics.srdf.groups import EndEffector, PlanningGroup

REASONS = ("Adjacent", "Default", "Always", "Never")
"""Reasons of the lines that an update replaces; MoveIt's assistant writes the same. `User` is left as it is."""

_OURS = re.compile(
    r"[ \t]*<disable_collisions\b[^<>]*\breason\s*=\s*([\"'])(?:" + "|".join(REASONS) + r")\1[^<>]*?/>[ \t]*\r?\n?"
)
_PAIR = re.compile(r"<disable_collisions\b[^<>]*>")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_URDF = re.compile(r"<(?:visual|collision|inertial|parent)\b")
"""Elements of a URDF that no SRDF has."""


def new_srdf(
    name: str, groups: Sequence[PlanningGroup], effectors: Sequence[EndEffector], matrix: CollisionMatrix, base: str
) -> str:
    """Return a whole SRDF.

    Args:
        name: name of the robot.
        groups: planning groups.
        effectors: end effectors.
        matrix: collisions of the links.
        base: the root link, for MoveIt's fixed virtual joint.
    """
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', f"<robot name={quoteattr(name)}>"]
    for group in groups:
        lines.append(f"  <group name={quoteattr(group.name)}>")
        if group.base:
            lines.append(f"    <chain base_link={quoteattr(group.base)} tip_link={quoteattr(group.tip)}/>")
        else:
            lines += [f"    <joint name={quoteattr(joint)}/>" for joint in group.joints]
        lines.append("  </group>")
    for each in effectors:
        words = {"name": each.name, "parent_link": each.parent, "group": each.group, "parent_group": each.parent_group}
        lines.append(f"  <end_effector {' '.join(f'{key}={quoteattr(value)}' for key, value in words.items())}/>")
    if groups:
        words = {"name": "fixed_base", "type": "fixed", "parent_frame": "world", "child_link": base}
        if base != "world":
            lines.append(f"  <virtual_joint {' '.join(f'{key}={quoteattr(value)}' for key, value in words.items())}/>")
    lines += _disabled(matrix, ())
    return "\n".join([*lines, "</robot>", ""])


def updated_srdf(old: str, matrix: CollisionMatrix, file: str) -> str:
    """Return an SRDF whose lines of disabled pairs with a reason of `REASONS` are replaced; the rest stays.

    Args:
        old: text of the SRDF.
        matrix: collisions of the links.
        file: its name, for the message.

    Raises:
        DescriptionError: the text has no ``</robot>``, or is a URDF.
    """
    if "</robot>" in old and _URDF.search(_COMMENT.sub("", old)):
        raise DescriptionError(f"{file} is a URDF, not an SRDF; it was not changed")
    hidden = [match.span() for match in _COMMENT.finditer(old)]
    found = [match for match in _OURS.finditer(old) if not any(a <= match.start() < b for a, b in hidden)]
    kept = old
    for match in reversed(found):
        kept = kept[: match.start()] + kept[match.end() :]
    others = [frozenset(_links(tag)) for tag in _PAIR.findall(_COMMENT.sub("", kept))]
    end = kept.rfind("</robot>")
    if end < 0:
        raise DescriptionError(f"{file} has no </robot>: it is not an SRDF")
    at = min(found[0].start(), end) if found else kept.rfind("\n", 0, end) + 1
    text = "".join(f"{line}\n" for line in _disabled(matrix, others))
    return kept[:at] + text + kept[at:]


def _disabled(matrix: CollisionMatrix, but: Iterable[frozenset[str]]) -> list[str]:
    without = set(but)
    return [
        f'  <disable_collisions link1={quoteattr(pair.first)} link2={quoteattr(pair.second)} reason="{pair.reason}"/>'
        for pair in matrix.disabled
        if frozenset((pair.first, pair.second)) not in without
    ]


def _links(tag: str) -> list[str]:
    return [match[2] for match in re.finditer(r"\blink[12]\s*=\s*([\"'])(.*?)\1", tag)]
