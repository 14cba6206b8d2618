"""Binary STL with nothing but numpy: most meshes of robots are, and trimesh takes half a second to import."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

HEADER = 84
"""80 bytes of anything, then the number of triangles."""
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])


def corners_of(content: bytes) -> NDArray[np.float32] | None:
    """Return the corners of the triangles of a file, shape (m, 3, 3); None where it is no well-formed binary STL."""
    if len(content) < HEADER:
        return None
    count = int.from_bytes(content[80:HEADER], "little")
    if count == 0 or len(content) != HEADER + TRIANGLE.itemsize * count:
        return None
    corners: NDArray[np.float32] = np.frombuffer(content, dtype=TRIANGLE, offset=HEADER)["corners"]
    return corners
