"""Positions of joints in the parameters of a robot's own nodes: beyond their limits, or in degrees or millimetres."""

import math
import re
from collections.abc import Iterator, Sequence

from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import controllers
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of, yamls
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.model.model import Model

_JOINTS = ("joints", "joint_names")
_NO_POSITIONS = (
    r"gain|vel|acc|jerk|effort|torque|current|tolerance|weight|limit|scal|offset|sign|ratio|time|id|index|max"
    r"|covar|noise"
)
"""Matches names of lists that are not positions of joints."""

_FEWEST, _FEWEST_OF_POSITIONS = 4, 3
"""Smallest number of joints whose lists are compared; the second for lists that are named as positions."""

_ROUNDING = {"revolute": 5e-3, "prismatic": 1e-3}
"""Type of a joint → accepted excess over a limit [rad or m]; 2.97 is a rounded limit of 2.967."""

_MOST_LACKING = 2
"""Largest difference of the lengths of lists that a missing value explains."""


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
        if lists:
            yield from _other_order(source, joints, names, [value for _, value in lists])
        is_listed = any(len(value.items) == len(names) for _, value in lists)
        for key, value in lists:
            lacking = abs(len(value.items) - len(names))
            if lacking == 0:
                yield from _beyond(key.text, value.items, names, robot)
            elif (
                is_listed
                and len(names) >= (_FEWEST_OF_POSITIONS if re.search(_POSITION, key.text) else _FEWEST)
                and lacking <= _MOST_LACKING
            ):
                yield value, f"`{key.text}` has {len(value.items)} values for {len(names)} joints"


def _other_order(
    source: Source, joints: Node | None, names: list[str], lists: list[Node]
) -> Iterator[tuple[Node, str]]:
    """Yield the list of joints whose order differs from that of a comment above or next to one of its lists.

    A comment is compared if it has one phrase for each joint, such as ``# rail m, lift m, yaw rad``.
    """
    lines = source.text.splitlines()
    for value in lists:
        if joints is None or len(value.items) != len(names):
            continue
        for number in (value.line - 1, value.line):
            _, sign, comment = lines[number - 1].partition("#")
            phrases = [re.findall(r"[a-z]\w*", phrase.lower()) for phrase in comment.split(",")] if sign else []
            if len(phrases) != len(names) or not all(phrases):
                continue
            parts = [name.lower().split("_") for name in names]
            fits = [
                [at for at, words in enumerate(parts) if phrase[0] in (*words, "_".join(words))] for phrase in phrases
            ]
            wrong = [at for at, found in enumerate(fits) if len(found) == 1 and found != [at]]
            if len(wrong) > 1 and {fits[at][0] for at in wrong} == set(wrong):
                first = wrong[0]
                message = f"joint {first + 1} of `joints` is `{names[first]}`, but `{' '.join(phrases[first])}` "
                yield joints.items[first], message + f"in the comment on line {number}"
                return


def _is_numbers(value: Node) -> bool:
    return bool(value.items) and all(item.is_plain and number_of(item) is not None for item in value.items)


def _is_other(name: str) -> bool:
    return re.search(_NO_POSITIONS, name, re.IGNORECASE) is not None


def _beyond(list_name: str, values: Sequence[Node], names: list[str], robot: Robot) -> Iterator[tuple[Node, str]]:
    """Yield the values beyond the limits of their joint, unless half of the values are, so that they are no positions.

    A single value is a position if it is beyond a limit by less than the range of the joint; others are in the units
    of a servo.
    """
    found = []
    for item, name in zip(values, names, strict=True):
        joint, number = robot.joint_by_name.get(name), number_of(item)
        limit = joint.limit if joint is not None and joint.type in ("revolute", "prismatic") else None
        lower, upper = (limit.lower or 0.0, limit.upper or 0.0) if limit is not None else (0.0, 0.0)
        excess = max(lower - number, number - upper) if number is not None else 0.0
        least = _ROUNDING.get(joint.type or "", 0.0) if joint is not None else 0.0
        if lower < upper and excess > least and (len(names) > 1 or excess < upper - lower):
            bounds = f"{lower:g} to {upper:g}"
            found.append((item, f"`{list_name}` has {number:g} for joint `{name}`, whose limits are {bounds}"))
    if 2 * len(found) < len(names) or len(names) == 1:
        yield from found


_POSITION = r"home|pose|position|initial|ready|rest|stow|park|fold|waypoint|goal|target|start|angle|configuration"
"""Matches names of positions of several joints."""

_OF_ONE = r"(?:position|pose|angle|width|opening|home|open|closed?|raised|lowered|extended|retracted|stowed)$"
"""Matches names of positions of one joint."""

_OF_GRIPPER = r"^(?:open|grip|grasp|closed?)\w*_(?:width|position|opening)$"
"""Matches names of positions of a gripper."""

_CONVERTED = {
    "degrees": r"(?i)radians\s*\(|deg\w*2\w*rad|deg\w*_to_rad|/\s*180|180\.?0?\s*\*",
    "millimetres": r"(?i)/\s*1000|\*\s*0?\.001|\*\s*1e-3",
}
"""Unit → pattern of code that converts it."""

_WRITTEN = r"(?i)deg|\bmm\b|_mm\b|millimet"
"""Matches a file that names one of these units."""

_FACTORS = {"degrees": math.pi / 180.0, "millimetres": 1e-3}
_LEAST = 3
"""Fewest values of a list without the names of its joints."""


