"""Requests of a page, and the checks on their values.

A request has a name and values; a table of `Schema` defines the accepted ones. Checked values are bounded and finite.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from urdfkit.errors import did_you_mean
from urdfkit.view.protocol.websocket_messages import MAX_MAGNITUDE, MAX_NAME, ProtocolError, RawRequest

Check = Callable[[Any], Any]
"""Returns the checked value; raises `ProtocolError` if it is invalid."""

DEPTH = 12
"""Maximum nesting of a message."""


@dataclass(frozen=True, slots=True)
class Schema:
    """The values that a request accepts.

    Attributes:
        values: name → check of a required value.
        optional: name → check of an optional value.
        changes: whether the request changes the simulation; while one page drives, other pages may not.
    """

    values: Mapping[str, Check] = field(default_factory=dict)
    optional: Mapping[str, Check] = field(default_factory=dict)
    changes: bool = True


@dataclass(frozen=True, slots=True)
class Request:
    """A checked request.

    Attributes:
        client: the page that waits for the answer.
        number: number of the request, counted by that page.
        name: name of the request.
        values: the values, as the checks of its `Schema` returned them.
    """

    client: int
    number: int
    name: str
    values: dict[str, Any]


def check(table: Mapping[str, Schema], client: int, raw: RawRequest) -> Request:
    """Check a request of a page.

    Raises:
        ProtocolError: the request is unknown, or a value is missing, unknown or invalid.
    """
    schema = table.get(raw.name)
    if schema is None:
        raise ProtocolError(f"unknown request `{raw.name}`{did_you_mean(raw.name, table)}")
    checks = {**schema.values, **schema.optional}
    for name in raw.values:
        if name not in checks:
            raise ProtocolError(f"`{raw.name}` has no value `{name}`{did_you_mean(name, checks)}")
    for name in schema.values:
        if name not in raw.values:
            raise ProtocolError(f"{_words(raw.name)}: the {_words(name)} is missing")
    values = {}
    for name, value in raw.values.items():
        try:
            values[name] = checks[name](value)
        except ProtocolError as error:
            raise ProtocolError(f"{_words(name)}: {error}") from None
    return Request(client, raw.number, raw.name, values)


def _words(name: str) -> str:
    """Return the name of a request or value with spaces instead of underscores."""
    return name.replace("_", " ")


def number(least: float = -MAX_MAGNITUDE, most: float = MAX_MAGNITUDE, *, unit: str = "") -> Check:
    """Return a check for a finite number within these bounds; `unit` is the unit in error messages."""

    def read(value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
            raise ProtocolError(f"{_shown(value)} is not a number, such as {_plain(max(0.5, least), unit)}")
        _require_within(value, least, most, unit)
        return float(value)

    return read


def whole(least: int = 0, most: int = 2**31, *, unit: str = "") -> Check:
    """Return a check for an integer within these bounds."""

    def read(value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int):
            raise ProtocolError(f"{_shown(value)} is not an integer, such as {_plain(max(1, least), unit)}")
        _require_within(value, least, most, unit)
        return value

    return read


def _require_within(value: float, least: float, most: float, unit: str) -> None:
    if value < least:
        raise ProtocolError(f"{_plain(value, unit)} is too small; the minimum is {_plain(least, unit)}")
    if value > most:
        raise ProtocolError(f"{_plain(value, unit)} is too large; the maximum is {_plain(most, unit)}")


def _plain(value: float, unit: str) -> str:
    return f"{value:g} {unit}".rstrip()


def _shown(value: Any) -> str:
    """Return a value for a message, shortened, with control characters escaped."""
    return f"“{ascii(value)[:40]}”" if not isinstance(value, str) else f"“{ascii(value[:40])[1:-1]}”"


def text(most: int = MAX_NAME) -> Check:
    """Return a check for a text without control characters."""

    def read(value: Any) -> str:
        if (
            not isinstance(value, str)
            or len(value) > most
            or any(ord(each) < 32 and each not in "\n\t" for each in value)
        ):
            raise ProtocolError(f"{_shown(value)} is not a string of at most {most} characters")
        return str(value)

    return read


def flag(value: Any) -> bool:
    """Return a boolean."""
    if not isinstance(value, bool):
        raise ProtocolError(f"{_shown(value)} is neither true nor false")
    return value


def choice(*names: str) -> Check:
    """Return a check for one of these texts."""

    def read(value: Any) -> str:
        if value not in names or not isinstance(value, str):
            near = did_you_mean(value, names) if isinstance(value, str) else ""
            raise ProtocolError(f"{_shown(value)} is not one of {', '.join(names)}{near}")
        return value

    return read


def numbers(least: int, most: int | None = None, *, bound: float = MAX_MAGNITUDE, unit: str = "") -> Check:
    """Return a check for a list of `least` to `most` finite numbers."""
    return listing(number(-bound, bound, unit=unit), least, least if most is None else most, "numbers")


def listing(each: Check, least: int, most: int, what: str = "entries") -> Check:
    """Return a check for a list of `least` to `most` entries."""

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
            raise ProtocolError(f"{_shown(value)} is not an object with {', '.join(fields)}")
        found = {}
        for name, check in fields.items():
            try:
                found[name] = check(value[name])
            except ProtocolError as error:
                raise ProtocolError(f"{_words(name)}: {error}") from None
        return found

    return read


def tree(value: Any) -> Any:
    """Return any JSON value that is not nested deeper than `DEPTH`."""
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
