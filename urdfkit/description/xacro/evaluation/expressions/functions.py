"""Functions: the names that expressions can use without a definition, exactly those of xacro 2.1."""

from __future__ import annotations

import builtins
import math
import re
from collections.abc import Callable

from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_BITS, TooLarge, excess
from urdfkit.description.xacro.evaluation.expressions.symbols import Namespace
from urdfkit.description.xacro.evaluation.expressions.values import Function, Type, YamlDict

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_DIRECT = "list dict map len str float int bool min max round"
_PYTHON = (
    f"{_DIRECT} sorted range abs all any complex divmod enumerate filter frozenset hash isinstance issubclass ord repr "
    "reversed slice set sum tuple type vars zip"
)
_EAGER = frozenset(("map", "filter", "zip", "enumerate", "reversed"))
_CALLING = frozenset(("map", "filter"))
_MAX_FACTORIAL = 1_000
_MAX_DIGITS = 3_000


class Functions:
    """Makes the functions of one file.

    Args:
        budget: counts their steps.
        callable_of: makes a function of an expression callable for Python.
    """

    def __init__(self, budget: Budget, callable_of: Callable[[Any], Callable[..., Any]]) -> None:
        self._budget, self._callable_of = budget, callable_of
        self.types: dict[type, Type] = {}

    def builtins(self, names: str) -> dict[str, Any]:
        """Return functions and types of Python by name."""
        return {name: self._builtin(name) for name in names.split()}

    def symbols(self, host: dict[str, Callable[..., Any]], warn: Callable[[str], None]) -> dict[str, Any]:
        """Return the global names.

        Args:
            host: the functions of the namespace ``xacro`` that concern the file: ``load_yaml``, ``message`` and so on.
            warn: receives the warnings about deprecated names.
        """
        python = self.builtins(_PYTHON)
        constants = mathematics(self._budget)
        own = {name: Function(name, call) for name, call in host.items()}
        own |= {"dotify": self._checked("dotify", YamlDict), "fatal": Function("fatal", _fatal)}
        own["tokenize"] = self._checked("tokenize", tokenize)
        symbols: dict[str, Any] = {name: python[name] for name in _DIRECT.split()}
        symbols |= {"True": True, "False": False, **constants}
        for name, function, namespace in (
            ("sorted", python["sorted"], "python"),
            ("range", python["range"], "python"),
            *((name, own[name], "xacro") for name in ("load_yaml", "abs_filename", "dotify")),
        ):
            message = f"Using {name}() directly is deprecated. Use {namespace}.{name}() instead."
            symbols[name] = Function(name, _warning_first(function.call, message, warn))
        symbols["python"] = Namespace.of({**python, "True": True, "False": False})
        symbols["math"] = Namespace.of(constants)
        symbols["xacro"] = Namespace.of(own)
        return symbols

    def _builtin(self, name: str) -> Function:
        if name == "type":
            return Type(type, self._type_of)
        if name == "vars":
            return Function(name, _refuse_vars)
        if name in ("isinstance", "issubclass"):
            return Function(name, self._check_type(getattr(builtins, name)))
        function = getattr(builtins, name)
        if isinstance(function, type):
            made = Type(function, self._checked(name, function).call)
            return self.types.setdefault(function, made)
        return self._checked(name, function)

    def _checked(self, name: str, function: Callable[..., Any]) -> Function:
        budget = self._budget

        def call(*values: Any, **named: Any) -> Any:
            for value in values:
                budget.spend_on(value)
            if name in _CALLING and values and values[0] is not None:
                values = (self._callable_of(values[0]), *values[1:])
            if "key" in named and named["key"] is not None and name in ("min", "max", "sorted"):
                named["key"] = self._callable_of(named["key"])
            if name == "sum" and len(values) + len(named) > 1:
                return self._sum(*values, **named)
            if name == "round" and len(values) > 1 and isinstance(values[0], int) and isinstance(values[1], int):
                _check_number("rounds to", abs(values[1]), _MAX_DIGITS, " digits")
            if name == "slice" and not all(value is None or type(value) is int for value in values):
                raise TooLarge("slice indices must be integers")
            result = function(*values, **named)
            if name in _EAGER:
                return iter(budget.checked(list(budget.each(result))))
            return budget.checked(result)

        return Function(name, call)

    def _sum(self, items: Any, /, start: Any = 0) -> Any:
        if isinstance(start, str):
            raise TypeError("sum() can't sum strings [use ''.join(seq) instead]")
        for item in self._budget.each(items):
            start = self._budget.add(start, item)
        return start

    def _type_of(self, value: Any, /, *others: Any) -> Type:
        if others:
            raise TypeError("type() accepts one argument: classes are not supported")
        kind = type(value)
        if isinstance(value, Type):
            return Type(type, self._type_of)
        return self.types.get(kind) or Type(kind, _refuse_type)

    def _check_type(self, check: Callable[..., bool]) -> Callable[..., bool]:
        def call(value: Any, kinds: Any, /) -> bool:
            value = value.kind if check is issubclass and isinstance(value, Type) else value
            return check(value, _kinds(kinds))

        return call


