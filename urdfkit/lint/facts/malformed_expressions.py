"""Malformed expressions that xacro copies without evaluation."""

import re

_INSIDE_OUT = r"\{\$(?<!\$\{\$)(?!\()[^{}]*\}"
_BROKEN = r"\$(?: +\{[^{}]*\}|\\\{|\{(?<!\$\$\{)[^{}\"'<>]*(?=[\"'<>]|\Z))"
"""``{$…}``; ``$ {…}``, ``$\\{`` and ``${…`` without end. Each pattern begins with a literal, for a fast search."""

_ODD = frozenset("{\"'<>")
_SWAPPED = r"(?:(?<!\$)\{\$(?!\()|\$ +\{)([^{}]*)\}"


def is_unexpanded(text: str) -> bool:
    """Return whether a value or a file contains an expression that xacro does not evaluate."""
    return (
        "$" in text
        and not _is_complete(text)
        and (re.search(_BROKEN, text) or re.search(_INSIDE_OUT, text)) is not None
    )


def _is_complete(text: str) -> bool:
    """Return whether every ``$`` begins a complete expression; a quick test before the patterns."""
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


def correct_escapes(text: str) -> str:
    """Return the text with ``${…}`` for ``{$…}`` and ``$ {…}``."""
    return re.sub(_SWAPPED, r"${\1}", text)
