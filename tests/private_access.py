"""Private attributes used outside the package that defines them."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path


def private_accesses(root: Path) -> list[tuple[str, str]]:
    """Return file and attribute of each `x._name`, x not being self or cls, that the file's package does not define."""
    trees = {path: ast.parse(path.read_text("utf-8")) for path in sorted(root.rglob("*.py"))}
    defined: dict[Path, set[str]] = {}
    for path, tree in trees.items():
        defined.setdefault(path.parent, set()).update(_definitions(tree))
    return [
        (str(path.relative_to(root)), name)
        for path, tree in trees.items()
        for name in _uses(tree)
        if name not in defined[path.parent]
    ]


def _is_own(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id in ("self", "cls")


def _is_private(name: str) -> bool:
    return name.startswith("_") and not name.endswith("__") and name != "_"


def _definitions(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and _is_own(node.value):
            yield node.attr
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def _uses(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and _is_private(node.attr) and not _is_own(node.value):
            yield node.attr
        elif isinstance(node, ast.ImportFrom):
            yield from (alias.name for alias in node.names if _is_private(alias.name))
