"""TriMesh: the triangles of a mesh, with their colours and textures; and distinct rows of arrays."""

import hashlib
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.meshes.textures import Texture


@dataclass(frozen=True, eq=False)
class TriMesh:
    """Triangles in the frame of their shape; all arrays are read-only.

    Attributes:
        vertices: [m], shape (n, 3), float32.
        faces: indices of vertices, counter-clockwise seen from outside, shape (m, 3), int32.
        normals: unit normals of the vertices, if the file has them, shape (n, 3), float32, or None (shade flat).
        colors: colours of the vertices, if the file has them, shape (n, 4), uint8, or None.
        uv: texture coordinates of the vertices, origin at the lower left corner, shape (n, 2), float32, or None.
        textures: the textures of the mesh.
        face_textures: index of the texture of each triangle, -1 for none; shape (m,), int32, or None.
        face_gloss: specular colour, 0..1, and exponent of each triangle; shape (m, 4), float32, or None.
        missing: names of referenced image files that are missing or invalid.
        broken: names of referenced image files that exist but are not valid images, each with its fault.
        open_vertices: whether the file names no material for the vertex; shape (n,), or None if so for all or no
            vertices.
        simplified_from: number of triangles in the file if the mesh was simplified for the screen, otherwise 0.
        hash: hexadecimal digest of all of the above: equal meshes have equal hashes.

    Examples:
        >>> import numpy as np
        >>> from urdfkit.scene import TriMesh
        >>> corners, white = np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.full((3, 4), 255, np.uint8)
        >>> mesh = TriMesh(corners, np.int32([[0, 1, 2]]), colors=white, open_vertices=np.array([True, False, False]))
        >>> mesh.bounds
        array([[0., 0., 0.],
               [1., 1., 0.]])
        >>> mesh.has_own_colors
        True
        >>> mesh.with_open_color((1.0, 0.0, 0.0, 1.0)).colors
        array([[255,   0,   0, 255],
               [255, 255, 255, 255],
               [255, 255, 255, 255]], dtype=uint8)
    """

    vertices: NDArray[np.float32] = field(repr=False)
    faces: NDArray[np.int32] = field(repr=False)
    normals: NDArray[np.float32] | None = field(default=None, repr=False)
    colors: NDArray[np.uint8] | None = field(default=None, repr=False)
    hash: str = ""
    uv: NDArray[np.float32] | None = field(default=None, repr=False)
    textures: tuple[Texture, ...] = field(default=(), repr=False)
    face_textures: NDArray[np.int32] | None = field(default=None, repr=False)
    missing: tuple[str, ...] = ()
    face_gloss: NDArray[np.float32] | None = field(default=None, repr=False)
    broken: tuple[tuple[str, str], ...] = ()
    open_vertices: NDArray[np.bool_] | None = field(default=None, repr=False)
    simplified_from: int = 0

    def __post_init__(self) -> None:
        digest = hashlib.sha256("".join(texture.hash for texture in self.textures).encode())
        for name in ("vertices", "faces", "normals", "colors", "uv", "face_textures", "face_gloss", "open_vertices"):
            array = getattr(self, name)
            if array is not None:
                array.flags.writeable = False
                digest.update(f"{name}{array.shape}".encode())
                digest.update(np.ascontiguousarray(array).data)
        object.__setattr__(self, "hash", digest.hexdigest()[:32])

    @property
    def has_own_colors(self) -> bool:
        """Whether the file has colours or textures."""
        return self.colors is not None or bool(self.textures)

    def with_open_color(self, rgba: tuple[float, float, float, float]) -> "TriMesh":
        """Return the mesh with a colour, 0..1, where the file names no material."""
        if self.open_vertices is None or self.colors is None:
            return self
        colors = self.colors.copy()
        colors[self.open_vertices] = np.rint(255.0 * np.clip(rgba, 0.0, 1.0))
        return replace(self, colors=colors, open_vertices=None)

    @cached_property
    def bounds(self) -> NDArray[np.float64]:
        """Lowest and highest corner [m]; shape (2, 3)."""
        return np.array([self.vertices.min(axis=0), self.vertices.max(axis=0)], dtype=float)


FACTORS = (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x27D4EB2F165667C5, 0x85EBCA77C2B2AE63,
           0xFF51AFD7ED558CCD, 0xC4CEB9FE1A85EC53, 0xA0761D6478BD642F, 0xE7037ED1A0B428DB,
           0x8EBC6AF09C88C6E3)  # fmt: skip
"""Odd multipliers of a hash; one per column."""


def unique_rows(rows: NDArray[Any]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the first index of each distinct row of integers, and the index of each row among the distinct ones.

    Rows are compared by a hash of their entries, which is much faster to sort than the rows. If different rows have the
    same hash, the rows themselves are sorted.

    Args:
        rows: shape (n, k), k at most ten.
    """
    factors = np.array(FACTORS, dtype=np.uint64)[: rows.shape[1]]
    keys = (rows.astype(np.int64).view(np.uint64) * factors).sum(axis=1, dtype=np.uint64)
    _, first, where = np.unique(keys, return_index=True, return_inverse=True)
    if not np.array_equal(rows[first[where]], rows):
        _, first, where = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first, where.reshape(-1)
