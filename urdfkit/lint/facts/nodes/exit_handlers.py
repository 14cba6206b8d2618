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


def never_started(tree: ast.Module) -> Iterator[tuple[ast.expr, str, str]]:
    """Yield the target of the first event handler of a circle, with its name and that of the action that starts it.

    The actions of a circle are started by its handlers only.
    """
    starts: list[tuple[ast.Name, list[ast.Name]]] = []
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        words = {word.arg: word.value for word in call.keywords}
        actions, target = words.get("on_exit") or words.get("on_start"), words.get("target_action")
        if name_of(call.func) in ("OnProcessExit", "OnProcessStart") and isinstance(target, ast.Name) and actions:
            starts.append((target, [each for each in ast.walk(actions) if isinstance(each, ast.Name)]))
    inner = {each for target, names in starts for each in (target, *names)}
    loaded = (node for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load))
    begun = {node.id for node in loaded if node not in inner}
    for _ in starts:
        begun |= {each.id for target, names in starts if target.id in begun for each in names}
    for target, _ in starts:
        before = next((other for other, names in starts if target.id in [each.id for each in names]), None)
        if target.id not in begun and before is not None and before is not target:
            yield target, target.id, before.id
            return


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
