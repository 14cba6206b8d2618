"""Loops and functions of expressions: comprehensions, ``lambda`` and ``:=``, which have variables of their own."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_CALLS_DEEP, TooLarge
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.expressions.values import Function

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    Compute = Callable[["LoopFrame"], Any]


_CALL = 10
"""Steps of a call of a lambda: at some depths Python allocates memory for each frame, which takes ten times as long."""


class LoopFrame:
    """The names an expression can see: the scope, and the variables of loops and functions around."""

    __slots__ = ("outer", "symbols", "variables")

    def __init__(self, symbols: Any, outer: LoopFrame | None = None) -> None:
        self.symbols, self.outer = symbols, outer
        self.variables: dict[str, Any] = {}


class Loops:
    """Compiles the parts of expressions that have variables.

    Attributes:
        budget: counts their steps.
    """

    budget: Budget
    _bound: list[set[str]]
    _calls: int
    _size: int

    def _compute(self, node: ast.expr) -> Compute:
        raise NotImplementedError

    def _assignment(self, node: ast.NamedExpr) -> Compute:
        name, value, nested = checked_name(node.target.id), self._compute(node.value), bool(self._bound)

        def assign(frame: LoopFrame) -> Any:
            result = value(frame)
            if not isinstance(frame.symbols, Scope):
                raise TypeError("$(eval …) does not support assignment")
            if nested:
                frame.symbols.values[name] = result
            else:
                frame.symbols.set(name, result, is_lazy=True)
            return result

        return assign

    def _lambda(self, node: ast.Lambda) -> Compute:
        arguments = node.args
        if arguments.vararg or arguments.kwarg or arguments.kwonlyargs or arguments.posonlyargs:
            raise SyntaxError("functions with `*` or `/` parameters are not supported in expressions")
        names = [checked_name(argument.arg) for argument in arguments.args]
        defaults = [self._compute(value) for value in arguments.defaults]
        start = self._size
        self._bound.append(set(names))
        body = self._compute(node.body)
        self._bound.pop()
        cost = _CALL + (self._size - start >> 4)

        def function(frame: LoopFrame) -> Any:
            by_default = dict(
                zip(names[len(names) - len(defaults) :], [value(frame) for value in defaults], strict=True)
            )

            def call(*values: Any, **named: Any) -> Any:
                inner = LoopFrame(frame.symbols, frame)
                inner.variables = _arguments(names, by_default, values, named)
                self.budget.spend(cost)
                if self._calls >= MAX_CALLS_DEEP:
                    raise TooLarge(f"its functions call each other more than {MAX_CALLS_DEEP} levels deep")
                self._calls += 1
                try:
                    return self.budget.checked(body(inner))
                finally:
                    self._calls -= 1

            return Function("<lambda>", call, "<function <lambda>>")

        return function

    def _generator(self, node: ast.GeneratorExp | ast.ListComp | ast.SetComp) -> Callable[[LoopFrame], Iterator[Any]]:
        return self._loop(node.generators, [node.elt], lambda frame, parts: parts[0](frame))

    def _collected(
        self, node: ast.GeneratorExp | ast.ListComp | ast.SetComp, kind: Callable[[Iterator[Any]], Any]
    ) -> Compute:
        run, checked = self._generator(node), self.budget.checked
        return lambda frame: checked(kind(run(frame)))

    def _dict_loop(self, node: ast.DictComp) -> Compute:
        run, checked = self._loop(node.generators, [node.key, node.value], _pair), self.budget.checked
        return lambda frame: checked(dict(run(frame)))

    def _loop(
        self, generators: list[ast.comprehension], results: list[ast.expr], result: Callable[[LoopFrame, Any], Any]
    ) -> Callable[[LoopFrame], Iterator[Any]]:
        outermost = self._compute(generators[0].iter)
        bound: set[str] = set()
        self._bound.append(bound)
        for generator in generators:
            if generator.is_async:
                raise SyntaxError("asynchronous loops are not supported in expressions")
            bound.update(child.id for child in ast.walk(generator.target) if isinstance(child, ast.Name))
        start = self._size
        steps: list[tuple[Compute | None, Callable[[LoopFrame, Any], None], list[Compute]]] = []
        for number, generator in enumerate(generators):
            items = self._compute(generator.iter) if number else None
            steps.append((items, self._target(generator.target), [self._compute(test) for test in generator.ifs]))
        parts = [self._compute(part) for part in results]
        self._bound.pop()
        cost = 1 + (self._size - start >> 4)
        spend = self.budget.spend

        def turn(frame: LoopFrame, number: int, items: Any) -> Iterator[Any]:
            _, store, tests = steps[number]
            for item in items:
                spend(cost)
                store(frame, item)
                if not all(test(frame) for test in tests):
                    continue
                if number + 1 == len(steps):
                    yield result(frame, parts)
                else:
                    yield from turn(frame, number + 1, steps[number + 1][0](frame))  # type: ignore[misc]

        return lambda frame: turn(LoopFrame(frame.symbols, frame), 0, outermost(frame))

    def _target(self, node: ast.expr) -> Callable[[LoopFrame, Any], None]:
        """Return a function that stores an item in the variables of a loop."""
        if isinstance(node, ast.Name):
            name = checked_name(node.id)
            return lambda frame, value: frame.variables.__setitem__(name, value)
        if not isinstance(node, (ast.Tuple, ast.List)) or any(isinstance(part, ast.Starred) for part in node.elts):
            raise SyntaxError("loops assign to names only")
        targets = [self._target(part) for part in node.elts]

        def unpack(frame: LoopFrame, value: Any) -> None:
            values = list(self.budget.each(value))
            if len(values) != len(targets):
                few = "not enough" if len(values) < len(targets) else "too many"
                raise ValueError(f"{few} values to unpack (expected {len(targets)}, got {len(values)})")
            for target, one in zip(targets, values, strict=True):
                target(frame, one)

        return unpack


def _pair(frame: LoopFrame, parts: list[Compute]) -> tuple[Any, Any]:
    key, value = parts
    return key(frame), value(frame)


def checked_name(name: str) -> str:
    """Return a name of an expression.

    Raises:
        NameError: it begins with two underscores.
    """
    if name.startswith("__"):
        raise NameError(f"use of invalid name(s): {name}")
    return name


def _arguments(
    names: list[str], defaults: dict[str, Any], values: tuple[Any, ...], named: dict[str, Any]
) -> dict[str, Any]:
    if len(values) > len(names):
        raise TypeError(f"<lambda>() takes {len(names)} positional arguments but {len(values)} were given")
    found = {**defaults, **dict(zip(names, values, strict=False))}
    for name, value in named.items():
        if name not in names or name in names[: len(values)]:
            raise TypeError(f"<lambda>() got an unexpected keyword argument '{name}'")
        found[name] = value
    if missing := [name for name in names if name not in found]:
        raise TypeError(f"<lambda>() missing required argument: '{missing[0]}'")
    return found
