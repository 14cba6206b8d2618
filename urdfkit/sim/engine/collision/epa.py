"""The depth of two overlapping convex shapes: the expanding polytope algorithm.

A polytope inside the Minkowski difference grows, always where its boundary is nearest to the origin, until it touches
the boundary of the difference there. After G. van den Bergen, Collision Detection in Interactive 3D Environments,
2003, section 4.3.8.
"""

import math
from typing import Any

from urdfkit.sim.engine.collision.gjk import store_vector_at, support_of_difference, triangle_weights
from urdfkit.sim.engine.collision.support_points import vertex_at
from urdfkit.sim.engine.collision.workspace import (
    DIFFERENCE,
    FACE_DISTANCE,
    FACE_NORMAL,
    FACE_POINT,
    HORIZON,
    MOST_FACES,
    MOST_POINTS,
    ON_A,
)
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.spatial_algebra import Vector, add, cross, dot, scale, sub

EXACT = 1e-9
"""Error of the depth, over the extent of the difference, at which the search ends."""
FLAT = 1e-10
"""Size over extent below which a simplex counts as flat."""


@inlined
def across(a: Vector) -> Vector:
    """Return a unit vector at right angles to a vector."""
    x, y, z = abs(a[0]), abs(a[1]), abs(a[2])
    other = (1.0, 0.0, 0.0)
    if y <= x and y <= z:
        other = (0.0, 1.0, 0.0)
    elif z <= x:
        other = (0.0, 0.0, 1.0)
    found = cross(a, other)
    length = math.sqrt(dot(found, found))
    return scale(1.0 / length, found) if length > 0.0 else (0.0, 0.0, 1.0)


@inlined
def off_simplex(count: int, work: Any, w: Vector) -> float:
    """Return how far a point is from the point, line or plane of a simplex."""
    p = vertex_at(work, DIFFERENCE, 0)
    offset = sub(w, p)
    if count == 1:
        return math.sqrt(dot(offset, offset))
    along = sub(vertex_at(work, DIFFERENCE, 1), p)
    if count == 2:
        normal = cross(along, offset)
        return math.sqrt(dot(normal, normal) / dot(along, along))
    normal = cross(along, sub(vertex_at(work, DIFFERENCE, 2), p))
    square = dot(normal, normal)
    return abs(dot(normal, offset)) / math.sqrt(square) if square > 0.0 else 0.0


@compiled
def fill_simplex(count: int, a: Any, b: Any, numbers: Any, indices: Any, work: Any) -> tuple[int, Vector]:
    """Add points until the simplex is a tetrahedron; return how many there are and, if less, a normal of the rest."""
    extent = 0.0
    first = vertex_at(work, DIFFERENCE, 0)
    for axis in range(6):
        sign = 1.0 if axis < 3 else -1.0
        k = axis % 3
        direction = (sign if k == 0 else 0.0, sign if k == 1 else 0.0, sign if k == 2 else 0.0)
        w, _ = support_of_difference(a, b, numbers, indices, direction)
        offset = sub(w, first)
        extent = max(extent, math.sqrt(dot(offset, offset)))
    normal = (0.0, 0.0, 1.0)
    while count < 4:
        tries = 6
        along = normal
        if count == 2:
            along = sub(vertex_at(work, DIFFERENCE, 1), first)
            normal = across(along)
        elif count == 3:
            normal = cross(
                sub(vertex_at(work, DIFFERENCE, 1), first),
                sub(vertex_at(work, DIFFERENCE, 2), first),
            )
            normal = scale(1.0 / math.sqrt(dot(normal, normal)), normal)
            tries = 2
        side = cross(along, normal)
        length = math.sqrt(dot(side, side))
        if length > 0.0:
            side = scale(1.0 / length, side)
        most = FLAT * extent
        best, best_on_a = first, first
        for j in range(tries):
            sign = 1.0 if j % 2 == 0 else -1.0
            direction = scale(sign, normal)
            if count == 1:
                direction = (sign if j < 2 else 0.0, sign if 2 <= j < 4 else 0.0, sign if j >= 4 else 0.0)
            elif count == 2:
                sine, cosine = sine_cosine(math.pi * j / 3.0)
                direction = add(scale(cosine, normal), scale(sine, side))
            w, on_a = support_of_difference(a, b, numbers, indices, direction)
            off = off_simplex(count, work, w)
            if off > most:
                most, best, best_on_a = off, w, on_a
        if most <= FLAT * extent:
            return count, normal
        store_vector_at(work, DIFFERENCE, count, best)
        store_vector_at(work, ON_A, count, best_on_a)
        count += 1
    return count, normal


@inlined
def add_face(count: int, i: int, j: int, k: int, work: Any, work_indices: Any) -> int:
    """Add a face whose corners run counter-clockwise seen from outside; return how many there are."""
    p = vertex_at(work, DIFFERENCE, i)
    normal = cross(sub(vertex_at(work, DIFFERENCE, j), p), sub(vertex_at(work, DIFFERENCE, k), p))
    length = math.sqrt(dot(normal, normal))
    at = FACE_POINT + 3 * count
    work_indices[at], work_indices[at + 1], work_indices[at + 2] = i, j, k
    # A face without area is kept, since it closes the polytope, and never the nearest.
    work[FACE_DISTANCE + count] = math.inf
    if length > 0.0:
        normal = scale(1.0 / length, normal)
        work[FACE_DISTANCE + count] = dot(normal, p)
    store_vector_at(work, FACE_NORMAL, count, normal)
    return count + 1