def mathematics(budget: Budget) -> dict[str, Any]:
    """Return the functions and constants of ``math``."""
    found: dict[str, Any] = {}
    for name, value in vars(math).items():
        if not name.startswith("_"):
            found[name] = Function(name, _bounded(budget, name, value)) if callable(value) else value
    return found


def _bounded(budget: Budget, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    def call(*values: Any, **named: Any) -> Any:
        for value in values:
            budget.spend_on(value)
        if name in ("factorial", "comb", "perm"):
            whole = max((abs(value) for value in values if isinstance(value, int)), default=0)
            _check_number(f"calls {name}() with", whole, _MAX_FACTORIAL, "")
        elif name == "lcm" and sum(value.bit_length() for value in values if isinstance(value, int)) > MAX_BITS:
            raise excess("an integer", MAX_BITS, "bits")
        elif name == "prod":
            return _product(budget, *values, **named)
        return budget.checked(function(*values, **named))

    return function if name in _PLAIN else call


_PLAIN = frozenset("sin cos tan asin acos atan atan2 sqrt radians degrees fabs exp log pow hypot copysign".split())  # noqa: SIM905


def _product(budget: Budget, items: Any, /, *, start: Any = 1) -> Any:
    for item in budget.each(items):
        start = budget.multiply(start, item)
    return start


def _check_number(what: str, number: int, limit: int, unit: str) -> None:
    """Refuse a number that makes a result far too large.

    Raises:
        TooLarge: it does.
    """
    if number > limit:
        raise TooLarge(f"it {what} more than {limit:,}{unit}")


def _kinds(kinds: Any) -> Any:
    if isinstance(kinds, tuple):
        return tuple(_kinds(kind) for kind in kinds)
    return kinds.kind if isinstance(kinds, Type) else kinds


def _warning_first(call: Callable[..., Any], message: str, warn: Callable[[str], None]) -> Callable[..., Any]:
    def warned(*values: Any, **named: Any) -> Any:
        warn(message)
        return call(*values, **named)

    return warned


def _refuse_vars(*_: Any) -> None:
    raise TypeError("vars() is not supported, because it exposes internal objects of Python")


def _refuse_type(*_: Any, **__: Any) -> None:
    raise TypeError("values of this type cannot be created")


def _fatal(*words: Any) -> None:
    raise ValueError(" ".join(map(str, words)))


def tokenize(s: Any, sep: str = ",; ", skip_empty: Any = True) -> list[str]:
    """Split a text at each of some characters, as ``xacro.tokenize`` does.

    Raises:
        TooLarge: the separators are a regular expression of their own.
    """
    if "]" in sep[1:]:
        raise TooLarge("a `]` among the separators of tokenize() is not supported: it makes them a regular expression")
    parts = re.split(f"[{sep}]", s)
    return [part for part in parts if part] if skip_empty else parts
