"""Attributes: the methods and data attributes that expressions can read, listed for each kind of value.

This table is the only way from a name in a file to an attribute. A name that is not in it does not exist, whatever
Python's object has; names that begin with two underscores are refused before they are looked up.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter

from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.formats import Formats
from urdfkit.description.xacro.evaluation.expressions.limits import TooLarge
from urdfkit.description.xacro.evaluation.expressions.value_size import CONTAINERS, check_characters, items_of, steps_of
from urdfkit.description.xacro.evaluation.expressions.values import Function, Type, YamlDict, YamlList

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_TEXT = (
    "capitalize casefold center count encode endswith expandtabs find index isalnum isalpha isascii isdecimal isdigit "
    "isidentifier islower isnumeric isprintable isspace istitle isupper join ljust lower lstrip partition removeprefix "
    "removesuffix replace rfind rindex rjust rpartition rsplit rstrip split splitlines startswith strip swapcase title "
    "translate upper zfill"
)
_METHODS: dict[type, str] = {
    str: _TEXT,
    bytes: "decode endswith hex startswith strip split",
    int: "as_integer_ratio bit_count bit_length conjugate",
    float: "as_integer_ratio conjugate hex is_integer",
    complex: "conjugate",
    list: "append clear copy count extend index insert pop remove reverse sort",
    tuple: "count index",
    range: "count index",
    dict: "clear copy get items keys pop popitem setdefault update values",
    set: "add clear copy difference discard intersection isdisjoint issubset issuperset pop remove "
    "symmetric_difference union update",
    frozenset: "copy difference intersection isdisjoint issubset issuperset symmetric_difference union",
    slice: "indices",
}
_DATA: dict[type, str] = {
    int: "real imag numerator denominator",
    float: "real imag",
    complex: "real imag",
    slice: "start stop step",
    range: "start stop step",
}
_OF_TYPES: dict[type, str] = {dict: "fromkeys", str: "maketrans", float: "fromhex"}


class Attributes:
    """Reads the attributes that expressions may read.

    Args:
        budget: counts the steps of methods.
        callable_of: makes a function of an expression callable for Python (``sort(key=…)``).
    """

    def __init__(self, budget: Budget, callable_of: Callable[[Any], Any]) -> None:
        self._budget, self._callable_of, self._formats = budget, callable_of, Formats(budget)
        self._found: dict[tuple[type, str], Function | None] = {}

    def read(self, value: Any, name: str) -> Any:
        """Return an attribute of a value.

        Raises:
            AttributeError: it has none of this name.
        """
        kind = type(value)
        base: type = dict if kind is YamlDict else list if kind is YamlList else int if kind is bool else kind
        method = self._method(base, name)
        if method is not None:
            return method.bound(value)
        if name in _DATA.get(base, "").split():
            return _DATA_READERS[name](value)
        if kind is YamlDict:
            return self._budget.checked(value[name])
        if isinstance(value, Type):
            if name in _OF_TYPES.get(value.kind, "").split():
                return Function(name, self._guarded(name, getattr(value.kind, name), is_method=False))
            if (method := self._method(value.kind, name)) is not None:
                return method
        shown = f"type object '{value.name}'" if isinstance(value, Type) else f"'{kind.__name__}' object"
        raise AttributeError(f"{shown} has no attribute '{name}'")

    def _method(self, kind: type, name: str) -> Function | None:
        key = kind, name
        if key not in self._found:
            found = None
            if kind is str and name == "format":
                found = Function(name, self._format)
            elif kind is str and name == "format_map":
                found = Function(name, lambda text, mapping: self._format(text, **mapping))
            elif name in _METHODS.get(kind, "").split():
                found = Function(name, self._guarded(name, vars(kind)[name], is_method=True))
            self._found[key] = found
        return self._found[key]

    def _format(self, text: str, /, *values: Any, **named: Any) -> str:
        return str(self._budget.checked(self._formats.vformat(text, values, named)))

    def _guarded(self, name: str, method: Callable[..., Any], *, is_method: bool) -> Callable[..., Any]:
        budget = self._budget

        def call(*values: Any, **named: Any) -> Any:
            if not values:
                return method(**named)
            args = values
            if is_method:
                args = (values[0], *self._arguments(values[0], name, values[1:], named))
            for value in args:
                budget.spend_on(value)
            if name == "sort":
                named = {key: self._callable_of(value) for key, value in named.items()}
            result = method(*args, **named)
            if result is None and isinstance(args[0], CONTAINERS):
                budget.checked(args[0])
            return budget.checked(result)

        return call

    def _arguments(self, owner: Any, name: str, args: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        """Return the arguments of a method whose result is small enough.

        Raises:
            TooLarge: it would not be.
        """
        if name in ("append", "insert", "add", "setdefault", "extend", "update"):
            for value in args:
                _refuse_containing(value, owner)
        if not isinstance(owner, str):
            return args
        if name in ("ljust", "rjust", "center", "zfill"):
            check_characters(max((value for value in args if isinstance(value, int)), default=0))
        elif name == "expandtabs":
            widths = [value for value in (*args, *named.values()) if isinstance(value, int)]
            check_characters(len(owner) + owner.count("\t") * max([8, *widths]))
        elif name == "replace" and len(args) > 1 and isinstance(args[0], str) and isinstance(args[1], str):
            check_characters(len(owner) + owner.count(args[0]) * len(args[1]))
        elif name == "join" and args:
            items = list(self._budget.each(args[0]))
            check_characters(sum(len(x) for x in items if isinstance(x, str)) + len(owner) * len(items))
            return (items, *args[1:])
        elif name == "translate" and args and isinstance(args[0], dict):
            longest = max((len(x) for x in args[0].values() if isinstance(x, str)), default=1)
            check_characters(len(owner) * longest)
        return args


def _refuse_containing(value: Any, owner: Any) -> None:
    """Refuse to put a container into itself.

    Raises:
        TooLarge: a container would contain itself, or be nested too deep.
    """
    if isinstance(value, CONTAINERS):
        steps_of(value)
        open_values: list[Any] = [value]
        while open_values:
            one = open_values.pop()
            if one is owner:
                raise TooLarge("it puts a list, dictionary or set into itself")
            if isinstance(one, CONTAINERS):
                open_values += items_of(one)


_DATA_READERS = {name: attrgetter(name) for names in _DATA.values() for name in names.split()}
