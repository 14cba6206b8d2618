"""Opacity and emission of COLLADA effects; trimesh reads only the fourth number of ``<transparent>``."""

from typing import Any
from xml.etree import ElementTree

import numpy as np

BEGIN, END = b"<library_effects", b"</library_effects>"
LUMINANCE = (0.212671, 0.71516, 0.072169)
"""Weights of red, green and blue in the opacity of the modes ``RGB_ZERO`` and ``RGB_ONE`` (COLLADA 1.5, page 304)."""


def plain_effects(content: bytes) -> bytes:
    """Return a file with the opacity of effects in ``<transparent>``, and their emission in the diffuse colour.

    An effect whose opacity is a texture gets an emission other than black, as a mark for `has_texture_opacity`. Other
    content is kept.
    """
    begin, end = content.find(BEGIN), content.rfind(END)
    if begin < 0 or end < begin:
        return content
    section = content[begin : end + len(END)]
    try:
        root = ElementTree.fromstring(section)
    except ElementTree.ParseError:  # the reader reports it
        return content
    changes = [_change(shading) for shading in root.iterfind(".//technique/*")]
    if not any(changes):
        return content
    return content[:begin] + ElementTree.tostring(root) + content[end + len(END) :]


def has_texture_opacity(material: Any) -> bool:
    """Whether the opacity of a material that trimesh read from a `plain_effects` file is a texture."""
    emission = getattr(material, "emissiveFactor", None)
    return emission is not None and bool(np.any(emission))


def _change(shading: ElementTree.Element) -> bool:
    before = ElementTree.tostring(shading)
    emission = _numbers(shading, "emission/color")
    if emission is not None and any(emission[:3]):
        diffuse = shading.find("diffuse")
        if diffuse is None:
            diffuse = ElementTree.SubElement(shading, "diffuse")
            ElementTree.SubElement(diffuse, "color").text = "0 0 0 1"
        color = _numbers(diffuse, "color")
        written = diffuse.find("color")
        if written is not None and color is not None:
            lit = [min(1.0, a + b) for a, b in zip(color[:3], emission, strict=False)]
            written.text = " ".join(map(str, (*lit, *color[3:])))
    is_texture = shading.find("transparent/texture") is not None
    if is_texture or (emission is not None and any(emission[:3])):
        for written in shading.findall("emission"):
            shading.remove(written)
    if is_texture:
        ElementTree.SubElement(ElementTree.SubElement(shading, "emission"), "color").text = "1 1 1 1"
    transparent, transparency = shading.find("transparent"), shading.find("transparency")
    color, factor = _numbers(shading, "transparent/color"), _numbers(shading, "transparency/float")
    if (transparent is None or color is not None) and (transparency is None or factor is not None):
        mode = "A_ONE" if transparent is None else transparent.get("opaque", "A_ONE")
        opacity = _opacity(color or [1.0] * 4, factor[0] if factor else 1.0, mode)
        if transparent is not None:
            shading.remove(transparent)
        if transparent is not None or opacity < 1.0:
            transparent = ElementTree.SubElement(shading, "transparent")
            ElementTree.SubElement(transparent, "color").text = f"1 1 1 {opacity}"
    return before != ElementTree.tostring(shading)


def _opacity(color: list[float], factor: float, mode: str) -> float:
    """Return the opacity; one instead of zero, because some programs write the opposite and no robot is invisible."""
    part = color[3] if mode.startswith("A") else sum(a * b for a, b in zip(LUMINANCE, color, strict=False))
    opacity = min(1.0, max(0.0, part * factor))
    if mode.endswith("ZERO"):
        opacity = 1.0 - opacity
    return opacity if opacity > 1e-3 else 1.0


def _numbers(element: ElementTree.Element, path: str) -> list[float] | None:
    """Return the numbers of an inner element, four for a colour; None without any."""
    found = element.find(path)
    try:
        numbers = [float(each) for each in (found.text or "").split()] if found is not None else []
    except ValueError:
        return None
    if path.endswith("color") and numbers:
        numbers = [*numbers, 1.0][:4] if len(numbers) >= 3 else []
    return numbers or None
