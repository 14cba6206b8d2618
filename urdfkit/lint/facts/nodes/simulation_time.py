"""Nodes of ROS 2 launch files that do not use the clock of the simulation although those around them do."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import launch_reader, name_of, unparsed
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import Node, start_of
from urdfkit.lint.facts.launch.actions import actions_of, all_elements, launch_files
from urdfkit.lint.facts.launch.python.names import python_files
from urdfkit.lint.facts.launch.receivers import actions_at, receiver
from urdfkit.lint.facts.launch.records import LaunchActions
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.navigation.tables import NODES
from urdfkit.lint.facts.nodes.conditional_starts import ConditionalAction, conditional_actions
from urdfkit.lint.facts.nodes.names import name_of_node
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes, parameter_files
from urdfkit.lint.model.model import Model

_KEY = "use_sim_time"
GAZEBO = ("gazebo_ros", "ros_gz_sim", "ros_ign_gazebo")
"""Packages whose launch files and programs start Gazebo."""

_TIMED = ("robot_localization", "robot_state_publisher", "slam_toolbox", "cartographer_ros")
"""Packages whose nodes compare the times of messages or transforms; those of Nav2 too."""

_STOPPED = ("moveit_ros_move_group", "moveit_servo", "robot_localization", "slam_toolbox", "cartographer_ros")
"""Packages whose nodes refuse or drop all messages of the other clock; those of Nav2 too.

