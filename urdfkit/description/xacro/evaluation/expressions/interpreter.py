"""Expressions: parsed with `ast` into functions of ours, and computed over plain values.

Python never runs the text of a file. `ast.parse` only reads it; each node becomes a closure below; a node that has
no method here is refused. Names are looked up in `symbols.Scope`, attributes in the table of `attributes`.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable

from urdfkit.description.xacro.evaluation.expressions.attributes import Attributes
from urdfkit.description.xacro.evaluation.expressions.budget import SIZED, Budget
from urdfkit.description.xacro.evaluation.expressions.formats import Formats
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_DEPTH, MAX_EXPRESSION, TooLarge
from urdfkit.description.xacro.evaluation.expressions.loops import LoopFrame, Loops, checked_name
from urdfkit.description.xacro.evaluation.expressions.symbols import Namespace, symbol_of
from urdfkit.description.xacro.evaluation.expressions.values import Function

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    Compute = Callable[[LoopFrame], Any]

_UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Invert: operator.invert,
    ast.Not: operator.not_,
}
_COMPARISONS: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda a, b: operator.contains(b, a),
    ast.NotIn: lambda a, b: not operator.contains(b, a),
}
_SCOPED = (ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp, ast.NamedExpr, ast.Starred)
_CONVERSIONS = {115: "s", 114: "r", 97: "a", -1: None}


class Expressions(Loops):
    """Compiles and computes the expressions of one file; a repeated expression is compiled once.

    Args:
        budget: counts their steps.

    Attributes:
        symbol: returns the value of a name; `symbol_of` unless replaced before the first expression.
    """

    def __init__(self, budget: Budget) -> None:
        self.budget = budget
        self._attributes = Attributes(budget, self.callable_of)
        self._compiled: dict[str, tuple[Compute, int]] = {}
        self._bound: list[set[str]] = []
        self._depth = self._calls = self._size = 0
        self.symbol = symbol_of
        self._parts: dict[type[ast.expr], Callable[[Any], Compute]] = {
            ast.Constant: self._constant,
            ast.Name: self._name,
            ast.Attribute: self._attribute,
            ast.BinOp: self._binary,
            ast.UnaryOp: self._unary,
            ast.BoolOp: self._boolean,
            ast.Compare: self._compare,
            ast.IfExp: self._conditional,
            ast.Subscript: self._subscript,
            ast.Slice: self._slice,
            ast.Call: self._call,
            ast.List: lambda node: self._display(node.elts, list),
            ast.Tuple: lambda node: self._display(node.elts, tuple),
            ast.Set: lambda node: self._display(node.elts, set),
            ast.Dict: self._dict,
            ast.JoinedStr: self._joined,
            ast.FormattedValue: self._formatted,
            ast.NamedExpr: self._assignment,
            ast.Lambda: self._lambda,
            ast.GeneratorExp: lambda node: self._collected(node, lambda items: iter(list(items))),
            ast.ListComp: lambda node: self._collected(node, list),
            ast.SetComp: lambda node: self._collected(node, set),
            ast.DictComp: self._dict_loop,
        }

    def evaluate(self, expression: str, symbols: Any) -> Any:
        """Return the value of an expression.

        Args:
            expression: as written between the braces.
            symbols: where names are looked up.

        Raises:
            SyntaxError: it is not an expression.
            NameError: it uses a name that is not defined.
            TooLarge: it computes too much.
        """
        found = self._compiled.get(expression)
        if found is None:
            found = self._compiled[expression] = self.compile(expression.strip())
        compute, size = found
        self.budget.spend(size >> 4)
        return self.budget.checked(compute(LoopFrame(symbols)))

    def compile(self, expression: str) -> tuple[Compute, int]:
        """Return a function that computes an expression, and the number of its parts.

        Raises:
            SyntaxError: it is not an expression.
            TooLarge: it is too long, or nested too deep.
        """
        if len(expression) > MAX_EXPRESSION:
            raise TooLarge(f"it has {len(expression):,} characters; at most {MAX_EXPRESSION:,} are evaluated")
        self._depth = self._size = 0
        self._bound = []
        try:
            tree = ast.parse(expression, "<expression>", "eval")
            compute = self._compute(tree.body)
            if any(isinstance(node, _SCOPED) for node in ast.walk(tree)):
                compile(tree, "<expression>", "eval")  # only for the errors that Python reports; never run
        except (RecursionError, MemoryError) as error:
            raise TooLarge("it is nested too deeply") from error
        return compute, self._size

    def call(self, function: Any, /, *values: Any, **named: Any) -> Any:
        """Return the result of a function of an expression.

        Raises:
            TypeError: it is not a function.
        """
        self.budget.spend(1)
        if not isinstance(function, Function):
            raise TypeError(f"'{type(function).__name__}' object is not callable")
        return function.call(*values, **named)

    def callable_of(self, function: Any) -> Callable[..., Any]:
        """Return a function that Python can call, for ``map`` and ``key=``."""
        return lambda *values: self.call(function, *values)

    def _compute(self, node: ast.expr) -> Compute:
        self._depth += 1
        self._size += 1
        if self._depth > MAX_DEPTH:
            raise TooLarge(f"it is nested more than {MAX_DEPTH} levels deep")
        part = self._parts.get(type(node))
        if part is None:
            raise SyntaxError(f"{type(node).__name__} is not supported in expressions")
        compute = part(node)
        self._depth -= 1
        return compute

    def _constant(self, node: ast.Constant) -> Compute:
        value = node.value
        return lambda _: value

    def _name(self, node: ast.Name) -> Compute:
        name, symbol = checked_name(node.id), self.symbol
        if not any(name in names for names in self._bound):
            return lambda frame: symbol(frame.symbols, name)

        def variable(frame: LoopFrame) -> Any:
            at: LoopFrame | None = frame
            while at is not None:
                if name in at.variables:
                    return at.variables[name]
                at = at.outer
            return symbol(frame.symbols, name)

        return variable

    def _attribute(self, node: ast.Attribute) -> Compute:
        owner, name, read = self._compute(node.value), checked_name(node.attr), self._attributes.read
        symbol = self.symbol

        def attribute(frame: LoopFrame) -> Any:
            value = owner(frame)
            if isinstance(value, Namespace):
                return symbol(value, name)
            return read(value, name)

        return attribute

    def _binary(self, node: ast.BinOp) -> Compute:
        left, right = self._compute(node.left), self._compute(node.right)
        operation = self.budget.operators[type(node.op).__name__]
        return lambda frame: operation(left(frame), right(frame))

    def _unary(self, node: ast.UnaryOp) -> Compute:
        operand, operation = self._compute(node.operand), _UNARY[type(node.op)]
        return lambda frame: operation(operand(frame))

    def _boolean(self, node: ast.BoolOp) -> Compute:
        parts = [self._compute(value) for value in node.values]
        stops_at = isinstance(node.op, ast.Or)

        def decide(frame: LoopFrame) -> Any:
            value: Any = None
            for part in parts:
                value = part(frame)
                if bool(value) is stops_at:
                    break
            return value

        return decide

    def _compare(self, node: ast.Compare) -> Compute:
        first = self._compute(node.left)
        rest = [
            (_COMPARISONS[type(op)], self._compute(side)) for op, side in zip(node.ops, node.comparators, strict=True)
        ]
        budget = self.budget

        def compare(frame: LoopFrame) -> Any:
            left, result = first(frame), None
            for operation, side in rest:
                right = side(frame)
                for value in (left, right):
                    if isinstance(value, SIZED):
                        budget.checked(value)
                result = operation(left, right)
                if not result:
                    return result
                left = right
            return result

        return compare

    def _conditional(self, node: ast.IfExp) -> Compute:
        test, body, other = self._compute(node.test), self._compute(node.body), self._compute(node.orelse)
        return lambda frame: body(frame) if test(frame) else other(frame)

    def _subscript(self, node: ast.Subscript) -> Compute:
        owner, index, budget = self._compute(node.value), self._compute(node.slice), self.budget

        def item(frame: LoopFrame) -> Any:
            value, at = owner(frame), index(frame)
            if isinstance(value, Function):
                raise TypeError(f"'{value.name}' object is not subscriptable")
            return budget.checked(value[at])

        return item

    def _slice(self, node: ast.Slice) -> Compute:
        parts = [self._compute(part) if part is not None else None for part in (node.lower, node.upper, node.step)]
        return lambda frame: slice(*[part(frame) if part is not None else None for part in parts])

    def _call(self, node: ast.Call) -> Compute:
        function = self._compute(node.func)
        consumes = len(node.args) == 1 and isinstance(node.args[0], ast.GeneratorExp)
        args = self._generator(node.args[0]) if consumes else self._items(node.args)  # type: ignore[arg-type]
        named = [(keyword.arg, self._compute(keyword.value)) for keyword in node.keywords]
        call = self.call

        def called(frame: LoopFrame) -> Any:
            target = function(frame)
            values = [args(frame)] if consumes else args(frame)
            if not named:
                return call(target, *values)
            by_name: dict[str, Any] = {}
            for name, value in named:
                more = {name: value(frame)} if name is not None else dict(value(frame))
                if repeated := more.keys() & by_name.keys():
                    raise TypeError(f"got multiple values for keyword argument '{min(repeated)}'")
                by_name.update(more)
            return call(target, *values, **by_name)

        return called

    def _items(self, nodes: list[ast.expr]) -> Callable[[LoopFrame], list[Any]]:
        """Return a function that computes the items of a display or the arguments of a call."""
        if not any(isinstance(node, ast.Starred) for node in nodes):
            parts = [self._compute(node) for node in nodes]
            return lambda frame: [part(frame) for part in parts]
        mixed = [
            (self._compute(node.value), True) if isinstance(node, ast.Starred) else (self._compute(node), False)
            for node in nodes
        ]
        each = self.budget.each

        def items(frame: LoopFrame) -> list[Any]:
            found: list[Any] = []
            for part, is_starred in mixed:
                if is_starred:
                    found.extend(each(part(frame)))
                else:
                    found.append(part(frame))
            return found

        return items

    def _display(self, nodes: list[ast.expr], kind: Callable[[list[Any]], Any]) -> Compute:
        items, checked = self._items(nodes), self.budget.checked
        return lambda frame: checked(kind(items(frame)))

    def _dict(self, node: ast.Dict) -> Compute:
        pairs = [
            (self._compute(key) if key is not None else None, self._compute(value))
            for key, value in zip(node.keys, node.values, strict=True)
        ]
        checked = self.budget.checked

        def display(frame: LoopFrame) -> Any:
            found: dict[Any, Any] = {}
            for key, value in pairs:
                if key is None:
                    found.update(value(frame))
                else:
                    found[key(frame)] = value(frame)
            return checked(found)

        return display

    def _joined(self, node: ast.JoinedStr) -> Compute:
        parts = [self._compute(part) for part in node.values]
        checked = self.budget.checked
        return lambda frame: checked("".join([part(frame) for part in parts]))

    def _formatted(self, node: ast.FormattedValue) -> Compute:
        value, conversion, formats = self._compute(node.value), _CONVERSIONS[node.conversion], Formats(self.budget)
        specification = self._compute(node.format_spec) if node.format_spec is not None else lambda _: ""
        return lambda frame: formats.format_field(formats.convert_field(value(frame), conversion), specification(frame))
