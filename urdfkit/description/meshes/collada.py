"""Bounding boxes of COLLADA files: of all vertices of the geometries in the scene, whether a face uses them or not.

Of the long texts of numbers, only those with the positions of vertices are read, or a part of each.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from urdfkit.description.meshes.collada_outline import Outline, outline_of
from urdfkit.description.meshes.format_faults import dae_fault
from urdfkit.description.meshes.node_transforms import AffineTransform, moved
from urdfkit.description.meshes.points import UnusualFileError, corners_of_columns, part, union
from urdfkit.description.meshes.unchanged_files import remembered

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from typing import BinaryIO
    from xml.etree.ElementTree import Element

    from urdfkit.description.meshes.points import Corners

PARTS = 128
"""Parts of a text that a sample reads, evenly distributed."""
PART = 120
"""Bytes of a part."""

_READ = ("triangles", "polylist", "polygons")
_UNUSUAL = re.compile(
    rb"<!DOCTYPE|<!ENTITY|<\w*:?(?:instance_node|instance_controller|lookat|skew|trifans|tristrips|morph|lines\w*)\b"
)
_PICTURE = re.compile(rb"<init_from>\s*([^<]+?)\s*</init_from>")
_PLACEHOLDER = re.compile(rb">\s*@\d")
"""Matches the placeholder of a long text, and a short text that looks like one."""

_MOST_NODES = 20_000


class _Positions(NamedTuple):
    """Positions of vertices: where their text is, how many there are, and numbers for each."""

    start: int
    end: int
    vertices: int
    stride: int


class Contents(NamedTuple):
    """Contents of a COLLADA file without its numbers.

    Attributes:
        shapes: positions of the vertices of each geometry in the scene, with the transform of its node; empty if the
            file is not valid, or uses features that are not read here, such as controllers.
        unit: length of a unit [m].
        fault: fault of the vertices; empty if none is found.
        pictures: names of images.
    """

    shapes: tuple[tuple[_Positions, AffineTransform], ...]
    unit: float
    fault: str
    pictures: tuple[str, ...]


@remembered
def contents(path: Path) -> Contents:
    """Return the contents of a file. Each rule that needs some of them gets them from one reading."""
    content = path.read_bytes()
    outline = outline_of(content)
    names = _PICTURE.findall(outline.skeleton)
    names = [content[slice(*outline.texts[name])] if name in outline.texts else name for name in names]
    pictures = tuple(name.decode(errors="replace").strip() for name in names)
    try:
        shapes, unit = _shapes(outline)
    except UnusualFileError:
        shapes, unit = (), 1.0
    return Contents(shapes, unit, dae_fault(content, outline), pictures)


def corners(path: Path, *, estimated: bool = False) -> Corners:
    """Return the corners of the bounding box [m].

    Args:
        path: the file.
        estimated: read only a sample of the vertices of large geometries.

    Raises:
        UnusualFileError: the file is not valid, or uses features that are not read here, such as controllers.
        OSError: the file cannot be read.
    """
    found = contents(path)
    columns: dict[_Positions, list[list[float]]] = {}
    boxes: list[Corners] = []
    with path.open("rb", buffering=0) as file:
        for positions, transform in found.shapes:
            if positions not in columns:
                try:
                    columns[positions] = _columns(file, positions, estimated)
                except ValueError as error:
                    raise UnusualFileError from error
            boxes.append(_moved(columns[positions], transform))
    low, high = union(boxes)
    return tuple(x * found.unit for x in low), tuple(x * found.unit for x in high)  # type: ignore[return-value]


def _shapes(outline: Outline) -> tuple[tuple[tuple[_Positions, AffineTransform], ...], float]:
    """Return the positions of each geometry in the scene, with the transform of its node, and the unit."""
    from xml.etree.ElementTree import ParseError, fromstring

    is_ambiguous = len(_PLACEHOLDER.findall(outline.skeleton)) > len(outline.texts)
    if is_ambiguous or _UNUSUAL.search(outline.skeleton):
        raise UnusualFileError
    try:
        root = fromstring(outline.skeleton)
        named = {"#" + name: element for element in root.iter() if (name := element.get("id"))}
        instance = next(_all(root, "instance_visual_scene"))
        shapes = [
            (positions, transform)
            for geometry, transform in _instances(named[instance.attrib["url"]])
            for positions in _positions(named[geometry], named, outline)
        ]
    except (ParseError, LookupError, ValueError, StopIteration, RuntimeError) as error:
        raise UnusualFileError from error
    return tuple(shapes), _unit(root)


def _all(element: Element, tag: str) -> Iterator[Element]:
    return (inner for inner in element.iter() if _tag(inner) == tag)


def _tag(element: Element) -> str:
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def _unit(root: Element) -> float:
    """Return the length of a unit [m]."""
    asset = next((child for child in root if _tag(child) == "asset"), None)
    for unit in () if asset is None else _all(asset, "unit"):
        try:
            factor = float(unit.get("meter", "1"))
        except ValueError:
            return 1.0
        return factor if 0.0 < factor < float("inf") else 1.0
    return 1.0


def _instances(scene: Element) -> Iterator[tuple[str, AffineTransform]]:
    """Yield the URL of each geometry in a scene, with its transform."""
    pending = [(scene, AffineTransform.identity())]
    for node, above in pending:  # the list grows during the iteration
        if len(pending) > _MOST_NODES:
            raise UnusualFileError
        transform = above
        for child in node:
            tag = _tag(child)
            numbers = [float(word) for word in (child.text or "").split()] if tag in _TRANSFORMS else []
            if len(numbers) != _TRANSFORMS.get(tag, 0):
                raise UnusualFileError
            if tag == "matrix":
                transform @= AffineTransform.of_rows([numbers[0:4], numbers[4:8], numbers[8:12]])
            elif tag == "rotate":
                transform @= AffineTransform.turned(numbers[:3], numbers[3])
            elif tag == "translate":
                rows = AffineTransform.identity().rows
                transform @= AffineTransform.of_rows(
                    [[*row[:3], offset] for row, offset in zip(rows, numbers, strict=True)]
                )
            elif tag == "scale":
                x, y, z = numbers
                transform @= AffineTransform.of_rows([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]])
        for child in node:
            if _tag(child) == "node":
                pending.append((child, transform))
            elif _tag(child) == "instance_geometry":
                yield child.attrib["url"], transform


_TRANSFORMS = {"matrix": 16, "rotate": 4, "translate": 3, "scale": 3}
"""Tag → numbers in its text."""


def _positions(geometry: Element, named: dict[str, Element], outline: Outline) -> Iterator[_Positions]:
    """Yield the positions of the vertices that the faces of a geometry use."""
    for primitive in geometry.iter():
        if _tag(primitive) not in _READ:
            continue
        if primitive.get("count") == "0":
            raise UnusualFileError
        vertices = next(one for one in _all(primitive, "input") if one.get("semantic") == "VERTEX")
        inputs = _all(named[vertices.attrib["source"]], "input")
        source = named[next(one for one in inputs if one.get("semantic") == "POSITION").attrib["source"]]
        accessor, array = next(_all(source, "accessor")), next(_all(source, "float_array"))
        span = outline.texts.get((array.text or "").strip().encode())
        count, stride = int(accessor.attrib["count"]), int(accessor.get("stride", "1"))
        if span is None or stride < 3 or accessor.get("offset", "0") != "0":
            raise UnusualFileError  # fewer vertices than libraries take to load, or an unusual layout
        yield _Positions(*span, count, stride)


def _columns(file: BinaryIO, positions: _Positions, estimated: bool) -> list[list[float]]:
    """Return x, y and z of all vertices, or of a sample."""
    text = part(file, positions.start, positions.end - positions.start).strip()
    stride, length = positions.stride, positions.vertices * positions.stride
    if estimated and len(text) > 2 * PARTS * PART and (words := _sample(text, length, stride)):
        numbers = list(map(float, words))
    else:
        numbers = list(map(float, text.split()))
        if len(numbers) < length:
            raise UnusualFileError
        del numbers[length:]
    return [numbers[axis::stride] for axis in range(3)]


def _sample(text: bytes, length: int, stride: int) -> list[bytes]:
    """Return the numbers of some vertices; none where it is not known which number of the text is an x.

    Exporters write one white space between numbers, so the number of spaces is the index of the next number.
    """
    found: list[bytes] = []
    counted = position = 0
    spaces = [space for space in (b" ", b"\n", b"\t", b"\r") if space in text]
    for n in range(PARTS if spaces else 0):
        start = text.find(spaces[0], n * len(text) // PARTS) + 1 if n else 0
        if n and not start:
            return []
        counted += sum(text.count(space, position, start) for space in spaces)
        position = start
        words = text[start : start + PART].split()[:-1]  # the last one may be cut off
        first = -counted % stride
        found += words[first : first + (len(words) - first) // stride * stride]
    counted += sum(text.count(space, position) for space in spaces)
    return found if counted == length - 1 else []


def _moved(columns: list[list[float]], transform: AffineTransform) -> Corners:
    try:
        return moved(corners_of_columns(columns), transform)
    except UnusualFileError:  # a part that is turned
        return corners_of_columns(
            [[a * x + b * y + c * z + d for x, y, z in zip(*columns, strict=True)] for a, b, c, d in transform.rows]
        )
