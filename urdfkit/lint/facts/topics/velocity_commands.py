"""Remappings of common nodes: names that the node does not have, and velocity commands that no node reads.

Sources: teleop_twist_joy, teleop_twist_keyboard, joy, twist_mux, robot_state_publisher, joint_state_publisher,
robot_localization (navsat_transform.cpp, ros_filter.cpp), octomap_server (octomap_server.cpp), nav2_velocity_smoother,
nmea_navsat_driver (driver.py),
diff_drive_controller, mecanum_drive_controller, tricycle_controller and steering_controllers_library (README and source
files), Noetic to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named, controllers
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.ros2_controllers import declared
from urdfkit.lint.facts.control.ros_gz_bridges import bridged_topics
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, start_of, walk, yamls
from urdfkit.lint.facts.gazebo.plugins import plugins, references
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes, parameter_files
from urdfkit.lint.facts.topics.graph import drive_topics, remapped, remaps_groups
from urdfkit.lint.facts.topics.node_topics import published_commands, topics_of
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model

_NAMES = {
    "joint_state_publisher": "joint_states robot_description",
    "joint_state_publisher_gui": "joint_states robot_description",
    "joy": "joy joy/set_feedback diagnostics",
    "nav2_velocity_smoother": "cmd_vel cmd_vel_smoothed odom",
    "nmea_navsat_driver": "fix vel heading time_reference nmea_sentence",
    **dict.fromkeys(
        ("robot_localization/ekf_node", "robot_localization/ukf_node"),
        "odometry/filtered accel/filtered set_pose cmd_vel enable toggle set_state reset diagnostics",
    ),
    "robot_localization/navsat_transform_node": "imu gps/fix odometry/filtered odometry/gps gps/filtered datum toLL"
    " fromLL fromLLArray setUTMZone",
    "octomap_server": "cloud_in octomap_binary octomap_full octomap_point_cloud_centers occupied_cells_vis_array"
    " free_cells_vis_array projected_map map clear_bbx reset clear_bbox",
    "robot_state_publisher": "joint_states robot_description",
    "teleop_twist_joy": "cmd_vel joy",
    "teleop_twist_keyboard": "cmd_vel key_vel",
    "twist_mux": "cmd_vel_out diagnostics",
}
"""Package, or package and executable → topics and services of the nodes; those of their parameters are accepted too."""

_OF_ROS1 = {
    "amcl": ("scan",),
    "gmapping": ("scan",),
    "move_base": ("cmd_vel", "odom"),
    "robot_state_publisher": ("joint_states",),
    "twist_mux": ("cmd_vel_out",),
}
"""ROS 1 package → topics of its node that launch files usually remap."""

_DESCRIBED = ("joint_state_publisher", "joint_state_publisher_gui", "robot_state_publisher", "controller_manager")
"""Packages whose nodes exchange or read the description of the robot."""

_DESCRIPTION_SET = (
    r"<param\s+name\s*=\s*[\"']/?robot_description[\"']\s[^<>]*?(?:command|textfile|\$\(command)"
    r"|[\"']robot_description[\"']\s*:"
)
"""Matches a launch file that sets the parameter with the description."""

_EVERY_NODE = ("tf", "tf_static", "clock", "rosout", "parameter_events")

_OF_FRAME = r"(?m)^\s*\w*frame(?:_id)?\s*:.*$"
"""Matches a parameter that is a frame, which can have the name of a topic."""

_SENDERS = ("twist_mux", "controller_server", "velocity_smoother", "teleop_node")
"""Programs whose velocity commands must reach the drive without a remapping on the command line."""

_CONTROLLERS = r"diff_drive|_steering_controller/|mecanum_|tricycle_controller/"
"""Matches the types of controllers that read velocity commands."""

_DRIVES = r"drive|planar|velocity|mecanum|holonomic|ackermann|steer|force|prius"


def misnamed_remappings(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the old name and the message of each remapping that has no effect."""
    inputs, files = set(_mux_topics(model, ("topics", "locks"))), parameter_files(model)
    seen = set[tuple[str, int]]()
    nodes = launched_nodes(model)
    yield from _undescribed(nodes, model)
    shared = {(node.source.file, old.start) for node in nodes for old, _ in node.remappings if _is_own(node, old)}
    for node in nodes:
        for old, new in node.remappings:
            if re.fullmatch(rf"~/?{re.escape(old.name.strip('/'))}", new.name) and not old.name.startswith("~"):
                yield node.source, old, f"the names of this remapping are swapped; write `{new.name}` first"
            elif (
                ("$" in old.name or old.name.strip("/") in inputs)
                and new.name in _OF_ROS1.get(node.package, ())
                and reads_ros1(node.source)
            ):
                yield (
                    node.source,
                    old,
                    f"`{node.program}` has the topic `{new.name}`, not `{old.name}`; swap the names",
                )
        for old, message in _swapped(node):
            if (node.source.file, old.start) not in seen | shared:  # several nodes can have one list of remappings
                seen.add((node.source.file, old.start))
                yield node.source, old, message
        label = node.program if f"{node.package}/{node.program}" in _NAMES else node.package
        names = (_NAMES.get(f"{node.package}/{label}") or _NAMES.get(node.package, "")).split()
        if node.program == "navsat_transform_node" and reads_ros1(node.source):
            continue
        if not names or (node.package == "twist_mux" and (not inputs or node.program != "twist_mux")):
            continue
        accepted = {*names, *_EVERY_NODE, *(inputs if node.package == "twist_mux" else ())}
        written = {old.name.strip("/") for old, _ in node.remappings}
        for old, new in node.remappings:
            name = old.name.removeprefix("~").strip("/")
            is_moved = "/" in name and name.rpartition("/")[2] in accepted and new.name.strip("/") not in names
            texts = [_settings(node, files[file]) if file in files else name for file in node.files]
            is_read = any(
                re.search(rf"(?<![\w/]){re.escape(name)}(?![\w/])", re.sub(_OF_FRAME, "", text)) for text in texts
            )
            if name in accepted or is_moved or not re.fullmatch(r"[\w/]+", name) or is_read:
                continue
            left = [each for each in names if each not in written]
            near = new.name if new.name in left else nearest(name, left, cutoff=0.6)
            yield node.source, old, f"`{label}` has no topic `{name}`" + Suggestion(near, name)


