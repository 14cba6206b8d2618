"""Names in Python launch files: imported classes, and names that are defined nowhere."""

import ast
import builtins
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.launch.python_constants import LaunchReader, name_of, parsed
from urdfkit.description.xml.source import Source
from urdfkit.lint.model.model import Model

_OF_MODULES = frozenset(("__file__", "__name__", "__doc__", "__package__", "__spec__", "__loader__", "__class__"))
_ROOTS = frozenset(("launch", "launch_ros", "nav2_common"))


def python_files(model: Model) -> Iterator[tuple[Source, ast.Module]]:
    """Yield the Python launch files of the robot's package and of related packages, and their syntax trees."""
    for name, source in model.related_files.items():
        if name.endswith((".launch.py", "_launch.py")) and (tree := _tree(source)) is not None:
            yield source, tree


@lru_cache(maxsize=100)
def _tree(source: Source) -> ast.Module | None:
    return parsed(source)


def defined(tree: ast.Module) -> set[str] | None:
    """Return the names that any scope of a file binds; None if it imports all names of a module."""
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.alias):
            if node.name == "*":
                return None
            names.add(node.asname or node.name.partition(".")[0])
        elif isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            names.add(node.id)
        elif isinstance(node, ast.arg):
            names.add(node.arg)
        elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, (ast.ExceptHandler, ast.MatchAs, ast.MatchStar)):
            names.add(node.name or "")
        elif isinstance(node, ast.MatchMapping):
            names.add(node.rest or "")
        elif isinstance(node, ast.Global):
            names.update(node.names)
    return names


def undefined(tree: ast.Module) -> dict[str, ast.Name]:
    """Return the names that a file uses and that neither it nor Python defines, with their first use."""
    names = defined(tree)
    if names is None:
        return {}
    used: dict[str, ast.Name] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            first = used.setdefault(node.id, node)
            if (node.lineno, node.col_offset) < (first.lineno, first.col_offset):
                used[node.id] = node
    bound = names | _OF_MODULES
    return {name: node for name, node in used.items() if name not in bound and not hasattr(builtins, name)}


def launch_classes(tree: ast.Module) -> dict[str, str]:
    """Return the local name of each class that a file imports from the launch packages, and its name there."""
    return {
        word.asname or word.name: word.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] in _ROOTS and not node.level
        for word in node.names
    }


def class_called(node: ast.expr, classes: dict[str, str]) -> str:
    """Return the class of the launch packages that an expression calls; empty for other expressions.

    Args:
        node: the expression.
        classes: the classes that the file imports, see `launch_classes`.
    """
    if not isinstance(node, ast.Call):
        return ""
    if isinstance(node.func, ast.Name):
        return classes.get(node.func.id, "")
    root: ast.expr = node.func
    while isinstance(root, ast.Attribute):
        root = root.value
    is_module = isinstance(root, ast.Name) and root.id in (*_ROOTS, "actions", "substitutions")
    return node.func.attr if is_module and isinstance(node.func, ast.Attribute) else ""


def value_of(node: ast.expr, reader: LaunchReader) -> ast.expr:
    """Return the value of a variable that is assigned once; other expressions as they are."""
    return (reader.assigned.get(node.id) or node) if isinstance(node, ast.Name) else node


def called(node: ast.expr, reader: LaunchReader) -> str:
    """Return the last part of the name that an expression, or the value of a variable, calls; empty for others."""
    value = value_of(node, reader)
    return name_of(value.func) if isinstance(value, ast.Call) else ""


def own_nodes(function: ast.FunctionDef) -> Iterator[ast.AST]:
    """Yield the nodes of a function's body without those of functions inside it."""
    pending: list[ast.AST] = list(function.body)
    while pending:
        node = pending.pop()
        yield node
        if not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)):
            pending.extend(ast.iter_child_nodes(node))
