"""Velocity commands that collision_monitor reads or publishes under a name that no other node has.

Source: ros-navigation/navigation2 (nav2_collision_monitor: collision_monitor_node.cpp; nav2_bringup:
navigation_launch.py), Humble to Rolling.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, start_of, yamls
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.topics.velocity_commands import drive_command_topics, has_drive, velocity_inputs
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xml.source import Source
    from urdfkit.lint.model.model import Model

_COMMON = {
    "cmd_vel_in_topic": ("cmd_vel_smoothed", "cmd_vel_nav", "cmd_vel_raw", "cmd_vel"),
    "cmd_vel_out_topic": ("cmd_vel",),
}
"""Parameter → topics of the nodes that nav2_bringup starts around the monitor."""


def unconnected_monitors(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield each topic of a collision monitor that no other node has: file, value, message."""
    words = Words(model)
    moved = [(node.source.file, old.start) for node in launched_nodes(model) for old, _ in node.remappings]
    inputs = velocity_inputs(model)
    # Without the velocity commands of a plugin, a driver of another package may read `cmd_vel`.
    is_closed = bool(drive_command_topics(model)) and "cmd_vel" not in inputs and not has_drive(model)
    for source in yamls(model):
        for key, group in sections(source) if "cmd_vel_in_topic" in source.text and PARAMETERS in source.text else ():
            if key.last_name != "collision_monitor":
                continue
            for parameter, common in _COMMON.items():
                value = group.find(parameter)
                topic = value.text.strip("/") if value is not None else ""
                is_unread = is_closed and parameter == "cmd_vel_out_topic"
                if value is None or (topic in common and not is_unread) or not re.fullmatch(r"\w+", topic):
                    continue
                is_input, near = parameter == "cmd_vel_in_topic", nearest(topic, common, cutoff=0.75)
                # Otherwise a node of another package can have the topic.
                others = "velocity_smoother" in source.text if is_input else inputs
                own = [(source.file, start_of(source, value)), *moved]
                if (others or near is not None) and topic not in inputs and not words.names(topic, own):
                    verb = "publishes" if is_input else "subscribes to"
                    shown = ", ".join(f"`{each}`" for each in sorted(inputs)[:4])
                    hint = (
                        f"; the nodes of these packages subscribe to {shown}"
                        if near == topic
                        else Suggestion(near, topic)
                    )
                    yield source, value, f"no node {verb} the velocity commands on `{value.text}`" + hint
