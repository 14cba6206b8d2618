"""Calls of macros that pass the length of a part as its radius, and the radius as its length."""

from __future__ import annotations

import re

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Expansion
from urdfkit.lint.model.model import Model

_RADIUS = ("r", "radius")
_LENGTH = ("h", "l", "w", "height", "length", "len", "thickness", "width")

_SIZE = re.compile(r"(.*?)(?:\b|_)(height|length|radius|thickness|width)\W*")
"""Matches an expression that is the size of a part; the first group is the part."""


def swapped_arguments(model: Model, element: Element) -> tuple[Expansion, str, str] | None:
    """Return the macro call of an element that swaps radius and length, with the names of both arguments.

    Both values have to be sizes of the same part, such as ``${wheel_width}`` and ``${wheel_radius}``.
    """
    for call in element.origin.expansions:
        tag = model.tag(call.position)
        attributes = tag.attributes if tag is not None else {}
        radii = [name for name in attributes if name.rpartition("_")[2] in _RADIUS]
        lengths = [name for name in attributes if name.rpartition("_")[2] in _LENGTH]
        sizes = [_size(attributes[name].value) for name in (*radii, *lengths)]
        if len(radii) == len(lengths) == 1 and None not in sizes:
            (part, radius), (other, length) = sizes[0] or ("", ""), sizes[1] or ("", "")
            if part == other and radius != "radius" and length == "radius":
                return call, radii[0], lengths[0]
    return None


def _size(text: str) -> tuple[str, str] | None:
    """Return the part and the size that a value is; None for calculations."""
    written = re.fullmatch(r"\s*\$\{\s*([\w.\[\]'\"]+)\s*\}\s*", text)
    found = _SIZE.fullmatch(written[1]) if written else None
    return (found[1], found[2]) if found else None
