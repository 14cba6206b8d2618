"""Defects of collision_monitor and of the inputs of twist_mux in ROS 2 parameter files.

Sources: ros-navigation/navigation2 (collision_monitor_node.cpp, polygon.cpp, Humble to Rolling), ros-teleop/twist_mux
(twist_mux.cpp, topic_handle.hpp).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, number_of
from urdfkit.lint.facts.navigation.sections import sections

Defects = Iterator[tuple[Node, str]]

_LISTS = {
    "polygons": ("polygon", "circle", "velocity_polygon"),
    "observation_sources": ("scan", "pointcloud", "range", "polygon", "costmap"),
}
"""List of names → types of the sections with these names."""

_ACTIONS = ("stop", "slowdown", "limit", "approach", "none")
_LEAST = 4
"""Number of points that a polygon needs (polygon.cpp: 7 values and 3 points are refused; migration guide, Iron.rst)."""

_PAIR = r"\[\s*[-+.\deE]+\s*,\s*[-+.\deE]+\s*\]"


def monitor_defects(source: Source) -> Defects:
    """Yield the defects of collision_monitor and collision_detector."""
    for key, group in sections(source) if PARAMETERS in source.text else ():
        if key.last_name not in ("collision_monitor", "collision_detector"):
            continue
        into, out = group.find("cmd_vel_in_topic"), group.find("cmd_vel_out_topic")
        if into is not None and out is not None and into.text.strip("/") == out.text.strip("/"):
            if out.text.strip("/") == "cmd_vel":  # the default, which drives the robot
                yield into, f"`cmd_vel_in_topic` is `{out.text}`, the topic that the node publishes"
            else:
                yield out, f"`cmd_vel_out_topic` is `{into.text}`, the topic to which the node subscribes"
        for name, types in _LISTS.items():
            listed = group.find(name)
            for item in listed.items if listed is not None else ():
                section = group.find(item.text)
                if section is None:
                    if item.text and not any(each.text.startswith(f"{item.text}.") for each, _ in group.entries):
                        others = [each.text for each, value in group.entries if value.find("type") is not None]
                        near = nearest(item.text, others, cutoff=0.6)
                        yield item, f"`{name}` lists `{item.text}`, which has no section" + Suggestion(near, item.text)
                else:
                    yield from _part(section, item.text, types, name == "polygons")


def _part(section: Node, name: str, types: tuple[str, ...], is_polygon: bool) -> Defects:
    kind, action, points = (section.find(each) for each in ("type", "action_type", "points"))
    if kind is not None and kind.text not in types and kind.text and "$" not in kind.text:
        hint = Suggestion(nearest(kind.text, types), kind.text) or f"; write one of {', '.join(types)}"
        yield kind, f"unknown type `{kind.text}` of `{name}`" + hint
    if not is_polygon:
        return
    if action is not None and action.text not in _ACTIONS and "$" not in action.text:
        hint = Suggestion(nearest(action.text, _ACTIONS), action.text) or f"; write one of {', '.join(_ACTIONS)}"
        yield action, f"unknown `action_type` `{action.text}` of `{name}`" + hint
    if points is not None and points.kind == "text" and points.text and "$" not in points.text:
        pairs = re.findall(_PAIR, points.text)
        if not re.fullmatch(rf"\[\s*{_PAIR}(?:\s*,\s*{_PAIR})*\s*\]", points.text.strip()):
            yield points, f"`points` of `{name}` is not a list of points; write [[x1, y1], [x2, y2], …]"
        elif len(pairs) < _LEAST:
            yield points, f"`points` of `{name}` has {len(pairs)} points; collision_monitor needs at least {_LEAST}"
    elif points is not None and points.kind == "list":
        count = len(points.items) if all(item.kind == "text" for item in points.items) else 2 * _LEAST
        if count % 2 or count < 2 * _LEAST:
            yield points, f"`points` of `{name}` has {count} values; write x and y of at least {_LEAST} points"
    radius = section.find("radius")
    if kind is not None and kind.text == "circle" and radius is None:
        yield kind, f"circle `{name}` has no `radius`"


def mux_defects(source: Source) -> Defects:
    """Yield inputs of twist_mux with one priority, missing parameters, and stops that do not stop every input."""
    for root in documents(source) if "priority" in source.text else ():
        groups = [group for _, group in sections(source)] if PARAMETERS in source.text else [root]
        groups += [value for _, value in root.entries] if PARAMETERS not in source.text else []
        for group in groups:
            inputs = _inputs(group.find("topics"))
            by_priority: dict[float, str] = {}
            for name, entry in inputs:
                value = entry.find("priority")
                number = number_of(value)
                if value is None or number is None:
                    continue
                if number in by_priority:
                    message = (
                        f"inputs `{by_priority[number]}` and `{name}` of twist_mux have the same priority, {number:g}"
                    )
                    yield value, f"{message}; only one of them is forwarded"
                by_priority.setdefault(number, name)
            yield from _unending(inputs)
            yield from _below_navigation(inputs)
            for name, entry in _inputs(group.find("locks")):
                value = entry.find("priority")
                number = number_of(value)
                if value is None or number is None or not by_priority:
                    continue
                if 0 < number <= min(by_priority):
                    yield value, f"lock `{name}` has the priority {number:g}, but no input has a lower priority"
                    continue
                if not re.search(r"stop|emergency", name, re.I):
                    continue
                above = [each for priority, each in by_priority.items() if priority > number]
                if above and number > 0:
                    yield value, f"lock `{name}` has the priority {number:g} and does not stop input `{above[-1]}`"


def _below_navigation(inputs: list[tuple[str, Node]]) -> Defects:
    """Yield the priority of each joystick that cannot interrupt the commands of navigation."""
    values = [(name, entry.find("priority"), entry.find("topic")) for name, entry in inputs]
    named = [(f"{name} {topic.text}" if topic is not None else name, name, value) for name, value, topic in values]
    goals = [
        (number, name)
        for words, name, value in named
        if re.search(_NAVIGATES, words, re.I) and not re.search(_MANUAL, words, re.I)
        if (number := number_of(value)) is not None
    ]
    for words, name, value in named:
        number = number_of(value)
        above = [other for priority, other in goals if number is not None and priority > number]
        if value is not None and number and above and re.search(_MANUAL, words, re.I):
            message = f"input `{name}` has the priority {number:g}, lower than `{above[0]}`"
            message += ", so an operator cannot interrupt it"
            yield value, message


_NAVIGATES = r"nav|move_base|autonom|planner"
_MANUAL = r"joy|gamepad|joystick"
"""Words of inputs of twist_mux: commands of a program, and of a person."""


def _unending(inputs: list[tuple[str, Node]]) -> Defects:
    """Yield the timeouts of zero, with which the last command of an input blocks those of lower priority for ever.

    Source: twist_mux (topic_handle.hpp, ``hasExpired``).
    """
    priorities = [number_of(entry.find("priority")) for _, entry in inputs]
    for (name, entry), own in zip(inputs, priorities, strict=True):
        value = entry.find("timeout")
        is_above = own is not None and any(other is not None and other < own for other in priorities)
        if value is not None and number_of(value) == 0.0 and is_above:
            yield value, f"`timeout` of input `{name}` is 0, so its last command blocks the other inputs forever"


def _inputs(node: Node | None) -> list[tuple[str, Node]]:
    """Return the inputs of twist_mux: groups in ROS 2, a list of groups in ROS 1."""
    if node is None:
        return []
    named = [(key.text, value) for key, value in node.entries if value.kind == "group"]
    items = [(name.text if (name := item.find("name")) is not None else "", item) for item in node.items]
    return named + [(name, item) for name, item in items if item.kind == "group"]
