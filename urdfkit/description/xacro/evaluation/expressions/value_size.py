"""How large a value is, with everything in it: in steps, elements and characters."""

from __future__ import annotations

from urdfkit.description.xacro.evaluation.expressions.limits import (
    MAX_CHARACTERS,
    MAX_ELEMENTS,
    MAX_NESTING,
    TooLarge,
    excess,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

TEXTS = (str, bytes, bytearray)
_VIEWS: tuple[type, ...] = (type({}.keys()), type({}.values()), type({}.items()))
CONTAINERS = (list, tuple, set, frozenset, dict, *_VIEWS)


def steps_of(value: Any) -> int:
    """Return how many steps a value is, with everything in it.

    Raises:
        TooLarge: it has too many characters or elements, or is nested too deep.
    """
    total = 0
    level = [value]
    for _ in range(MAX_NESTING):
        below: list[Any] = []
        for one in level:
            total += 1
            if isinstance(one, TEXTS):
                check_characters(len(one))
                total += len(one) >> 3
            elif isinstance(one, int):
                total += one.bit_length() >> 8
            elif isinstance(one, range):
                total += len(one[: MAX_ELEMENTS + 1])
            elif isinstance(one, CONTAINERS):
                items: list[Any] = items_of(one)
                if total + len(below) + len(items) > MAX_ELEMENTS:
                    raise excess("lists", MAX_ELEMENTS, "elements in total")
                below += items
            if total > MAX_ELEMENTS:
                raise excess("lists", MAX_ELEMENTS, "elements in total")
        if not below:
            return total
        level = below
    raise TooLarge(f"it creates lists nested more than {MAX_NESTING} levels deep")


def items_of(container: Any) -> list[Any]:
    """Return the plain contents of a container, without the wrappers that xacro adds on access."""
    if isinstance(container, dict):
        return [*dict.keys(container), *dict.values(container)]
    return list(list.__iter__(container)) if isinstance(container, list) else list(container)


def check_characters(count: int) -> None:
    """Refuse a text that is too long.

    Raises:
        TooLarge: it is.
    """
    if count > MAX_CHARACTERS:
        raise excess("a string", MAX_CHARACTERS, "characters")


def check_widths(text: str) -> None:
    """Refuse a format string whose widths or precisions produce too many characters.

    Raises:
        TooLarge: it does.
    """
    import re

    check_characters(sum(int(digits[:9]) for digits in re.findall(r"\d+", text)))
