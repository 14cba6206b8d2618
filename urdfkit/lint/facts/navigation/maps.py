"""Defects of the YAML files of maps.

Sources: ros-navigation/navigation2 (nav2_map_server/src/map_io.cpp), ros-planning/navigation (map_server/src/main.cpp).
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.existence import is_file
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest, suggestion
from urdfkit.lint.facts.control.yaml_tree import Node, documents, number_of

_KEYS = ("image", "resolution", "origin", "occupied_thresh", "free_thresh")
_MODES = ("trinary", "scale", "raw")
_IMAGES = ("*.pgm", "*.png", "*.bmp")


def map_defects(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the missing image, the unknown mode and the impossible numbers of a map."""
    for root in documents(source)[0] if "occupied_thresh" in source.text else ():
        image, resolution, _, occupied, free = (root.find(key) for key in _KEYS)
        if image is None or resolution is None or occupied is None or free is None:
            continue
        folder = Path(source.file).absolute().parent
        is_relative = image.text and not image.text.startswith(("/", "~", "$"))
        # Without any image in the folder, this is a copy without large files.
        images = [file.name for pattern in _IMAGES for file in sorted(folder.glob(pattern))] if is_relative else []
        if images and not is_file(folder / image.text):
            yield image, f"image `{image.text}` of the map does not exist{suggestion(nearest(image.text, images))}"
        mode = root.find("mode")
        if mode is not None and mode.text and mode.text not in _MODES:
            hint = suggestion(nearest(mode.text, _MODES)) or f"; write one of {', '.join(_MODES)}"
            yield mode, f"unknown `mode` `{mode.text}` of the map{hint}"
        length, low, high = number_of(resolution), number_of(free), number_of(occupied)
        if length is not None and length <= 0.0:
            yield resolution, f"`resolution` is {length:g} m; it must be positive"
        if low is not None and high is not None and low > high:
            yield free, f"`free_thresh` is {low:g}, more than `occupied_thresh`, {high:g}"
