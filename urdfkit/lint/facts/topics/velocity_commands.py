"""Topics of velocity commands: topics that no node reads, and inputs of twist_mux on which no node publishes.

Sources: diff_drive_controller, mecanum_drive_controller, tricycle_controller and steering_controllers_library (README
and source files), Noetic to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named, controllers
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.ros2_controllers import declared
from urdfkit.lint.facts.control.ros_gz_bridges import bridged_topics
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, start_of, walk, yamls
from urdfkit.lint.facts.gazebo.plugins import plugins, references
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes
from urdfkit.lint.facts.topics.graph import drive_topics, remapped, remaps_groups
from urdfkit.lint.facts.topics.node_topics import published_commands
from urdfkit.lint.facts.topics.own_ends import own_ends
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model

_SENDERS = ("twist_mux", "controller_server", "velocity_smoother", "teleop_node")
"""Programs whose velocity commands must reach the drive without a remapping on the command line."""

_CONTROLLERS = r"diff_drive|_steering_controller/|mecanum_|tricycle_controller/"
"""Matches the types of controllers that read velocity commands."""

_DRIVES = r"drive|planar|velocity|mecanum|holonomic|ackermann|steer|force|prius"


def _unfed(model: Model, published: set[str]) -> LaunchedNode | None:
    """Return the only velocity smoother that reads the topic by default, if no node publishes on it."""
    nodes = [node for node in launched_nodes(model) if node.program == "velocity_smoother"]
    default = nodes[0] if len(nodes) == 1 and remapped(nodes[0], "cmd_vel") == "cmd_vel" else None
    return None if default is None or default.has_more_remappings or "cmd_vel" in published else default


def unread_commands(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the new name and the message of each velocity topic that no node reads."""
    nodes = [node for node in launched_nodes(model) if node.package in published_commands()]
    written = [(node, old, new) for node in nodes for old, new in node.remappings if _is_command(node, old)]
    drives = drive_command_topics(model) if nodes else frozenset()
    every = velocity_inputs(model) if nodes else drives
    own = [(node.source.file, name.start) for node, old, new in written for name in (old, new)]
    own += [(node.source.file, old.start) for node in launched_nodes(model) for old, _ in node.remappings]
    used = {new.name.strip("/") for _, _, new in written}
    muxes = {node.source.file for node in nodes if node.package == "twist_mux"}
    words, seen = Words(model), set[str]()
    yield from _unmoved_outputs(model, nodes, (drives, every), words, own)
    yield from _past_smoothers(model)
    for node, _, new in written:
        topic = new.name.strip("/")
        # A driver in another package may read the output of twist_mux, and cmd_vel.
        is_of_driver = topic.endswith("cmd_vel") and (topic == "cmd_vel" or node.source.file not in muxes)
        readers = drives if node.package == "twist_mux" or is_of_driver else every
        if not readers or topic in every | seen or not re.fullmatch(r"[\w/]+", topic) or words.names(topic, own):
            continue
        if (
            "/" in topic
            and words.names(topic.rpartition("/")[0], own)
            and topic.partition("/")[0] not in _drives(model)
        ):
            continue  # a namespace
        if topic == "cmd_vel" and has_drive(model):
            continue
        seen.add(topic)
        unfed = sorted(readers - used)
        near = unfed[0] if len(unfed) == 1 else nearest(topic, unfed, cutoff=0.7)
        shown = ", ".join(f"`{name}`" for name in sorted(readers)[:3])
        what = Suggestion(near, new.name) if near is not None else f"; the nodes of these packages subscribe to {shown}"
        if (lone := _unfed(model, used)) is not None and lone.place is not None and near is None:
            named = Named(lone.source.text[slice(*lone.place)], lone.place[0])
            message = f"no node publishes the velocity commands of this node on `cmd_vel`; remap its input to `{topic}`"
            yield lone.source, named, message
            continue
        yield node.source, new, f"no node subscribes to the velocity commands on `{new.name}`" + what