Source of the first: moveit_ros_planning (current_state_monitor.cpp), which waits for a state newer than its own time.
"""

_WITNESSES = ("robot_state_publisher", "rviz2", "joint_state_publisher", *_STOPPED)
"""Packages whose nodes use the clock of the whole launch; those of Nav2 too."""

_FOR_ALL = ("SetParameter", "SetUseSimTime", "set_parameter")
_IDLE = ("lifecycle_manager", "map_server", "map_saver_server")

_OF_CLOCK = r"sim|gazebo|gz|real|hard|robot|fake|mock|\$\(eval|\bfalse\b"
"""Matches a condition that may hold without a simulation only."""

_SCOPES = r"\b(?:GroupAction|OpaqueFunction)\("
"""Matches launch files whose includes can be conditional without a condition of their own."""

Defects = Iterator[tuple[Source, tuple[int, int], str]]


def without_clock(model: Model) -> Defects:
    """Yield the nodes without ``use_sim_time`` in a file where another node, mostly of their package, has it."""
    files = parameter_files(model)
    by_file: dict[str, list[LaunchedNode]] = {}
    for node in launched_nodes(model):
        by_file.setdefault(node.source.file, []).append(node)
    for nodes in by_file.values():
        source = nodes[0].source
        if _KEY not in source.text or any(word in source.text for word in _FOR_ALL) or reads_ros1(source):
            continue
        setting = [node for node in nodes if node.inline is not None and _KEY in node.inline]
        for node in nodes:
            is_unset = all(file in files and _KEY not in files[file].text for file in node.files)
            if node.inline is None or _KEY in node.inline or not is_unset or not _is_timed(node):
                continue
            other = next((each for each in setting if _family(each) == _family(node)), None)
            if other is None and _needs_clock(node):
                other = next((each for each in setting if _family(each) in (*_WITNESSES, "nav2")), None)
            label = node.name.name if node.name is not None else node.program
            is_python = node.source.file.endswith(".py")
            at = (None if is_python else _name_place(node)) or node.place
            if other is not None and at is not None:
                same = "the other " if node.program == other.program else ""
                yield source, at, f"node `{label}` has no `{_KEY}`, but {same}`{other.program}` has it"
            elif at is not None and _needs_clock(node) and _starts_gazebo(source, model):
                yield source, at, f"node `{label}` has no `{_KEY}`, but this file starts Gazebo"


def _needs_clock(node: LaunchedNode) -> bool:
    return not node.is_conditional and _family(node) in (*_STOPPED, "nav2")


def computer_time(model: Model) -> Defects:
    """Yield each constant ``use_sim_time`` that is false in a launch file that always starts Gazebo."""
    for source, tree in python_files(model):
        if _KEY in source.text and _starts_gazebo(source, model):
            yield from _in_python(source, tree)
    yield from _in_parameter_files(model)
    for name, source in model.related_files.items():
        is_launch = name.endswith((".launch.xml", ".launch.yaml", ".launch")) and _KEY in source.text
        if is_launch and _starts_gazebo(source, model):
            for element in all_elements(source):
                key, default = (element.attributes.get(each) for each in ("name", "default"))
                is_key = element.tag == "arg" and key is not None and key.name == _KEY
                if is_key and default is not None and default.name.lower() == "false" and not reads_ros1(source):
                    yield source, (default.start, default.end), _message()
                value = element.attributes.get("value")
                is_global = element.tag == "param" and key is not None and key.name.strip("/") == _KEY
                if is_global and value is not None and value.name.lower() == "false":
                    yield source, (value.start, value.end), _message()
                conditions = [element.attributes[key].name for key in ("if", "unless") if key in element.attributes]
                if element.tag == "include" and not any(re.search(_OF_CLOCK, each) for each in conditions):
                    for child in element.children:
                        key, value = (child.attributes.get(each) for each in ("name", "value"))
                        is_key = child.tag in ("arg", "let") and key is not None and key.name == _KEY
                        if is_key and value is not None and value.name.lower() == "false":
                            yield source, (value.start, value.end), _message()


def time_without_simulation(model: Model) -> Defects:
    """Yield each ``use_sim_time`` that a Python file passes as true to an include, next to a publisher by hand.

    joint_state_publisher_gui and Gazebo do not run together, and no other file includes this one.
    """
    for source, tree in python_files(model):
        if "joint_state_publisher_gui" not in source.text or _KEY not in source.text:
            continue
        name = source.file.rpartition("/")[2]
        others = [each.text for each in model.related_files.values() if each is not source]
        is_alone = not re.search(_CLOCKS, source.text) and not any(name in text for text in others)
        reader = launch_reader(tree)
        for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call)) if is_alone else ():
            words = {word.arg: word.value for word in call.keywords}
            passed = words.get("launch_arguments") if name_of(call.func) == "IncludeLaunchDescription" else None
            for inner in ast.walk(passed) if passed is not None else ():
                pairs = zip(inner.keys, inner.values, strict=True) if isinstance(inner, ast.Dict) else ()
                for key, value in pairs:
                    is_key = key is not None and reader.text(key) == _KEY
                    if is_key and isinstance(value, ast.Constant) and str(value.value).lower() == "true":
                        message = f"`{_KEY}` is true, but this file starts no simulation, so the time stays at zero"
                        yield source, place(source, value), message


def included_without_clock(model: Model) -> Defects:
    """Yield the includes of files in which `use_sim_time` is false by default, if Gazebo and others get it.

    An argument that an earlier include passes holds for those after it, too (launch, include_launch_description.py).
    """
    for actions in launch_files(model):
        source = actions.source
        passing = [call for call in actions.includes if any(name.name == _KEY for name in call.passed)]
        if not passing or _KEY in actions.declared or any(word in source.text for word in _FOR_ALL):
            continue
        if reads_ros1(source) or not _starts_gazebo(source, model):
            continue
        for call in actions.includes:
            path = None if call.passes_all or call.is_conditional else receiver(call, model)
            if call.start >= min(each.start for each in passing) or path is None:
                continue
            included = actions_at(path, model)
            if included is not None and _is_off(included) and not _starts_gazebo(included.source, model):
                message = f"{path.name} is included without `{_KEY}`, which is false there, but this file starts Gazebo"
                yield source, (call.start, call.end), message


def _is_off(actions: LaunchActions) -> bool:
    default = actions.defaults.get(_KEY)
    if default is None:
        found = re.search(rf"[\"']{_KEY}[\"'],\s*default_value\s*=\s*[\"'](\w+)[\"']", actions.source.text)
        default = found[1] if found is not None else ""
    return _KEY in actions.declared and default.lower() == "false"


_CLOCKS = r"gazebo|gz_|ign_|_gz|webots|isaac|clock|rosbag|bag|simul(?!ated)"
"""Matches a launch file that may start a publisher of the simulated time."""


def _in_parameter_files(model: Model) -> Defects:
    """Yield each ``use_sim_time`` that is false in YAML, if the other nodes of the file use the simulated time.

    Also yields those of a node that is started together with Gazebo and has no other setting.
    """
    files, seen = parameter_files(model), set[tuple[str, int]]()
    for source in files.values():
        found = [value for _, group in sections(source) if (value := group.find(_KEY)) is not None]
        off = [value for value in found if value.text.lower() == "false"]
        if off and 3 * len(off) <= len(found):
            for value in off:
                seen.add((source.file, value.line))
                yield source, _value_place(source, value), f"`{_KEY}` is false here and true for the other nodes"
    for node in launched_nodes(model):
        if node.inline is None or _KEY in node.inline or not _is_timed(node) or not _starts_gazebo(node.source, model):
            continue
        for source in (files[file] for file in node.files if file in files):
            for key, group in sections(source):
                value, name = group.find(_KEY), key.last_name
                is_own = name == (name_of_node(node) or node.program)
                if (
                    value is not None
                    and value.text.lower() == "false"
                    and is_own
                    and (source.file, value.line) not in seen
                ):
                    seen.add((source.file, value.line))
                    message = f"`{_KEY}` is false, but {_short(node.source)} starts this node and Gazebo"
                    yield source, _value_place(source, value), message


def _value_place(source: Source, value: Node) -> tuple[int, int]:
    start = start_of(source, value)
    return start, start + len(value.text)


def _short(source: Source) -> str:
    return source.file.rpartition("/")[2]


def _in_python(source: Source, tree: ast.Module) -> Defects:
    reader = launch_reader(tree)
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        words = {word.arg: word.value for word in call.keywords}
        default = words.get("default_value")
        is_declared = name_of(call.func) == "DeclareLaunchArgument" and call.args and reader.text(call.args[0]) == _KEY
        if is_declared and default is not None and (reader.text(default) or "").lower() == "false":
            yield source, place(source, default), _message()
        package = reader.text(words["package"]) if "package" in words else None
        is_timed = name_of(call.func) == "Node" and (package in _TIMED or (package or "").startswith("nav2_"))
        condition = words.get("condition")
        names = [each.id for each in ast.walk(condition) if isinstance(each, ast.Name)] if condition is not None else []
        conditions = [value for value in (condition, *map(reader.assigned.get, names)) if value is not None]
        if any(re.search(_OF_CLOCK, unparsed(value)) for value in conditions):
            continue
        if not (is_timed or name_of(call.func) == "IncludeLaunchDescription"):
            continue
        for part in (words.get("launch_arguments"), words.get("parameters")):
            named = [reader.assigned.get(each.id) for each in getattr(part, "elts", ()) if isinstance(each, ast.Name)]
            parts = [part, *(each for each in named if isinstance(each, ast.Dict))]
            for inner in (each for one in parts if one is not None for each in ast.walk(one)):
                keys = inner.keys if isinstance(inner, ast.Dict) else []
                values = inner.values if isinstance(inner, ast.Dict) else []
                if isinstance(inner, ast.Tuple) and len(inner.elts) == 2:
                    keys, values = list(inner.elts[:1]), inner.elts[1:]
                for key, value in zip(keys, values, strict=True):
                    is_key = key is not None and reader.text(key) == _KEY
                    if is_key and isinstance(value, ast.Constant) and str(value.value).lower() == "false":
                        yield source, place(source, value), _message()


def _message() -> str:
    return f"`{_KEY}` is false, but this file starts Gazebo, which publishes simulation time"


def _starts_gazebo(source: Source, model: Model, depth: int = 0) -> bool:
    """Return whether a launch file always starts Gazebo, itself or by its includes."""
    values = {(each.argument, each.value) for each in conditional_actions(source) if _is_gazebo(each)}
    if any((name, not value) in values for name, value in values):
        return True  # under two conditions, one of which always holds
    if re.search(_SCOPES, source.text):
        return False
    for call in actions_of(source).includes:
        if call.is_conditional:
            continue
        path = receiver(call, model) if depth < 3 and call.package not in GAZEBO else None
        included = actions_at(path, model) if path is not None else None
        if call.package in GAZEBO or (included is not None and _starts_gazebo(included.source, model, depth + 1)):
            return True
    return False


def _is_gazebo(action: ConditionalAction) -> bool:
    return any(package in GAZEBO and "/" in path for package, path in action.subjects)


def _is_timed(node: LaunchedNode) -> bool:
    is_navigation = node.package.startswith("nav2_") and node.program in NODES and node.program not in _IDLE
    return bool(node.program) and (node.package in (*_TIMED, *_STOPPED) or is_navigation)


def _family(node: LaunchedNode) -> str:
    return "nav2" if node.package.startswith("nav2_") else node.package


def _name_place(node: LaunchedNode) -> tuple[int, int] | None:
    return (node.name.start, node.name.end) if node.name is not None else None
