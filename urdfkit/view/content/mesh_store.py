"""Triangle meshes for the browser, addressed by the hash of their content."""

import hashlib
import struct
from collections.abc import Collection, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.meshes.unique_rows import unique_rows
from urdfkit.scene import TriMesh

HEADER = struct.Struct("<III")
"""Number of vertices and triangles, whether the mesh has colours. Then per vertex 3 × float32 position and 3 × float32
normal, per triangle 3 × uint32, and per vertex 4 × uint8 colour if the mesh has colours."""

CREASE = np.deg2rad(35.0)
"""Neighbouring faces that meet at less than this angle are shaded as one smooth surface [rad]."""


class GeometryStore:
    """Packed meshes by content hash. Written by the thread of the caller, read by the thread of the server."""

    def __init__(self) -> None:
        self._packed: dict[str, bytes] = {}
        self._names: dict[str, str] = {}

    def add(self, mesh: TriMesh) -> str:
        """Store a mesh unless it is already stored; return its name, 64 hexadecimal digits."""
        name = self._names.get(mesh.hash)
        if name is None:
            packed = pack(mesh)
            name = self._names[mesh.hash] = hashlib.sha256(packed).hexdigest()
            self._packed[name] = packed
        return name

    def get(self, name: str) -> bytes | None:
        """Return a packed mesh."""
        return self._packed.get(name)

    def keep_only(self, names: Collection[str]) -> None:
        """Remove all other meshes."""
        self._names = {mesh: name for mesh, name in self._names.items() if name in names}
        self._packed = {name: packed for name, packed in self._packed.items() if name in names}

    def __len__(self) -> int:
        return len(self._packed)

    def __iter__(self) -> Iterator[tuple[str, bytes]]:
        """Yield names and packed meshes."""
        yield from self._packed.items()


def pack(mesh: TriMesh) -> bytes:
    """Return a mesh in its binary format; missing normals are computed so that creases stay sharp."""
    points: NDArray[Any] = mesh.vertices
    faces: NDArray[Any] = mesh.faces
    normals: NDArray[Any]
    colors = mesh.colors
    if mesh.normals is not None:
        normals = mesh.normals
    elif colors is not None:
        # Corners at the same position may differ in colour: shade flat, with separate corners.
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
    """Return area vectors (of length twice the area) and unit normals (or zero) of triangles of shape (m, 3, 3)."""
    sides = sides.astype(float)
    area = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    length = np.linalg.norm(area, axis=1, keepdims=True)
    return area, np.divide(area, length, out=np.zeros_like(area), where=length > 0)


def crease(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], *, angle: float = CREASE
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Compute a normal for every corner of every face: the mean over the smoothly adjacent faces at its vertex.

    Args:
        vertices: shape (n, 3).
        faces: shape (m, 3).
        angle: faces whose normals differ by more are not averaged [rad].

    Returns:
        Vertices and unit normals, shape (k, 3) each, equal corners merged, and faces (m, 3) into them.
    """
    if len(faces) == 0:
        return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    # STL has no shared vertices: merge equal positions first.
    vertices = vertices.astype(np.float32) + np.float32(0)  # -0.0 becomes 0.0
    kept, where = unique_rows(vertices.view(np.uint32))
    places = vertices[kept]
    faces = where[faces]
    area, flat = _flat(places[faces])
    corner_vertex = faces.reshape(-1)
    even, mean = _even(len(places), corner_vertex, area, flat, angle)
    rough = np.flatnonzero(~even[corner_vertex])
    normals = _paired(rough, corner_vertex, area, flat, angle)

    # A smooth vertex is kept; at a crease each normal gets its own vertex.
    rows = np.hstack([corner_vertex[rough, None], np.round(normals * 32767).astype(np.int64)])
    kept, index = unique_rows(rows)
    smooth = np.flatnonzero(even)
    number = np.full(len(places), -1)
    number[smooth] = np.arange(len(smooth))
    found = number[corner_vertex]
    found[rough] = len(smooth) + index
    points = np.concatenate([places[smooth], places[corner_vertex[rough[kept]]]]).astype(float)
    return points, np.concatenate([mean[smooth], normals[kept]]), found.reshape(-1, 3)


def _even(
    count: int, corner_vertex: NDArray[np.int64], area: NDArray[Any], flat: NDArray[Any], angle: float
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return which vertices have no crease, and their mean normals: all faces are within half of `angle` of it."""
    total: NDArray[np.float64] = np.stack(
        [np.bincount(corner_vertex, np.repeat(area[:, k], 3), count) for k in range(3)], axis=1
    )
    mean = _unit(total)
    near = np.einsum("ijk,ik->ij", mean[corner_vertex].reshape(-1, 3, 3), flat).reshape(-1) > np.cos(angle / 2)
    even = np.bincount(corner_vertex, ~near, count) == 0
    return even & (np.bincount(corner_vertex, minlength=count) > 0), mean


def _paired(
    corners: NDArray[np.int64], corner_vertex: NDArray[np.int64], area: NDArray[Any], flat: NDArray[Any], angle: float
) -> NDArray[np.float64]:
    """Return the normals of corners (all corners of their vertices): the mean over smoothly adjacent faces."""
    # All pairs of corners with the same vertex: sort the corners by vertex, then pair them at increasing distance.
    order = np.argsort(corner_vertex[corners], kind="stable")
    sorted_vertex = corner_vertex[corners[order]]
    face_of = corners[order] // 3
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
    return _unit(normals)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Normalize vectors of shape (n, 3); zero vectors become the z axis."""
    size = np.linalg.norm(vectors, axis=1, keepdims=True)
    found: NDArray[np.float64] = np.tile([0.0, 0.0, 1.0], (len(vectors), 1))
    np.divide(vectors, size, out=found, where=size > 0)
    return found
