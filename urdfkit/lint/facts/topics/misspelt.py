"""Topics in launch files, parameter files and bridges that differ by a letter from a topic of the robot.

A name that occurs twice in the files of the packages is accepted, because two nodes can exchange messages on it.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import launch_reader, name_of, parsed
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import nodes, start_of
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.navigation.misspelt import misspelt_navigation
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.facts.topics.graph import has_namespaces, is_closed, published_by_type, remapped
from urdfkit.lint.facts.topics.loops import published_together, swapped_types
from urdfkit.lint.facts.topics.node_topics import topics_of
from urdfkit.lint.facts.topics.robot_topics import BRIDGE_KEYS, RobotTopics, last, robot_topics
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_COMMON = """
cmd_vel cmd_vel_joy cmd_vel_nav cmd_vel_out cmd_vel_smoothed cmd_vel_teleop cmd_vel_unstamped odom scan
"""
COMMON = frozenset(_COMMON.split())
"""Topics that a misspelt name is compared with even if no file of the robot names them."""

_ACCEPTED = (
    "joint_states clock tf tf_static map imu odometry image image_raw camera_info points robot_description pose twist"
)

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

_ADDED = ("data", "in", "input", "laser", "lidar", "out", "output", "raw", "topic")
"""Words added to the topic of a sensor that give a topic without publisher."""


@record(eq=False)
class Mention:
    """A topic that a file names.

    Attributes:
        source: the file.
        topic: the whole name, and its offset.
        reads: whether a node only subscribes to the topic.
        is_input: whether it is an input of robot_localization; parameter-value-invalid compares its controller.
        type: ROS type of the messages that a node reads from it, without its package; empty if unknown.
    """

    source: Source
    topic: Named
    reads: bool = False
    is_input: bool = False
    type: str = ""


def misspelt_topics(model: Model) -> Iterator[tuple[Span, str, str]]:
    """Yield the place of each misspelt or unpublished topic, the topic, and the end of the message."""
    topics = robot_topics(model)
    words = Words(model)
    seen = {
        (source.file, start_of(source, node))
        for source in model.related_files.values()
        if source.file.endswith((".yaml", ".yml"))
        for node, kind, _ in misspelt_navigation(source)
        if kind == "topic"
    }
    for mention in mentions(model):
        if (mention.source.file, mention.topic.start) in seen or "$" in mention.topic.name:
            continue
        near = _meant(mention, topics)
        if near is not None and words.occurs_once(_part(mention.topic.name, near)):
            seen.add((mention.source.file, mention.topic.start))
            span = mention.source.span(mention.topic.start, mention.topic.end)
            yield span, mention.topic.name, Suggestion(near, mention.topic.name)
    for mention, others in unpublished(model, words):
        if (mention.source.file, mention.topic.start) not in seen:
            near = others[0] if len(others) == 1 else nearest(mention.topic.name.strip("/"), others, cutoff=0.75)
            span = mention.source.span(mention.topic.start, mention.topic.end)
            listed = f"; {_listed(mention.type, others)}"
            yield span, mention.topic.name, Suggestion(near, mention.topic.name) if near is not None else listed
    for name, elements in topics.elements.items():
        if name in COMMON or name in topics.bridged or len(elements) > 1:
            continue
        candidates = (COMMON | topics.bridged) - topics.described
        near = next((each for each in sorted(candidates) if _is_misspelling(name, each, True)), None)
        if near is not None and elements[0].text.strip().endswith(name) and words.occurs_once(name):
            yield (
                model.span(elements[0].origin.position),
                elements[0].text.strip(),
                Suggestion(near, elements[0].text.strip()),
            )


def _listed(kind: str, topics: list[str]) -> str:
    return f"the {kind} topics of these packages are {', '.join(f'`{topic}`' for topic in topics[:3])}"


def mentions(model: Model) -> Iterator[Mention]:
    """Yield the topics in remappings, parameters, arguments and bridges of the related files."""
    for node in launched_nodes(model):
        topics = topics_of(node.package, node.program)
        is_python, inputs = node.source.file.endswith(".py"), topics.read if topics is not None else {}
        for old, new in node.remappings:
            kind = inputs.get(old.name.strip("/"), "").removeprefix("Twist")  # velocity_commands reports these
            if is_python or kind:
                yield Mention(node.source, old)
                reads = last(old.name) in ("scan", "points", "image")
                yield Mention(node.source, new, reads and is_python, type=kind)
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
                        named = group.find("data_type")
                        type = _TYPES.get(key.text.rstrip("0123456789"), named.text if named is not None else "")
                        yield Mention(source, Named(value.text, start_of(source, value)), reads, is_input, type)


def unpublished(model: Model, words: Words) -> Iterator[tuple[Mention, list[str]]]:
    """Yield the topics that a node reads and nothing publishes, with the topics of the robot of that type.

    If the launch files may start another publisher, only a robot with one topic of the type is checked. Several
    mentions of a topic have one cause, such as a remapping, and are reported once.
    """
    read = [mention for mention in mentions(model) if mention.type and "$" not in mention.topic.name]
    closed = {type: is_closed(model, type) for type in dict.fromkeys(mention.type for mention in read)}
    by_type = {is_all: published_by_type(model, not is_all) for is_all in sorted(set(closed.values()))}
    if not any(by_type.values()):
        return
    controllers = robot_topics(model).controllers
    in_namespaces = has_namespaces(model)
    has_camera, seen = _has_camera_driver(model), set[str]()
    places = [(mention.source.file, mention.topic.start) for mention in read]
    places += [(node.source.file, old.start) for node in launched_nodes(model) for old, _ in node.remappings]
    doubled = {*(type for _, _, type in published_together(model)), *swapped_types(model)}
    for file, source in model.related_files.items():
        if file.endswith((".yaml", ".yml")):
            places += (
                (file, at.start(1)) for at in re.finditer(r"(?:gz|ign)_topic_name\s*:\s*[\"']?([\w/]+)", source.text)
            )
            places += _names_of_sources(source) if any(closed.values()) else ()
    filtered = {
        remapped(node, topic)
        for node in launched_nodes(model)
        if node.package == "robot_localization" and (own := topics_of(node.package, node.program)) is not None
        for topic in own.published
    }
    for mention in read:
        is_all = closed[mention.type]
        topic, topics = mention.topic.name.strip("/"), by_type[is_all].get(mention.type, set())
        if (
            topic in topics
            or topic in seen
            or mention.type in doubled
            or (mention.type == "PointCloud2" and has_camera)
        ):
            continue
        topics = topics - filtered if mention.is_input or mention.type == "NavSatFix" else topics
        is_below = any(
            f"/{one}".endswith(f"/{other}") for each in topics for one, other in ((each, topic), (topic, each))
        )
        is_other = topic.startswith("odometry/") or topic.partition("/")[0] in controllers
        is_open = (is_below and (in_namespaces or not is_all)) or ((is_other or len(topics) > 1) and not is_all)
        if topics and not is_open and not words.names(topic, places, without_rviz=is_all):
            seen.add(topic)
            yield mention, sorted(topics)


def _names_of_sources(source: Source) -> Iterator[tuple[str, int]]:
    """Yield file and offset of the words that name a source of measurements of a costmap, and not a topic."""
    for line in re.finditer(r"\b(?:observation_sources|\w+)\s*:", source.text):
        start = line.start()
        end = line.end() if not line[0].startswith("observation") else source.text.find("\n", start)
        yield from ((source.file, start + at.start()) for at in re.finditer(r"\w+", source.text[start:end]))


_CAMERA_DRIVERS = r"realsense|depthai|astra|zed_|orbbec|kinect_ros|azure_kinect|openni"


def _has_camera_driver(model: Model) -> bool:
    """Return whether files of the packages name a driver of depth cameras, which has topics of its own."""
    return any(re.search(_CAMERA_DRIVERS, source.text) for source in model.related_files.values())


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


def _meant(mention: Mention, topics: RobotTopics) -> str | None:
    """Return the whole name of the topic that a mention stands for; None if it may be right."""
    name = mention.topic.name
    end = last(name)
    space, _, _ = name.rstrip("/").rpartition("/")
    first = name.strip("/").partition("/")[0]
    if space.strip("/") and not mention.is_input and first not in topics.controllers:
        near = [each for each in sorted(topics.controllers) if len(each) > 5 and is_slip(first, each)]
        if len(near) == 1:
            return name.replace(first, near[0], 1)
    if end in COMMON or end in topics.names or end in _ACCEPTED.split() or len(end) < 3:
        return None
    # launch-name-misspelt reports `joint_states` and `robot_description` in launch files.
    is_launch = mention.source.file.endswith(LAUNCH)
    names = topics.names - {"joint_states", "robot_description"} if is_launch else topics.names
    strong = [each for each in sorted(names) if _is_misspelling(end, each, True)]
    near = strong or [each for each in sorted(COMMON) if _is_misspelling(end, each, False)]
    if len(near) == 1:
        return f"{name[: len(name.rstrip('/')) - len(end)]}{near[0]}"
    if mention.reads and not near:
        parts = end.split("_")
        if "scan" in topics.sensors and len(parts) == 2 and "scan" in parts and not {*parts}.isdisjoint(_ADDED):
            return f"{name[: len(name.rstrip('/')) - len(end)]}scan"
    return None


def _is_misspelling(name: str, topic: str, is_of_robot: bool) -> bool:
    """Return whether a name differs by a letter from a topic, and not by a word that means another topic."""
    if name == topic or not is_slip(name, topic) or len(topic) < 3 or max(len(name), len(topic)) < 4:
        return False
    changed = [(a, b) for a, b in zip(name.split("_"), topic.split("_"), strict=False) if a != b]
    if len(name.split("_")) == len(topic.split("_")) and any(max(len(a), len(b)) < 3 for a, b in changed):
        return False  # camera_l and camera_r
    is_short = len(topic) < 6
    if is_short and len(name) == len(topic) and sorted(name) != sorted(topic):
        return False
    return is_of_robot or min(len(name), len(topic)) >= 4


def _part(name: str, near: str) -> str:
    """Return the part of a name that differs from the meant one."""
    pairs = zip(name.strip("/").split("/"), near.strip("/").split("/"), strict=False)
    return next((a for a, b in pairs if a != b), last(name))
