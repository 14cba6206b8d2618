"""Bounding boxes of STL files."""

from __future__ import annotations

import sys
from struct import Struct

from urdfkit.description.meshes.points import UnusualFileError, corners_of_columns, corners_of_numbers, part

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import BinaryIO

    from urdfkit.description.meshes.points import Corners

HEADER = 84
"""80 arbitrary bytes, then the number of triangles."""
SIZE = 50
"""Bytes of a triangle: normal and three corners of 32-bit numbers, two more bytes."""
SAMPLES = 160
"""Triangles of a sample, evenly distributed over the file, or parts of a text file."""
PART = 512
"""Bytes of each part of a text file."""

_SMALL = 40_000
"""Number of triangles below which importing numpy takes longer than reading the triangles."""


def is_binary(size: int, head: bytes) -> bool:
    """Return whether a file is valid binary STL: it contains its number of triangles, and perhaps more bytes."""
    return len(head) >= HEADER and 0 < _count(head) * SIZE <= size - HEADER


def _count(head: bytes) -> int:
    return int.from_bytes(head[80:HEADER], "little")


def corners(content: bytes) -> Corners:
    """Return the corners of the bounding box.

    Raises:
        UnusualFileError: the file is not valid.
    """
    if not is_binary(len(content), content[:HEADER]):
        words = _text_words(content)
        if len(words) % 9:
            raise UnusualFileError  # the last triangle is cut off
        return corners_of_numbers(words)
    if len(content) > HEADER + SIZE * _SMALL or "numpy" in sys.modules:
        try:
            return _with_numpy(content)
        except ImportError:
            pass
    return corners_of_columns(
        list(zip(*Struct("<12x9f2x").iter_unpack(content[HEADER : HEADER + SIZE * _count(content)]), strict=True))
    )


def _with_numpy(content: bytes) -> Corners:
    import numpy as np

    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    points = np.frombuffer(content, dtype=record, count=_count(content), offset=HEADER)["corners"]
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    if not (np.isfinite(low).all() and np.isfinite(high).all()):  # both propagate values that are not numbers
        raise UnusualFileError
    return tuple(low.tolist()), tuple(high.tolist())


def estimated_corners(file: BinaryIO, size: int) -> Corners | None:
    """Return the corners of the bounding box of a sample of the triangles; None if the file is small.

    Args:
        file: the open file.
        size: of the file [byte].

    Raises:
        UnusualFileError: the file is not valid.
    """
    if is_binary(size, head := file.read(HEADER)):
        count = _count(head)
        if count <= 2 * SAMPLES:
            return None
        import mmap

        read = Struct("<9f").unpack_from
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            rows = [read(content, HEADER + 12 + n * count // SAMPLES * SIZE) for n in range(SAMPLES)]
        return corners_of_columns(list(zip(*rows, strict=True)))
    if size <= 2 * SAMPLES * PART:
        return None
    words: list[bytes] = []
    for n in range(SAMPLES):  # the last vertex of each part may be cut off
        words += _text_words(part(file, n * size // SAMPLES, PART).rpartition(b"vertex")[0])
    return corners_of_numbers(words)


def _text_words(content: bytes) -> list[bytes]:
    """Return the coordinates in a text file."""
    return [word for part in content.split(b"vertex")[1:] for word in part.split(None, 3)[:3]]
