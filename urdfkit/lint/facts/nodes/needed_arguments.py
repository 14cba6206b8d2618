"""Nodes that stop without arguments, or without a parameter.

The behaviour is that of map_server, gazebo_ros, controller_manager, rosbag, topic_tools, tf and tf2_ros of Noetic, and
of controller_manager, gazebo_ros, ros_gz_bridge, ros_gz_sim and nav2_map_server of Humble to Rolling; the sources were
not compared.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.actions import launch_elements
from urdfkit.lint.facts.launch.python.names import python_files
from urdfkit.lint.facts.launch.spawned_controllers import ros1_files, tags
from urdfkit.lint.facts.launch.started_nodes import StartedNode, started_nodes
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Tag

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

_LOADED = {
    ("twist_mux", "twist_mux"): r"topics",
    **{("robot_localization", f"{kind}_localization_node"): r"(?:odom|imu|pose|twist)\d" for kind in ("ekf", "ukf")},
}
"""Package and program of ROS 1 → pattern of the parameters without which it has no inputs."""

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


def nodes_without_arguments(model: Model) -> Iterator[tuple[Source, tuple[int, int], str, tuple[str, ...]]]:
    """Yield launch file, place and message of each node without its arguments, and the parameters that replace them."""
    for source, tag in tags(ros1_files(model), "node"):
        package, program, arguments = (
            tag.attributes[name].value.strip() if name in tag.attributes else "" for name in ("pkg", "type", "args")
        )
        if (package, program) in _LOADED and not _has_parameters(tag, source, _LOADED[package, program]):
            yield (source, (tag.start, tag.end), f"`{program}` has no inputs; load its parameters with <rosparam>", ())
        needed = _ROS1.get((package, program))
        if needed is not None and not arguments:
            yield source, (tag.start, tag.end), f"`{program}` has no arguments; write {needed} in `args`", ()
    for node in started_nodes(model):
        message = _of_ros2(node)
        if message:
            yield node.source, node.settings_place, message, _ROS2[node.package, node.program][0]


def _has_parameters(tag: Tag, source: Source, pattern: str) -> bool:
    """Return whether a node of ROS 1 loads a file or has a parameter of a pattern, or may get them elsewhere."""
    inner = [child.attributes["name"].value for child in tag.children if "name" in child.attributes]
    is_set = any(child.name == "rosparam" for child in tag.children) or any(re.match(pattern, name) for name in inner)
    return is_set or len(re.findall(r"<rosparam\b", source.text)) > _inside(source)


def _inside(source: Source) -> int:
    """Return the number of <rosparam> elements inside of nodes."""
    found = [tag for _, tag in tags([source], "rosparam")]
    return sum(tag.parent is not None and tag.parent.name == "node" for tag in found)


_GAZEBO = ("gz_args", "ign_args")
_RUNNING = r"(?:^|\s)(?:-[a-zA-Z]*r[a-z0-9]*|--run)(?:\s|$)"
_HEADLESS = r"(?:^|\s)-[a-zA-Z]*s[a-z0-9]*(?:\s|$)"
"""Match the options of gz sim that start it at once, and without a user interface."""

Places = Iterator[tuple[Source, tuple[int, int], str]]


def paused_simulations(model: Model) -> Places:
    """Yield the arguments with which Gazebo starts paused, although no user can start it or controllers wait for it."""
    has_controllers = any("controller_manager" in source.text for source in model.related_files.values())
    for source, at, text in _gazebo_arguments(model):
        is_headless = re.search(_HEADLESS, text) is not None
        if re.search(_RUNNING, text) or not text.strip() or not (is_headless or has_controllers):
            continue
        reason = (
            "and it has no user interface to start the simulation"
            if is_headless
            else "and controllers wait until it runs"
        )
        yield source, at, f"Gazebo starts paused, {reason}; add `-r`"


def _gazebo_arguments(model: Model) -> Iterator[tuple[Source, tuple[int, int], str]]:
    """Yield file, place and text of the arguments of gz sim; a path stands for each path of a package."""
    for source, tree in python_files(model):
        reader = launch_reader(tree) if any(name in source.text for name in _GAZEBO) else None
        for node in ast.walk(tree) if reader is not None else ():
            pairs = zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ()
            for key, value in pairs:
                if reader is not None and key is not None and reader.text(key) in _GAZEBO:
                    text = _text(value, reader)
                    if text is not None:
                        yield source, place(source, value), text
    for source, element in launch_elements(model, _GAZEBO):
        name, written = (element.attributes.get(each) for each in ("name", "value"))
        if name is not None and written is not None and name.name in _GAZEBO and "$(var" not in written.name:
            yield source, (written.start, written.end), written.name


def _text(node: ast.expr, reader: LaunchReader) -> str | None:
    """Return the text of a list of words; None if a part that is no path is computed."""
    listed = _assigned(node, reader)
    pieces = []
    for part in listed.elts if isinstance(listed, (ast.List, ast.Tuple)) else [listed]:
        value = _assigned(part, reader)
        text = reader.text(value)
        if text is None:
            is_argument = isinstance(value, ast.Call) and name_of(value.func) == "LaunchConfiguration" and value.args
            named = reader.text(value.args[0]) if isinstance(value, ast.Call) and is_argument else None
            if reader.path(value) is None and not (named or "").startswith("world"):
                return None
            text = "world.sdf"
        pieces.append(text)
    return "".join(pieces)


def _assigned(node: ast.expr, reader: LaunchReader) -> ast.expr:
    return (reader.assigned.get(node.id) or node) if isinstance(node, ast.Name) else node


def idle_managers(model: Model) -> Places:
    """Yield each ``autostart`` of a lifecycle manager that is false if nothing in the workspace calls its service."""
    texts = [source.text for source in model.related_files.values()]
    if any(re.search(r"manage_nodes|LifecycleManagerClient|lifecycle_manager_client", text) for text in texts):
        return
    for source, tree in python_files(model):
        reader = launch_reader(tree) if "nav2_lifecycle_manager" in source.text else None
        for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call)) if reader is not None else ():
            words = {word.arg: word.value for word in call.keywords}
            package, listed = words.get("package"), words.get("parameters")
            if reader is None or package is None or reader.text(package) != "nav2_lifecycle_manager":
                continue
            for item in listed.elts if isinstance(listed, ast.List) else ():
                for key, value in zip(item.keys, item.values, strict=True) if isinstance(item, ast.Dict) else ():
                    is_off = isinstance(value, ast.Constant) and value.value in (False, "false", "False")
                    if key is not None and reader.text(key) == "autostart" and is_off:
                        yield source, place(source, value), _IDLE
    for source, element in launch_elements(model, ("nav2_lifecycle_manager",)):
        for child in element.children:
            name, written = (child.attributes.get(each) for each in ("name", "value"))
            if name is not None and written is not None and (name.name, written.name.lower()) == ("autostart", "false"):
                yield source, (written.start, written.end), _IDLE


_IDLE = "`autostart` is false, and nothing activates the nodes of this lifecycle manager"


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
