"""Lists of joint positions in the parameters of a robot's own nodes, next to the list of these joints."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of

_JOINTS = ("joints", "joint_names")
_NO_POSITIONS = (
    r"gain|vel|acc|jerk|effort|torque|current|tolerance|weight|limit|scal|offset|sign|ratio|time|id|index|max"
)
"""Matches names of lists that are not positions of joints."""

_FEWEST = 4
_MOST_LACKING = 2


def list_defects(source: Source, robot: Robot) -> Iterator[tuple[Node, str]]:
    """Yield the lists of positions with a wrong number of values, and the values beyond the limits of their joint.

    A list is compared if a list of numbers next to it, or the list itself, has one value for each joint.
    """
    for group in (node for node in nodes(source) if node.entries):
        joints = next((list_ for name in _JOINTS if (list_ := group.find(name)) is not None), None)
        names = [item.text for item in joints.items] if joints is not None else []
        if len(names) < 2 or any(name not in robot.joint_by_name for name in names):
            continue
        lists = [(key, value) for key, value in group.entries if _is_numbers(value) and not _is_other(key.text)]
        is_listed = any(len(value.items) == len(names) for _, value in lists)
        for key, value in lists:
            lacking = abs(len(value.items) - len(names))
            if lacking == 0:
                yield from _beyond(key.text, value, names, robot)
            elif is_listed and len(names) >= _FEWEST and lacking <= _MOST_LACKING:
                yield value, f"`{key.text}` has {len(value.items)} values for {len(names)} joints"


def _is_numbers(value: Node) -> bool:
    return bool(value.items) and all(item.is_plain and number_of(item) is not None for item in value.items)


def _is_other(name: str) -> bool:
    return re.search(_NO_POSITIONS, name, re.IGNORECASE) is not None


def _beyond(list_name: str, value: Node, names: list[str], robot: Robot) -> Iterator[tuple[Node, str]]:
    """Yield the values beyond the limits of their joint, unless most of them are, so that they are no positions."""
    found = []
    for item, name in zip(value.items, names, strict=True):
        joint, number = robot.joint_by_name[name], number_of(item)
        limit = joint.limit if joint.type in ("revolute", "prismatic") else None
        lower, upper = (limit.lower, limit.upper) if limit is not None else (None, None)
        if number is None or lower is None or upper is None or not lower < upper:
            continue
        if not lower - 1e-3 <= number <= upper + 1e-3:
            bounds = f"{lower:g} to {upper:g}"
            found.append((item, f"`{list_name}` has {number:g} for joint `{name}`, whose limits are {bounds}"))
    if 2 * len(found) < len(names):
        yield from found
