"""Bounding boxes of OBJ files: of all vertices, whether a face uses them or not."""

from __future__ import annotations

from urdfkit.description.meshes.points import UnusualFileError, corners_of_numbers, part

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import BinaryIO

    from urdfkit.description.meshes.points import Corners

SAMPLES = 192
"""Parts of a sample, evenly distributed over the file."""
PART = 512
"""Bytes of a part."""
FEWEST = 300
"""Vertices that a sample needs."""


def corners(content: bytes) -> Corners:
    """Return the corners of the bounding box.

    Raises:
        UnusualFileError: the file has no vertex or face, or is not valid.
    """
    lines = content.split(b"\n")
    if not any(line.lstrip()[:2] in (b"f ", b"f\t") for line in lines):
        raise UnusualFileError
    return corners_of_numbers(_words(lines))


def estimated_corners(file: BinaryIO, size: int) -> Corners | None:
    """Return the corners of the bounding box of a sample of the vertices; None if that needs the whole file.

    Args:
        file: the open file.
        size: of the file [byte].

    Raises:
        UnusualFileError: the file is not valid.
    """
    if size <= 2 * SAMPLES * PART:
        return None
    words: list[bytes] = []
    has_faces = False
    for n in range(SAMPLES):  # the first and last line of a part may be cut off
        lines = part(file, n * size // SAMPLES, PART).split(b"\n")[1:-1]
        has_faces = has_faces or any(line[:2] == b"f " for line in lines)
        words += _words(lines)
    return corners_of_numbers(words) if has_faces and len(words) >= 3 * FEWEST else None


def _words(lines: list[bytes]) -> list[bytes]:
    """Return the coordinates of the vertices; a vertex may have a weight or a colour besides."""
    return [word for line in lines if line[:2] in (b"v ", b"v\t") for word in _point(line)]


def _point(line: bytes) -> list[bytes]:
    words = line.split()
    if len(words) not in (4, 7):  # a weight divides the coordinates
        raise UnusualFileError
    return words[1:4]
