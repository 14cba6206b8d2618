"""What a page may order, and the checks on every value of an order.

An order is a name and values; a table of `Schema` says what there is. Like everything that comes in, values are bounded
and finite before anybody else sees them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from urdfkit.errors import did_you_mean
from urdfkit.view.protocol import MAX_MAGNITUDE, MAX_NAME, Do, ProtocolError

Check = Callable[[Any], Any]
"""Returns a value as it is to be used; raises `ProtocolError` where it makes no sense."""

MAX_TEXT = 32 * 1024
"""Longest text in an order [characters]."""
DEPTH = 12
"""Deepest nesting of what is written freely."""


@dataclass(frozen=True, slots=True)
class Schema:
    """What an order takes.

    Attributes:
        values: name → check of what it needs.
        optional: name → check of what may be left out.
        changes: whether it changes something: while somebody drives, nobody else may.
    """

    values: Mapping[str, Check] = field(default_factory=dict)
    optional: Mapping[str, Check] = field(default_factory=dict)
    changes: bool = True


@dataclass(frozen=True, slots=True)
class Order:
    """A checked order.

    Attributes:
        client: the page that waits for the answer.
        number: of the order, that page's own.
        name: of the order.
        values: as its `Schema` returned them.
    """

    client: int
    number: int
    name: str
    values: dict[str, Any]


def check(table: Mapping[str, Schema], client: int, wish: Do) -> Order:
    """Return a page's wish as an order.

    Raises:
        ProtocolError: there is no such order, or a value is missing, unknown or makes no sense.
    """
    schema = table.get(wish.order)
    if schema is None:
        raise ProtocolError(f"no order `{wish.order}`{did_you_mean(wish.order, table)}")
    known = {**schema.values, **schema.optional}
    for name in wish.values:
        if name not in known:
            raise ProtocolError(f"`{wish.order}` takes no `{name}`{did_you_mean(name, known)}")
    for name in schema.values:
        if name not in wish.values:
            raise ProtocolError(f"`{wish.order}` needs `{name}`")
    found = {}
    for name, value in wish.values.items():
        try:
            found[name] = known[name](value)
        except ProtocolError as error:
            raise ProtocolError(f"`{name}` of `{wish.order}`: {error}") from None
    return Order(client, wish.number, wish.order, found)


def number(least: float = -MAX_MAGNITUDE, most: float = MAX_MAGNITUDE) -> Check:
    """Return a check for a finite number in these bounds."""

    def read(value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= most:
            raise ProtocolError(f"it must be a number from {least:g} to {most:g}")
        return float(value)

    return read


def whole(least: int = 0, most: int = 2**31) -> Check:
    """Return a check for a whole number in these bounds."""

    def read(value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            raise ProtocolError(f"it must be a whole number from {least} to {most}")
        return value

    return read


def text(most: int = MAX_NAME) -> Check:
    """Return a check for a text without control characters."""

    def read(value: Any) -> str:
        if (
            not isinstance(value, str)
            or len(value) > most
            or any(ord(each) < 32 and each not in "\n\t" for each in value)
        ):
            raise ProtocolError(f"it must be a text of at most {most} characters")
        return str(value)

    return read


def flag(value: Any) -> bool:
    """Return a truth value."""
    if not isinstance(value, bool):
        raise ProtocolError("it must be true or false")
    return value


def choice(*names: str) -> Check:
    """Return a check for one of these texts."""

    def read(value: Any) -> str:
        if value not in names or not isinstance(value, str):
            raise ProtocolError(f"it must be one of {', '.join(names)}")
        return value

    return read


def numbers(least: int, most: int | None = None, *, bound: float = MAX_MAGNITUDE) -> Check:
    """Return a check for a list of so many finite numbers."""
    return listing(number(-bound, bound), least, least if most is None else most)


def listing(each: Check, least: int, most: int) -> Check:
    """Return a check for a list of so many entries."""

    def read(value: Any) -> list[Any]:
        if not isinstance(value, list) or not least <= len(value) <= most:
            count = str(least) if least == most else f"{least} to {most}"
            raise ProtocolError(f"it must be a list of {count}")
        return [each(entry) for entry in value]

    return read


def record(**fields: Check) -> Check:
    """Return a check for an object with exactly these fields."""

    def read(value: Any) -> dict[str, Any]:
        if not isinstance(value, dict) or value.keys() != fields.keys():
            raise ProtocolError(f"it must be an object with {', '.join(fields)}")
        return {name: check(value[name]) for name, check in fields.items()}

    return read


def tree(value: Any) -> Any:
    """Return anything that JSON can say, not nested deeper than `DEPTH`."""
    _require_shallow(value, DEPTH)
    return value


def _require_shallow(value: Any, depth: int) -> None:
    if depth == 0:
        raise ProtocolError(f"it is nested deeper than {DEPTH}")
    if isinstance(value, float) and not math.isfinite(value):
        raise ProtocolError("it holds a number that is not finite")
    entries = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    for entry in entries:
        _require_shallow(entry, depth - 1)
