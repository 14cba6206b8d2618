"""The contacts of two convex shapes that touch along a known normal: where their touching faces cover each other.

Each point is taken along the normal to the other's face; the gap there is never less than that of the shapes, since the
normal is that of their least distance.
"""

import math
from typing import Any

import numpy as np

from urdfkit.sim.engine.collision.contact_candidates import add_candidate, keep_widest
from urdfkit.sim.engine.collision.gjk import store_vector_at
from urdfkit.sim.engine.collision.support_faces import column, touching_face
from urdfkit.sim.engine.collision.support_points import WHEEL, radius_of, vertex_at
from urdfkit.sim.engine.collision.workspace import (
    CLIPPED,
    CLIPPED_ID,
    CLIPPED_ID_NEXT,
    CLIPPED_NEXT,
    ID_A,
    ID_B,
    MOST_CANDIDATES,
    MOST_CLIPPED,
    NONE,
    POLYGON_A,
    POLYGON_B,
)
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.spatial_algebra import Vector, add, cross, dot, scale, sub

PARALLEL = 0.05
"""Sine of the angle below which two lines touch along their length."""
TWO = np.int64(2)
"""Corners of a line, of the type of counts that are found."""
LEVEL = 0.05
"""Cosine between a face and the normal below which the face cannot be clipped against."""
REACHED = 1e-7
"""How near [m] to the gap of the shapes that of a clipped point must come to stand for it."""
INSIDE = 1e-9
"""How far [m] outside an edge a point still counts as on it."""
NEAREST = 1 << 20
"""Feature of the nearest points themselves."""
B_IS_CLIPPED = 1 << 19
"""Added to features that count the corners of b, not of a."""


@inlined
def clip_edge(count: int, start: Vector, outward: Vector, plane: int, work: Any, ids: Any) -> int:
    """Cut a polygon, a line or a point off outside a plane; return how many corners are left.

    A corner that a cut makes is numbered by the cut and by the edge it is on.
    """
    furthest = -math.inf
    for k in range(count):
        furthest = max(furthest, dot(outward, sub(vertex_at(work, CLIPPED, k), start)))
    if furthest <= INSIDE:
        return count
    left = 0
    # A line is gone through once, a polygon all the way round.
    for k in range(count if count != 2 else 1):
        j = k + 1 if k + 1 < count else 0
        p, q = vertex_at(work, CLIPPED, k), vertex_at(work, CLIPPED, j)
        p_out, q_out = dot(outward, sub(p, start)) - INSIDE, dot(outward, sub(q, start)) - INSIDE
        if p_out <= 0.0 and left < MOST_CLIPPED:
            store_vector_at(work, CLIPPED_NEXT, left, p)
            ids[CLIPPED_ID_NEXT + left] = ids[CLIPPED_ID + k]
            left += 1
        if (p_out <= 0.0) != (q_out <= 0.0) and left < MOST_CLIPPED:
            store_vector_at(work, CLIPPED_NEXT, left, add(p, scale(p_out / (p_out - q_out), sub(q, p))))
            # The corner that stays, of the two the edge had, is numbered by the edge.
            edge = ids[CLIPPED_ID + k]
            ids[CLIPPED_ID_NEXT + left] = (
                ((plane + 1) << 6) + edge if edge < 64 else (1 << 18) + ((plane + 1) << 6) + ((edge >> 6) & 63)
            )
            left += 1
        if count == 2 and q_out <= 0.0:
            store_vector_at(work, CLIPPED_NEXT, left, q)
            ids[CLIPPED_ID_NEXT + left] = ids[CLIPPED_ID + j]
            left += 1
    for k in range(left):
        store_vector_at(work, CLIPPED, k, vertex_at(work, CLIPPED_NEXT, k))
        ids[CLIPPED_ID + k] = ids[CLIPPED_ID_NEXT + k]
    return left


@inlined
def load_polygon(count: int, polygon: int, id_at: int, work: Any, ids: Any) -> None:
    """Copy a polygon into the buffer for clipping."""
    for k in range(count):
        store_vector_at(work, CLIPPED, k, vertex_at(work, polygon, k))
        ids[CLIPPED_ID + k] = ids[id_at + k]


@inlined
def clip_to_face(count: int, polygon: int, corners: int, normal: Vector, work: Any, ids: Any) -> int:
    """Clip the loaded polygon to the sides of a face, along the normal; return how many corners are left."""
    centre = (0.0, 0.0, 0.0)
    for k in range(corners):
        centre = add(centre, scale(1.0 / corners, vertex_at(work, polygon, k)))
    for k in range(corners):
        start = vertex_at(work, polygon, k)
        along = sub(vertex_at(work, polygon, k + 1 if k + 1 < corners else 0), start)
        outward = cross(along, normal)
        square = dot(outward, outward)
        if square < 1e-24:
            continue
        towards = dot(outward, sub(start, centre))
        outward = scale((1.0 if towards >= 0.0 else -1.0) / math.sqrt(square), outward)
        count = clip_edge(count, start, outward, k, work, ids)
        if count == 0:
            break
    return count


