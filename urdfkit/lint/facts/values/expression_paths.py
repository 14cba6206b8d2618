"""Names, keys and items in the syntax trees of expressions."""

from __future__ import annotations

import ast

Keys = tuple[str | int, ...]
"""Keys and indices, outermost first."""


def path_of(expression: str) -> tuple[str, Keys] | None:
    """Return the name and the keys of the text of an expression; see `path`."""
    return path(ast.parse(expression.strip(), mode="eval").body)


def path(node: ast.expr) -> tuple[str, Keys] | None:
    """Return the name and the keys of ``name['key'][0].key``; None for other expressions."""
    keys: list[str | int] = []
    while not isinstance(node, ast.Name):
        if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant):
            key = node.slice.value
            keys.append(key if isinstance(key, int) else str(key))
        elif isinstance(node, ast.Attribute):
            keys.append(node.attr)
        else:
            return None
        node = node.value
    return node.id, tuple(reversed(keys))


def called(node: ast.Call) -> str:
    """Return the name of a called function, without its module."""
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def item(node: ast.expr, key: str | int) -> ast.expr | None:
    """Return an item of a list, dictionary or call of ``dict``."""
    if isinstance(node, (ast.List, ast.Tuple)) and isinstance(key, int) and -len(node.elts) <= key < len(node.elts):
        return node.elts[key]
    if isinstance(node, ast.Dict):
        pairs = zip(node.keys, node.values, strict=True)
        return next((value for at, value in pairs if isinstance(at, ast.Constant) and at.value == key), None)
    if isinstance(node, ast.Call) and called(node) == "dict":
        return next((each.value for each in node.keywords if each.arg == key), None)
    return None
