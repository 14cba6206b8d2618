"""Expressions that are written so that xacro leaves them as they are."""

from __future__ import annotations

import re

_INSIDE_OUT = r"\{\$(?<!\$\{\$)(?!\()[^{}]*\}"
_BROKEN = r"\$(?: +\{[^{}]*\}|\\\{|\{(?<!\$\$\{)[^{}\"'<>]*(?=[\"'<>]|\Z))"
"""``{$…}``; ``$ {…}``, ``$\\{`` and ``${…`` without end. Both begin with a letter, so that they are found fast."""

_ODD = frozenset("{\"'<>")
_SWAPPED = r"(?:(?<!\$)\{\$(?!\()|\$ +\{)([^{}]*)\}"


def is_unexpanded(text: str) -> bool:
    """Whether a value, or a whole file, holds an expression that xacro does not evaluate."""
    return (
        "$" in text and not _is_sound(text) and (re.search(_BROKEN, text) or re.search(_INSIDE_OUT, text)) is not None
    )


def _is_sound(text: str) -> bool:
    """Whether every ``$`` surely begins an expression that ends; most texts are such, and need no patterns."""
    if "{$" in text:
        return False
    for piece in text.split("$")[1:]:
        if piece[:1] in (" ", "\\"):
            return False
        if piece[:1] == "{":
            inside, end, _ = piece[1:].partition("}")
            if not end or not _ODD.isdisjoint(inside):
                return False
    return True


def righted(text: str) -> str:
    """Return the text with ``${…}`` for ``{$…}`` and ``$ {…}``."""
    return re.sub(_SWAPPED, r"${\1}", text)
