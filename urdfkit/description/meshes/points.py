"""Bounding boxes of points, and parts of files."""

from __future__ import annotations

from math import isfinite

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from mmap import mmap
    from typing import BinaryIO

    Corners = tuple[tuple[float, float, float], tuple[float, float, float]]
    """Lowest and highest corner."""


class UnusualFileError(Exception):
    """A file that the quick readers do not read: it is damaged, or uses a feature that they lack."""


def corners_of_columns(columns: Sequence[Sequence[float]]) -> Corners:
    """Return the corners of the bounding box of points.

    Args:
        columns: x, y and z of all points; more columns repeat them, as the corners of triangles do.

    Raises:
        UnusualFileError: there is no point, or a coordinate is not finite.
    """
    if not columns or not columns[0]:
        raise UnusualFileError
    low = [min(min(column) for column in columns[axis::3]) for axis in range(3)]
    high = [max(max(column) for column in columns[axis::3]) for axis in range(3)]
    if not all(isfinite(sum(column)) for column in columns):  # min and max skip values that are not numbers
        raise UnusualFileError
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def corners_of_numbers(words: Iterable[bytes]) -> Corners:
    """Return the corners of the bounding box of points written as text.

    Raises:
        UnusualFileError: there is no point, the last one is incomplete, or a number is invalid or not finite.
    """
    try:
        numbers = list(map(float, words))
    except ValueError as error:
        raise UnusualFileError from error
    if len(numbers) % 3:
        raise UnusualFileError
    return corners_of_columns([numbers[axis::3] for axis in range(3)])


def union(boxes: Sequence[Corners]) -> Corners:
    """Return the corners of the box around boxes.

    Raises:
        UnusualFileError: there is no box.
    """
    if not boxes:
        raise UnusualFileError
    lows, highs = zip(*boxes, strict=True)
    return tuple(map(min, zip(*lows, strict=True))), tuple(map(max, zip(*highs, strict=True)))


def part(file: BinaryIO, start: int, size: int) -> bytes:
    """Return a part of an open file."""
    file.seek(start)
    return file.read(size)


def has_infinite(content: bytes | mmap, first: int, end: int, stride: int) -> bool:
    """Return whether a coordinate is infinite or not a number.

    All eight bits of the exponent of such a number are set: seven in its last byte, one in the byte before.

    Args:
        content: points of three 32-bit numbers, the lowest byte first.
        first: the position of the first point.
        end: the position after the last point.
        stride: bytes from point to point.
    """
    for number in range(first, first + 12, 4):
        last = content[number + 3 : end : stride]
        if (b"\x7f" in last or b"\xff" in last) and any(
            high & 0x7F == 0x7F and low & 0x80
            for high, low in zip(last, content[number + 2 : end : stride], strict=False)
        ):
            return True
    return False
