"""Variables of Python launch files that hold the value of a declared argument which nothing uses."""

from __future__ import annotations

import ast
import sys
from collections import Counter
from collections.abc import Iterator, Sequence

from urdfkit.description.launch.python_constants import assignments
from urdfkit.lint.facts.launch.python.names import class_called, launch_classes

_READERS = frozenset(("IncludeLaunchDescription", "OpaqueFunction", "GroupAction", "ParameterFile"))
"""Actions that can read an argument without naming it."""

_CLOCK = "use_sim_time"

_WITHOUT_ACTIONS = sys.stdlib_module_names | {
    "launch",
    "launch_ros",
    "nav2_common",
    "ament_index_python",
    "xacro",
    "yaml",
}
"""Modules whose functions return no actions that read an argument without naming it."""


def unused_arguments(tree: ast.Module) -> Iterator[tuple[str, ast.expr]]:
    """Yield each declared argument whose value is assigned but not used, with the place of the defect.

    Included files read the arguments of the file that includes them, and so may functions of other modules: nothing is
    yielded for files with either. The place of an unused ``use_sim_time`` is the list of parameters of the only node
    that has one.
    """
    classes = launch_classes(tree)
    calls = [(node, class_called(node, classes)) for node in ast.walk(tree) if isinstance(node, ast.Call)]
    if any(name in _READERS for _, name in calls) or _calls_others(tree, calls):
        return
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}
    texts = Counter(node.value for node in ast.walk(tree) if isinstance(node, ast.Constant))
    declared = {_first_text(call) for call, name in calls if name == "DeclareLaunchArgument"}
    for node in ast.walk(tree):
        if not isinstance(node, ast.Assign) or len(node.targets) != 1:
            continue
        for name, value in assignments(node.targets[0], node.value):
            argument = _first_text(value) if class_called(value, classes) == "LaunchConfiguration" else None
            is_used = name.id in names or texts[argument] > 2  # declared and assigned
            if argument in declared and argument is not None and not is_used:
                parameters = _parameters(calls) if argument == _CLOCK else []
                yield argument, parameters[0] if len(parameters) == 1 else name


def _calls_others(tree: ast.Module, calls: Sequence[tuple[ast.Call, str | None]]) -> bool:
    """Return whether a function of an imported module is called that may return actions."""
    others = set[str]()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] not in _WITHOUT_ACTIONS:
            others.update(alias.asname or alias.name for alias in node.names)
        elif isinstance(node, ast.Import):
            names = (alias for alias in node.names if alias.name.partition(".")[0] not in _WITHOUT_ACTIONS)
            others.update(alias.asname or alias.name.partition(".")[0] for alias in names)
    return any(isinstance(part, ast.Name) and part.id in others for call, _ in calls for part in ast.walk(call.func))


def _first_text(call: ast.expr) -> str | None:
    first = call.args[0] if isinstance(call, ast.Call) and call.args else None
    return first.value if isinstance(first, ast.Constant) and isinstance(first.value, str) else None


def _parameters(calls: Sequence[tuple[ast.Call, str | None]]) -> list[ast.expr]:
    """Return the parameters of the nodes."""
    nodes = [call for call, name in calls if name in ("Node", "LifecycleNode", "ComposableNode")]
    return [word.value for call in nodes for word in call.keywords if word.arg == "parameters"]
