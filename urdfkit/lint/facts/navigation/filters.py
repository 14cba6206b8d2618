"""Filters of robot_localization: their frames and transforms, and what they fuse.

Sources: robot_localization (README, doc/state_estimation_nodes.rst, doc/configuring_robot_localization.rst,
src/ros_filter.cpp), Noetic to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.yaml_tree import Node, documents, yamls
from urdfkit.lint.facts.gazebo.plugins import references
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.node_sections import groups_of
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes, parameter_files
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.description_files import descriptions
from urdfkit.record import record

Defects = Iterator[tuple[Source, Node, str]]

_TRUE = ("true", "True", "TRUE")
FALSE = ("false", "False", "FALSE")
AXES = ["x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "vroll", "vpitch", "vyaw", "ax", "ay", "az"]
_UNMEASURED = {"imu": (0, 1, 2, 6, 7, 8), "pose": tuple(range(6, 15)), "twist": (*range(6), 12, 13, 14)}
"""Kind of an input → positions in its configuration that its messages do not have."""

_DRIVES = r"(?:diff_drive|mecanum_drive|omni_wheel_drive|tricycle|\w+_steering)_controller/"
_BROADCASTS = r"TransformBroadcaster|sendTransform"
_OTHER_ODOMETRY = (
    r"(?i)rf2o|rtabmap|laser_scan_matcher|cartographer|\bfuse_|\bvio\b|vins|odometry_node|\bzed_|t265|hector|kiss_icp"
    r"|icp_odometry|ground_truth|p3d|odom_publisher|(?<!enable_)odom_tf|tf_broadcaster|OdometryPublisher"
)
"""Matches nodes and plugins that may publish the transform from the odometry frame."""


@record(eq=False)
class Filter:
    """The parameters of a filter.

    Attributes:
        source: the file.
        name: name of its node in the file; empty in ROS 1.
        group: the parameters.
    """

    source: Source
    name: str
    group: Node

    def text(self, name: str) -> str:
        """Return the text of a parameter without slashes; empty if it is missing or computed."""
        node = self.group.find(name)
        return node.text.strip("/") if node is not None and "$" not in node.text else ""

    @property
    def is_local(self) -> bool:
        """Whether it estimates the pose in the odometry frame."""
        return bool(self.text("odom_frame")) and self.text("world_frame") == self.text("odom_frame")

    @property
    def is_global(self) -> bool:
        """Whether it estimates the pose in the map frame."""
        return bool(self.text("map_frame")) and self.text("world_frame") == self.text("map_frame") and not self.is_local

    @property
    def publishes(self) -> bool:
        """Whether it publishes its transform."""
        return self.text("publish_tf") not in FALSE

    def inputs(self) -> Iterator[tuple[str, Node, Node, list[str]]]:
        """Yield name, topic, configuration and its values for each input with a configuration of 15 values."""
        for key, value in self.group.entries:
            config = self.group.find(f"{key.text}_config")
            if re.fullmatch(r"(?:odom|imu|pose|twist)\d+", key.text) and config is not None and len(config.items) == 15:
                yield key.text, value, config, [item.text for item in config.items]

    def is_absolute(self, name: str, values: list[str]) -> bool:
        """Return whether an input sets x and y, and not only their changes."""
        return set(values[:2]) <= {*_TRUE} and all(
            self.text(f"{name}_{flag}") not in _TRUE for flag in ("differential", "relative")
        )


def filters(model: Model) -> list[Filter]:
    """Return the filters in the YAML files around a robot."""
    found = []
    for source in yamls(model):
        if "world_frame" not in source.text:
            continue
        named = [(key.last_name, group) for key, group in sections(source)]
        groups = named or [
            (name, group)
            for root in documents(source)
            for name, group in (("", root), *((key.text, value) for key, value in root.entries))
        ]
        for name, group in groups:
            if group.find("world_frame") is not None and group.find("base_link_frame") is not None:
                found.append(Filter(source, name, group))
    return found


def filter_defects(model: Model, every: list[Filter]) -> Defects:
    """Yield the parameters of filters that contradict each other or the robot: file, place, message."""
    wheels = _wheel_odometry(model) if every else set()
    children = list(_second_parents(model, every))
    yield from children
    pairs: list[tuple[Source, Node, str]] = []
    for file in dict.fromkeys(each.source.file for each in every):
        is_reported = any(source.file == file for source, _, _ in children)
        pairs += _of_pair([each for each in every if each.source.file == file], not is_reported)
    yield from pairs
    if len({each.source.file for each in every}) > 1:
        yield from _of_launched(model, every)
    for each in every:
        local = {topic.text.strip("/") for one in every if one.is_local for _, topic, _, _ in one.inputs()}
        yield from _of_inputs(each, wheels | local)
    reported = {id(node) for _, node, _ in pairs}  # Filters that publish the same transform lack the other one.
    yield from (each for each in _without_transform(model, every) if id(each[1]) not in reported)


def _of_pair(pair: list[Filter], has_root: bool) -> Defects:
    """Yield the frames of two filters in one file that do not suit each other.

    Args:
        pair: the filters of a file.
        has_root: whether their base frames can be compared; otherwise one of them is reported already.
    """
    if len(pair) != 2 or len({each.name for each in pair}) != 2 or not all(each.publishes for each in pair):
        return
    first, second = pair
    for scope, words, frame in (("is_global", r"odom|local", "odom"), ("is_local", r"map|global", "map")):
        if all(getattr(each, scope) for each in pair) and first.text("odom_frame") == second.text("odom_frame"):
            wrong = next((each for each in pair if re.search(words, each.name)), first if frame == "odom" else second)
            node, other = wrong.group.find("world_frame"), second if wrong is first else first
            if node is not None:
                message = (
                    f"filters `{wrong.name}` and `{other.name}` publish the same transform; "
                    f"set `world_frame` of one of them to `{frame}`"
                )
                yield wrong.source, node, message
    frames = [each.text("base_link_frame") for each in pair]
    node = first.group.find("base_link_frame")
    if node is not None and all(frames) and frames[0] != frames[1] and has_root:
        yield first.source, node, f"`base_link_frame` is `{frames[0]}`, but that of `{second.name}` is `{frames[1]}`"


def _of_launched(model: Model, every: list[Filter]) -> Defects:
    """Yield the world frame of each of two filters in a launch file that publish the same transform."""
    files = parameter_files(model)
    by_group = {(each.source.file, id(each.group)): each for each in every}  # equal files share their nodes
    launched = [
        (node, found)
        for node in launched_nodes(model)
        for source, group in groups_of(node, files)
        if (found := by_group.get((source.file, id(group)))) is not None and found.publishes
    ]
    for (node, one), (other, two) in combinations(launched, 2):
        is_same = (one.is_local and two.is_local) or (one.is_global and two.is_global)
        if not is_same or node.source is not other.source or (node.is_conditional and other.is_conditional):
            continue
        pair = ((node, one), (other, two))
        wrong, word = (r"map|global", "map") if one.is_local else (r"odom|local", "odom")
        names = [f"{each.source.file.rpartition('/')[2]} {_name(at)}" for at, each in pair]
        if one is two:
            if other.place is not None:
                at = other.source.position(other.place[0])
                value = Node("text", other.source.text[slice(*other.place)], (), (), at.line, at.column)
                message = f"`{_name(node)}` and `{_name(other)}` load the same parameters, so both publish the"
                yield other.source, value, f"{message} transform from `{one.text('world_frame')}`"
            continue
        found = one if re.search(wrong, names[0]) and not re.search(wrong, names[1]) else two
        if (frame := found.group.find("world_frame")) is not None:
            message = f"filters `{_name(node)}` and `{_name(other)}` publish the same transform"
            yield found.source, frame, f"{message}; set `world_frame` of one of them to `{word}`"


def _name(node: LaunchedNode) -> str:
    return node.name.name if node.name is not None else node.program


def _of_inputs(each: Filter, relative: set[str]) -> Defects:
    """Yield inputs of a filter that occur twice or do not measure the fused values.

    Args:
        each: the filter.
        relative: topics of odometry that drifts.
    """
    seen: dict[tuple[str, str], str] = {}
    inputs = list(each.inputs())
    absolute = [name for name, _, _, values in inputs if each.is_absolute(name, values)]
    for name, topic, config, values in inputs:
        kind = name.rstrip("0123456789")
        other = seen.setdefault((kind, topic.text.strip("/")), name)
        if topic.text and other != name:
            yield each.source, topic, f"`{name}` and `{other}` are both the topic `{topic.text}`"
        both = [at for at in (0, 1) if values[at] in _TRUE and values[at + AXES.index("vx")] in _TRUE]
        is_second = each.is_global and name in absolute and len(absolute) > 1
        if kind == "odom" and topic.text.strip("/") in relative and len(both) > 1 and not is_second:
            message = f"`{name}_config` fuses positions and velocities of the same odometry; fuse the velocities only"
            yield each.source, config.items[0], message
            continue
        wrong = [at for at in _UNMEASURED.get(kind, ()) if values[at] in _TRUE]
        fused = [AXES[at] for at in wrong]
        if fused:
            message = f"`{name}_config` fuses {', '.join(fused)}, which its messages do not contain"
            yield each.source, config.items[wrong[0]], message
        if is_second and topic.text.strip("/") in relative:
            message = (
                f"`{name}_config` fuses x and y of drifting odometry in addition to `{{}}`; fuse its velocities instead"
            )
            yield each.source, config, message.format(next(one for one in absolute if one != name))
    positions = [name for name, _, _, values in inputs if set(values[:2]) <= {*_TRUE}]
    if each.is_global and positions and not absolute:
        node = next(
            (found for name in positions if (found := each.group.find(f"{name}_differential")) and found.text in _TRUE),
            None,
        )
        if node is not None:
            message = (
                "no input measures a position in the map frame; set this to false if the input measures this position"
            )
            yield each.source, node, message


def _wheel_odometry(model: Model) -> set[str]:
    """Return the topics of odometry that drive controllers and plugins compute from the wheels."""
    found = {
        f"{one.name}/{topic}"
        for source in yamls(model)
        for one in settings(source)
        if re.match(_DRIVES, one.kind)
        for topic in ("odom", "odometry")
    }
    for text, _, parameter, _ in references(model, ("topic",)):
        if parameter.meaning == "odometry_topic":
            found.add(text.strip().strip("/"))
    return found


def _second_parents(model: Model, every: list[Filter]) -> Defects:
    """Yield the base frame of each published odometry transform that already has a parent in the robot."""
    if model.is_incomplete or len(model.robot.roots()) != 1:
        return
    parents = {joint.child: joint for joint in model.robot.joints}
    found = [
        (each.source, each.group.find("base_link_frame"), f"filter `{each.name}`" if each.name else "the filter")
        for each in every
        if each.is_local and each.publishes
    ]
    for source, node, who in found:
        joint = parents.get(node.text.strip("/")) if node is not None else None
        if node is None or joint is None or joint.parent is None or _is_elsewhere(model, node.text.strip("/")):
            continue
        message = f"{who} makes `{node.text}` a child of the odometry frame, but its parent is `{joint.parent}`"
        yield source, node, f"{message}; write `{model.robot.roots()[0].name}`"


def _is_elsewhere(model: Model, link: str) -> bool:
    """Return whether a description that the robot does not include mentions a link."""
    included = {str(Path(name).absolute()) for name in model.expanded.sources}
    packages = {model.package, *(package_of(Path(file)) for file in model.related_files)}
    folders = sorted(package for package in packages if package is not None)
    texts = (text for folder in folders for path, text in descriptions(folder) if str(path.absolute()) not in included)
    return any(link in text for text in texts)


def _without_transform(model: Model, every: list[Filter]) -> Defects:
    """Yield a flag if every node that can publish the transform from the odometry frame has it disabled."""
    if not every:
        return
    flags: list[tuple[Source, Node]] = []
    for source in yamls(model):
        for one in settings(source):
            if re.match(_DRIVES, one.kind):
                enabled = one.group.find("enable_odom_tf")
                if enabled is None or enabled.text not in FALSE:
                    return
                flags.append((source, enabled))
    if not flags or any((each.is_local and each.publishes) or not (each.is_local or each.is_global) for each in every):
        return
    text = "".join(source.text for source in model.related_files.values())
    if re.search(_OTHER_ODOMETRY, text) or re.search(_BROADCASTS, text) or Words(model).match(_BROADCASTS):
        return
    if any(parameter.meaning == "odometry_topic" for _, _, parameter, _ in references(model, ("topic",))):
        return
    local = [(each.source, node) for each in every if each.is_local and (node := each.group.find("publish_tf"))]
    world = [(each.source, node) for each in every if each.is_global and (node := each.group.find("world_frame"))]
    source, node = (local or world or flags)[0]
    yield source, node, "no node publishes the transform from the odometry frame to the base of the robot"
