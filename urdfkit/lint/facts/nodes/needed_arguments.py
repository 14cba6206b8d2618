"""Nodes that stop without arguments, or without a parameter.

The behaviour is that of map_server, gazebo_ros, controller_manager, rosbag, topic_tools, tf and tf2_ros of Noetic, and
of controller_manager, gazebo_ros, ros_gz_bridge, ros_gz_sim and nav2_map_server of Humble to Rolling; the sources were
not compared.
"""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.launch.spawned_controllers import ros1_files, tags
from urdfkit.lint.facts.launch.started_nodes import StartedNode, started_nodes
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.model.model import Model

_ROS1 = {
    ("controller_manager", "spawner"): "the names of controllers",
    ("gazebo_ros", "spawn_model"): "`-model` and the description",
    ("map_server", "map_server"): "the file of the map",
    ("rosbag", "play"): "the bag",
    ("tf", "static_transform_publisher"): "the transform",
    ("tf2_ros", "static_transform_publisher"): "the transform",
    **{("topic_tools", name): "topics" for name in ("relay", "throttle", "mux", "drop")},
}
"""Package and program of ROS 1 → what its arguments are."""

_OF_PIPELINES = (
    *("planning_pipelines", "planning_plugin", "planning_plugins", "move_group"),
    *("ompl", "chomp", "stomp", "pilz_industrial_motion_planner"),
)
"""Parameters of move_group with a planning pipeline, one of them in the namespace of a pipeline."""

_ROS2 = {
    ("controller_manager", "spawner"): ((), "the names of controllers"),
    ("gazebo_ros", "spawn_entity.py"): ((), "`-entity` and the description"),
    ("moveit_ros_move_group", "move_group"): (_OF_PIPELINES, "the planning pipelines of the MoveIt configuration"),
    ("nav2_map_server", "map_server"): (("yaml_filename",), "the parameter `yaml_filename`"),
    ("ros_gz_bridge", "parameter_bridge"): (("config_file", "bridge_names"), "topics, or the parameter `config_file`"),
    ("ros_gz_sim", "create"): (("topic", "file", "string"), "`-topic`, `-file` or `-string`"),
}
"""Package and program of ROS 2 → parameters that can replace its arguments, and what they are."""

_BY_PARAMETER = ("moveit_ros_move_group", "nav2_map_server")
"""Packages whose programs have no command line arguments of their own."""


def nodes_without_arguments(model: Model) -> Iterator[tuple[Source, tuple[int, int], str]]:
    """Yield launch file, place and message of each node without its arguments."""
    for source, tag in tags(ros1_files(model), "node"):
        package, program, arguments = (
            tag.attributes[name].value.strip() if name in tag.attributes else "" for name in ("pkg", "type", "args")
        )
        needed = _ROS1.get((package, program))
        if needed is not None and not arguments:
            yield source, (tag.start, tag.end), f"`{program}` has no arguments; write {needed} in `args`"
    for node in started_nodes(model):
        message = _of_ros2(node)
        if message:
            yield node.source, (node.start, node.end), message


def _of_ros2(node: StartedNode) -> str:
    """Return the message for a node of ROS 2 without its arguments; empty for other nodes."""
    found = _ROS2.get((node.package, node.program))
    if found is None or node.parameters is None:
        return ""
    names, needed = found
    if any(is_slip(written, name) for written in node.parameters for name in names):
        return ""  # launch-name-misspelt
    has_arguments = node.has_arguments and node.package not in _BY_PARAMETER
    return "" if has_arguments or not {*names}.isdisjoint(node.parameters) else f"`{node.program}` needs {needed}"
