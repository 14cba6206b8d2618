"""Constants of Python launch files, from their syntax tree; the files are not executed."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.xml.source import Source

SHARE = frozenset(("get_package_share_directory", "get_package_share_path", "FindPackageShare"))
"""Functions and substitutions that return the share folder of a package."""

JOINS = frozenset(("join", "PathJoinSubstitution"))
"""Functions and substitutions that join the parts of a path."""


def parsed(source: Source) -> ast.Module | None:
    """Return the syntax tree of a Python launch file, with calls of its functions written out; None without one.

    All callers share it. `inlined` of `python_inlining` is the tree's form; a file that is not Python has no tree.
    """
    return _tree(source.text)


@lru_cache(maxsize=200)
def _tree(text: str) -> ast.Module | None:
    import warnings

    from urdfkit.description.launch.python_inlining import inlined

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            tree = ast.parse(text)
            try:
                return inlined(tree)
            except RecursionError:  # an expression of thousands of terms
                return ast.parse(text)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return None


@lru_cache(maxsize=200)
def launch_reader(tree: ast.Module) -> LaunchReader:
    """Return the reader of a syntax tree, which all callers share."""
    return LaunchReader(tree)


class LaunchReader:
    """Evaluate constants, and names that are assigned exactly once.

    Args:
        tree: syntax tree of the launch file.

    Attributes:
        assigned: name → value of the variables that are assigned exactly once.
    """

    def __init__(self, tree: ast.Module) -> None:
        from collections import Counter

        values: dict[str, list[ast.expr | None]] = {}
        for node in ast.walk(tree):
            if isinstance(node, ast.Assign) and len(node.targets) == 1:
                for name, value in assignments(node.targets[0], node.value):
                    values.setdefault(name.id, []).append(value)
        stored = Counter(n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store))
        arguments = {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
        self.assigned = {
            name: each[0]
            for name, each in values.items()
            if len(each) == 1 and stored[name] == 1 and name not in arguments
        }

    def text(self, node: ast.expr, depth: int = 0) -> str | None:
        """Return the text of a constant expression; None for other expressions."""
        if isinstance(node, ast.Constant):
            return node.value if isinstance(node.value, str) else None
        if isinstance(node, ast.Name) and depth < 8 and (value := self.assigned.get(node.id)) is not None:
            return self.text(value, depth + 1)
        if isinstance(node, ast.JoinedStr) and depth < 8:
            pieces = [each.value if isinstance(each, ast.FormattedValue) else each for each in node.values]
            is_plain = all(not isinstance(each, ast.FormattedValue) or inserts_text(each) for each in node.values)
            texts = [self.text(each, depth + 1) for each in pieces] if is_plain else [None]
            return "".join(text for text in texts if text is not None) if None not in texts else None
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add) and depth < 8:
            left, right = self.text(node.left, depth + 1), self.text(node.right, depth + 1)
            return left + right if left is not None and right is not None else None
        return None

    def items(self, node: ast.expr | None, depth: int = 0) -> list[ast.expr]:
        """Return the items of a list or tuple, with those of lists that are unpacked or added; empty for others.

        A computed part of a sum of lists, such as ``a if b else c``, counts as one item.
        """
        if depth > 8:
            return []
        if isinstance(node, ast.Name):
            return self.items(self.assigned.get(node.id), depth + 1)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            parts = [(part, self.items(part, depth + 1)) for part in (node.left, node.right)]
            return [item for part, inner in parts for item in inner or self._computed(part)]
        found: list[ast.expr] = []
        for item in node.elts if isinstance(node, (ast.List, ast.Tuple)) else ():
            inner = self.items(item.value, depth + 1) if isinstance(item, ast.Starred) else []
            found += inner or [item]
        return found

    def _computed(self, node: ast.expr) -> list[ast.expr]:
        """Return an expression without known items as one item; an empty list has none."""
        value = self.assigned.get(node.id) if isinstance(node, ast.Name) else node
        return [] if isinstance(value, (ast.List, ast.Tuple, ast.BinOp)) else [node]

    def _end(self, node: ast.expr) -> str:
        """Return the last character of a text, or of the last part of a sum, if it is constant."""
        return (self.text(node.right if isinstance(node, ast.BinOp) else node) or "")[-1:]

    def share(self, node: ast.expr) -> str | None:
        """Return the package whose share folder a call returns; None for other calls."""
        if isinstance(node, ast.Call) and name_of(node.func) in SHARE:
            words = [*node.args, *(word.value for word in node.keywords)]
            return self.text(words[0]) if len(words) == 1 else None
        return None

    def path(self, node: ast.expr, depth: int = 0) -> tuple[str, str] | None:
        """Return package and path that an expression evaluates to; None if it is computed or not a package path."""
        if depth > 20:
            return None
        if isinstance(node, ast.Name) and (value := self.assigned.get(node.id)) is not None:
            return self.path(value, depth + 1)
        if (package := self.share(node)) is not None:
            return package, ""
        if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Div)):
            head, tail = self.path(node.left, depth + 1), self.text(node.right)
            has_slash = isinstance(node.op, ast.Div) or (self._end(node.left) + (tail or "")[:1]).count("/") > 0
            if head is None or tail is None or not has_slash:
                return None
            return head[0], f"{head[1]}/{tail.strip('/')}"
        if isinstance(node, (ast.List, ast.Tuple, ast.JoinedStr)):  # joined without a separator
            pieces = [
                each.value if isinstance(each, ast.FormattedValue) else each
                for each in (node.values if isinstance(node, ast.JoinedStr) else node.elts)
            ]
            head = self.path(pieces[0], depth + 1) if pieces else None
            texts = [self.text(each) for each in pieces[1:]]
            if head is None or None in texts:
                return None
            tail = "".join(text for text in texts if text is not None)
            return (head[0], f"{head[1]}{tail}") if not tail or tail.startswith("/") else None
        if isinstance(node, ast.Call) and name_of(node.func) in (*JOINS, "Path", "str"):
            parts = node.args
            if len(parts) == 1 and isinstance(parts[0], (ast.List, ast.Tuple)):
                parts = parts[0].elts
            if not parts or node.keywords:
                return None
            head, tails = self.path(parts[0], depth + 1), [self.text(part) for part in parts[1:]]
            if head is None or None in tails:
                return None
            return head[0], "/".join((head[1], *(tail.strip("/") for tail in tails if tail is not None)))
        return None


def assignments(target: ast.expr, value: ast.expr) -> Iterator[tuple[ast.Name, ast.expr]]:
    """Yield the names that an assignment binds, with their values; ``a, b = x, y`` binds two."""
    if isinstance(target, ast.Name):
        yield target, value
    elif isinstance(target, (ast.Tuple, ast.List)) and isinstance(value, (ast.Tuple, ast.List)):
        is_plain = not any(isinstance(each, ast.Starred) for each in (*target.elts, *value.elts))
        if is_plain and len(target.elts) == len(value.elts):
            for name, each in zip(target.elts, value.elts, strict=True):
                yield from assignments(name, each)


def name_of(node: ast.expr) -> str:
    """Return the last part of a dotted name; empty for other expressions."""
    return str(getattr(node, "attr", getattr(node, "id", "")))


def unparsed(node: ast.AST) -> str:
    """Return the source text of a node in a normal form; empty for an expression that is nested too deeply."""
    try:
        return ast.unparse(node)
    except RecursionError:  # hundreds of chained attributes
        return ""


def inserts_text(value: ast.FormattedValue) -> bool:
    """Return whether an f-string inserts a text as it is."""
    return value.conversion in (-1, ord("s")) and value.format_spec is None
