"""The text of an SRDF."""

import re
from collections.abc import Iterable, Sequence
from xml.sax.saxutils import quoteattr, unescape

from urdfkit.description.urdf.robot import Robot
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
_NAME = re.compile(r"<robot\b[^<>]*?\bname\s*=\s*([\"'])(.*?)\1")
_LINK = re.compile(r"<link\b[^<>]*?\bname\s*=\s*([\"'])(.*?)\1")
_LINKS = re.compile(r"\b(?:link[12]|base_link|tip_link|parent_link|child_link)\s*=\s*([\"'])(.*?)\1")
SHARED = 0.5
"""Part of the links of an SRDF that a robot has at least, unless the SRDF is another robot's."""


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


def missing_links(old: str, robot: Robot, file: str) -> list[str]:
    """Return the links that an SRDF names and the robot does not have, in the order of the SRDF.

    Args:
        old: text of the SRDF; values with a ``$`` of xacro are ignored.
        robot: the robot.
        file: name of the SRDF, for messages.

    Raises:
        DescriptionError: the text is a URDF, or the SRDF is that of another robot, by its name or most of its links.
    """
    text = _COMMENT.sub("", old)
    if "</robot>" in text and _URDF.search(text):
        raise DescriptionError(f"{file} is a URDF, not an SRDF; it was not changed")
    names = [unescape(match[2]) for match in _NAME.finditer(text)][:1]
    if names and "$" not in names[0] and names[0] != robot.name:
        raise DescriptionError(f"{file} is the SRDF of robot `{names[0]}`, not of `{robot.name}`; it was not changed")
    found = (unescape(match[2]) for pattern in (_LINK, _LINKS) for match in pattern.finditer(text))
    links = dict.fromkeys(name for name in found if "$" not in name)
    missing = [name for name in links if name not in robot.link_by_name]
    if len(missing) > (1.0 - SHARED) * len(links):
        raise DescriptionError(
            f"{file} is the SRDF of another robot `{robot.name}`: {len(missing)} of its {len(links)} links, such as "
            f"`{missing[0]}`, do not exist in robot `{robot.name}`; it was not changed"
        )
    return missing


def updated_srdf(old: str, matrix: CollisionMatrix, file: str) -> str:
    """Return an SRDF whose lines of disabled pairs with a reason of `REASONS` are replaced; the rest stays.

    Lines of links whose shapes cannot be read stay, too.

    Args:
        old: text of the SRDF.
        matrix: collisions of the links.
        file: its name, for the message.

    Raises:
        DescriptionError: the text has no ``</robot>``.
    """
    hidden = [match.span() for match in _COMMENT.finditer(old)]
    found = [
        match
        for match in _OURS.finditer(old)
        if not any(a <= match.start() < b for a, b in hidden) and matrix.incomplete.isdisjoint(_links(match[0]))
    ]
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
