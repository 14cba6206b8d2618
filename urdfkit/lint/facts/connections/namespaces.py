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
from urdfkit.lint.facts.connections.controller_managers import KNOWN, manager_of
from urdfkit.lint.facts.connections.trees import full_name, is_known, is_ros1, launch_trees, place_of
from urdfkit.lint.facts.control.ros_gz_bridges import bridged_topics
from urdfkit.lint.facts.gazebo.plugins import plugins
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

_SPAWNERS = ("create", "spawn_entity.py")
_BROADCASTERS = r"joint_state_(?:broadcaster|controller)"
_OTHERS = "joint_state_publisher"
"""Part of the names of Gazebo plugins that publish ``joint_states``."""


@record(eq=False)
class _End:
    """A publisher or subscriber of a topic.

    Attributes:
        node: the node.
        topic: the full name of the topic, without slashes at its ends.
        is_renamed: whether the launch file names the topic.
    """

    node: LaunchNode
    topic: str
    is_renamed: bool = False


def nodes_apart(model: Model) -> Iterator[tuple[Span, str]]:
    """Yield place and message of each node whose topic another node has in another namespace."""
    seen = set[tuple[str, int]]()
    for base in ("robot_description", "joint_states"):
        trees = [(tree, _publishers(tree, base)) for tree in launch_trees(model)]
        every = {end.topic for _, publishers in trees for end in publishers}
        is_computed = not all(is_known(topic) and topic.endswith(base) for topic in every)
        if not every or is_computed or (base == "joint_states" and _is_simulated(model)):
            continue
        for tree, publishers in trees:
            is_open = any(package not in KNOWN for package, _ in tree.outside)
            is_param = base == "robot_description" and is_ros1(tree, model)
            readers = list(_readers(tree, base)) if publishers and not is_open and not is_param else []
            for reader in readers:
                is_own = reader.is_renamed and reader.topic in every
                if not is_known(reader.topic) or not reader.topic.endswith(base) or is_own:
                    continue
                if all(end.topic != reader.topic for end in publishers):
                    blamed, message = _message(tree, publishers, reader)
                    span = place_of(blamed.node, model)
                    if span is not None and (span.file, span.line) not in seen:
                        seen.add((span.file, span.line))
                        yield span, message


def _message(tree: LaunchContents, publishers: list[_End], reader: _End) -> tuple[_End, str]:
    """Return the end whose node or topic is the other than most, and the message."""
    spaces = Counter(node.namespace for node in tree.nodes)
    first = min(publishers, key=lambda end: end.node.is_skipped)
    is_rare = spaces[first.node.namespace] < spaces[reader.node.namespace]
    is_other = len(publishers) == 1 and not reader.is_renamed and (is_rare or first.is_renamed)
    blamed, other = (first, reader) if is_other else (reader, first)
    own, far = ("publishes", "subscribes to") if is_other else ("subscribes to", "publishes")
    message = f"`{blamed.node.program}` {own} `/{blamed.topic}`, but `{other.node.program}` {far} `/{other.topic}`"
    return blamed, message + "; start both in one namespace"


def _publishers(tree: LaunchContents, base: str) -> list[_End]:
    found = [_end(node, base) for node in tree.nodes if base in _PUBLISHED.get(node.package, ())]
    spawners = [node for node in tree.nodes if node.package == "controller_manager" and base == "joint_states"]
    is_renamed = any(base in {old.strip("/") for old in node.remappings} for node in spawners)
    for node in spawners:
        if any(re.fullmatch(_BROADCASTERS, word.text) for word in node.arguments):
            manager = manager_of(node)
            name = full_name(node, manager.text) if manager is not None and not is_renamed else UNKNOWN
            found.append(_End(node, f"{name.rpartition('/')[0]}/{base}".strip("/") if is_known(name) else UNKNOWN))
    return found


def _is_simulated(model: Model) -> bool:
    """Return whether a plugin or a bridge publishes ``joint_states`` too."""
    is_bridged = any(topic.endswith("joint_states") for topic, _, is_read in bridged_topics(model) if not is_read)
    return is_bridged or any(_OTHERS in (plugin.filename or "") for plugin, _, _ in plugins(model.robot))


def _readers(tree: LaunchContents, base: str) -> Iterator[_End]:
    for node in tree.nodes:
        if base in _READ.get(node.package, ()) and not node.is_open:
            yield _end(node, base)
        elif base == "robot_description" and node.program in _SPAWNERS:
            for before, word in zip(node.arguments, node.arguments[1:], strict=False):
                if before.text == "-topic":
                    yield _End(node, full_name(node, word.text), word.text != base)
        elif node.program == "ros2_control_node" and (new := node.remappings.get(f"~/{base}")) is not None:
            yield _End(node, full_name(node, new), True)


def _end(node: LaunchNode, topic: str) -> _End:
    names = {old.strip("/"): new for old, new in node.remappings.items()}
    return _End(node, full_name(node, names.get(topic, topic)), topic in names)