@inlined
def clip_to_line(polygon: int, work: Any, ids: Any) -> int:
    """Clip the line that was taken to the length of another, nearly parallel; return how many ends are left."""
    start, end = vertex_at(work, polygon, 0), vertex_at(work, polygon, 1)
    along = sub(end, start)
    along = scale(1.0 / math.sqrt(dot(along, along)), along)
    count = clip_edge(TWO, start, scale(-1.0, along), NONE, work, ids)
    if count == 2:
        count = clip_edge(count, end, along, TWO, work, ids)
    return count


@inlined
def are_parallel(work: Any) -> bool:
    """Return whether the two lines are nearly parallel."""
    a = sub(vertex_at(work, POLYGON_A, 1), vertex_at(work, POLYGON_A, 0))
    b = sub(vertex_at(work, POLYGON_B, 1), vertex_at(work, POLYGON_B, 0))
    normal = cross(a, b)
    return bool(dot(normal, normal) < PARALLEL * PARALLEL * dot(a, a) * dot(b, b) and dot(a, a) * dot(b, b) > 0.0)


@inlined
def leaning(shape: Any, corners: int, normal: Vector) -> float:
    """Return how much nearer the lower edge of a wheel may be than the middle of its rim, which stands for it [m]."""
    if shape[0] == WHEEL and corners == 1:
        return float(shape[1][1] * abs(dot(column(shape[2], 2), normal)))
    return 0.0


@compiled
def face_contacts(
    count: int,
    a: Any,
    b: Any,
    numbers: Any,
    indices: Any,
    normal: Vector,
    gap: float,
    between: Vector,
    has_nearest: bool,
    margin: float,
    feature: int,
    work: Any,
    work_indices: Any,
) -> int:
    """Note the contacts of two shapes that touch along a normal.

    Args:
        count: how many candidates have been noted.
        a: the first shape: kind, size, rotation, centre, data.
        b: the second.
        numbers: of hulls and meshes.
        indices: of hulls and meshes.
        normal: unit vector from b to a.
        gap: of the two cores along it [m].
        between: half-way between the nearest points of the cores [m].
        has_nearest: whether `between` is known, and a contact wherever the faces do not cover each other.
        margin: gap of the shapes below which a point is a contact [m].
        feature: added to the features.
        work: working memory.
        work_indices: working memory.

    Returns:
        How many candidates there are then.
    """
    radius_a, radius_b = radius_of(a[0], a[1]), radius_of(b[0], b[1])
    shift = scale(0.5 * (radius_b - radius_a), normal)
    limit = margin + radius_a + radius_b
    first = count
    down = scale(-1.0, normal)
    corners_a, face_a = touching_face(a, numbers, indices, down, work, POLYGON_A, work_indices, ID_A)
    corners_b, face_b = touching_face(b, numbers, indices, normal, work, POLYGON_B, work_indices, ID_B)
    level_a = dot(face_a, down) if corners_a > 2 else 0.0
    level_b = dot(face_b, normal) if corners_b > 2 else 0.0
    clipped = 0
    # The face that is more nearly square to the normal stays whole; of two alike that is b's.
    clips_a = level_b >= level_a - 1e-6 and level_b > LEVEL
    clips_b = not clips_a and level_a > LEVEL
    start, facing = vertex_at(work, POLYGON_B, 0), face_b
    if clips_a:
        load_polygon(corners_a, POLYGON_A, ID_A, work, work_indices)
        clipped = clip_to_face(corners_a, POLYGON_B, corners_b, normal, work, work_indices)
    elif clips_b:
        start, facing = vertex_at(work, POLYGON_A, 0), face_a
        load_polygon(corners_b, POLYGON_B, ID_B, work, work_indices)
        clipped = clip_to_face(corners_b, POLYGON_A, corners_a, normal, work, work_indices)
    elif corners_a == 2 and corners_b == 2 and are_parallel(work):
        clips_a = True
        load_polygon(corners_a, POLYGON_A, ID_A, work, work_indices)
        clipped = clip_to_line(POLYGON_B, work, work_indices)
        # The face of b is the plane through its line that is most nearly perpendicular to the normal.
        along = sub(vertex_at(work, POLYGON_B, 1), start)
        facing = sub(normal, scale(dot(normal, along) / dot(along, along), along))
    least = math.inf
    for k in range(clipped):
        point = vertex_at(work, CLIPPED, k)
        height = dot(facing, sub(point, start)) / dot(facing, normal)
        # Past the end of a line that is not quite parallel the other seems nearer than anything is.
        here = max(gap, height if clips_a else -height)
        if here < limit:
            least = min(least, here)
            if count < MOST_CANDIDATES:
                middle = add(sub(point, scale(0.5 * height, normal)), shift)
                number = feature + work_indices[CLIPPED_ID + k] + (0 if clips_a else B_IS_CLIPPED)
                count = add_candidate(count, middle, normal, here - radius_a - radius_b, number, work, work_indices)
    # The lower edge of a leaning wheel is left out for the middle of its rim.
    reached = least <= gap + REACHED + leaning(a, corners_a, normal) + leaning(b, corners_b, normal)
    if has_nearest and gap < limit and not reached and count < MOST_CANDIDATES:
        count = add_candidate(
            count, add(between, shift), normal, gap - radius_a - radius_b, feature + NEAREST, work, work_indices
        )
    return keep_widest(first, count, work, work_indices)
