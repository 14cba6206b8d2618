"""Bounding boxes of binary glTF files, which contain those of their vertices."""

from __future__ import annotations

import json

from urdfkit.description.meshes.node_transforms import AffineTransform, moved
from urdfkit.description.meshes.points import UnusualFileError, has_infinite, union

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.meshes.points import Corners

_TRIANGLES = (4, 5, 6)
"""Modes of primitives: triangles, strips and fans."""
_VERSION = b"\x02\0\0\0"
_MOST_NODES = 20_000


def corners(content: bytes) -> Corners:
    """Return the corners of the bounding box.

    Raises:
        UnusualFileError: the file is not valid, or a part of it is turned by an angle that is not a multiple of 90°.
    """
    length = int.from_bytes(content[12:16], "little")
    if content[:4] != b"glTF" or content[4:8] != _VERSION or content[16:20] != b"JSON" or 20 + length > len(content):
        raise UnusualFileError
    try:
        document = json.loads(content[20 : 20 + length])
        scene = document["scenes"][document.get("scene", 0)]
        return union(_boxes(document, scene["nodes"], content[28 + length :]))
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, RecursionError) as error:
        raise UnusualFileError from error


def _boxes(document: dict[str, Any], roots: list[int], stored: bytes) -> list[Corners]:
    found: list[Corners] = []
    pending = [(number, AffineTransform.identity()) for number in roots]
    for number, above in pending:  # the list grows during the iteration
        if len(pending) > _MOST_NODES:
            raise UnusualFileError
        node = document["nodes"][number]
        if "skin" in node or "extensions" in node:
            raise UnusualFileError
        placed = above @ _transform(node)
        pending += [(child, placed) for child in node.get("children", ())]
        if "mesh" in node:
            for primitive in document["meshes"][node["mesh"]]["primitives"]:
                if primitive.get("mode", 4) in _TRIANGLES:
                    accessor = document["accessors"][primitive["attributes"]["POSITION"]]
                    if not _are_finite(document, accessor, stored):
                        raise UnusualFileError
                    low, high = (tuple(map(float, accessor[name])) for name in ("min", "max"))
                    if len(low) != 3 or len(high) != 3 or "targets" in primitive:
                        raise UnusualFileError
                    found.append(moved((low, high), placed))
    return found


def _are_finite(document: dict[str, Any], accessor: dict[str, Any], stored: bytes) -> bool:
    """Return whether the file contains the numbers of an accessor of positions, and all are finite."""
    view = document["bufferViews"][accessor["bufferView"]]
    if "uri" in document["buffers"][view["buffer"]]:
        return False
    first, stride = view.get("byteOffset", 0) + accessor.get("byteOffset", 0), view.get("byteStride", 12)
    end = first + stride * (accessor["count"] - 1) + 12
    return end <= len(stored) and not has_infinite(stored, first, end, stride)


def _transform(node: dict[str, Any]) -> AffineTransform:
    if "matrix" in node:
        columns = [node["matrix"][4 * k : 4 * k + 4] for k in range(4)]
        return AffineTransform.of_rows([[float(columns[k][row]) for k in range(4)] for row in range(3)])
    x, y, z, w = map(float, node.get("rotation", (0, 0, 0, 1)))
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    scale, origin = map(float, node.get("scale", (1, 1, 1))), map(float, node.get("translation", (0, 0, 0)))
    factors = list(scale)
    return AffineTransform.of_rows(
        [[*(row[k] * factors[k] for k in range(3)), offset] for row, offset in zip(rows, origin, strict=True)]
    )
