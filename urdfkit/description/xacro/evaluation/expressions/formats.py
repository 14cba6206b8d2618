"""Formats: ``str.format`` and f-strings over plain values, without access to attributes or items."""

from __future__ import annotations

from collections.abc import Callable
from string import Formatter

from urdfkit.description.xacro.evaluation.expressions.budget import Budget
from urdfkit.description.xacro.evaluation.expressions.value_size import check_characters, check_widths, steps_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_CONVERSIONS: dict[str, Callable[[Any], str]] = {"s": str, "r": repr, "a": ascii}


def formatted(budget: Budget, text: str, values: tuple[Any, ...], named: dict[str, Any]) -> str:
    """Return what ``text.format(*values, **named)`` returns.

    Args:
        budget: counts the steps.
        text: the format; a field names a position or an argument, never an attribute or an item.
        values: arguments by position.
        named: arguments by name.

    Raises:
        ValueError: a field names an attribute or item.
        TooLarge: the result is too long.
    """
    return _formatted(budget, text, values, named, _Numbers(), 2)


class _Numbers:
    """The numbers of fields without a name."""

    def __init__(self) -> None:
        self._automatic: int | None = None

    def position(self, name: str) -> int:
        """Return the position of the argument that a field means.

        Raises:
            ValueError: some fields are numbered and others are not.
        """
        if self._automatic is None:
            self._automatic = -1 if name else 0
        if (self._automatic < 0) != bool(name):
            raise ValueError("cannot switch between automatic field numbering and manual field specification")
        if name:
            return int(name)
        self._automatic += 1
        return self._automatic - 1


def _formatted(
    budget: Budget, text: str, values: tuple[Any, ...], named: dict[str, Any], numbers: _Numbers, depth: int
) -> str:
    if depth < 1:
        raise ValueError("Max string recursion exceeded")
    parts: list[str] = []
    length = 0
    for literal, name, specification, conversion in Formatter().parse(text):
        parts.append(literal)
        if name is not None:
            if "." in name or "[" in name:
                raise ValueError(f"the format field `{{{name}}}` reads an attribute or item, which is not supported")
            value = named[name] if name and not name.isdigit() else values[numbers.position(name)]
            inner = _formatted(budget, specification, values, named, numbers, depth - 1) if specification else ""
            parts.append(shown(budget, value, conversion, inner))
        length += sum(map(len, parts[-2:]))
        check_characters(length)
    return "".join(parts)


def shown(budget: Budget, value: Any, conversion: str | None, specification: str) -> str:
    """Return one value as a field of a format shows it.

    Raises:
        TooLarge: the text is too long.
    """
    budget.check_text(steps_of(value))
    if conversion is not None:
        value = _CONVERSIONS[conversion](value)
    check_widths(specification)
    return str(budget.checked(format(value, specification)))