def _unmoved_outputs(
    model: Model,
    nodes: list[LaunchedNode],
    readers: tuple[frozenset[str], frozenset[str]],
    words: Words,
    own: list[tuple[str, int]],
) -> Iterator[tuple[Source, Named, str]]:
    """Yield the nodes without a remapping whose velocity commands no drive and no other node reads."""
    drives, every = readers
    if remaps_groups(model):
        return
    seen = {"cmd_vel"} if has_drive(model) else set[str]()
    for node in nodes:
        topic = published_commands()[node.package]
        is_moved = node.has_more_remappings or any(_is_command(node, old) for old, _ in node.remappings)
        if is_moved or node.program not in _SENDERS or node.place is None or node.namespace is None:
            continue
        if node.namespace:
            yield from _in_other_namespace(node, topic, every)
            continue
        if not drives or topic in every | seen:
            continue
        seen.add(topic)
        if words.names(topic, own):
            continue
        others = sorted(drives if node.package == "twist_mux" else every)
        what = f"; remap it to `{others[0]}`" if len(others) == 1 else ""
        named = Named(node.source.text[slice(*node.place)], node.place[0])
        named = next((old for old, _ in node.remappings if "vel" in old.name), named)
        yield node.source, named, f"no node subscribes to the velocity commands on `{topic}` of this node{what}"


