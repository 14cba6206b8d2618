"""The convex hull of a set of points, with as many vertices as a contact needs."""

from dataclasses import dataclass

import numpy as np

from urdfkit.linear_algebra import Array, matmul, vector_norm

MOST_VERTICES = 64
"""Vertices of a hull, at most: the time of a contact grows with them."""
FLAT = 1e-7
"""Distance over extent at which points count as on one plane."""


@dataclass(frozen=True, slots=True, eq=False)
class Hull:
    """A convex polyhedron; of flat points both sides of a polygon, of points on a line their two ends.

    Attributes:
        vertices: [m], shape (n, 3).
        faces: of each face the vertices in order round it, counter-clockwise seen from outside.
        normals: of each face, shape (faces, 3).
        error: how far the furthest of the points is outside [m]: none is where all its vertices were kept.
    """

    vertices: Array
    faces: tuple[tuple[int, ...], ...]
    normals: Array
    error: float


def convex_hull(points: Array, *, most: int = MOST_VERTICES) -> Hull:
    """Return the convex hull of points, growing it by the point furthest outside until none is or it has enough.

    Args:
        points: [m], shape (n, 3), at least one.
        most: vertices it may have, at least 4.

    Returns:
        The hull, inside that of all the points.
    """
    points = np.unique(np.asarray(points, dtype=float).reshape(-1, 3), axis=0)
    extent = float(np.max(np.ptp(points, axis=0))) if len(points) else 0.0
    corners = first_corners(points, FLAT * extent)
    if len(corners) < 3:
        normal = np.array([[0.0, 0.0, 1.0]])
        return Hull(points[corners], (tuple(range(len(corners))),), normal, 0.0)
    if len(corners) == 3:
        return flat_hull(points, points[corners], most)
    return solid_hull(points, corners, most, FLAT * extent)


def first_corners(points: Array, tolerance: float) -> list[int]:
    """Return up to four points that span as much as the points do: a point, a line, a triangle or a tetrahedron."""
    corners = [int(np.argmin(points[:, 0]))]
    offset = points - points[corners[0]]
    distances = np.linalg.norm(offset, axis=1)
    for _ in range(3):
        furthest = int(np.argmax(distances))
        if distances[furthest] <= tolerance:
            break
        corners.append(furthest)
        along = offset[furthest] / vector_norm(offset[furthest])
        offset = offset - np.outer(matmul(offset, along), along)
        distances = np.linalg.norm(offset, axis=1)
    return corners


def flat_hull(points: Array, corners: Array, most: int) -> Hull:
    """Return both sides of the convex polygon of points on a plane, of those furthest out in so many directions."""
    x = corners[1] - corners[0]
    x /= vector_norm(x)
    normal = np.cross(x, corners[2] - corners[0])
    normal /= vector_norm(normal)
    y = np.cross(normal, x)
    angles = 2.0 * np.pi * np.arange(most) / most
    directions = np.outer(np.cos(angles), x) + np.outer(np.sin(angles), y)
    loop: list[int] = []
    for k in np.argmax(matmul(points, directions.T), axis=0):
        if int(k) not in loop:
            loop.append(int(k))
    forward = tuple(range(len(loop)))
    error = float(np.max(matmul(points, directions.T).max(axis=0) - matmul(points[loop], directions.T).max(axis=0)))
    return Hull(points[loop], (forward, forward[::-1]), np.array([normal, -normal]), error)


def plane_of(points: Array, face: tuple[int, ...]) -> tuple[Array, float]:
    """Return normal and offset of the plane through the first three vertices of a face."""
    p, q, r = points[list(face[:3])]
    normal = np.cross(q - p, r - p)
    length = vector_norm(normal)
    normal = normal / length if length > 0.0 else normal
    return normal, matmul(normal, p)


