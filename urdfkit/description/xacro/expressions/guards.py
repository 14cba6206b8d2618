"""Rewrites an expression so that whatever can grow, or go on, is done by the guards of `limits`."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from urdfkit.description.xacro.expressions.excess import MAX_DEPTH, TooLarge

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_OPERATORS: dict[type[ast.operator], str] = {
    ast.Add: "__add__",
    ast.Sub: "__sub__",
    ast.Mult: "__mul__",
    ast.Pow: "__pow__",
    ast.Mod: "__mod__",
    ast.LShift: "__lshift__",
    ast.BitOr: "__or___",
    ast.BitAnd: "__and___",
    ast.BitXor: "__xor__",
}
_DISPLAYS = (ast.List, ast.Tuple, ast.Set, ast.Dict)
_LOOPS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)


def names_in(tree: ast.AST) -> Iterator[str]:
    """Yield the names and attributes that an expression uses, in order."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.arg):
            yield node.arg


def bound_in(tree: ast.AST) -> set[str]:
    """Return the names that an expression itself gives a value: of loops and functions in it."""
    stored = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    return stored | {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}


class Guarding(ast.NodeTransformer):
    """Puts guards into the tree of an expression.

    Attributes:
        stores: whether it gives names values that outlive it (``:=``).
    """

    def __init__(self) -> None:
        self.stores = False
        self._depth = 0
        self._loops = 0

    def visit(self, node: ast.AST) -> Any:
        """Visit a node.

        Raises:
            TooLarge: it is nested too deep.
        """
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise TooLarge(f"it is nested more than {MAX_DEPTH} deep")
        try:
            if isinstance(node, _DISPLAYS):
                return self._display(node)
            return self._comprehension(node) if isinstance(node, _LOOPS) else super().visit(node)
        finally:
            self._depth -= 1

    def generic_visit(self, node: ast.AST) -> ast.AST:
        """Visit what is below; inside loops, what copies on being read is counted."""
        if isinstance(node, (ast.Yield, ast.YieldFrom, ast.Await)):
            raise TooLarge("it uses `yield`, which is not supported")
        super().generic_visit(node)
        if isinstance(node, ast.Attribute) and self._loops:
            return _guarded("__whole__", node)
        return node

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """Let a guard do what an operator does."""
        left, right = self.visit(node.left), self.visit(node.right)
        name = _OPERATORS.get(type(node.op))
        return ast.BinOp(left, node.op, right) if name is None else _guarded(name, left, right)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Let a guard call."""
        self.generic_visit(node)
        for keyword in node.keywords:
            if keyword.arg is None:
                keyword.value = _guarded("__whole__", keyword.value)
        return ast.Call(_name("__call__"), [node.func, *node.args], node.keywords)

    def visit_Starred(self, node: ast.Starred) -> ast.AST:
        """Count what is unpacked."""
        self.generic_visit(node)
        return ast.Starred(_guarded("__each__", node.value), node.ctx)

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        """Count what is compared, where it can be long."""
        plain = any(isinstance(side, ast.Constant) for side in (node.left, *node.comparators))
        contains = any(isinstance(op, (ast.In, ast.NotIn)) for op in node.ops)
        self.generic_visit(node)
        if self._loops or not plain or contains or len(node.ops) > 1:
            node.left = _guarded("__sized__", node.left)
            node.comparators = [_guarded("__sized__", side) for side in node.comparators]
        return node

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        """Bound slices; inside loops, all that is looked up."""
        sliced = isinstance(node.slice, ast.Slice)
        self.generic_visit(node)
        if self._loops and not isinstance(node.slice, (ast.Slice, ast.Constant)):
            node.slice = _guarded("__sized__", node.slice)
        return _guarded("__whole__", node) if sliced or self._loops else node

    def _display(self, node: Any) -> ast.AST:
        if not isinstance(getattr(node, "ctx", None), (ast.Store, ast.Del)):
            parts = getattr(node, "elts", None) or getattr(node, "values", [])
            plain = all(isinstance(part, ast.Constant) for part in parts) and not self._loops
            self.generic_visit(node)
            return node if plain else _guarded("__whole__", node)
        return node  # type: ignore[no-any-return]

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.AST:
        """Bound the parts of an f-string."""
        parts: list[ast.expr] = []
        for part in node.values:
            if isinstance(part, ast.FormattedValue):
                given = self.visit(part.format_spec) if part.format_spec is not None else ast.Constant("")
                value = _guarded("__format__", self.visit(part.value), ast.Constant(part.conversion), given)
                parts.append(ast.FormattedValue(value, -1, None))
            else:
                parts.append(part)
        return _guarded("__whole__", ast.JoinedStr(parts))

    def _comprehension(self, node: Any) -> ast.AST:
        self._loops += 1
        self.generic_visit(node)
        self._loops -= 1
        for generator in node.generators:
            generator.iter = _guarded("__each__", generator.iter)
        return node if isinstance(node, ast.GeneratorExp) else _guarded("__whole__", node)

    def visit_Lambda(self, node: ast.Lambda) -> ast.AST:
        """What is in a function may be done many times."""
        self._loops += 1
        self.generic_visit(node)
        self._loops -= 1
        return node

    def visit_NamedExpr(self, node: ast.NamedExpr) -> ast.AST:
        """Look at what is kept."""
        self.stores = True
        node.value = _guarded("__stored__", self.visit(node.value))
        return node


def with_parameters(body: ast.expr, names: list[str]) -> ast.expr:
    """Return a function of the guards, so that they need not be looked up among the properties."""
    arguments = ast.arguments([], [ast.arg(name) for name in names], None, [], [], None, [])
    return ast.Lambda(arguments, body)


def _guarded(name: str, *values: ast.expr) -> ast.Call:
    return ast.Call(_name(name), list(values), [])


def _name(name: str) -> ast.Name:
    return ast.Name(name, ast.Load())
