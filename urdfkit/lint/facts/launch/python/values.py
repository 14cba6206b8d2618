"""Values of the wrong kind in Python launch files: handlers, conditions, remappings, parameters and actions.

Sources: ros2/launch (event_handlers/on_action_event_base.py, event_handlers/on_process_exit.py,
conditions/evaluate_condition_expression_impl.py, actions/timer_action.py, actions/declare_launch_argument.py,
launch_description.py, substitutions/command.py, launch_configuration.py and path_join_substitution.py), ros2/launch_ros
(actions/node.py, utilities/normalize_parameters.py, utilities/normalize_remap_rule.py, parameter_descriptions.py),
Humble to Rolling.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control_commands import control_command
from urdfkit.lint.facts.launch.python.api import incomplete_call
from urdfkit.lint.facts.launch.python.lists import ACTIONS, wrong_lists
from urdfkit.lint.facts.launch.python.names import called, class_called, launch_classes, value_of
from urdfkit.lint.facts.launch.python.unevaluated import (
    mappings_of_xacro,
    unevaluated_in_assignment,
    unevaluated_in_call,
    unevaluated_in_text,
)
from urdfkit.lint.facts.launch.quoted_names import quoted_names
from urdfkit.lint.facts.lifecycle_transitions import unknown_constant, wrong_transition

Defects = Iterator[tuple[ast.expr, str]]

_HANDLERS = {"OnProcessExit": "on_exit", "OnProcessStart": "on_start", "OnExecutionComplete": "on_completion"}
_OF_PROCESSES = ("OnProcessExit", "OnProcessStart", "OnProcessIO")
"""Handlers that accept only processes as their target."""

_NO_PROCESSES = (
    *("DeclareLaunchArgument", "EmitEvent", "GroupAction", "IncludeLaunchDescription", "LaunchDescription", "LogInfo"),
    *("LoadComposableNodes", "OpaqueFunction", "PushRosNamespace", "RegisterEventHandler", "SetEnvironmentVariable"),
    *("SetLaunchConfiguration", "SetParameter", "SetRemap", "TimerAction"),
)
_TRUTH = ("true", "false", "1", "0")
_PATHS = ("join", "LaunchConfiguration", "ParameterFile", "PathJoinSubstitution", "PathSubstitution", "RewrittenYaml")
_VALUES = ("Command", "ParameterValue")
_NODES = ("Node", "LifecycleNode", "ComposableNodeContainer", "ComposableNode")
_ONLY_FIRST = {
    "Command": "`Command` accepts one argument; write its words in one list",
    "DeclareLaunchArgument": "write `default_value=` before this argument",
    "EnvironmentVariable": "write `default_value=` before this argument",
    "LaunchConfiguration": "write `default=` before this argument",
    "PathJoinSubstitution": "`PathJoinSubstitution` accepts one argument; write the parts in one list",
}
"""Class with one argument without a name → what to do with a second one."""


def wrong_values(source: Source, tree: ast.Module) -> Iterator[tuple[tuple[int, int], str]]:
    """Yield the place and message of each value of the wrong kind."""
    reader, classes = launch_reader(tree), launch_classes(tree)
    mappings = mappings_of_xacro(tree)
    created = {name for name, kind in classes.items() if kind in ACTIONS}
    flags = set(_flags(tree, reader))
    found: Iterable[tuple[ast.expr, str]]
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and (kind := class_called(node, classes)):
            found = (*_of_call(node, kind, reader), *_flags_as_files(node, kind, flags, reader))
        elif isinstance(node, (ast.Compare, ast.If, ast.IfExp)):
            found = _compared(node, reader)
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and called(node.func, reader) in created:
            found = [(node, f"`{node.func.id}` is an action, not a function; write it without parentheses")]
        elif isinstance(node, ast.Call) and name_of(node.func) == "bool" and len(node.args) == 1:
            found = _truth(node, node.args[0], reader)
        elif isinstance(node, ast.Call):
            found = unevaluated_in_call(node, reader)
            if name_of(node.func) == "join":
                found = (*found, *_absolute_parts(node.args, reader))
        elif isinstance(node, (ast.BinOp, ast.JoinedStr)):
            found = unevaluated_in_text(node, reader)
        elif isinstance(node, ast.Assign):
            found = unevaluated_in_assignment(node, mappings, reader)
        elif isinstance(node, ast.Attribute):
            found = unknown_constant(node)
        else:
            continue
        yield from ((place(source, at), message) for at, message in found)
    yield from ((place(source, at), message) for at, message in quoted_names(source))


def _flags(tree: ast.Module, reader: LaunchReader) -> Iterator[str]:
    """Yield the launch arguments whose default is true or false."""
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and name_of(call.func) == "DeclareLaunchArgument" and call.args:
            default = next((word.value for word in call.keywords if word.arg == "default_value"), None)
            if default is not None and (reader.text(default) or "").lower() in ("true", "false"):
                yield reader.text(call.args[0]) or ""


def _flags_as_files(call: ast.Call, kind: str, flags: set[str], reader: LaunchReader) -> Defects:
    """Yield the launch arguments that are true or false among the files of ``parameters``."""
    words = {word.arg: word.value for word in call.keywords}
    for item in reader.items(words.get("parameters")) if flags and kind in _NODES else ():
        value = value_of(item, reader)
        named = value.args[0] if isinstance(value, ast.Call) and value.args else None
        name = reader.text(named) if named is not None and called(item, reader) == "LaunchConfiguration" else None
        if name in flags:
            message = f"an item of `parameters` is the value of `{name}`, which is not a file; write {{'{name}': …}}"
            yield item, message


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _of_call(call: ast.Call, kind: str, reader: LaunchReader) -> Defects:
    words = {word.arg: word.value for word in call.keywords if word.arg is not None}
    if (incomplete := incomplete_call(kind, call)) is not None:
        yield incomplete
    elif kind in _ONLY_FIRST and len(call.args) > 1:
        yield call.args[1], _ONLY_FIRST[kind]
    elif kind == "PathJoinSubstitution":
        yield from _absolute_parts(reader.items(call.args[0]) if call.args else [], reader)
    elif kind == "ParameterValue" and "value_type" in words and _is_text(words["value_type"]):
        yield words["value_type"], "`value_type` is a string; write a type, such as `str`, without quotes"
    elif kind == "ParameterValue":
        yield from _of_command(call, words.get("value_type"), reader)
    yield from wrong_lists(call, kind, words, reader)
    if kind in _OF_PROCESSES and (target := words.get("target_action")) is not None:
        what = called(target, reader)
        if what in _NO_PROCESSES:
            yield target, f"`target_action` of `{kind}` is `{what}`, which is not a process; write a process or node"
    if kind in _HANDLERS:
        yield from _handler(words.get("target_action"), words.get(_HANDLERS[kind]), _HANDLERS[kind], reader)
    elif kind in ("IfCondition", "UnlessCondition") and len(call.args) == 1 and _is_text(call.args[0]):
        text = reader.text(call.args[0]) or ""
        if text.strip().lower() not in _TRUTH:
            yield call.args[0], f'`{text}` is neither true nor false; write `LaunchConfiguration("{text}")`'
    elif kind in _SOURCES and call.args:
        yield from _other_format(call, kind, reader)
    elif kind in _NODES:
        yield from _node(words, kind, reader)
    elif kind == "ExecuteProcess":
        yield from control_command(reader.items(words.get("cmd")), reader)
    elif kind == "OnStateTransition":
        yield from wrong_transition(words, reader)


def _absolute_parts(parts: list[ast.expr], reader: LaunchReader) -> Defects:
    """Yield the parts of a joined path that start with a slash: the path starts again there."""
    is_of_package = bool(parts) and reader.path(parts[0]) is not None
    for part in parts[1:] if is_of_package else ():
        text = reader.text(part) or ""
        if isinstance(part, ast.Constant) and text.startswith("/"):
            yield part, f"`{text}` starts with a slash, so the parts before it are dropped; write `{text.strip('/')}`"


def _of_command(call: ast.Call, kind: ast.expr | None, reader: LaunchReader) -> Defects:
    """Yield a ``ParameterValue`` that reads the output of a command as something else than a text."""
    value = call.args[0] if call.args else next((each.value for each in call.keywords if each.arg == "value"), None)
    kind = kind or (call.args[1] if len(call.args) > 1 else None)
    if value is None or called(value, reader) != "Command":
        return
    if kind is None:
        yield call, "without `value_type`, the launch reads the output of the command as YAML; add `value_type=str`"
    elif isinstance(kind, ast.Name) and kind.id in ("bool", "int", "float", "list", "dict"):
        yield kind, f"the output of the command is a string, not a value of type `{kind.id}`; write `str`"


def _handler(target: ast.expr | None, reactions: ast.expr | None, word: str, reader: LaunchReader) -> Defects:
    if target is not None and (_is_text(target) or isinstance(value_of(target, reader), (ast.List, ast.Tuple))):
        what = "string" if _is_text(target) else "list"
        yield target, f"`target_action` is a {what}; write one action"
    listed = [] if reactions is None else reader.items(reactions) or [reactions]
    for item in listed:
        if _is_text(item):
            yield item, f"`{word}` has a string; write the variable of an action without quotes"
        elif isinstance(item, ast.Name) and isinstance(target, ast.Name) and item.id == target.id:
            yield target, f"`{target.id}` waits for its own exit, so it never starts"


def _node(words: dict[str, ast.expr], kind: str, reader: LaunchReader) -> Defects:
    for name in ("parameters", "remappings", "arguments"):
        value = words.get(name)
        if value is not None and called(value, reader) in (*_PATHS, *_VALUES):
            yield value, f"`{name}` of `{kind}` is not a list; write it in brackets"
    for item in reader.items(words["parameters"]) if "parameters" in words else ():
        value = value_of(item, reader)
        if _is_text(value) and value is item and (name := reader.text(value) or "") in reader.assigned:
            yield value, f"an item of `parameters` is the string `{name}`; write the variable `{name}` without quotes"
        elif isinstance(value, ast.Set):
            yield value, "an item of `parameters` is a set; write a colon between name and value"
        elif called(item, reader) in _VALUES:
            yield item, "an item of `parameters` is a value without a name; write {name: value}"
        elif called(item, reader) == "to_moveit_configs":
            yield item, "an item of `parameters` is a MoveItConfigs; write `.to_dict()` after it"
        for key, each in zip(value.keys, value.values, strict=True) if isinstance(value, ast.Dict) else ():
            if (
                key is not None
                and reader.text(key) == "robot_description"
                and (path := _description_path(each, reader))
            ):
                message = f"`robot_description` is the path of `{path}`, not its text; run xacro with `Command`"
                yield each, message
            elif key is not None and reader.text(key) == "robot_description" and _is_document(each, reader):
                yield each, "`robot_description` is an XML document, not its text; write `.toxml()` after it"
    for item in reader.items(words["arguments"]) if "arguments" in words else ():
        number = item.operand if isinstance(item, ast.UnaryOp) else item
        if isinstance(number, ast.Constant) and isinstance(number.value, (int, float)):
            yield item, "an item of `arguments` is not a string; write it in quotes"
    remappings = words.get("remappings")
    for item in remappings.elts if isinstance(remappings, ast.List) else ():
        value = value_of(item, reader)
        if isinstance(value, ast.List) and len(value.elts) == 2 and all(_is_text(each) for each in value.elts):
            yield item, 'an item of `remappings` is a list; write a tuple, ("from", "to")'
        elif isinstance(value, ast.List):
            yield item, "an item of `remappings` is a list of pairs; add the lists, or write `*` before this one"
    pairs = reader.items(remappings) if remappings is not None else []
    if remappings is not None and (pairs and all(_is_text(each) for each in pairs)):
        yield remappings, 'an item of `remappings` is a string; write pairs, [("from", "to")]'


def _is_document(node: ast.expr, reader: LaunchReader) -> bool:
    """Return whether an expression is the result of ``xacro.process_file``."""
    value = value_of(node, reader)
    if isinstance(value, ast.Call) and name_of(value.func) == "ParameterValue" and value.args:
        value = value.args[0]
    return called(value, reader) == "process_file"


def _description_path(node: ast.expr, reader: LaunchReader) -> str:
    """Return the name of the file whose path an expression is; empty if it is no path of a description."""
    value = value_of(node, reader)
    if isinstance(value, ast.Call) and name_of(value.func) == "ParameterValue" and value.args:
        value = value.args[0]
    found = reader.path(value)
    name = found[1].rpartition("/")[2] if found is not None else ""
    return name if name.endswith((".urdf", ".xacro")) else ""


def _never_equal(node: ast.Compare, reader: LaunchReader) -> Defects:
    """Yield a comparison of the text of a launch argument with a truth value of Python, or of lower with upper case."""
    for one, other in ((node.left, node.comparators[0]), (node.comparators[0], node.left)):
        value = value_of(one, reader)
        is_lower = isinstance(value, ast.Call) and name_of(value.func) == "lower"
        if is_lower and (text := _constant(other)) is not None and text != text.lower():
            yield node, f"a lower-case string is never `{text}`; write `{text.lower()}`"
        elif _performed(one, reader) and isinstance(other, ast.Constant) and isinstance(other.value, bool):
            yield node, f'this compares a string with {other.value}; compare it with "{str(other.value).lower()}"'


def _performed(node: ast.expr, reader: LaunchReader) -> bool:
    """Return whether an expression is the text of a launch argument, ``LaunchConfiguration(...).perform(context)``."""
    value = value_of(node, reader)
    if not (isinstance(value, ast.Call) and isinstance(value.func, ast.Attribute) and value.func.attr == "perform"):
        return False
    return called(value.func.value, reader) == "LaunchConfiguration"


def _truth(node: ast.expr, value: ast.expr, reader: LaunchReader) -> Defects:
    """Yield an expression that takes the text of a launch argument as a truth value."""
    if _performed(value, reader):
        yield node, 'this string is always true, even if it is `false`; compare it, for example `.lower() == "true"`'
    elif called(value, reader) == "LaunchConfiguration":
        yield node, "a LaunchConfiguration is always true in Python; use `condition=IfCondition(...)`"


_SOURCES = {
    "PythonLaunchDescriptionSource": ((".xml", ".yaml", ".yml", ".launch"), "AnyLaunchDescriptionSource"),
    "XMLLaunchDescriptionSource": ((".py", ".yaml", ".yml"), "AnyLaunchDescriptionSource"),
    "YAMLLaunchDescriptionSource": ((".py", ".xml", ".launch"), "AnyLaunchDescriptionSource"),
}
"""Class that loads a launch file of one format → endings of other formats, and the class that loads each."""


def _other_format(call: ast.Call, kind: str, reader: LaunchReader) -> Defects:
    """Yield the path of a launch file in another format than its class loads."""
    endings, right = _SOURCES[kind]
    constants = [node for node in ast.walk(value_of(call.args[0], reader)) if isinstance(node, ast.Constant)]
    last = max(constants, key=lambda node: (node.lineno, node.col_offset), default=None)
    text = _constant(last) if last is not None else None
    if text is not None and text.endswith(endings):
        name = text.rpartition("/")[2]
        yield call.func, f"`{kind}` cannot load `{name}`, which has another format; use `{right}`"


def _constant(node: ast.AST) -> str | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


def _compared(node: ast.Compare | ast.If | ast.IfExp, reader: LaunchReader) -> Defects:
    """Yield the uses of a ``LaunchConfiguration`` as a value of Python, which are always true or always false."""
    if isinstance(node, ast.Compare):
        parts = [node.left, *node.comparators]
        if all(isinstance(each, (ast.Eq, ast.NotEq, ast.In)) for each in node.ops):
            use = next((each for each in parts if called(each, reader) == "LaunchConfiguration"), None)
            if use is not None:
                message = "this compares the object, not its value; use `EqualsSubstitution` in a condition"
                yield node, message
            yield from _never_equal(node, reader)
    elif called(node.test, reader) == "LaunchConfiguration":
        yield node.test, "a LaunchConfiguration is always true in Python; use `condition=IfCondition(...)`"