@inlined
def toggle_edge(edges: int, i: int, j: int, work_indices: Any) -> int:
    """Note an edge of the hole, or strike out the same edge of the neighbouring face; return how many there are."""
    for k in range(edges):
        at = HORIZON + 2 * k
        if work_indices[at] == j and work_indices[at + 1] == i:
            last = HORIZON + 2 * (edges - 1)
            work_indices[at], work_indices[at + 1] = work_indices[last], work_indices[last + 1]
            return edges - 1
    work_indices[HORIZON + 2 * edges], work_indices[HORIZON + 2 * edges + 1] = i, j
    return edges + 1


@inlined
def point_on_face(face: int, work: Any, work_indices: Any) -> Vector:
    """Return the point of a that makes the point of a face nearest to the origin."""
    at = FACE_POINT + 3 * face
    i, j, k = work_indices[at], work_indices[at + 1], work_indices[at + 2]
    w = triangle_weights(vertex_at(work, DIFFERENCE, i), vertex_at(work, DIFFERENCE, j), vertex_at(work, DIFFERENCE, k))
    return add(
        add(scale(w[0], vertex_at(work, ON_A, i)), scale(w[1], vertex_at(work, ON_A, j))),
        scale(w[2], vertex_at(work, ON_A, k)),
    )


@compiled
def depth(
    count: int, a: Any, b: Any, numbers: Any, indices: Any, work: Any, work_indices: Any
) -> tuple[Vector, Vector, Vector]:
    """Find how two overlapping cores come apart with the least motion.

    Args:
        count: points of the simplex that `distance` left.
        a: the first shape: kind, size, rotation, centre, data.
        b: the second.
        numbers: of hulls and meshes.
        indices: of hulls and meshes.
        work: working memory with the simplex.
        work_indices: working memory.

    Returns:
        The unit normal from b to a; from the deepest point on b to that on a; the latter.
    """
    count, normal = fill_simplex(count, a, b, numbers, indices, work)
    if count < 4:
        # The difference is flat and the origin in it.
        zero = (0.0, 0.0, 0.0)
        return normal, zero, vertex_at(work, ON_A, 0)
    faces = 0
    extent = 0.0
    for opposite in range(4):
        i, j, k = (opposite + 1) % 4, (opposite + 2) % 4, (opposite + 3) % 4
        p, q, r = vertex_at(work, DIFFERENCE, i), vertex_at(work, DIFFERENCE, j), vertex_at(work, DIFFERENCE, k)
        extent = max(extent, math.sqrt(dot(p, p)))
        if dot(cross(sub(q, p), sub(r, p)), sub(vertex_at(work, DIFFERENCE, opposite), p)) > 0.0:
            j, k = k, j
        faces = add_face(faces, i, j, k, work, work_indices)
    best_normal, best_w, best_on_a = normal, (0.0, 0.0, 0.0), vertex_at(work, ON_A, 0)
    least_reach = math.inf
    while True:
        nearest = 0
        for face in range(1, faces):
            if work[FACE_DISTANCE + face] < work[FACE_DISTANCE + nearest]:
                nearest = face
        normal = vertex_at(work, FACE_NORMAL, nearest)
        height = work[FACE_DISTANCE + nearest]
        w, on_a = support_of_difference(a, b, numbers, indices, normal)
        reach = dot(normal, w)
        # The depth is at most how far the difference reaches along any normal.
        if reach < least_reach:
            least_reach = reach
            best_normal = normal
            best_w = scale(reach, normal)
            best_on_a = point_on_face(nearest, work, work_indices)
        if reach - height <= EXACT * extent or count >= MOST_POINTS or not math.isfinite(height):
            break
        edges = 0
        kept = 0
        for face in range(faces):
            at = FACE_POINT + 3 * face
            i, j, k = work_indices[at], work_indices[at + 1], work_indices[at + 2]
            outward = vertex_at(work, FACE_NORMAL, face)
            seen = dot(outward, sub(w, vertex_at(work, DIFFERENCE, i))) > 1e-13 * extent
            if seen and edges < MOST_FACES - 3:
                edges = toggle_edge(edges, i, j, work_indices)
                edges = toggle_edge(edges, j, k, work_indices)
                edges = toggle_edge(edges, k, i, work_indices)
            else:
                to = FACE_POINT + 3 * kept
                work_indices[to], work_indices[to + 1], work_indices[to + 2] = i, j, k
                store_vector_at(work, FACE_NORMAL, kept, outward)
                work[FACE_DISTANCE + kept] = work[FACE_DISTANCE + face]
                kept += 1
        faces = kept
        if edges == 0 or faces + edges > MOST_FACES:
            break
        store_vector_at(work, DIFFERENCE, count, w)
        store_vector_at(work, ON_A, count, on_a)
        for edge in range(edges):
            i, j = work_indices[HORIZON + 2 * edge], work_indices[HORIZON + 2 * edge + 1]
            faces = add_face(faces, i, j, count, work, work_indices)
        count += 1
    return scale(-1.0, best_normal), best_w, best_on_a
