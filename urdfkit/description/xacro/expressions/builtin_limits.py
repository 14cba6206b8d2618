"""Functions and methods of Python whose result can be far larger than what they are given, and what bounds it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from types import GeneratorType

from urdfkit.description.xacro.expressions.excess import MAX_BITS, MAX_CHARACTERS, TooLarge, excess
from urdfkit.description.xacro.expressions.value_size import check_characters, check_widths, steps_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any, Protocol

    class Bounds(Protocol):
        """What the checks need of `limits.Bounds`."""

        def each(self, items: Iterable[Any]) -> Iterator[Any]:
            """Yield the items, each of which is a step."""

        def spend(self, steps: int) -> None:
            """Count steps."""

        def plus(self, a: Any, b: Any) -> Any:
            """Return a + b."""

        def times(self, a: Any, b: Any) -> Any:
            """Return a * b."""


_MAX_FACTORIAL = 1_000
_MAX_DIGITS = 3_000
_PADDING = ("ljust", "rjust", "center", "zfill", "to_bytes")
_NESTED = re.compile(r"\{[^{}]*\{").search
_INSIDE = re.compile(r"\{[^}]*\.\s*(__|gi_|cr_|ag_|f_|tb_)").search
_KEEPING = ("append", "insert", "add", "setdefault")


def check_method(bounds: Bounds, owner: Any, name: str, args: tuple[Any, ...], named: dict[str, Any]) -> Any:
    """Look at a call of a method.

    Args:
        bounds: counts the steps.
        owner: whose method it is.
        name: of the method.
        args: what it is given.
        named: what it is given by name.

    Returns:
        The arguments to give it.

    Raises:
        TooLarge: it would make too much.
    """
    if name in _KEEPING:
        for argument in args:
            if isinstance(argument, GeneratorType):
                raise TooLarge("generators cannot be stored")
    if not isinstance(owner, (str, bytes, int)):
        return args
    numbers = [x for x in (*args, *named.values()) if isinstance(x, int)]
    if name in _PADDING:
        check_characters(max(numbers, default=0))
    elif name == "expandtabs" and not isinstance(owner, int):
        tabs = owner.count("\t") if isinstance(owner, str) else owner.count(b"\t")
        check_characters(len(owner) + tabs * max([8, *numbers]))
    elif name == "replace" and len(args) > 1 and isinstance(owner, str):
        check_characters(len(owner) + owner.count(args[0]) * len(args[1]))
    elif name == "join" and args and not isinstance(owner, int):
        items = list(bounds.each(args[0]))
        check_characters(sum(len(x) for x in items if isinstance(x, (str, bytes))) + len(owner) * len(items))
        return (items,)
    elif name == "translate" and args and isinstance(owner, str):
        values = args[0].values() if isinstance(args[0], dict) else ()
        check_characters(len(owner) * max((len(x) for x in values if isinstance(x, str)), default=1))
    elif name in ("format", "format_map") and isinstance(owner, str):
        check_format(bounds, owner, "{", (*args, *named.values()), _NESTED(owner) is not None)
    return args


def check_format(bounds: Bounds, text: str, sign: str, values: Iterable[Any], is_nested: bool) -> None:
    """Look at a format and what is put into it.

    Args:
        bounds: counts the steps.
        text: the format.
        sign: what a field starts with.
        values: what is put in.
        is_nested: whether a width can be one of the values.

    Raises:
        TooLarge: the result could be too long, or the format reaches for what expressions must not see.
    """
    if sign == "{" and _INSIDE(text):
        raise TooLarge("a format that names attributes of Python itself is refused")
    check_widths(text)
    given: list[Any] = []
    for value in values:
        given += value if isinstance(value, (tuple, list)) else value.values() if isinstance(value, dict) else [value]
        bounds.spend(steps_of(value))
    numbers = [abs(x) for x in given if type(x) is int]
    if is_nested and max(numbers, default=0) > MAX_CHARACTERS:
        check_characters(max(numbers))
    longest = max((8 * steps_of(x) for x in given), default=0)
    if longest > 10_000:
        check_characters(text.count(sign) * longest // 2)


def replaced(bounds: Bounds, function: Callable[..., Any], args: tuple[Any, ...]) -> Callable[..., Any]:
    """Return a function of Python, or what does the same by guarded steps.

    Args:
        bounds: counts the steps.
        function: one whose result may be far larger than its arguments.
        args: what it will be given.

    Raises:
        TooLarge: it would make too much.
    """
    name = function.__name__
    whole = [abs(x) for x in args if isinstance(x, int)]
    if name == "sum" and len(args) > 1 and not isinstance(args[1], (int, float, complex)):
        return lambda items, start: _folded(bounds.plus, items, start)
    if name == "prod":
        return lambda items, *, start=1: _folded(bounds.times, items, start)
    if name == "lcm" and sum(x.bit_length() for x in whole) > MAX_BITS:
        raise excess("an integer", MAX_BITS, "bits")
    if name in ("factorial", "comb", "perm") and max(whole, default=0) > _MAX_FACTORIAL:
        raise TooLarge(f"it calls {name}() with more than {_MAX_FACTORIAL:,}")
    if name == "round" and len(args) > 1 and isinstance(args[0], int) and whole and whole[-1] > _MAX_DIGITS:
        raise TooLarge(f"it rounds to more than {_MAX_DIGITS:,} digits")
    return function


def _folded(operation: Callable[[Any, Any], Any], items: Iterable[Any], start: Any) -> Any:
    if isinstance(start, str):
        raise TypeError("sum() can't sum strings [use ''.join(seq) instead]")
    for item in items:
        start = operation(start, item)
    return start
