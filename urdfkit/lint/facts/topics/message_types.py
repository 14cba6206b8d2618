"""Types of messages: topics that a node reads with another type than they have, and stamped velocity commands.

Sources: diff_drive_controller (userdoc.rst), robot_localization (README, Humble to Rolling), and the sources of
`node_topics`.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.ros2_controllers import declared
from urdfkit.lint.facts.control.ros_gz_bridges import bridged_topics
from urdfkit.lint.facts.control.yaml_tree import Node, documents, span_of, yamls
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.facts.gazebo.sensor_topics import published
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.names import name_of_node
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.topics.graph import published_by_type, remapped
from urdfkit.lint.facts.topics.mentions import mentions
from urdfkit.lint.facts.topics.node_topics import command_topics
from urdfkit.lint.facts.topics.robot_topics import last
from urdfkit.lint.facts.topics.velocity_commands import drive_command_topics
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_DATA_TYPES = (
    *("LaserScan", "PointCloud2", "Odometry", "Imu", "Image"),
    *("PoseWithCovarianceStamped", "TwistWithCovarianceStamped"),
)

_NAMES = {"LaserScan": r"scan[^/]*$", "PointCloud2": r"(?:cloud|points?)[^/]*$"}
"""Type of messages → the last part of topics that are named after it."""

_NAV2 = "enable_stamped_cmd_vel"
"""Flag of the nodes of Nav2 for stamped velocity commands; false by default until Jazzy."""

_TRUTHS = {"true": True, "false": False}


def mistyped(model: Model) -> Iterator[tuple[Span, str, Element | None, bool]]:
    """Yield the topics that a node reads with another type than they have.

    Yields:
        The place, the message, the element of the description that sets the type, and whether that is the wrong one
        according to the name of the topic.
    """
    read = [mention for mention in mentions(model) if mention.type and "$" not in mention.topic.name]
    types = _types(model) if read else {}
    unbridged = _unbridged(model) if read else {}
    seen = set[str]()
    for mention in read:
        start, name = mention.topic.start, mention.topic.name
        found = types.get(name.strip("/"), set())
        span = mention.source.span(start, start + len(name))
        if found and mention.type not in found and mention.type in _DATA_TYPES:
            what = " and ".join(sorted(found))
            message = f"`{name}` has {what} messages, but its subscriber expects {mention.type} messages"
            at = mention.typed
            if at is not None and any(re.search(_NAMES.get(each, "$^"), name) for each in found):
                span = mention.source.span(at.start, at.start + len(at.name))  # the topic has the name of its type
            is_named = re.search(_NAMES.get(mention.type, "$^"), name) is not None
            yield span, message, _output_type(name.strip("/"), model), is_named
        elif not found and name.strip("/") not in seen and (other := unbridged.get(name.strip("/"))):
            seen.add(name.strip("/"))
            yield span, f"`{name}` is a topic of Gazebo; the bridge publishes its messages on `{other}`", None, False


def _output_type(topic: str, model: Model) -> Element | None:
    """Return the ``<output_type>`` of the plugin that publishes a topic; None without one."""
    for publication in published(model):
        if publication.topic.strip("/") == topic:
            above = [
                plugin.element for plugin, _, _ in plugins(model.robot) if publication.element in plugin.element.walk()
            ]
            return next((written for each in above if (written := each.find("output_type")) is not None), None)
    return None


def _unbridged(model: Model) -> dict[str, str]:
    """Return topic of a sensor in Gazebo that no bridge has as its topic in ROS → its topic in ROS."""
    pairs: dict[str, str] = {}
    for source in yamls(model):
        for entry in (item for root in documents(source) for item in root.items):
            gazebo, ros = entry.find("gz_topic_name") or entry.find("ign_topic_name"), entry.find("ros_topic_name")
            direction = entry.find("direction")
            if gazebo is not None and ros is not None and (direction is None or direction.text.endswith("_TO_ROS")):
                pairs[gazebo.text.strip("/")] = ros.text
    own = {name.strip("/") for name in pairs.values()} | {topic for topic, _, _ in bridged_topics(model)}
    sensors = {publication.topic.strip("/") for publication in published(model)}
    return {gazebo: ros for gazebo, ros in pairs.items() if gazebo in sensors - own}


def _types(model: Model) -> dict[str, set[str]]:
    """Return topic without slashes at its ends → types of its messages without their packages."""
    found: dict[str, set[str]] = {}
    for kind, topics in published_by_type(model).items():
        for topic in topics:
            found.setdefault(topic, set()).add(kind)
    return found


@record(eq=False)
class _End:
    """A publisher or subscriber of velocity commands.

    Attributes:
        topic: the topic without slashes at its ends.
        is_stamped: whether its messages have a stamp.
        who: the node.
        flag: file and value of the parameter that sets this; None if it is fixed.
    """

    topic: str
    is_stamped: bool
    who: str
    flag: tuple[Source, Node] | None = None


def unequal_stamps(model: Model) -> Iterator[tuple[Span, str]]:
    """Yield the flags for stamped velocity commands that differ from the other side of a topic: place and message."""
    publishers, readers = _ends(model)
    left = [
        (publisher, reader)
        for publisher in publishers
        for reader in readers
        if publisher.topic == reader.topic and publisher.is_stamped != reader.is_stamped
    ]
    while left:
        counts = Counter(id(end.flag[1]) for pair in left for end in pair if end.flag is not None)
        worst = max(counts, key=lambda key: counts[key], default=None)
        pair = next((each for each in left for end in each if end.flag is not None and id(end.flag[1]) == worst), None)
        if pair is None:
            return
        is_first = pair[0].flag is not None and id(pair[0].flag[1]) == worst
        own, other = pair if is_first else (pair[1], pair[0])
        verb = "reads" if is_first else "publishes"
        kind = "TwistStamped" if other.is_stamped else "Twist"
        if own.flag is not None:
            value = "true" if own.is_stamped else "false"
            message = f"this flag of `{own.who}` is {value}, but `{other.who}` {verb} {kind} on `{other.topic}`"
            yield span_of(*own.flag), message
        left = [each for each in left if all(end.flag is None or id(end.flag[1]) != worst for end in each)]


def _ends(model: Model) -> tuple[list[_End], list[_End]]:
    """Return the publishers and the subscribers of velocity commands of which the type is known."""
    named: dict[str, list[tuple[Source, Node]]] = {}
    publishers: list[_End] = []
    readers: list[_End] = []
    flags: list[tuple[Source, Node]] = []
    drives = drive_command_topics(model)
    for source in yamls(model):
        for key, group in sections(source):
            named.setdefault(key.last_name, []).append((source, group))
        for one in declared(source):
            value = one.settings.find("use_stamped_vel") if one.settings is not None else None
            is_stamped = _TRUTHS.get(value.text.lower()) if value is not None else None
            flag = (source, value) if value is not None else None
            flags += [flag] if flag is not None and is_stamped is not None else []
            if one.kind.text.startswith("tricycle_controller/") and is_stamped is not None:
                readers.append(_End(f"{one.name}/cmd_vel", is_stamped, one.name, flag))
            if "diff_drive" in one.kind.text:
                own = (
                    _End(f"{one.name}/cmd_vel", True, one.name, flag if is_stamped else None),
                    _End(f"{one.name}/cmd_vel_unstamped", False, one.name),
                )
                readers += [end for end in own if end.topic in drives]
    for topic, kind, is_read in bridged_topics(model):
        if is_read and last(kind) in ("Twist", "TwistStamped"):
            readers.append(_End(topic, last(kind) == "TwistStamped", "parameter_bridge"))
    for node in launched_nodes(model):
        commands = command_topics().get(node.package)
        if commands is None:
            continue
        name = name_of_node(node) or node.program
        is_set = any(group.find(commands.flag) is not None for _, group in named.get(name, ()))
        is_default = commands.flag == _NAV2 and not is_set and node.inline is not None and _NAV2 not in node.inline
        if flags and is_default and not commands.read:
            # The releases with `use_stamped_vel` have no stamps in Nav2 by default.
            publishers.append(_End(remapped(node, commands.published), False, name))
        for source, group in named.get(name, ()) if commands.flag else ():
            value = group.find(commands.flag)
            is_stamped = _TRUTHS.get(value.text.lower()) if value is not None else None
            if value is None or is_stamped is None:
                continue
            for topic, ends in ((commands.published, publishers), (commands.read, readers)):
                parameter = group.find(topic) if topic.endswith("_topic") else None
                if topic and (parameter is not None or not topic.endswith("_topic")):
                    used = parameter.text if parameter is not None else topic
                    ends.append(_End(remapped(node, used.strip("/")), is_stamped, name, (source, value)))
            inputs = group.find("topics") if node.package == "twist_mux" else None
            for _, entry in inputs.entries if inputs is not None else ():
                if (used_topic := entry.find("topic")) is not None:
                    topic = remapped(node, used_topic.text.strip("/"))
                    readers.append(_End(topic, is_stamped, name, (source, value)))
    return publishers, readers
