"""Binary STL, the format of most meshes of robots, without trimesh, which takes half a second to import."""

import numpy as np
from numpy.typing import NDArray

HEADER = 84
"""80 arbitrary bytes, then the number of triangles."""
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])


def corners_of(content: bytes) -> NDArray[np.float32] | None:
    """Return the corners of the triangles of a file, shape (m, 3, 3); None if it is not valid binary STL.

    Bytes after the last triangle are ignored, as by Assimp, which RViz and Gazebo use.
    """
    if len(content) < HEADER:
        return None
    count = int.from_bytes(content[80:HEADER], "little")
    if count == 0 or len(content) < HEADER + TRIANGLE.itemsize * count:
        return None
    corners: NDArray[np.float32] = np.frombuffer(content, dtype=TRIANGLE, count=count, offset=HEADER)["corners"]
    return corners
