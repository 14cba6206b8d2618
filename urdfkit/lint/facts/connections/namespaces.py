"""Nodes that do not reach each other because one of them is in another namespace.

Sources: robot_state_publisher (robot_state_publisher.cpp), joint_state_publisher (joint_state_publisher.py),
joint_state_broadcaster (userdoc.rst), ros_gz_sim (create.cpp), gazebo_ros (spawn_entity.py), moveit_ros_planning
(current_state_monitor_middleware_handle.cpp).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.description.launch.launch_scope import UNKNOWN, LaunchContents, LaunchNode
from urdfkit.description.xml.source import Span
from urdfkit.lint.facts.connections.controller_managers import WITHOUT_MANAGER, manager_of
from urdfkit.lint.facts.connections.trees import full_name, is_constant, is_ros1, launch_trees, place_of
from urdfkit.lint.facts.control.ros_gz_bridges import bridged_topics
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.facts.gazebo.spawned_models import SPAWNERS
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_PUBLISHED = {
    "robot_state_publisher": ("robot_description",),
    "joint_state_publisher": ("joint_states",),
    "joint_state_publisher_gui": ("joint_states",),
}
"""Package → topics that its node publishes."""

_READ = {
    "robot_state_publisher": ("joint_states",),
    "joint_state_publisher": ("robot_description",),
    "joint_state_publisher_gui": ("robot_description",),
    "moveit_ros_move_group": ("joint_states",),
}
"""Package → topics that its node subscribes to."""

_BROADCASTERS = r"joint_state_(?:broadcaster|controller)"
_OTHERS = "joint_state_publisher"
"""Part of the names of Gazebo plugins that publish ``joint_states``."""


@record(eq=False)
class _Connection:
    """A publisher or subscriber of a topic.

    Attributes:
        node: the node.
        topic: the full name of the topic, without slashes at its ends.
        is_renamed: whether the launch file names the topic.
    """

    node: LaunchNode
    topic: str
    is_renamed: bool = False


def separated_nodes(model: Model) -> Iterator[tuple[Span, str, str]]:
    """Yield place, message and topic of each node whose topic another node has in another namespace."""
    seen = set[tuple[str, int]]()
    for base in ("robot_description", "joint_states"):
        trees = [(tree, _publishers(tree, base)) for tree in launch_trees(model)]
        every = {end.topic for _, publishers in trees for end in publishers}
        is_computed = not all(is_constant(topic) and topic.endswith(base) for topic in every)
        if not every or is_computed or (base == "joint_states" and _is_simulated(model)):
            continue
        for tree, publishers in trees:
            is_open = any(package not in WITHOUT_MANAGER for package, _ in tree.outside)
            is_param = base == "robot_description" and is_ros1(tree, model)
            readers = list(_readers(tree, base)) if publishers and not is_open and not is_param else []
            for reader in readers:
                is_own = reader.is_renamed and reader.topic in every
                if not is_constant(reader.topic) or not reader.topic.endswith(base) or is_own:
                    continue
                others = [end for end in publishers if not _is_alternative(end, reader, readers)]
                if others and all(end.topic != reader.topic for end in publishers):
                    wrong, message = _message(tree, others, reader)
                    span = place_of(wrong.node, model)
                    if span is not None and (span.file, span.line) not in seen:
                        seen.add((span.file, span.line))
                        yield span, message, reader.topic.strip("/")


def _is_alternative(end: _Connection, reader: _Connection, readers: list[_Connection]) -> bool:
    """Return whether a publisher starts under another condition than a reader, together with a reader of its own."""
    pairs = (other for other in readers if other.topic == end.topic)
    is_same = end.node.is_skipped is reader.node.is_skipped
    return not is_same and any(other.node.is_skipped is end.node.is_skipped for other in pairs)


def _message(tree: LaunchContents, publishers: list[_Connection], reader: _Connection) -> tuple[_Connection, str]:
    """Return the end whose node or topic is the other than most, and the message."""
    spaces = Counter(node.namespace for node in tree.nodes)
    first = min(publishers, key=lambda end: end.node.is_skipped)
    is_rare = spaces[first.node.namespace] < spaces[reader.node.namespace]
    is_other = len(publishers) == 1 and not reader.is_renamed and (is_rare or first.is_renamed)
    wrong, other = (first, reader) if is_other else (reader, first)
    own, far = ("publishes", "subscribes to") if is_other else ("subscribes to", "publishes")
    message = f"`{wrong.node.program}` {own} `/{wrong.topic}`, but `{other.node.program}` {far} `/{other.topic}`"
    return wrong, message + "; start both in one namespace"


def _publishers(tree: LaunchContents, base: str) -> list[_Connection]:
    found = [_connection(node, base) for node in tree.nodes if base in _PUBLISHED.get(node.package, ())]
    spawners = [node for node in tree.nodes if node.package == "controller_manager" and base == "joint_states"]
    is_renamed = any(base in {old.strip("/") for old in node.remappings} for node in spawners)
    for node in spawners:
        if any(re.fullmatch(_BROADCASTERS, word.text) for word in node.arguments):
            manager = manager_of(node)
            topic = UNKNOWN
            if manager is not None and not is_renamed:
                topic = f"{full_name(node, manager.text).rpartition('/')[0]}/{base}".strip("/")
            found.append(_Connection(node, topic))
    return found


def _is_simulated(model: Model) -> bool:
    """Return whether a plugin or a bridge publishes ``joint_states`` too."""
    is_bridged = any(topic.endswith("joint_states") for topic, _, is_read in bridged_topics(model) if not is_read)
    return is_bridged or any(_OTHERS in (plugin.filename or "") for plugin, _, _ in plugins(model.robot))


def _readers(tree: LaunchContents, base: str) -> Iterator[_Connection]:
    for node in tree.nodes:
        if base in _READ.get(node.package, ()) and not node.is_open:
            yield _connection(node, base)
        elif base == "robot_description" and (node.package, node.program) in SPAWNERS:
            for before, word in zip(node.arguments, node.arguments[1:], strict=False):
                if before.text == "-topic":
                    yield _Connection(node, full_name(node, word.text), word.text != base)
        elif node.program == "ros2_control_node" and (new := node.remappings.get(f"~/{base}")) is not None:
            yield _Connection(node, full_name(node, new), True)


def _connection(node: LaunchNode, topic: str) -> _Connection:
    names = {old.strip("/"): new for old, new in node.remappings.items()}
    return _Connection(node, full_name(node, names.get(topic, topic)), topic in names)
