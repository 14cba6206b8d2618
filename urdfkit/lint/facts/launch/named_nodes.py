"""Nodes of one name in a launch file in Python."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import launch_reader, name_of
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.launch_package_paths import place

_NODES = ("Node", "LifecycleNode", "ComposableNodeContainer")
_MOVING = ("PushRosNamespace", "PushROSNamespace", "RegisterEventHandler")
"""Actions after which nodes are in another namespace, or do not run at the same time."""
_CONDITIONAL = (
    *(ast.If, ast.IfExp, ast.For, ast.While, ast.Try, ast.ListComp, ast.GeneratorExp, ast.Lambda),
    *(ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef),
)
"""Parts of the syntax tree that run for some launches only, several times, or elsewhere."""


def duplicates(source: Source, tree: ast.Module) -> Iterator[tuple[str, Span, int]]:
    """Yield the name, its place and the line of the other node for each node whose name an earlier node has."""
    if any(word in source.text for word in _MOVING):
        return
    reader = launch_reader(tree)
    for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
        first: dict[tuple[str, str], ast.Call] = {}
        calls = (call for statement in function.body for call in calls_in(statement, _NODES))
        for call in sorted(calls, key=lambda each: (each.lineno, each.col_offset)):
            words = {word.arg: word.value for word in call.keywords if word.arg is not None}
            name, space = (reader.text(words[key]) if key in words else "" for key in ("name", "namespace"))
            if not name or space is None or len(words) < len(call.keywords):
                continue
            other = first.setdefault((space, name), call)
            if other is not call and not all(_has_condition(each) for each in (other, call)):
                start, end = place(source, words["name"])
                yield name, source.span(start, end), other.lineno


def _has_condition(call: ast.Call) -> bool:
    return any(word.arg == "condition" for word in call.keywords)


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
