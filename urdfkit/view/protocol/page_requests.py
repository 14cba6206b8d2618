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
from urdfkit.view.protocol.websocket_messages import MAX_MAGNITUDE, MAX_NAME, Do, ProtocolError

Check = Callable[[Any], Any]
"""Returns a value as it is to be used; raises `ProtocolError` where it makes no sense."""

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
            raise ProtocolError(f"{_words(wish.order)}: the {_words(name)} is missing")
    found = {}
    for name, value in wish.values.items():
        try:
            found[name] = known[name](value)
        except ProtocolError as error:
            raise ProtocolError(f"{_words(name)}: {error}") from None
    return Order(client, wish.number, wish.order, found)


def _words(name: str) -> str:
    """Return the name of an order or value as people say it."""
    return name.replace("_", " ")


def number(least: float = -MAX_MAGNITUDE, most: float = MAX_MAGNITUDE, *, unit: str = "") -> Check:
    """Return a check for a finite number in these bounds; `unit` is what it is counted in, for who is told."""

    def read(value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
            raise ProtocolError(f"{_shown(value)} is no number, such as {_plain(max(0.5, least), unit)}")
        _require_within(value, least, most, unit)
        return float(value)

    return read


def whole(least: int = 0, most: int = 2**31, *, unit: str = "") -> Check:
    """Return a check for a whole number in these bounds."""

    def read(value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int):
            raise ProtocolError(f"{_shown(value)} is no whole number, such as {_plain(max(1, least), unit)}")
        _require_within(value, least, most, unit)
        return value

    return read


def _require_within(value: float, least: float, most: float, unit: str) -> None:
    if value < least:
        raise ProtocolError(f"{_plain(value, unit)} is too little; the least is {_plain(least, unit)}")
    if value > most:
        raise ProtocolError(f"{_plain(value, unit)} is too much; the most is {_plain(most, unit)}")


def _plain(value: float, unit: str) -> str:
    return f"{value:g} {unit}".rstrip()


def _shown(value: Any) -> str:
    """Return a value as it was written, not too long, without what a terminal would act on."""
    return f"“{ascii(value)[:40]}”" if not isinstance(value, str) else f"“{ascii(value[:40])[1:-1]}”"


def text(most: int = MAX_NAME) -> Check:
    """Return a check for a text without control characters."""

    def read(value: Any) -> str:
        if (
            not isinstance(value, str)
            or len(value) > most
            or any(ord(each) < 32 and each not in "\n\t" for each in value)
        ):
            raise ProtocolError(f"{_shown(value)} is no text of at most {most} characters")
        return str(value)

    return read


def flag(value: Any) -> bool:
    """Return a truth value."""
    if not isinstance(value, bool):
        raise ProtocolError(f"{_shown(value)} is neither true nor false")
    return value


def choice(*names: str) -> Check:
    """Return a check for one of these texts."""

    def read(value: Any) -> str:
        if value not in names or not isinstance(value, str):
            near = did_you_mean(value, names) if isinstance(value, str) else ""
            raise ProtocolError(f"{_shown(value)} is none of {', '.join(names)}{near}")
        return value

    return read


def numbers(least: int, most: int | None = None, *, bound: float = MAX_MAGNITUDE, unit: str = "") -> Check:
    """Return a check for a list of so many finite numbers."""
    return listing(number(-bound, bound, unit=unit), least, least if most is None else most, "numbers")


def listing(each: Check, least: int, most: int, what: str = "entries") -> Check:
    """Return a check for a list of so many entries."""

    def read(value: Any) -> list[Any]:
        if not isinstance(value, list) or not least <= len(value) <= most:
            count = str(least) if least == most else f"{least} to {most}"
            found = f"{len(value)} {what}" if isinstance(value, list) else _shown(value)
            raise ProtocolError(f"{found} instead of a list of {count} {what}")
        return [each(entry) for entry in value]

    return read


def record(**fields: Check) -> Check:
    """Return a check for an object with exactly these fields."""

    def read(value: Any) -> dict[str, Any]:
        if not isinstance(value, dict) or value.keys() != fields.keys():
            raise ProtocolError(f"{_shown(value)} is no object with {', '.join(fields)}")
        found = {}
        for name, check in fields.items():
            try:
                found[name] = check(value[name])
            except ProtocolError as error:
                raise ProtocolError(f"{_words(name)}: {error}") from None
        return found

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
