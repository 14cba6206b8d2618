"""Simplify large meshes for the screen: vertices in the same cell of a grid become one, their mean (vertex clustering).

Source: Rossignac and Borrel, *Multi-resolution 3D approximations for rendering complex scenes* (1993).
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from urdfkit.meshes.triangle_mesh import TriMesh

MOST_TRIANGLES = 1_000_000
"""Meshes with more triangles are simplified for the screen."""
WANTED_TRIANGLES = 500_000
"""Triangles of a simplified mesh, approximately."""
CHUNK = 250_000
"""Triangles that are processed at once, which limits the memory."""
TRIANGLES_PER_CELL = 3.0
"""A surface of area A has about 3 A / s^2 triangles after clustering in cells of edge s: it passes through 1.5 A / s^2
cells (1.5 is the mean of |nx| + |ny| + |nz| over all directions), and a closed surface has two triangles per vertex."""


class Clusters(NamedTuple):
    """A simplified mesh.

    Attributes:
        vertices: shape (n, 3), float32.
        faces: shape (m, 3), int32.
        triangles: number of the triangle from which each face comes; shape (m,).
        corners: number of one corner in each vertex's cell (three corners per triangle, in order); shape (n,).
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]
    triangles: NDArray[np.int64]
    corners: NDArray[np.int64]


def clustered(count: int, corners: Callable[[slice], NDArray[Any]]) -> Clusters:
    """Simplify triangles to about `WANTED_TRIANGLES`.

    Args:
        count: number of triangles.
        corners: returns the corners of some triangles; shape (k, 3, 3).
    """
    chunks = [slice(at, min(at + CHUNK, count)) for at in range(0, count, CHUNK)]
    low, high, area = np.full(3, np.inf), np.full(3, -np.inf), 0.0
    for chunk in chunks:
        points = corners(chunk).astype(float)
        low, high = np.minimum(low, points.min(axis=(0, 1))), np.maximum(high, points.max(axis=(0, 1)))
        area += float(np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1).sum())
    edge = max(float(np.sqrt(TRIANGLES_PER_CELL * area / 2 / WANTED_TRIANGLES)), float((high - low).max()) * 2.0**-20)
    edge = edge or 1.0  # all corners are at one point

    where: list[NDArray[Any]] = []
    keys, sums, firsts = [], [], []
    for chunk in chunks:
        points = corners(chunk).reshape(-1, 3).astype(float)
        x, y, z = np.floor((points - low) / edge).astype(np.int64).T
        cells, first, inverse = np.unique((x << 42) | (y << 21) | z, return_index=True, return_inverse=True)
        keys.append(cells)
        where.append(inverse.astype(np.int32))
        sums.append(np.stack([np.bincount(inverse, points[:, k]) for k in range(3)] + [np.bincount(inverse)], axis=1))
        firsts.append(first + 3 * chunk.start)
    found, first, number = np.unique(np.concatenate(keys), return_index=True, return_inverse=True)
    rows = np.concatenate(sums)
    total = np.stack([np.bincount(number, rows[:, k], len(found)) for k in range(4)], axis=1)

    faces: list[NDArray[np.int32]] = []
    triangles, start = [], 0
    for chunk, cells, rank in zip(chunks, keys, where, strict=True):
        corner: Any = number[start : start + len(cells)][rank].reshape(-1, 3)
        start += len(cells)
        solid = (corner[:, 0] != corner[:, 1]) & (corner[:, 1] != corner[:, 2]) & (corner[:, 2] != corner[:, 0])
        faces.append(corner[solid].astype(np.int32))
        triangles.append(np.flatnonzero(solid) + chunk.start)
    face: Any = np.concatenate(faces)
    triangle = np.concatenate(triangles)
    # The same three vertices in the same direction are drawn once.
    turn = face.argmin(axis=1)[:, None]
    face = np.take_along_axis(face, (turn + np.arange(3)) % 3, axis=1)
    _, kept = np.unique(np.ascontiguousarray(face).view([("", np.int32)] * 3).reshape(-1), return_index=True)
    kept.sort()
    return Clusters(
        (total[:, :3] / total[:, 3:]).astype(np.float32) + np.float32(0),
        np.ascontiguousarray(face[kept]),
        triangle[kept],
        np.concatenate(firsts)[first],
    )


def simplified(mesh: TriMesh) -> TriMesh:
    """Return a mesh of more than `MOST_TRIANGLES` triangles with about `WANTED_TRIANGLES`; any other mesh as it is.

    Colours and texture coordinates are those of one vertex in the cell. The normals are omitted.
    """
    if len(mesh.faces) <= MOST_TRIANGLES:
        return mesh
    found = clustered(len(mesh.faces), lambda chunk: mesh.vertices[mesh.faces[chunk]])
    vertex, triangle = mesh.faces.reshape(-1)[found.corners], found.triangles
    return replace(
        mesh,
        vertices=found.vertices,
        faces=found.faces,
        normals=None,
        colors=None if mesh.colors is None else mesh.colors[vertex],
        uv=None if mesh.uv is None else mesh.uv[vertex],
        open_vertices=None if mesh.open_vertices is None else mesh.open_vertices[vertex],
        face_textures=None if mesh.face_textures is None else mesh.face_textures[triangle],
        face_gloss=None if mesh.face_gloss is None else mesh.face_gloss[triangle],
        simplified_from=mesh.simplified_from or len(mesh.faces),
    )
