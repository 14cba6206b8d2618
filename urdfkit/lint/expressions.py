"""Expressions that are written so that xacro leaves them as they are."""

from __future__ import annotations

import re

UNEXPANDED = r"(?<!\$)\{\$(?!\()[^{}]*\}|\$ +\{[^{}]*\}|(?<!\$)\$\{[^{}\"'<>]*(?=[\"'<>]|\Z)|\$\\\{"
"""``{$…}``, ``$ {…}``, ``${…`` without end and ``$\\{``."""

_SWAPPED = r"(?:(?<!\$)\{\$(?!\()|\$ +\{)([^{}]*)\}"


def is_unexpanded(text: str) -> bool:
    """Whether a value, or a whole file, holds an expression that xacro does not evaluate."""
    return re.search(UNEXPANDED, text) is not None


def righted(text: str) -> str:
    """Return the text with ``${…}`` for ``{$…}`` and ``$ {…}``."""
    return re.sub(_SWAPPED, r"${\1}", text)
