"""Defects of the parameters of Nav2 and robot_localization.

Sources: ros-navigation/navigation2 (costmap_2d_ros.cpp, obstacle_layer.cpp, velocity_smoother.cpp, node_utils.hpp),
robot_localization (ros_filter.cpp), Humble to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest, suggestion
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, not_a_number, number_of, walk
from urdfkit.lint.facts.navigation.tables import (
    DEFAULTS,
    DOUBLES,
    INTEGERS,
    NODES,
    OTHERS,
    PLUGINS,
    POSITIVE,
    VELOCITY_LIMITS,
)

Defects = Iterator[tuple[Node, str]]

_LISTS = ("plugins", "filters", "navigators")
_INPUT = r"((?:odom|imu|pose|twist)\d+)(?:_(\w+))?"
_OF_INPUTS = (
    *("config", "differential", "relative", "queue_size", "remove_gravitational_acceleration", "nodelay"),
    *("pose_rejection_threshold", "twist_rejection_threshold", "linear_acceleration_rejection_threshold"),
)
_TOPICS = ("scan", "odom", "cmd_vel", "joint_states", "local_costmap", "global_costmap", "costmap_raw")
_INTEGER = r"[-+]?\d+"
_DOUBLE = r"[-+]?\d*\.\d*"


def sections(source: Source) -> Iterator[tuple[Node, Node]]:
    """Yield the names of nodes of ROS 2 in a YAML file with their parameters; namespaces are passed over."""
    waiting = [(entry, 0) for root in documents(source)[0] for entry in root.entries]
    while waiting:
        (key, value), depth = waiting.pop(0)
        group = value.find(PARAMETERS)
        if group is not None:
            yield key, group
        elif depth < 3:
            waiting += [(entry, depth + 1) for entry in value.entries]


def navigation_defects(source: Source, controllers: frozenset[str]) -> Defects:
    """Yield the defects of the parameters of Nav2 and robot_localization.

    Args:
        source: a YAML file.
        controllers: the names of the controllers of the robot, in which topics of sensors start.
    """
    if PARAMETERS not in source.text:
        return
    for key, group in sections(source):
        name = key.text.strip("/").rpartition("/")[2]
        if name in NODES:
            for node in walk(group):
                yield from _plugins(node)
                yield from _values(node)
            if name == "velocity_smoother":
                yield from _velocity_limits(group)
        elif group.find("world_frame") is not None and group.find("odom_frame") is not None:
            yield from _filter(group, controllers)


def misspelt_navigation(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield the misspelt nodes, plugins and parameters of Nav2: YAML node, kind, suggested name."""
    from urdfkit.lint.facts.ros_packages import is_slip

    if PARAMETERS not in source.text:
        return
    valid = DOUBLES | INTEGERS | OTHERS
    named = [(key, group, key.text.strip("/").rpartition("/")[2]) for key, group in sections(source)]
    written = {name for _, _, name in named}
    for key, group, name in named:
        if name not in NODES:
            near = next((each for each in sorted(NODES - written) if is_slip(name, each)), None)
            if near is not None:
                yield key, "node", near
            continue
        for node in walk(group) if name != "amcl" else ():  # `node_parameters` has the parameters of amcl
            names = {each.text for each, _ in node.entries}
            for parameter, value in node.entries:
                if parameter.text == "plugin" and value.kind == "text":
                    written_type = value.text.replace("/", "::")
                    near = nearest(written_type, PLUGINS, cutoff=0.93) if written_type not in PLUGINS else None
                    if near is not None and is_slip(written_type.rpartition("::")[2], near.rpartition("::")[2]):
                        yield value, "plugin", near.replace("::", "/" if "/" in value.text else "::")
                    continue
                topic = value.text.rpartition("/")[2]
                if topic not in _TOPICS and (parameter.text == "topic" or parameter.text.endswith("_topic")):
                    near = next((each for each in _TOPICS if is_slip(topic, each)), None)
                    if near is not None:
                        yield value, "topic", value.text.removesuffix(topic) + near
                if value.kind == "group" or parameter.text in valid or len(parameter.text) < 6:
                    continue
                near = next((each for each in sorted(valid - names) if is_slip(parameter.text, each)), None)
                if near is not None and len(near) >= 6:
                    yield parameter, "parameter", near


