"""How much an expression may compute and make: what Python itself would go on with until memory or patience ends.

A description is the text of a stranger, and ``${9**9**9}`` takes for ever. So whatever can grow is done by a guard that
looks first: `guards` puts them where an expression has operators, calls, displays and loops. A result is bounded, and
so is the sum of the steps of one run: a step is an operation, an element of a list, or 8 characters of a text.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator
from types import BuiltinFunctionType, FunctionType, GeneratorType, GenericAlias, MethodDescriptorType, ModuleType

from urdfkit.description.xacro.expressions.excess import (
    MAX_BITS,
    MAX_CALLS_DEEP,
    MAX_ELEMENTS,
    MAX_STEPS,
    TooLarge,
    endless,
    excess,
)
from urdfkit.description.xacro.expressions.value_size import CONTAINERS, TEXTS, check_characters, check_widths, steps_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_CALLING = (map, filter, min, max, sorted)
_EAGER = (map, filter, zip, enumerate, reversed)
_CONVERSIONS: dict[int, Callable[[Any], str]] = {115: str, 114: repr, 97: ascii}
_PASSED_TO = {"sort", "sorted"}


class Bounds:
    """The steps of one run, and the guards that count them."""

    def __init__(self) -> None:
        self.left = MAX_STEPS
        self._deep = 0
        self.guards: dict[str, Callable[..., Any]] = {
            "__call__": self.call,
            "__each__": self.each,
            "__whole__": self.checked,
            "__sized__": self.sized,
            "__stored__": self.stored,
            "__format__": self.formatted,
            "__add__": self.plus,
            "__mul__": self.times,
            "__pow__": self.power,
            "__mod__": self.modulo,
            "__lshift__": self.shifted,
            **{f"__{name}__": self._counted(getattr(operator, name)) for name in ("sub", "or_", "and_", "xor")},
        }

    @property
    def is_exhausted(self) -> bool:
        """Whether no step is left."""
        return self.left < 0

    def spend(self, steps: int) -> None:
        """Take steps.

        Raises:
            TooLarge: there are none left.
        """
        self.left -= steps
        if self.left < 0:
            raise endless()

    def checked(self, value: Any) -> Any:
        """Return a value that is not too large.

        Raises:
            TooLarge: it is.
        """
        kind = type(value)
        if kind is float or kind is bool:
            return value
        if kind is int:
            if value.bit_length() > MAX_BITS:
                raise excess("an integer", MAX_BITS, "bits")
        elif isinstance(value, (*TEXTS, *CONTAINERS, range)):
            self.spend(steps_of(value))
        elif kind is GenericAlias:
            raise TooLarge("types of types are not supported")
        return value

    def sized(self, value: Any) -> Any:
        """Return a value that is compared or looked up; its size counts."""
        if not isinstance(value, (int, float)):
            self.checked(value)
        else:
            self.spend(1)
        return value

    def stored(self, value: Any) -> Any:
        """Return a value that is given a name inside an expression.

        Raises:
            TooLarge: it is a generator: chains of them overflow the stack.
        """
        if isinstance(value, GeneratorType):
            raise TooLarge("generators cannot be stored")
        return self.checked(value)

    def each(self, items: Iterable[Any]) -> Iterator[Any]:
        """Yield the items, each of which is a step."""
        for item in items:
            self.spend(1)
            yield item

    def plus(self, a: Any, b: Any) -> Any:
        """Return a + b."""
        self.spend(1)
        if isinstance(a, (int, float)):
            return a + b
        return self.checked(a + b)

    def times(self, a: Any, b: Any) -> Any:
        """Return a * b."""
        self.spend(1)
        if type(a) is float or type(b) is float:
            return a * b
        if isinstance(a, int) and isinstance(b, int):
            if a.bit_length() + b.bit_length() > MAX_BITS:
                raise excess("an integer", MAX_BITS, "bits")
            return a * b
        if isinstance(b, int):
            self._repeat(a, b)
        elif isinstance(a, int):
            self._repeat(b, a)
        return a * b

    def _repeat(self, value: Any, count: int) -> None:
        if count > 0 and isinstance(value, TEXTS):
            check_characters(len(value) * count)
            self.spend(1 + (len(value) * count >> 3))
        elif count > 0 and isinstance(value, CONTAINERS):
            if (steps := steps_of(value) * count) > MAX_ELEMENTS:
                raise excess("lists", MAX_ELEMENTS, "elements in all")
            self.spend(steps)

    def power(self, a: Any, b: Any) -> Any:
        """Return a ** b."""
        self.spend(1)
        if isinstance(a, int) and isinstance(b, int) and abs(a) > 1 and a.bit_length() * abs(b) > MAX_BITS:
            raise excess("an integer", MAX_BITS, "bits")
        return a**b

    def shifted(self, a: Any, b: Any) -> Any:
        """Return a << b."""
        self.spend(1)
        if isinstance(a, int) and isinstance(b, int) and a and a.bit_length() + b > MAX_BITS:
            raise excess("an integer", MAX_BITS, "bits")
        return a << b

    def modulo(self, a: Any, b: Any) -> Any:
        """Return a % b, where a may be a format."""
        self.spend(1)
        if isinstance(a, (str, bytes)):
            self._check_format(a if isinstance(a, str) else a.decode("latin-1"), "%", (b,), "*" in str(a))
            return self.checked(a % b)
        return a % b

    def formatted(self, value: Any, conversion: int, specification: str) -> str:
        """Return what a part of an f-string becomes."""
        self.spend(1)
        turned = _CONVERSIONS[conversion](value) if conversion in _CONVERSIONS else value
        check_widths(specification)
        return str(self.checked(format(turned, specification)))

    def call(self, function: Any, /, *args: Any, **named: Any) -> Any:
        """Return what a function returns, where it can be told that it will not be too much."""
        self.spend(1)
        kind = type(function)
        if kind is FunctionType:
            return self._deeper(function, args, named)
        if kind is MethodDescriptorType and args:
            function, args = function.__get__(args[0]), args[1:]
            kind = type(function)
        if kind is type:
            return self._make(function, args, named)
        if kind is not BuiltinFunctionType:
            return self.checked(function(*args, **named))
        for argument in args:
            if isinstance(argument, (*TEXTS, list, tuple, dict)):
                self.spend(len(argument) >> 3)
        owner, name = function.__self__, function.__name__
        if not isinstance(owner, ModuleType):
            from urdfkit.description.xacro.expressions.builtin_limits import check_method

            args = check_method(self, owner, name, args, named)
            value = function(*self._watched(args, name), **self._watched_by_name(named, name))
            if value is None and isinstance(owner, CONTAINERS) and any(isinstance(x, CONTAINERS) for x in args):
                self.checked(owner)
            return self.checked(value)
        if function in (min, max, sorted):
            args, named = self._watched(args, name), self._watched_by_name(named, name)
        elif name in ("sum", "prod", "lcm", "factorial", "comb", "perm", "round"):
            from urdfkit.description.xacro.expressions.builtin_limits import replaced

            function = replaced(self, function, args)
        return self.checked(function(*args, **named))

    def _deeper(self, function: Any, args: Any, named: Any) -> Any:
        if self._deep >= MAX_CALLS_DEEP:
            raise TooLarge(f"its functions call each other more than {MAX_CALLS_DEEP} deep")
        self._deep += 1
        try:
            return self.checked(function(*args, **self._watched_by_name(named, "sorted")))
        finally:
            self._deep -= 1

    def _make(self, kind: Any, args: Any, named: Any) -> Any:
        if kind is type and len(args) != 1:
            raise TooLarge("classes are not supported")
        if kind is slice and not all(x is None or type(x) is int for x in args):
            raise TooLarge("slice indices must be integers")
        if kind in (bytes, bytearray) and args and isinstance(args[0], int):
            check_characters(args[0])
        if kind in _CALLING:
            args = self._watched(args, "sorted")
        for argument in args:
            if isinstance(argument, (*TEXTS, *CONTAINERS)):
                self.spend(steps_of(argument))
        value = kind(*args, **named)
        if kind in _EAGER:
            return iter(self.checked(list(value)))
        return self.checked(value)

    def _watched(self, values: Iterable[Any], name: str) -> tuple[Any, ...]:
        """Return arguments, those that will be called made to be called by a guard."""
        if name not in _PASSED_TO and name not in ("min", "max"):
            return tuple(values)
        return tuple(self._guarding(x) if callable(x) and not isinstance(x, FunctionType) else x for x in values)

    def _watched_by_name(self, named: dict[str, Any], name: str) -> dict[str, Any]:
        return dict(zip(named, self._watched(named.values(), name), strict=True))

    def _guarding(self, function: Any) -> Callable[..., Any]:
        return lambda *args: self.call(function, *args)

    def _check_format(self, text: str, sign: str, values: Iterable[Any], is_nested: bool) -> None:
        from urdfkit.description.xacro.expressions.builtin_limits import check_format

        check_format(self, text, sign, values, is_nested)

    def _counted(self, operation: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
        def count(a: Any, b: Any) -> Any:
            self.spend(1)
            if isinstance(a, (int, float)):
                return operation(a, b)
            return self.checked(operation(self.checked(a), self.checked(b)))

        return count