def _past_smoothers(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the controller servers that publish past the smoother whose input the behavior server has.

    In nav2_bringup, the controller always publishes to the smoother, but in Humble the behaviors do not.
    """
    nodes = [node for node in launched_nodes(model) if not node.has_more_remappings and node.place is not None]
    if remaps_groups(model):
        return
    for smoother in (node for node in nodes if node.program == "velocity_smoother"):
        topic = remapped(smoother, "cmd_vel")
        same = [node for node in nodes if (node.source, node.namespace) == (smoother.source, smoother.namespace)]
        moved = [node for node in same if node.program == "behavior_server" and remapped(node, "cmd_vel") == topic]
        for node in same if moved and topic != "cmd_vel" else ():
            if (
                node.program == "controller_server"
                and remapped(node, "cmd_vel") == "cmd_vel"
                and node.place is not None
            ):
                named = Named(node.source.text[slice(*node.place)], node.place[0])
                message = "publishes its velocity commands on `cmd_vel`, past `velocity_smoother`, which reads"
                yield node.source, named, f"this node {message} `{topic}`"


def _in_other_namespace(node: LaunchedNode, topic: str, readers: frozenset[str]) -> Iterator[tuple[Source, Named, str]]:
    """Yield the namespace of a node whose commands would have a reader in another namespace only."""
    used = f"{node.namespace}/{topic}"
    others = sorted(each for each in readers if each.endswith(f"/{topic}"))
    if used not in readers and topic not in readers and others and node.spaced_by is not None:
        near = others[0] if len(others) == 1 else nearest(used, others, cutoff=0.6)
        message = f"no node subscribes to the velocity commands on `{used}`"
        yield node.source, node.spaced_by, message + Suggestion(near, used)


def unfed_mux_topics(model: Model) -> Iterator[tuple[Source, Node, str, str]]:
    """Yield the topics of a twist_mux that nearly match a topic of velocity commands: file, value, topic, message."""
    published = set[str]()
    topics = {package: topic for package, topic in published_commands().items() if package != "twist_mux"}
    for node in (each for each in launched_nodes(model) if each.package in topics):
        published.add(remapped(node, topics[node.package]))
    words = Words(model)
    for source in yamls(model) if published else ():
        entries = [each for node in nodes(source) for each in node.entries]
        for group in (value for key, value in entries if key.text == "topics" and "priority" in source.text):
            for topic in (value.find("topic") for _, value in group.entries if value.find("priority") is not None):
                name = topic.text.strip("/") if topic is not None else ""
                near = nearest(name, sorted(published), cutoff=0.85) if name and name not in published else None
                if topic is None or near is None or near in set(mux_topics(model)):
                    continue
                if not words.names(name, [(source.file, start_of(source, topic))]):
                    message = f"no node publishes velocity commands on `{topic.text}`" + Suggestion(near, topic.text)
                    yield source, topic, near, message


def velocity_inputs(model: Model) -> frozenset[str]:
    """Return the topics of velocity commands that drives, bridges and twist_mux read."""
    return drive_command_topics(model) | frozenset(mux_topics(model))


def _is_command(node: LaunchedNode, old: Named) -> bool:
    return old.name.removeprefix("~").strip("/") == published_commands()[node.package]


def mux_topics(model: Model, kinds: tuple[str, ...] = ("topics",)) -> Iterator[str]:
    """Yield the topics that a twist_mux reads, those of velocity commands by default."""
    for source in yamls(model):
        if "priority" not in source.text:
            continue
        for group in nodes(source):
            for key, inputs in group.entries:
                for node in walk(inputs) if key.text in kinds else ():
                    topic = node.find("topic")
                    if topic is not None and node.find("priority") is not None and topic.text:
                        yield topic.text.strip("/")


def _drives(model: Model) -> dict[str, str]:
    """Return the names of the drive controllers → their type."""
    found = {each.name: each.kind.text for source in yamls(model) for each in declared(source)}
    found |= {each.name: each.kind for source in yamls(model) for each in settings(source)}
    return {name: kind for name, kind in found.items() if re.search(_CONTROLLERS, kind)}


def drive_command_topics(model: Model) -> frozenset[str]:
    """Return the topics of velocity commands that controllers, plugins and bridges read."""
    found = set[str]()
    flags = [source.text for source in yamls(model) if "use_stamped_vel" in source.text]
    for name, kind in _drives(model).items():
        is_unstamped, is_stamped = (
            any(re.search(rf"use_stamped_vel\s*:\s*{word}", text, re.I) for text in flags) for word in ("false", "true")
        )
        if re.search(r"(?<!four_wheel)_steering_controller/", kind):  # the default differs between releases
            found |= {f"{name}/reference_unstamped"} if not is_stamped else set()
            found |= {f"{name}/reference"} if not is_unstamped else set()
            continue
        if kind.startswith("tricycle_controller/"):
            found.add(f"{name}/cmd_vel")
            continue
        if "mecanum_drive_controller/" in kind:  # has `use_stamped_vel` in Humble only
            found.add(f"{name}/reference_unstamped" if is_unstamped else f"{name}/reference")
            continue
        found.add(f"{name}/cmd_vel_unstamped" if is_unstamped else f"{name}/cmd_vel")
    for text, _, parameter, _ in references(model, ("topic",)):
        if parameter.meaning == "command_topic":
            found.add(text.strip().strip("/"))
    found |= set(drive_topics(model, "command_topic"))
    found |= {topic for topic, kind, is_read in bridged_topics(model) if is_read and "geometry_msgs/msg/Twist" in kind}
    return frozenset(found | _own_drive_topics(model))


_OF_JOINTS = ("Float64", "Float64MultiArray", "JointTrajectory", "AckermannDrive", "AckermannDriveStamped")
"""Messages with which a node of the workspace moves joints."""


def _own_drive_topics(model: Model) -> set[str]:
    """Return the topics on which nodes of the workspace that publish commands for joints read velocity commands."""
    ends = [end for end in own_ends(model) or [] if end.topic and end.is_launched]
    moving = {end.path for end in ends if end.publishes and end.type in _OF_JOINTS}
    return {end.topic for end in ends if not end.publishes and "Twist" in end.type and end.path in moving}


def has_drive(model: Model) -> bool:
    """Return whether a plugin may read velocity commands on its default topic."""
    is_ros1 = not _drives(model) and any(controllers(source) and not list(declared(source)) for source in yamls(model))
    return is_ros1 or any(re.search(_DRIVES, plugin.filename or "") for plugin, _, _ in plugins(model.robot))
