"""What stands in for values that could not be evaluated, and how xacro's tables are made to yield it."""

from __future__ import annotations

from collections.abc import Callable

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


class Unknown(str):
    """The value of what could not be evaluated; its text is the expression."""

    __slots__ = ()


class FallbackSymbols(dict[str, object]):
    """xacro's global symbols, which ask somebody for what is not there.

    Args:
        symbols: xacro's own.
        missing: called with the name; may raise KeyError.
    """

    def __init__(self, symbols: dict[str, object], missing: Callable[[str], Any]) -> None:
        super().__init__(symbols)
        self._missing = missing

    def __missing__(self, name: str) -> Any:
        return self._missing(name)


def peek(table: Any, name: str) -> Any:
    """Return the value of a name in a chain of xacro's tables, None when it is not there."""
    while table is not None and hasattr(table, "parent"):
        if dict.__contains__(table, name):
            return table[name]
        table = table.parent
    return None
