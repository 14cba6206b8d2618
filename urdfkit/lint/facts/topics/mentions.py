"""Topics that files of the packages name, and topics by default of nodes that no file renames."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import launch_reader, name_of, parsed
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, start_of
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.topics.graph import remapped, remaps_groups
from urdfkit.lint.facts.topics.node_topics import topics_of
from urdfkit.lint.facts.topics.own_nodes import own_subscriptions
from urdfkit.lint.facts.topics.robot_topics import BRIDGE_KEYS, last
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_PARAMETER = r"(?:\w+_)?topic|(?:odom|imu|twist|pose)\d+"
"""Matches parameters whose values are topics: of Nav2, slam_toolbox, twist_mux, robot_localization and others."""

_TYPES = {
    "scan_topic": "LaserScan",
    "odom": "Odometry",
    "odom_topic": "Odometry",
    "imu": "Imu",
    "pose": "PoseWithCovarianceStamped",
    "twist": "TwistWithCovarianceStamped",
    "point_cloud_topic": "PointCloud2",
    "image_topic": "Image",
}
"""Parameter without its number → type of the messages that the node reads."""


_SENSED = ("Image", "Imu", "LaserScan", "NavSatFix", "Odometry", "PointCloud2")
_BY_PARAMETER = ("nav2_amcl", "nav2_bt_navigator", "nav2_velocity_smoother", "slam_toolbox")


@record(eq=False)
class Mention:
    """A topic that a file names.

    Attributes:
        source: the file.
        topic: the whole name, and its offset.
        reads: whether a node only subscribes to the topic.
        is_input: whether it is an input of robot_localization; parameter-value-invalid compares its controller.
        type: ROS type of the messages that a node reads from it, without its package; empty if unknown.
        reader: the executable that has the topic by default; then the place is the executable.
        needs_all: whether the topic is reported only if all publishers are known.
        own: the topics that the reader publishes.
        typed: the place of the type in the file; None if the name of the parameter is for one type.
    """

    source: Source
    topic: Named
    reads: bool = False
    is_input: bool = False
    type: str = ""
    reader: str = ""
    needs_all: bool = False
    own: frozenset[str] = frozenset()
    typed: Named | None = None


def mentions(model: Model) -> Iterator[Mention]:
    """Yield the topics in remappings, parameters, arguments and bridges of the related files."""
    own: dict[str, dict[str, str]] = {}
    for node in launched_nodes(model):
        topics = topics_of(node.package, node.program)
        is_python, is_own = node.source.file.endswith(".py"), topics is None and bool(node.remappings)
        if is_own and node.package not in own:
            own[node.package] = own_subscriptions(model, node.package)
        inputs = topics.read if topics is not None else own.get(node.package, {})
        for old, new in node.remappings:
            kind = inputs.get(old.name.strip("/"), "").removeprefix("Twist")  # velocity_commands reports these
            if is_python or kind:
                yield Mention(node.source, old)
                reads = last(old.name) in ("scan", "points", "image")
                yield Mention(node.source, new, reads and is_python, type=kind, needs_all=is_own)
    for file, source in model.related_files.items():
        if file.endswith((".launch.py", "_launch.py")):
            yield from _in_python(source)
        elif file.endswith(LAUNCH):
            yield from _in_elements(source)
        elif file.endswith((".yaml", ".yml")):
            for group in (each for each in nodes(source) if each.kind == "group"):
                is_bridge = any(group.find(key) is not None for key in ("ros_type_name", "gz_type_name"))
                for key, value in group.entries:
                    is_topic = key.text == BRIDGE_KEYS[0] if is_bridge else re.fullmatch(_PARAMETER, key.text)
                    if is_topic and value.kind == "text" and re.fullmatch(r"[\w/]+", value.text):
                        reads = key.text == "scan_topic" or group.find("data_type") is not None
                        is_input = key.text[-1].isdigit()
                        named = group.find("data_type") or _source_type(group)
                        written = _SOURCES.get(named.text, named.text) if named is not None else ""
                        type = _TYPES.get(key.text.rstrip("0123456789"), written)
                        at = Named(named.text, start_of(source, named)) if named is not None else None
                        topic = Named(value.text, start_of(source, value))
                        yield Mention(source, topic, reads, is_input, type, typed=at)


_SOURCES = {"scan": "LaserScan", "pointcloud": "PointCloud2"}
"""Type of a source of nav2_collision_monitor → the type of its messages."""


def _source_type(group: Node) -> Node | None:
    kind = group.find("type")
    return kind if kind is not None and kind.text in _SOURCES and group.find("min_height") is not None else None


def topics_of_receivers(model: Model) -> Iterator[Mention]:
    """Yield the topics by default from which nodes without namespace read sensors and odometry.

    The topics of the nodes in `_BY_PARAMETER` depend on their parameters.
    """
    for node in launched_nodes(model) if not remaps_groups(model) else ():
        topics = topics_of(node.package, node.program)
        is_open = node.has_more_remappings or node.namespace != "" or node.place is None
        for topic, kind in topics.read.items() if topics is not None and not is_open else ():
            is_fixed = kind in _SENSED and node.package not in _BY_PARAMETER
            if is_fixed and node.place is not None and remapped(node, topic) == topic:
                own = (
                    frozenset(remapped(node, each) for each in topics.published) if topics is not None else frozenset()
                )
                at = Named(topic, node.place[0])
                yield Mention(node.source, at, type=kind, reader=node.program, needs_all=True, own=own)


def _in_elements(source: Source) -> Iterator[Mention]:
    for element in all_elements(source):
        at = element.attributes
        if element.tag == "remap":
            reads = "from" in at and last(at["from"].name) == "scan"
            yield from (Mention(source, at[key], reads and key == "to") for key in ("from", "to") if key in at)
        elif element.tag in ("arg", "param", "let") and "name" in at and re.fullmatch(_PARAMETER, at["name"].name):
            value = at.get("default") or at.get("value")
            if value is not None and re.fullmatch(r"[\w/]+", value.name):
                yield Mention(source, value, at["name"].name == "scan_topic", type=_TYPES.get(at["name"].name, ""))


def _in_python(source: Source) -> Iterator[Mention]:
    tree = parsed(source) if "topic" in source.text else None
    if tree is None:
        return
    reader = launch_reader(tree)
    pairs: list[tuple[ast.expr | None, ast.expr | None]] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Dict):
            pairs += zip(node.keys, node.values, strict=True)
        elif isinstance(node, ast.Call) and name_of(node.func) == "DeclareLaunchArgument" and node.args:
            words = {word.arg: word.value for word in node.keywords}
            pairs.append((node.args[0], words.get("default_value")))
    for key, value in pairs:
        name = reader.text(key) if key is not None else None
        if name is None or not re.fullmatch(_PARAMETER, name) or not isinstance(value, ast.Constant):
            continue
        if isinstance(value.value, str) and re.fullmatch(r"[\w/]+", value.value):
            start, end = place(source, value)
            offset = source.text[start:end].find(value.value)
            topic = Named(value.value, start + max(offset, 0))
            yield Mention(source, topic, name == "scan_topic", type=_TYPES.get(name, ""))
