"""Remappings of common nodes whose old name is no topic of the node, or whose names are swapped.

Sources: teleop_twist_joy, teleop_twist_keyboard, joy, twist_mux, robot_state_publisher, joint_state_publisher,
robot_localization (navsat_transform.cpp, ros_filter.cpp), octomap_server (octomap_server.cpp), nav2_velocity_smoother
and nmea_navsat_driver (driver.py), Noetic to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.yaml_tree import Node, walk
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes, parameter_files
from urdfkit.lint.facts.topics.node_topics import published_commands, topics_of
from urdfkit.lint.facts.topics.velocity_commands import mux_topics
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


def misnamed_remappings(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the old name and the message of each remapping that has no effect."""
    inputs, files = set(mux_topics(model, ("topics", "locks"))), parameter_files(model)
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
        for old, message in _swapped(node, files):
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
            if name in accepted or is_moved or not re.fullmatch(r"[\w/]+", name) or _is_parameter(node, name, files):
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
            yield node.source, new, f"no other file names `{name}`, so `{node.program}` receives no description"


def _is_parameter(node: LaunchedNode, name: str, files: dict[tuple[str, str], Source]) -> bool:
    """Return whether a topic is the value of a parameter, in a file of the node or in the launch file."""
    inline = rf"(?::\s*(?:\[[^\]]*)?|\bvalue\s*=\s*)[\"']/?{re.escape(name)}[\"']"
    if re.search(inline, node.source.text):
        return True
    texts = [_settings(node, files[file]) if file in files else name for file in node.files]
    return any(re.search(rf"(?<![\w/]){re.escape(name)}(?![\w/])", re.sub(_OF_FRAME, "", text)) for text in texts)


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


def _swapped(node: LaunchedNode, files: dict[tuple[str, str], Source]) -> Iterator[tuple[Named, str]]:
    """Yield the remappings of a well-known node whose new name is a topic of the node, and whose old name is not."""
    if node.package in _NAMES or f"{node.package}/{node.program}" in _NAMES or node.package in _OF_ROS1:
        return
    for old, new in node.remappings:
        is_own = _is_own(node, old) or _is_parameter(node, old.name.strip("/"), files)
        if new.name.strip("/") in _own_topics(node) and not is_own:
            yield old, f"`{node.program}` has the topic `{new.name}`, not `{old.name}`; swap the names"


def _own_topics(node: LaunchedNode) -> set[str]:
    """Return the topics of a well-known node, with that of its velocity commands; empty for other nodes."""
    topics, commands = topics_of(node.package, node.program), published_commands().get(node.package)
    return {*(topics.read if topics else ()), *(topics.published if topics else ()), *((commands,) if commands else ())}


def _is_own(node: LaunchedNode, old: Named) -> bool:
    return old.name.removeprefix("~").strip("/") in _own_topics(node)
