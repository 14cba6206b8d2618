"""Normals of vertices of meshes without normals: smooth surfaces with sharp creases."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.meshes.triangle_mesh import unique_rows

CREASE = np.deg2rad(35.0)
"""Neighbouring faces that meet at less than this angle are shaded as one smooth surface [rad]."""


def flat_normals(sides: NDArray[Any]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return area vectors (of length twice the area) and unit normals (or zero) of triangles of shape (m, 3, 3)."""
    sides = sides.astype(float)
    area = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    length = np.linalg.norm(area, axis=1, keepdims=True)
    return area, np.divide(area, length, out=np.zeros_like(area), where=length > 0)


def crease(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Compute a normal for every corner of every face: the mean over the smoothly adjacent faces at its vertex.

    Args:
        vertices: shape (n, 3).
        faces: shape (m, 3).

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
    area, flat = flat_normals(places[faces])
    corner_vertex = faces.reshape(-1)
    even, mean = _even(len(places), corner_vertex, area, flat)
    rough = np.flatnonzero(~even[corner_vertex])
    normals = _paired(rough, corner_vertex, area, flat)

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
    count: int, corner_vertex: NDArray[np.int64], area: NDArray[Any], flat: NDArray[Any]
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return which vertices have no crease, and their mean normals: all faces are within half of `CREASE` of it."""
    total: NDArray[np.float64] = np.stack(
        [np.bincount(corner_vertex, np.repeat(area[:, k], 3), count) for k in range(3)], axis=1
    )
    mean = _unit(total)
    near = np.einsum("ijk,ik->ij", mean[corner_vertex].reshape(-1, 3, 3), flat).reshape(-1) > np.cos(CREASE / 2)
    even = np.bincount(corner_vertex, ~near, count) == 0
    return even & (np.bincount(corner_vertex, minlength=count) > 0), mean


def _paired(
    corners: NDArray[np.int64], corner_vertex: NDArray[np.int64], area: NDArray[Any], flat: NDArray[Any]
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
        smooth = np.einsum("ij,ij->i", flat[a], flat[b]) > np.cos(CREASE)
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
