"""Expressions that are written so that xacro leaves them as they are."""

from __future__ import annotations

import re

_INSIDE_OUT = r"\{\$(?<!\$\{\$)(?!\()[^{}]*\}"
_BROKEN = r"\$(?: +\{[^{}]*\}|\\\{|\{(?<!\$\$\{)[^{}\"'<>]*(?=[\"'<>]|\Z))"
"""``{$…}``; ``$ {…}``, ``$\\{`` and ``${…`` without end. Both begin with a letter, so that they are found fast."""

_SWAPPED = r"(?:(?<!\$)\{\$(?!\()|\$ +\{)([^{}]*)\}"


def is_unexpanded(text: str) -> bool:
    """Whether a value, or a whole file, holds an expression that xacro does not evaluate."""
    return "$" in text and (re.search(_BROKEN, text) or re.search(_INSIDE_OUT, text)) is not None


def righted(text: str) -> str:
    """Return the text with ``${…}`` for ``{$…}`` and ``$ {…}``."""
    return re.sub(_SWAPPED, r"${\1}", text)
