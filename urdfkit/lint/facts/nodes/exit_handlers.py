"""Event handlers of Python launch files that wait for the end of a node that does not end."""

import ast
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place

_RUNNING = {
    ("controller_manager", "ros2_control_node"),
    ("joint_state_publisher", "joint_state_publisher"),
    ("robot_localization", "ekf_node"),
    ("robot_state_publisher", "robot_state_publisher"),
    ("ros_gz_bridge", "parameter_bridge"),
    ("twist_mux", "twist_mux"),
}
"""Package and executable of nodes that run until the launch ends."""

_STARTING = ("ExecuteProcess", "GroupAction", "IncludeLaunchDescription", "LifecycleNode", "Node", "TimerAction")


def never_run(source: Source, tree: ast.Module) -> Iterator[tuple[tuple[int, int], str]]:
    """Yield the place of the target of each ``OnProcessExit`` that starts actions and never runs, and its program."""
    reader = launch_reader(tree)
    functions = {node.name: node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        words = {word.arg: word.value for word in call.keywords}
        target, actions = words.get("target_action"), words.get("on_exit")
        if name_of(call.func) != "OnProcessExit" or target is None or actions is None:
            continue
        node = _value(target, reader)
        parts = {word.arg: reader.text(word.value) for word in node.keywords} if isinstance(node, ast.Call) else {}
        program = parts.get("executable") or ""
        listed = _value(actions, reader)
        items = listed.elts if isinstance(listed, (ast.List, ast.Tuple)) else [listed]
        if (parts.get("package"), program) in _RUNNING and all(_starts(each, reader, functions) for each in items):
            yield place(source, target), program


def _value(node: ast.expr, reader: LaunchReader) -> ast.expr:
    return (reader.assigned.get(node.id) or node) if isinstance(node, ast.Name) else node


def _starts(node: ast.expr, reader: LaunchReader, functions: dict[str, ast.FunctionDef]) -> bool:
    """Return whether an action starts a process: it is not a message, an event or the shutdown."""
    value = _value(node, reader)
    called = name_of(value.func) if isinstance(value, ast.Call) else ""
    if called in functions:
        inner = (name_of(each.func) for each in ast.walk(functions[called]) if isinstance(each, ast.Call))
        return any(name in _STARTING for name in inner)
    return called in _STARTING
