"""The face, edge or corner with which a convex shape touches in a direction, as a polygon in the working memory."""

import math
from typing import Any

from urdfkit.sim.engine.collision.gjk import store_vector_at
from urdfkit.sim.engine.collision.support_points import (
    BOX,
    CAPSULE,
    CYLINDER,
    FACES,
    FIRST_CORNER,
    FIRST_LOOP,
    FIRST_NORMAL,
    FIRST_VERTEX,
    HULL,
    TRIANGLE,
    WHEEL,
    support,
    unrotate,
    vertex_at,
)
from urdfkit.sim.engine.collision.workspace import MOST_CORNERS
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.spatial_algebra import Vector, add, cross, dot, rotate, scale, sub

RIM = 8
"""Corners that stand for the rim of a cylinder; between them its lowest point is a corner of its own."""
STANDING = 0.7
"""Cosine of the angle between axis and normal above which a cylinder touches with its flat face."""
LEANING = 0.02
"""Tilt [rad] over which the contact of a leaning wheel moves from the middle of its rim to the edge."""
UPRIGHT = 1e-3
"""Sine of that angle below which the corners are counted from the cylinder's own x axis, not from the lowest point."""


@inlined
def column(R: Any, k: int) -> Vector:
    """Return the k-th axis of a rotation."""
    return (R[k], R[3 + k], R[6 + k])


@inlined
def box_face(size: Vector, R: Any, p: Vector, d: Vector, work: Any, at: int, ids: Any, id_at: int) -> Vector:
    """Write the four corners of the face of a box that looks most in a direction; return its normal."""
    x, y, z = abs(d[0]), abs(d[1]), abs(d[2])
    k = 0
    if y > x:
        k = 1
    if z > max(x, y):
        k = 2
    i, j = (k + 1) % 3, (k + 2) % 3
    sign = 1.0 if d[k] >= 0.0 else -1.0
    normal = scale(sign, column(R, k))
    centre = add(p, scale(size[k], normal))
    u, v = scale(size[i], column(R, i)), scale(size[j], column(R, j))
    for corner in range(4):
        right = 1.0 if corner in (0, 3) else -1.0
        up = 1.0 if corner < 2 else -1.0
        store_vector_at(work, at, corner, add(centre, add(scale(right, u), scale(up, v))))
        ids[id_at + corner] = (
            ((1 if right > 0.0 else 0) << i) | ((1 if up > 0.0 else 0) << j) | ((1 if sign > 0.0 else 0) << k)
        )
    return normal


@inlined
def rim(size: Vector, R: Any, p: Vector, d: Vector, work: Any, at: int, ids: Any, id_at: int) -> Vector:
    """Write corners of the flat face of a cylinder that looks in a direction; return its normal."""
    sign = 1.0 if d[2] >= 0.0 else -1.0
    level = math.sqrt(d[0] * d[0] + d[1] * d[1])
    x, y = 1.0, 0.0
    if level > UPRIGHT * math.sqrt(dot(d, d)):
        x, y = d[0] / level, d[1] / level
    for corner in range(RIM):
        s, c = sine_cosine(2.0 * math.pi * corner / RIM)
        s, c = size[0] * s, size[0] * c
        store_vector_at(work, at, corner, add(p, rotate(R, (c * x - s * y, s * x + c * y, sign * size[1]))))
        ids[id_at + corner] = corner + (RIM if sign > 0.0 else 0)
    return scale(sign, column(R, 2))


@inlined
def line(size: Vector, R: Any, p: Vector, outward: Vector, work: Any, at: int, ids: Any, id_at: int) -> None:
    """Write the two ends of a line along the z axis of a shape, first the lower, moved outward."""
    axis = scale(size[1], column(R, 2))
    store_vector_at(work, at, 0, add(p, sub(outward, axis)))
    store_vector_at(work, at, 1, add(p, add(outward, axis)))
    ids[id_at], ids[id_at + 1] = 0, 1


@inlined
def hull_face(
    R: Any, p: Vector, data: int, numbers: Any, indices: Any, d: Vector, work: Any, at: int, ids: Any, id_at: int
) -> tuple[int, Vector]:
    """Write the face of a hull that looks most in a direction; return its corners and its normal."""
    first = indices[data + FIRST_NORMAL]
    best, most = 0, -math.inf
    for k in range(indices[data + FACES]):
        reach = dot(d, vertex_at(numbers, first, k))
        if reach > most:
            best, most = k, reach
    loop = indices[data + FIRST_LOOP] + best
    corners = indices[data + FIRST_CORNER]
    count = min(MOST_CORNERS, indices[loop + 1] - indices[loop])
    for k in range(count):
        vertex = indices[corners + indices[loop] + k]
        store_vector_at(work, at, k, add(p, rotate(R, vertex_at(numbers, indices[data + FIRST_VERTEX], vertex))))
        ids[id_at + k] = vertex
    return count, rotate(R, vertex_at(numbers, first, best))


@compiled
def touching_face(
    shape: Any, numbers: Any, indices: Any, direction: Vector, work: Any, at: int, ids: Any, id_at: int
) -> tuple[int, Vector]:
    """Write the corners of the core of a shape that touch first in a direction.

    Args:
        shape: kind, size, rotation, centre, data.
        numbers: of hulls and meshes.
        indices: of hulls and meshes.
        direction: unit vector.
        work: where the corners are written.
        at: from here on.
        ids: where the corners' numbers are written, each below 64.
        id_at: from here on.

    Returns:
        How many corners there are, one or two for a point or a line, and the normal of a face.
    """
    kind, size, R, p, data = shape
    d = unrotate(R, direction)
    if kind == BOX:
        return 4, box_face(size, R, p, d, work, at, ids, id_at)
    if kind == HULL:
        return hull_face(R, p, data, numbers, indices, d, work, at, ids, id_at)
    if kind == TRIANGLE:
        for k in range(3):
            store_vector_at(work, at, k, add(p, rotate(R, vertex_at(numbers, data, k))))
            ids[id_at + k] = k
        first = vertex_at(work, at, 0)
        normal = cross(sub(vertex_at(work, at, 1), first), sub(vertex_at(work, at, 2), first))
        square = dot(normal, normal)
        if square > 0.0:
            # Both sides of a triangle are its face.
            return 3, scale((1.0 if dot(normal, direction) >= 0.0 else -1.0) / math.sqrt(square), normal)
    elif kind == CAPSULE:
        line(size, R, p, (0.0, 0.0, 0.0), work, at, ids, id_at)
        return 2, direction
    elif kind in (CYLINDER, WHEEL):
        level = math.sqrt(d[0] * d[0] + d[1] * d[1])
        if abs(d[2]) > STANDING:
            return RIM, rim(size, R, p, d, work, at, ids, id_at)
        outward = rotate(R, (size[0] * d[0] / level, size[0] * d[1] / level, 0.0))
        if kind == WHEEL:
            along = size[1] * min(1.0, max(-1.0, d[2] / LEANING))
            store_vector_at(work, at, 0, add(p, add(outward, scale(along, column(R, 2)))))
            ids[id_at] = 0
            return 1, direction
        line(size, R, p, outward, work, at, ids, id_at)
        return 2, direction
    store_vector_at(work, at, 0, support(kind, size, R, p, data, numbers, indices, direction))
    ids[id_at] = 0
    return 1, direction