def wrong_numbers(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield integers in parameters of the type double, and the reverse: value, parameter, the right text."""
    for key, group in sections(source) if PARAMETERS in source.text else ():
        name = key.text.strip("/").rpartition("/")[2]
        is_filter = group.find("world_frame") is not None
        if name == "controller_manager":
            doubles, integers = frozenset[str](), frozenset(("update_rate",))
        elif name in NODES:
            doubles, integers = DOUBLES, INTEGERS
        elif is_filter:
            doubles, integers = frozenset(("frequency", "sensor_timeout")), frozenset()
        else:
            continue
        for parameter, value in (entry for node in walk(group) for entry in node.entries):
            if not value.is_plain:
                continue
            if parameter.text in doubles and re.fullmatch(_INTEGER, value.text):
                yield value, parameter.text, f"{value.text}.0"
            elif parameter.text in integers and re.fullmatch(_DOUBLE, value.text) and value.text.strip("+-."):
                yield value, parameter.text, f"{float(value.text):.0f}"


def _plugins(node: Node) -> Defects:
    """Yield plugins and observation sources that are listed without a section."""
    defined = {key.text: (key, value) for key, value in node.entries if value.kind == "group"}
    for key, value in node.entries:
        if key.text == "observation_sources" and value.kind == "text":
            listed = [(value, word) for word in value.text.split()]
            others = [name for name, (_, each) in defined.items() if each.find("topic") is not None]
        elif key.text in _LISTS or key.text.endswith("_plugins"):
            listed = [(item, item.text) for item in value.items if item.text]
            others = [name for name, (_, each) in defined.items() if each.find("plugin") is not None]
        else:
            continue
        names = {word for _, word in listed}
        unlisted = [name for name in others if name not in names]
        for item, word in listed:
            if word in defined or any(each.text.startswith(f"{word}.") for each, _ in node.entries):
                continue
            near = nearest(word, unlisted, cutoff=0.6) or (unlisted[0] if len(others) == len(unlisted) == 1 else None)
            if word in DEFAULTS and near is not None:
                message = f"section `{near}` is not in `{key.text}`; did you mean `{word}`?"
                yield defined[near][0], message
            elif near is not None or (word not in DEFAULTS and key.text != "observation_sources" and others):
                what = "topic" if key.text == "observation_sources" else "plugin"
                yield item, f"`{key.text}` lists `{word}`, which has no section with its `{what}`{suggestion(near)}"


def _values(node: Node) -> Defects:
    for key, value in node.entries:
        name = key.text
        if name == "data_type" and value.text not in ("LaserScan", "PointCloud2") and "$" not in value.text:
            near = nearest(value.text, ("LaserScan", "PointCloud2"))
            hint = suggestion(near) or "; write `LaserScan` or `PointCloud2`"
            yield value, f"unknown `data_type` `{value.text}` of an observation source{hint}"
        if name not in POSITIVE or value.kind != "text" or not value.text or "$" in value.text:
            continue
        if problem := not_a_number(value):
            yield value, f"`{name}` is {problem}"
        elif (number := number_of(value)) is not None and (number < 0.0 or (number == 0.0 and name not in _ZERO)):
            yield value, f"`{name}` is {number:g}; it must be positive"


_ZERO = ("robot_radius", "inflation_radius", "width", "height")
"""Parameters that may be zero."""


def _velocity_limits(group: Node) -> Defects:
    feedback = group.find("feedback")
    choices = ("OPEN_LOOP", "CLOSED_LOOP")
    if feedback is not None and feedback.text and feedback.text not in choices and "$" not in feedback.text:
        hint = suggestion(nearest(feedback.text, choices)) or "; write `OPEN_LOOP` or `CLOSED_LOOP`"
        yield feedback, f"unknown `feedback` `{feedback.text}` of velocity_smoother{hint}"
    for name, sign in VELOCITY_LIMITS.items():
        value = group.find(name)
        if value is None or value.kind != "list":
            continue
        if len(value.items) not in (3, 6):
            yield value, f"`{name}` has {len(value.items)} values; velocity_smoother requires 3 (x, y, rotation) or 6"
        for item in value.items:
            number = number_of(item) if item.is_plain else None
            if number is not None and number * sign > 0.0:
                wanted = "negative" if sign > 0 else "positive"
                yield item, f"`{name}` has {number:g}; velocity_smoother requires zero or {wanted} values"
                break


def _filter(group: Node, controllers: frozenset[str]) -> Defects:
    """Yield a world frame that is not one of the frames of robot_localization, and misspelt inputs."""
    from urdfkit.lint.facts.ros_packages import is_slip

    world, *frames = (group.find(name) for name in ("world_frame", "map_frame", "odom_frame"))
    names = [frame.text for frame in frames if frame is not None]
    is_literal = world is not None and world.text and len(names) == 2 and "$" not in "".join((world.text, *names))
    if world is not None and is_literal and world.text not in names:
        hint = suggestion(nearest(world.text, names)) or f"; write `{names[0]}` or `{names[1]}`"
        yield world, f"`world_frame` is `{world.text}`, which is neither `map_frame` nor `odom_frame`{hint}"
    for key, value in group.entries:
        at = re.fullmatch(_INPUT, key.text)
        if at is None:
            continue
        if at[2] is not None and at[2] not in _OF_INPUTS:
            near = next((each for each in _OF_INPUTS if is_slip(at[2], each)), None)
            if near is not None:
                yield key, f"unknown parameter `{key.text}` of robot_localization; did you mean `{at[1]}_{near}`?"
        elif at[2] is None and value.kind == "text":
            first, separator, rest = value.text.strip("/").partition("/")
            near = next((each for each in sorted(controllers) if is_slip(first, each)), None)
            if separator and first not in controllers and near is not None:
                yield value, f"no controller `{first}` publishes `{value.text}`; did you mean `{near}/{rest}`?"
