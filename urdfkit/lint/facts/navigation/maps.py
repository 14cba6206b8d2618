"""Defects of the YAML files of maps.

Sources: ros-navigation/navigation2 (nav2_map_server/src/map_io.cpp), ros-planning/navigation (map_server/src/main.cpp).
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.yaml_tree import Node, documents, number_of

_KEYS = ("image", "resolution", "origin", "occupied_thresh", "free_thresh")
_MODES = ("trinary", "scale", "raw")
_TURN = 6.3
_RESOLUTIONS = (0.01, 0.02, 0.025, 0.05, 0.1, 0.2)
"""Lengths of a pixel that maps have, in m."""

_NEAR = 0.01
"""Share by which the centre of a map may differ from its origin: a few pixels."""

_FACTOR = 1.5
"""Factor between two lengths of a pixel from which on one of them is wrong."""

_IMAGES = ("*.pgm", "*.png", "*.bmp")


def map_defects(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the missing image, the unknown mode and the impossible numbers of a map."""
    for root in documents(source) if "occupied_thresh" in source.text else ():
        image, resolution, origin, occupied, free = (root.find(key) for key in _KEYS)
        if image is None or resolution is None or occupied is None or free is None:
            continue
        folder = Path(source.file).absolute().parent
        is_relative = image.text and not image.text.startswith(("/", "~", "$"))
        # Without any image in the folder, this is a copy without large files.
        images = [file.name for pattern in _IMAGES for file in sorted(folder.glob(pattern))] if is_relative else []
        if images and not is_file(folder / image.text):
            yield (
                image,
                f"image `{image.text}` of the map does not exist" + Suggestion(nearest(image.text, images), image.text),
            )
        mode = root.find("mode")
        if mode is not None and mode.text and mode.text not in _MODES:
            hint = Suggestion(nearest(mode.text, _MODES), mode.text) or f"; write one of {', '.join(_MODES)}"
            yield mode, f"unknown `mode` `{mode.text}` of the map" + hint
        if (
            is_relative
            and resolution.is_plain
            and origin is not None
            and (centred := _centred(folder / image.text, origin))
        ):
            number = number_of(resolution) or 0.0
            if number > 0.0 and not 1.0 / _FACTOR < number / centred < _FACTOR:
                message = f"`resolution` is {number:g} m per pixel, but `origin` is half of the image size for"
                yield resolution, f"{message} {centred:g} m per pixel"
        length, low, high = number_of(resolution), number_of(free), number_of(occupied)
        if origin is not None and origin.kind == "list" and len(origin.items) != 3:
            yield origin, f"`origin` of the map has {len(origin.items)} values; write x, y and yaw"
        elif origin is not None and origin.items and abs(number_of(origin.items[2]) or 0.0) > _TURN:
            yield origin.items[2], f"yaw of the map is {origin.items[2].text} rad, more than one full turn"
        negate = root.find("negate")
        if negate is not None and negate.kind == "text" and negate.text.lower() not in ("0", "1", "true", "false"):
            yield negate, f"`negate` of the map is `{negate.text}`; write 0 or 1"
        if length is not None and length <= 0.0:
            yield resolution, f"`resolution` is {length:g} m; it must be positive"
        if low is not None and high is not None and low > high:
            yield free, f"`free_thresh` is {low:g}, more than `occupied_thresh`, {high:g}"


def _centred(image: Path, origin: Node) -> float:
    """Return the resolution with which the origin of the map would be its centre; 0 if it is not in `_RESOLUTIONS`."""
    x, y = (number_of(item) or 0.0 for item in origin.items[:2]) if len(origin.items) == 3 else (0.0, 0.0)
    width, height = _size(image) if x < 0.0 and y < 0.0 else (0, 0)
    if not width or not height:
        return 0.0
    found, other = -2.0 * x / width, -2.0 * y / height
    near = next((each for each in _RESOLUTIONS if abs(found - each) < _NEAR * each), 0.0)
    return near if abs(other - near) < _NEAR * near else 0.0


def _size(image: Path) -> tuple[int, int]:
    """Return width and height of an image in pixels, from its first bytes; zeros for other files."""
    try:
        with image.open("rb") as file:
            head = file.read(512) if is_file(image) else b""
    except OSError:
        return 0, 0
    if head.startswith(b"\x89PNG"):
        width, height = struct.unpack(">2I", head[16:24]) if len(head) >= 24 else (0, 0)
        return width, height
    if head.startswith(b"BM"):
        width, height = struct.unpack("<2i", head[18:26]) if len(head) >= 26 else (0, 0)
        return width, abs(height)
    sizes = re.match(rb"P[25](?:\s|#[^\n]*\n)+(\d{1,6})(?:\s|#[^\n]*\n)+(\d{1,6})\s", head)
    return (int(sizes[1]), int(sizes[2])) if sizes is not None else (0, 0)
