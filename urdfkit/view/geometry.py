"""Triangle meshes for the browser, known by the hash of their content and by nothing else."""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from urdfkit.scene import TriMesh

HEADER = struct.Struct("<III")
"""Vertices, triangles, whether there are colours. Then per vertex 3 × float32 position and 3 × float32 normal, per
triangle 3 × uint32, and per vertex 4 × uint8 colour if there are any."""

CREASE = np.deg2rad(35.0)
"""Neighbouring faces that meet at less than this angle are shaded as one smooth surface [rad]."""

FACTORS = (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x27D4EB2F165667C5)
"""Odd numbers without a pattern, as hashes use them."""


class GeometryStore:
    """Packed meshes by content hash. Filled by the caller's thread, read by the server's."""

    def __init__(self) -> None:
        self._packed: dict[str, bytes] = {}
        self._known: dict[str, str] = {}

    def add(self, mesh: TriMesh) -> str:
        """Keep a mesh and return its name, 64 hexadecimal digits; one that is there already costs nothing."""
        name = self._known.get(mesh.hash)
        if name is None:
            packed = pack(mesh)
            name = self._known[mesh.hash] = hashlib.sha256(packed).hexdigest()
            self._packed[name] = packed
        return name

    def get(self, name: str) -> bytes | None:
        """Return a packed mesh."""
        return self._packed.get(name)

    def keep_only(self, names: Collection[str]) -> None:
        """Forget all other meshes."""
        self._known = {mesh: name for mesh, name in self._known.items() if name in names}
        self._packed = {name: packed for name, packed in self._packed.items() if name in names}

    def __len__(self) -> int:
        return len(self._packed)

    def __iter__(self) -> Iterator[tuple[str, bytes]]:
        """Yield names and packed meshes."""
        yield from self._packed.items()


def pack(mesh: TriMesh) -> bytes:
    """Return a mesh as it travels; where the file has no normals they are made so that creases stay sharp."""
    points: NDArray[Any] = mesh.vertices
    faces: NDArray[Any] = mesh.faces
    normals: NDArray[Any]
    colors = mesh.colors
    if mesh.normals is not None:
        normals = mesh.normals
    elif colors is not None:
        # Corners of one place may differ in colour: shade flat, each corner on its own.
        corners = faces.reshape(-1)
        points, colors, faces = points[corners], colors[corners], np.arange(len(corners)).reshape(-1, 3)
        normals = np.repeat(_flat(points[faces])[1], 3, axis=0)
    else:
        points, normals, faces = crease(points.astype(float), faces.astype(np.int64))
    packed = (
        HEADER.pack(len(points), len(faces), colors is not None)
        + np.asarray(points, dtype="<f4").tobytes()
        + np.asarray(normals, dtype="<f4").tobytes()
        + np.asarray(faces, dtype="<u4").tobytes()
    )
    return packed if colors is None else packed + np.asarray(colors, dtype=np.uint8).tobytes()


def _flat(sides: NDArray[Any]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the area vectors (twice the area long) and unit normals (or zero) of triangles of shape (m, 3, 3)."""
    sides = sides.astype(float)
    area = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    length = np.linalg.norm(area, axis=1, keepdims=True)
    return area, np.divide(area, length, out=np.zeros_like(area), where=length > 0)


def crease(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], *, angle: float = CREASE
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Give every corner of every face a normal: the mean over the faces around its vertex that it is smooth with.

    Args:
        vertices: shape (n, 3).
        faces: shape (m, 3).
        angle: faces whose normals differ by more are not averaged [rad].

    Returns:
        Vertices and unit normals, shape (k, 3) each, equal corners merged, and faces (m, 3) into them.
    """
    if len(faces) == 0:
        return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    # STL has no shared vertices: merge what is in the same place first.
    vertices = vertices.astype(np.float32) + np.float32(0)  # there is one zero, not two
    kept, where = unique_rows(vertices.view(np.uint32))
    places = vertices[kept]
    faces = where[faces]
    area, flat = _flat(places[faces])

    # All pairs (corner, corner) that share a vertex, by sorting corners by vertex and pairing at growing distance.
    corner_vertex = faces.reshape(-1)
    order = np.argsort(corner_vertex, kind="stable")
    sorted_vertex = corner_vertex[order]
    face_of = order // 3
    total = area[face_of].copy()
    for distance in range(1, min(64, len(order))):
        first, second = slice(None, -distance), slice(distance, None)
        shared = sorted_vertex[first] == sorted_vertex[second]
        if not shared.any():
            break
        at = np.flatnonzero(shared)
        a, b = face_of[at], face_of[at + distance]
        smooth = np.einsum("ij,ij->i", flat[a], flat[b]) > np.cos(angle)
        at, a, b = at[smooth], a[smooth], b[smooth]
        total[at] += area[b]  # each index occurs once per distance
        total[at + distance] += area[a]
    normals = np.empty_like(total)
    normals[order] = total
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, size, out=np.tile([0.0, 0.0, 1.0], (len(normals), 1)), where=size > 0)

    corners = np.hstack([corner_vertex[:, None], np.round(normals * 32767).astype(np.int64)])
    kept, index = unique_rows(corners)
    return places[corner_vertex[kept]].astype(float), normals[kept], index.reshape(-1, 3)


def unique_rows(rows: NDArray[Any]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the first place of each different row of integers, and for each row which of those it is like.

    Rows are told apart by a number made of their entries, which sorts much faster than rows do; should two different
    rows ever have the same number, they are sorted as rows.

    Args:
        rows: shape (n, k).
    """
    factors = np.array(
        [0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x27D4EB2F165667C5], dtype=np.uint64
    )
    keys = (rows.astype(np.int64).view(np.uint64) * factors[: rows.shape[1]]).sum(axis=1, dtype=np.uint64)
    _, first, where = np.unique(keys, return_index=True, return_inverse=True)
    if not np.array_equal(rows[first[where]], rows):
        _, first, where = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first, where.reshape(-1)