def _undescribed(nodes: list[LaunchedNode], model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the new name of the robot description of each node, if no other file has this name."""
    moved = [
        (node, new)
        for node in nodes
        for old, new in (node.remappings if node.package in _DESCRIBED else ())
        if old.name.strip("/") == "robot_description" and re.fullmatch(r"[\w/]+", new.name.strip("/"))
    ]
    texts = (source.text for file, source in model.related_files.items() if file.endswith(LAUNCH))
    if not moved or not any(re.search(_DESCRIPTION_SET, text) for text in texts):
        return
    words = Words(model)
    for node, new in moved:
        name = new.name.strip("/")
        if not words.names(name, [(node.source.file, new.start)]):
            yield node.source, new, f"no other file names `{name}`, so `{node.program}` is without a description"


def _settings(node: LaunchedNode, file: Source) -> str:
    """Return the text of the sections of a node in its parameter file; the whole text if none has its name."""
    own = [group for key, group in sections(file) if node.name is not None and key.last_name == node.name.name]
    is_shared = not own or any("*" in key.text for key, _ in sections(file))
    groups = [each for group in own for each in walk(group)]
    values = [each for group in groups for key, value in group.entries for each in _values(key, value)]
    return file.text if is_shared else "\n".join(each.text for each in values)


def _values(key: Node, value: Node) -> tuple[Node, ...]:
    """Return a value and the items of a list, unless it is a frame."""
    return (value, *value.items) if not re.search(r"frame(?:_id)?$", key.text) else ()


def _unfed(model: Model, published: set[str]) -> LaunchedNode | None:
    """Return the only velocity smoother that reads the topic by default, if no node publishes on it."""
    nodes = [node for node in launched_nodes(model) if node.program == "velocity_smoother"]
    default = nodes[0] if len(nodes) == 1 and remapped(nodes[0], "cmd_vel") == "cmd_vel" else None
    return None if default is None or default.has_more_remappings or "cmd_vel" in published else default


def _swapped(node: LaunchedNode) -> Iterator[tuple[Named, str]]:
    """Yield the remappings of a well-known node whose new name is a topic of the node, and whose old name is not."""
    if node.package in _NAMES or f"{node.package}/{node.program}" in _NAMES or node.package in _OF_ROS1:
        return
    for old, new in node.remappings:
        if new.name.strip("/") in _own_topics(node) and not _is_own(node, old):
            yield old, f"`{node.program}` has the topic `{new.name}`, not `{old.name}`; swap the names"


def _own_topics(node: LaunchedNode) -> set[str]:
    """Return the topics of a well-known node, with that of its velocity commands; empty for other nodes."""
    topics, commands = topics_of(node.package, node.program), published_commands().get(node.package)
    return {*(topics.read if topics else ()), *(topics.published if topics else ()), *((commands,) if commands else ())}


def _is_own(node: LaunchedNode, old: Named) -> bool:
    return old.name.removeprefix("~").strip("/") in _own_topics(node)


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
        yield node.source, named, f"no node subscribes to the velocity commands on `{topic}` of this node{what}"


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
                if topic is None or near is None or near in set(_mux_topics(model)):
                    continue
                if not words.names(name, [(source.file, start_of(source, topic))]):
                    message = f"no node publishes velocity commands on `{topic.text}`" + Suggestion(near, topic.text)
                    yield source, topic, near, message


def velocity_inputs(model: Model) -> frozenset[str]:
    """Return the topics of velocity commands that drives, bridges and twist_mux read."""
    return drive_command_topics(model) | frozenset(_mux_topics(model))


def _is_command(node: LaunchedNode, old: Named) -> bool:
    return old.name.removeprefix("~").strip("/") == published_commands()[node.package]


def _mux_topics(model: Model, kinds: tuple[str, ...] = ("topics",)) -> Iterator[str]:
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
        if "_steering_controller/" in kind:  # the default differs between releases
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
    return frozenset(found)


def has_drive(model: Model) -> bool:
    """Return whether a plugin may read velocity commands on its default topic."""
    is_ros1 = not _drives(model) and any(controllers(source) and not list(declared(source)) for source in yamls(model))
    return is_ros1 or any(re.search(_DRIVES, plugin.filename or "") for plugin, _, _ in plugins(model.robot))
