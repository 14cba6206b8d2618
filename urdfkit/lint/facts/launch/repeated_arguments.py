"""Arguments that a launch file declares more than once."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import launch_reader
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.named_nodes import calls_in
from urdfkit.lint.facts.launch.python_names import python_files
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record


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