def positions_beyond_limits(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the positions beyond the limits of their joints that are within them as degrees or millimetres.

    Files and code that name the unit, or convert it, are accepted. Of joints that are listed alone, and of the first
    positions that the setup assistant of MoveIt 2 writes, other positions beyond the limits are yielded too.
    """
    robot, words = model.robot, None
    for source in yamls(model):
        if re.search(_WRITTEN, source.text):
            continue
        seen = set[tuple[int, int]]()
        for key, values in _compared(source, model):
            found = [(unit, *each) for unit in _FACTORS if (each := _outside(values, robot, unit)) is not None]
            if not found and len(values) == 1 and not _is_other(key) and not re.search(_OF_GRIPPER, key):
                name, value = values[0]
                for node, message in _beyond(key, [value], [name], robot):
                    yield source, node, message
            if not found or (found[0][2].line, found[0][2].column) in seen:
                continue
            unit, joint, value, bounds = found[0]
            seen.add((value.line, value.column))
            words = words or Words(model)
            if not words.match(_CONVERTED[unit]):
                right = "radians" if unit == "degrees" else "metres"
                message = f"`{key}` has {value.text} for joint `{joint}`, whose limits are {bounds}; write {right}"
                yield source, value, message + f", if the values are {unit}"


def _compared(source: Source, model: Model) -> Iterator[tuple[str, list[tuple[str, Node]]]]:
    """Yield the positions; those of ``initial_positions`` one by one, unless all are in another unit."""
    for key, values in _positions(source, model):
        is_split = key == "initial_positions" and not any(_outside(values, model.robot, unit) for unit in _FACTORS)
        yield from ((key, [each]) for each in values) if is_split else ((key, values),)


def _positions(source: Source, model: Model) -> Iterator[tuple[str, list[tuple[str, Node]]]]:
    """Yield the name of positions of joints, and the value of each joint."""
    robot, is_of_controllers = model.robot, bool(controllers(source))
    for group in (node for node in nodes(source) if node.entries):
        listed = next((each for name in (*_JOINTS, "joint") if (each := group.find(name)) is not None), None)
        names = listed.texts() if listed is not None else []
        gripper = _gripper_of(group, model) if any(re.search(_OF_GRIPPER, key.text) for key, _ in group.entries) else ""
        for key, value in group.entries:
            is_other, is_position = _is_other(key.text), re.search(_POSITION, key.text, re.IGNORECASE) is not None
            points = [point for item in value.items if (point := item.find("positions")) is not None]
            if len(names) == 1 and re.search(_OF_ONE, key.text) and number_of(value) is not None:
                yield key.text, [(names[0], value)]
            elif gripper and re.search(_OF_GRIPPER, key.text) and number_of(value) is not None:
                yield key.text, [(gripper, value)]
            if is_other or value is listed or not (is_position or points):
                continue
            pairs = [(each.text, inner) for each, inner in value.entries]
            if pairs and all(name in robot.joint_by_name for name, _ in pairs):
                yield key.text, pairs
            for numbers in (value, *points) if names else ():
                if len(numbers.items) == len(names) and _is_numbers(numbers):
                    yield key.text, list(zip(names, numbers.items, strict=True))
            if not names and not is_of_controllers and len(value.items) >= _LEAST and _is_numbers(value):
                sets = {each for each in _groups(model) if len(each) == len(value.items)}
                if len(sets) == 1:
                    yield key.text, list(zip(sets.pop(), value.items, strict=True))


def _gripper_of(group: Node, model: Model) -> str:
    """Return the joint of the only controller of one joint whose topic or action a node uses; empty without one."""
    found = set[str]()
    for _, value in group.entries:
        first, separator, _ = value.text.strip("/").partition("/")
        for one in (each for source in yamls(model) for each in settings(source)) if separator else ():
            joint = one.group.find("joint") or one.group.find("joints")
            if one.name == first and joint is not None and len(joint.texts()) == 1:
                found.update(joint.texts())
    return found.pop() if len(found) == 1 else ""


def _groups(model: Model) -> set[tuple[str, ...]]:
    """Return the lists of joints of the robot in its YAML files."""
    found = set[tuple[str, ...]]()
    for source in yamls(model):
        for group in (node for node in nodes(source) if node.entries):
            for name in _JOINTS:
                joints = group.find(name)
                names = tuple(joints.texts()) if joints is not None else ()
                if names and all(each in model.robot.joint_by_name for each in names):
                    found.add(names)
    return found


def _outside(values: list[tuple[str, Node]], robot: Robot, unit: str) -> tuple[str, Node, str] | None:
    """Return the first joint and value beyond the limits, and these, if all values are within them in a unit."""
    kind = "revolute" if unit == "degrees" else "prismatic"
    first, factor = None, _FACTORS[unit]
    for name, value in values:
        joint, number = robot.joint_by_name.get(name), number_of(value)
        limit = joint.limit if joint is not None and joint.type == kind else None
        if limit is None or limit.lower is None or limit.upper is None or not limit.lower < limit.upper:
            continue
        if number is None or 0.0 < abs(number) < 1.0:
            return None
        slack = 0.02 * (limit.upper - limit.lower)
        if not limit.lower - slack <= factor * number <= limit.upper + slack:
            return None
        is_beyond = not limit.lower - slack <= number <= limit.upper + slack
        if first is None and is_beyond:
            first = name, value, f"{limit.lower:g} to {limit.upper:g}"
    largest = max((abs(number_of(value) or 0.0) for _, value in values), default=0.0)
    return first if unit != "degrees" or largest > 2.0 * math.pi else None
