"""Arguments that a launch file declares more than once, and nodes of one name in a Python launch file."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import launch_reader, name_of, unparsed
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.python.names import python_files
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record

_NODES = ("Node", "LifecycleNode", "ComposableNodeContainer")
_MOVING = ("PushRosNamespace", "PushROSNamespace", "RegisterEventHandler")
"""Actions after which nodes are in another namespace, or do not run at the same time."""
_SERVERS = (("gazebo_ros", "/launch/gazebo.launch.py"), ("ros_gz_sim", "/launch/gz_sim.launch.py"))
"""Package and path of launch files that start Gazebo."""

_CONDITIONAL = (
    *(ast.If, ast.IfExp, ast.For, ast.While, ast.Try, ast.ListComp, ast.GeneratorExp, ast.Lambda),
    *(ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef),
)
"""Parts of the syntax tree that run for some launches only, several times, or elsewhere."""


@record(eq=False)
class RepeatedArgument:
    """A declaration after the first one: name of the argument, its place, line of the first one, whether of ROS 1."""

    name: str
    span: Span
    first: int
    is_ros1: bool


def repeated_arguments(model: Model) -> Iterator[RepeatedArgument]:
    """Yield the repeated declarations in launch files, without those under a condition.

    In ROS 2, only those with another default: the first one applies.
    """
    for source, tree in python_files(model):
        yield from _in_python(source, tree)
    for name, source in model.related_files.items():
        if name.endswith((".launch", ".launch.xml", "_launch.xml")):
            for root in Document(source).roots:
                for parent in root.walk():
                    yield from _in_xml(source, parent)


def _in_xml(source: Source, parent: Tag) -> Iterator[RepeatedArgument]:
    if parent.name not in ("launch", "group"):
        return
    first: dict[str, Tag] = {}
    is_ros1 = reads_ros1(source)
    for tag in parent.children:
        name = tag.attributes.get("name")
        if tag.name != "arg" or name is None or {"if", "unless"} & tag.attributes.keys():
            continue
        other = first.setdefault(name.value, tag)
        defaults = [each.attributes["default"].value if "default" in each.attributes else None for each in (tag, other)]
        if other is not tag and (is_ros1 or defaults[0] != defaults[1]):
            span = source.span(name.value_start, name.value_end)
            yield RepeatedArgument(name.value, span, source.position(other.start).line, is_ros1)


def _in_python(source: Source, tree: ast.Module) -> Iterator[RepeatedArgument]:
    reader = launch_reader(tree)
    for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
        first: dict[str, ast.Call] = {}
        calls = (call for statement in function.body for call in calls_in(statement, ("DeclareLaunchArgument",)))
        for call in sorted(calls, key=lambda each: (each.lineno, each.col_offset)):
            words = {word.arg: word.value for word in call.keywords}
            written = call.args[0] if call.args else words.get("name")
            name = reader.text(written) if written is not None else None
            if name is None or written is None or "condition" in words:
                continue
            other = first.setdefault(name, call)
            if other is not call and _default(call) != _default(other):
                yield RepeatedArgument(name, source.span(*place(source, written)), other.lineno, False)


def _default(call: ast.Call) -> str:
    found = next((word.value for word in call.keywords if word.arg == "default_value"), None)
    return ast.dump(found) if found is not None else ""


def repeated_nodes(source: Source, tree: ast.Module) -> Iterator[tuple[str, Span, int]]:
    """Yield the name, its place and the line of the other node for each node whose name an earlier node has."""
    if any(word in source.text for word in _MOVING):
        return
    reader = launch_reader(tree)
    for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
        earlier: dict[tuple[str, str], list[ast.Call]] = {}
        calls = (call for statement in function.body for call in calls_in(statement, _NODES))
        for call in sorted(calls, key=lambda each: (_name_of(each).lineno, _name_of(each).col_offset)):
            words = {word.arg: word.value for word in call.keywords if word.arg is not None}
            name, space = (reader.text(words[key]) if key in words else "" for key in ("name", "namespace"))
            if not name or space is None or len(words) < len(call.keywords):
                continue
            others = earlier.setdefault((space, name), [])
            other = next((each for each in others if _condition(each) in ("", _condition(call))), None)
            other = others[0] if other is None and others and not _condition(call) else other
            if other is not None:
                yield name, source.span(*place(source, _name_of(call))), _name_of(other).lineno
            others.append(call)


def repeated_simulators(source: Source, tree: ast.Module) -> Iterator[tuple[Span, str]]:
    """Yield the second of two servers of Gazebo that a launch file starts under the same condition."""
    reader = launch_reader(tree)
    servers: dict[str, ast.expr] = {}
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    for call in (each for each in calls if name_of(each.func) == "IncludeLaunchDescription"):
        words = {word.arg: word.value for word in call.keywords}
        condition = words.get("condition")
        paths = [found for node in ast.walk(call) if isinstance(node, ast.expr) and (found := reader.path(node))]
        arguments = unparsed(words["launch_arguments"]) if "launch_arguments" in words else ""
        is_client = re.search(r"['\" ]-g\b", arguments) is not None
        if is_client or not isinstance(condition, ast.Call) or not any(path in _SERVERS for path in paths):
            continue
        key = f"{name_of(condition.func)} {[unparsed(each) for each in condition.args]}"
        first = servers.setdefault(key, condition)
        if first is not condition:
            place_of_condition = source.span(*place(source, condition))
            yield place_of_condition, f"line {first.lineno} also starts Gazebo under this condition"


def _condition(call: ast.Call) -> str:
    return next((unparsed(word.value) for word in call.keywords if word.arg == "condition"), "")


def _name_of(call: ast.Call) -> ast.expr:
    """Return the name of a node, or the argument of the call of a function that sets it."""
    name = next((word.value for word in call.keywords if word.arg == "name"), call)
    called = getattr(call, "called_at", None)
    if called is None:
        return name
    parts = [each for each in ast.walk(name) if isinstance(each, ast.Constant)]
    passed = [each for each in parts if called.lineno <= each.lineno <= (called.end_lineno or called.lineno)]
    return passed[-1] if passed else called


def calls_in(statement: ast.AST, names: tuple[str, ...]) -> Iterator[ast.Call]:
    """Yield the calls of some classes that a statement makes whenever it runs."""
    pending = [statement]
    for part in pending:  # The list grows during the iteration.
        called = name_of(part.func) if isinstance(part, ast.Call) else ""
        if isinstance(part, _CONDITIONAL) or called == "GroupAction":
            continue
        if isinstance(part, ast.Call) and called in names:
            yield part
        pending += ast.iter_child_nodes(part)