def solid_hull(points: Array, corners: list[int], most: int, tolerance: float) -> Hull:
    """Return the hull that grows from a tetrahedron of points."""
    centre = points[corners].mean(axis=0)
    faces: list[tuple[int, ...]] = []
    for k in range(4):
        i, j, m = (corners[(k + n) % 4] for n in (1, 2, 3))
        normal, offset = plane_of(points, (i, j, m))
        faces.append((i, j, m) if matmul(normal, centre) < offset else (i, m, j))
    planes = [plane_of(points, face) for face in faces]
    outside = np.arange(len(points))
    used = 4
    while True:
        normals = np.array([plane[0] for plane in planes])
        heights = matmul(points[outside], normals.T) - np.array([plane[1] for plane in planes])
        highest = heights.max(axis=1)
        left = highest > tolerance
        error = float(highest.max(initial=0.0))
        outside, heights = outside[left], heights[left]
        if len(outside) == 0 or used == most:
            break
        at = int(np.argmax(highest[left]))
        vertex = int(outside[at])
        seen = heights[at] > 0.5 * tolerance
        edges = {(f[k], f[(k + 1) % 3]) for f, s in zip(faces, seen, strict=True) if s for k in range(3)}
        rim = [(i, j) for i, j in sorted(edges) if (j, i) not in edges]
        faces = [f for f, s in zip(faces, seen, strict=True) if not s] + [(i, j, vertex) for i, j in rim]
        planes = [p for p, s in zip(planes, seen, strict=True) if not s]
        planes += [plane_of(points, face) for face in faces[len(planes) :]]
        used = len({i for face in faces for i in face})
    merged = merge_faces(points, faces, planes, 2.0 * tolerance)
    names = sorted({i for face in merged for i in face})
    number = {name: k for k, name in enumerate(names)}
    loops = tuple(tuple(number[i] for i in face) for face in merged)
    vertices = points[names]
    return Hull(vertices, loops, np.array([loop_normal(vertices[list(loop)]) for loop in loops]), max(0.0, error))


def loop_normal(corners: Array) -> Array:
    """Return the unit normal of a polygon (Newell's method)."""
    normal = np.cross(corners - corners[0], np.roll(corners, -1, axis=0) - corners[0]).sum(axis=0)
    return np.asarray(normal / vector_norm(normal))


def merge_faces(
    points: Array, faces: list[tuple[int, ...]], planes: list[tuple[Array, float]], tolerance: float
) -> list[tuple[int, ...]]:
    """Merge neighbouring coplanar triangles into faces; patches without a single boundary loop are not merged."""
    face_of = {(f[k], f[(k + 1) % 3]): n for n, f in enumerate(faces) for k in range(3)}
    areas = [vector_norm(np.cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]])) for f in faces]
    free = set(range(len(faces)))
    merged: list[tuple[int, ...]] = []
    for seed in sorted(range(len(faces)), key=lambda n: (-areas[n], n)):
        if seed not in free:
            continue
        normal, offset = planes[seed]
        group, waiting = {seed}, [seed]
        while waiting:
            face = faces[waiting.pop()]
            for k in range(3):
                other = face_of.get((face[(k + 1) % 3], face[k]))
                if other is None or other in group or other not in free:
                    continue
                if np.all(np.abs(matmul(points[list(faces[other])], normal) - offset) <= tolerance):
                    group.add(other)
                    waiting.append(other)
        loop = boundary([faces[n] for n in sorted(group)])
        if not loop:
            group, loop = {seed}, faces[seed]
        free -= group
        merged.append(loop)
    return merged


def boundary(triangles: list[tuple[int, ...]]) -> tuple[int, ...]:
    """Return the loop round a patch of triangles, empty if it has not just one."""
    edges = {(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)}
    after = {i: j for i, j in sorted(edges) if (j, i) not in edges}
    if not after or len(after) != sum((j, i) not in edges for i, j in edges):
        return ()
    loop = [min(after)]
    while after.get(loop[-1], loop[0]) != loop[0] and len(loop) <= len(after):
        loop.append(after[loop[-1]])
    return tuple(loop) if len(loop) == len(after) else ()
