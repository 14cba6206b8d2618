"""Topics in launch files, parameter files and bridges that differ by a letter from a topic of the robot.

A name that occurs twice in the files of the packages is accepted, because two nodes can exchange messages on it.
"""

import re
from collections.abc import Iterator, Set

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.yaml_tree import start_of
from urdfkit.lint.facts.navigation.misspelt import misspelt_navigation
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.facts.topics.graph import has_namespaces, is_closed, published_by_type, remapped, starts_components
from urdfkit.lint.facts.topics.loops import published_together, swapped_types
from urdfkit.lint.facts.topics.mentions import Mention, mentions, topics_of_receivers
from urdfkit.lint.facts.topics.node_topics import topics_of
from urdfkit.lint.facts.topics.robot_topics import RobotTopics, last, robot_topics
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model

_COMMON = """
cmd_vel cmd_vel_joy cmd_vel_nav cmd_vel_out cmd_vel_smoothed cmd_vel_teleop cmd_vel_unstamped odom scan
"""
COMMON = frozenset(_COMMON.split())
"""Topics that a misspelt name is compared with even if no file of the robot names them."""

_ACCEPTED = (
    "joint_states clock tf tf_static map imu odometry image image_raw camera_info points robot_description pose twist"
)

_ADDED = ("data", "in", "input", "laser", "lidar", "out", "output", "raw", "topic")
"""Words added to the topic of a sensor that give a topic without publisher."""


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
    found: list[tuple[Mention, str]] = []
    moved = {last(new.name) for node in launched_nodes(model) for _, new in node.remappings if "$" not in new.name}
    for mention in mentions(model):
        if (mention.source.file, mention.topic.start) in seen or "$" in mention.topic.name:
            continue
        near = _meant(mention, topics, moved)
        if near is not None and words.occurs_once(_part(mention.topic.name, near)):
            seen.add((mention.source.file, mention.topic.start))
            found.append((mention, near))
    for mention, near in found:
        pair = next((other for other, name in found if other.topic.name == near and name == mention.topic.name), None)
        # Of two names that differ by a letter, the one with the rarer word is misspelt.
        ranks = [(words.count_of(each.topic.name), -each.topic.start) for each in (mention, pair) if each is not None]
        if pair is None or ranks[0] < ranks[1]:
            span = mention.source.span(mention.topic.start, mention.topic.end)
            yield span, mention.topic.name, Suggestion(near, mention.topic.name)
    for mention, others in unpublished(model, words):
        if (mention.source.file, mention.topic.start) not in seen:
            near = others[0] if len(others) == 1 else nearest(mention.topic.name.strip("/"), others, cutoff=0.75)
            end = mention.topic.start + len(mention.reader) if mention.reader else mention.topic.end
            element = _renamed(near, mention.topic.name, topics, words) if near is not None else None
            if element is not None and near is not None:
                yield model.span(element.origin.position), near, Suggestion(mention.topic.name.strip("/"), near)
                continue
            use = f", which `{mention.reader}` reads" if mention.reader else ""
            hint = Suggestion(near, mention.topic.name) if near is not None else f"; {_listed(mention.type, others)}"
            yield mention.source.span(mention.topic.start, end), mention.topic.name, use + hint
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


def _renamed(topic: str, read: str, topics: RobotTopics, words: Words) -> Element | None:
    """Return the only element of the description that names a topic, if several files name the topic of a reader.

    Args:
        topic: the topic that a sensor publishes.
        read: a topic that a node reads.
        topics: the topics of the robot.
        words: the words of the files.
    """
    elements = topics.elements.get(last(topic), ())
    is_named_once = words.places_of(topic.strip("/")) == 1 and len(elements) == 1
    is_sensor = is_named_once and elements[0].text.strip().endswith(topic.strip("/"))
    return elements[0] if is_sensor and words.places_of(read.strip("/")) >= _OTHER_PLACES else None


_OTHER_PLACES = 3
"""Number of places that name a topic from which on the sensor has the wrong name."""


def _listed(kind: str, topics: list[str]) -> str:
    return f"the {kind} topics of these packages are {', '.join(f'`{topic}`' for topic in topics[:3])}"


def unpublished(model: Model, words: Words) -> Iterator[tuple[Mention, list[str]]]:
    """Yield the topics that a node reads and nothing publishes, with the topics of the robot of that type.

    If the launch files may start another publisher, only a robot with one topic of the type is checked. Several
    mentions of a topic have one cause, such as a remapping, and are reported once.
    """
    named = (*mentions(model), *topics_of_receivers(model))
    read = [mention for mention in named if mention.type and "$" not in mention.topic.name]
    closed = {type: is_closed(model, type) for type in dict.fromkeys(mention.type for mention in read)}
    by_type = {is_all: published_by_type(model, not is_all) for is_all in sorted(set(closed.values()))}
    if not any(by_type.values()):
        return
    controllers = robot_topics(model).controllers
    in_namespaces, has_components = has_namespaces(model), starts_components(model)
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
        topic, topics = mention.topic.name.strip("/"), by_type[is_all].get(mention.type, set()) - mention.own
        if (
            topic in topics
            or topic in seen
            or mention.type in doubled
            or (mention.needs_all and (has_components or not is_all))
            or (mention.type == "PointCloud2" and has_camera)
        ):
            continue
        topics = topics - filtered if mention.is_input or mention.type == "NavSatFix" else topics
        # The namespace of a node does not change the name of a topic that begins with a slash.
        is_below = any(
            f"/{topic}".endswith(f"/{each}")
            or (f"/{each}".endswith(f"/{topic}") and not mention.topic.name.startswith("/"))
            for each in topics
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


def _meant(mention: Mention, topics: RobotTopics, moved: Set[str]) -> str | None:
    """Return the whole name of the topic that a mention stands for; None if it may be right.

    Args:
        mention: the mention.
        topics: the topics of the robot.
        moved: the topics to which launch files remap those of nodes.
    """
    name = mention.topic.name
    end = last(name)
    space, _, _ = name.rstrip("/").rpartition("/")
    first = name.strip("/").partition("/")[0]
    if space.strip("/") and not mention.is_input and first not in topics.controllers:
        candidates = sorted(each for each in topics.controllers if len(each) > 5 and each != first)
        near = [
            each for each in candidates if is_slip(first, each) or re.sub("s_", "_", first) == re.sub("s_", "_", each)
        ]
        if len(near) == 1:
            return name.replace(first, near[0], 1)
    if end in COMMON or end in topics.names or end in _ACCEPTED.split() or len(end) < 3:
        return None
    # launch-name-misspelt reports `joint_states` and `robot_description` in launch files.
    is_launch = mention.source.file.endswith(LAUNCH)
    names = topics.names - {"joint_states", "robot_description"} if is_launch else topics.names
    names = names | (moved - {"joint_states", "robot_description"} if end in moved else frozenset())
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
