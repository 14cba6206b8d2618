"""Contacts of a convex shape with the triangles of a mesh.

The triangles near the shape are found in a tree of boxes and collided one by one. A triangle is collided without
its neighbours: where the normal found leans over an edge that only joins it to a neighbour, no shape can
come from there, and the normal is that of the triangle.
"""

import math
from typing import Any

import numpy as np

from urdfkit.sim.engine.collision.contact_candidates import keep_spread
from urdfkit.sim.engine.collision.convex_convex import nearest
from urdfkit.sim.engine.collision.face_clipping import face_contacts
from urdfkit.sim.engine.collision.support_faces import column
from urdfkit.sim.engine.collision.support_points import (
    FIRST_BOUND,
    FIRST_FLAG,
    FIRST_TRIANGLE,
    LEAVES,
    TRIANGLE,
    TRIANGLES,
    radius_of,
    support,
    vertex_at,
)
from urdfkit.sim.engine.collision.workspace import MOST_CANDIDATES, NONE, OTHER_STACK, STACK
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.spatial_algebra import Vector, add, cross, dot, rotate, scale, sub

LEAF = 4
"""Triangles in each leaf of the tree."""
A_TRIANGLE = np.int64(TRIANGLE)
"""The kind, of the type that other kinds have when they are looked up."""
ONE_SIDED = 8
"""Flag of a triangle of a closed mesh; the first three flags are those of edges that can be hit."""
LEANS = 1e-3
"""Sine of the angle above which a normal leans over an edge."""
KEPT, MOST_OF_ONE = np.int64(24), 6
"""Contacts kept when there is no room for more, and contacts that one triangle has at most."""
TRIANGLE_FEATURES = 1 << 21
"""Features of each triangle."""


@compiled
def bounds_in(
    a: Any, R: Any, p: Vector, numbers: Any, indices: Any, margin: float
) -> tuple[float, float, float, float, float, float]:
    """Return the least and the largest coordinates of a convex shape, with a margin, along the axes of a frame."""
    x, y, z = column(R, 0), column(R, 1), column(R, 2)
    reach = radius_of(a[0], a[1]) + margin
    low_x = dot(x, sub(support(a[0], a[1], a[2], a[3], a[4], numbers, indices, scale(-1.0, x)), p)) - reach
    low_y = dot(y, sub(support(a[0], a[1], a[2], a[3], a[4], numbers, indices, scale(-1.0, y)), p)) - reach
    low_z = dot(z, sub(support(a[0], a[1], a[2], a[3], a[4], numbers, indices, scale(-1.0, z)), p)) - reach
    high_x = dot(x, sub(support(a[0], a[1], a[2], a[3], a[4], numbers, indices, x), p)) + reach
    high_y = dot(y, sub(support(a[0], a[1], a[2], a[3], a[4], numbers, indices, y), p)) + reach
    high_z = dot(z, sub(support(a[0], a[1], a[2], a[3], a[4], numbers, indices, z), p)) + reach
    return (low_x, low_y, low_z, high_x, high_y, high_z)


@inlined
def meet(box: Any, numbers: Any, at: int) -> bool:
    """Return whether a box meets one of six numbers that start at `at`."""
    return bool(
        box[0] <= numbers[at + 3]
        and box[1] <= numbers[at + 4]
        and box[2] <= numbers[at + 5]
        and box[3] >= numbers[at]
        and box[4] >= numbers[at + 1]
        and box[5] >= numbers[at + 2]
    )


@inlined
def near_triangle(box: Any, numbers: Any, at: int) -> bool:
    """Return whether a box meets the box of a triangle whose nine numbers start at `at`."""
    for k in range(3):
        x, y, z = numbers[at + k], numbers[at + 3 + k], numbers[at + 6 + k]
        if box[k] > max(x, y, z) or box[3 + k] < min(x, y, z):
            return False
    return True


@inlined
def leans_over(flags: int, normal: Vector, facing: Vector, p: Vector, q: Vector, r: Vector) -> bool:
    """Return whether a normal leans over edges of a triangle none of which can be hit."""
    lateral = sub(normal, scale(dot(normal, facing), facing))
    square = dot(lateral, lateral)
    if square < LEANS * LEANS:
        return False
    reach_p, reach_q, reach_r = dot(lateral, p), dot(lateral, q), dot(lateral, r)
    furthest = max(reach_p, reach_q, reach_r)
    extent = furthest - min(reach_p, reach_q, reach_r)
    slack = 1e-6 * extent
    on_p, on_q, on_r = reach_p >= furthest - slack, reach_q >= furthest - slack, reach_r >= furthest - slack
    # An edge is leant over as a whole, or both edges of a corner are.
    over = 0
    if on_p and on_q:
        over = 1
    elif on_q and on_r:
        over = 2
    elif on_r and on_p:
        over = 4
    elif on_p:
        over = 5
    elif on_q:
        over = 3
    else:
        over = 6
    return bool((flags & over) == 0)


@compiled
def collide_triangle(
    count: int,
    a: Any,
    triangle: Any,
    flags: int,
    numbers: Any,
    indices: Any,
    margin: float,
    feature: int,
    work: Any,
    work_indices: Any,
) -> int:
    """Note the contacts of a convex shape with one triangle of a mesh; return how many there are."""
    limit = margin + radius_of(a[0], a[1])
    near, normal, gap, between = nearest(a, triangle, numbers, indices, limit, work, work_indices)
    if not near:
        return count
    R, place, data = triangle[2], triangle[3], triangle[4]
    p = add(place, rotate(R, vertex_at(numbers, data, 0)))
    q = add(place, rotate(R, vertex_at(numbers, data, 1)))
    r = add(place, rotate(R, vertex_at(numbers, data, 2)))
    facing = cross(sub(q, p), sub(r, p))
    square = dot(facing, facing)
    has_nearest = True
    if square > 0.0:
        facing = scale(1.0 / math.sqrt(square), facing)
        if flags & ONE_SIDED == 0 and dot(facing, sub(a[3], p)) < 0.0:
            facing = scale(-1.0, facing)
        if flags & ONE_SIDED and dot(normal, facing) < -LEANS:
            # The shape is behind: that is for the faces it came in by, or a thin plate would be left at its far side.
            return count
        leans = abs(dot(normal, facing)) < 1.0 - 0.5 * LEANS * LEANS
        # Along the triangle's own normal shapes touch inside it, or not this triangle.
        has_nearest = leans
        if leans_over(flags, normal, facing, p, q, r):
            normal = facing
            lowest = support(a[0], a[1], a[2], a[3], a[4], numbers, indices, scale(-1.0, normal))
            gap = dot(normal, sub(lowest, p))
            has_nearest = False
            if gap >= limit:
                return count
    return face_contacts(
        count,
        a,
        triangle,
        numbers,
        indices,
        normal,
        gap,
        between,
        has_nearest,
        margin,
        feature,
        work,
        work_indices,
    )


@compiled
def collide_mesh(
    count: int, a: Any, mesh: Any, numbers: Any, indices: Any, margin: float, feature: int, work: Any, work_indices: Any
) -> int:
    """Note the contacts of a convex shape with a mesh, the second; return how many there are."""
    R, p, data = mesh[2], mesh[3], mesh[4]
    box = bounds_in(a, R, p, numbers, indices, margin)
    reach = 0.5 * (box[3] - box[0] + box[4] - box[1] + box[5] - box[2])
    leaves, bounds = indices[data + LEAVES], indices[data + FIRST_BOUND]
    triangles, first, flag = indices[data + TRIANGLES], indices[data + FIRST_TRIANGLE], indices[data + FIRST_FLAG]
    work_indices[STACK] = 0
    waiting = 1
    while waiting > 0:
        waiting -= 1
        node = work_indices[STACK + waiting]
        if not meet(box, numbers, bounds + 6 * node):
            continue
        if node < leaves - 1:
            work_indices[STACK + waiting] = 2 * node + 2
            work_indices[STACK + waiting + 1] = 2 * node + 1
            waiting += 2
            continue
        leaf = LEAF * (node - leaves + 1)
        for k in range(leaf, min(leaf + LEAF, triangles)):
            if near_triangle(box, numbers, first + 9 * k):
                if count > MOST_CANDIDATES - MOST_OF_ONE:
                    count = keep_spread(count, KEPT, reach, work, work_indices)
                triangle = (A_TRIANGLE, mesh[1], R, p, first + 9 * k)
                number = feature + TRIANGLE_FEATURES * k
                count = collide_triangle(
                    count, a, triangle, indices[flag + k], numbers, indices, margin, number, work, work_indices
                )
    return count


@compiled
def collide_meshes(a: Any, b: Any, numbers: Any, indices: Any, margin: float, work: Any, work_indices: Any) -> int:
    """Note the contacts of two meshes; return how many there are."""
    R, p, data = a[2], a[3], a[4]
    # The ball round the box of b, along the axes of a.
    at = indices[b[4] + FIRST_BOUND]
    low, high = vertex_at(numbers, at, 0), vertex_at(numbers, at, 1)
    half = scale(0.5, sub(high, low))
    reach = math.sqrt(dot(half, half)) + margin
    centre = sub(add(b[3], rotate(b[2], scale(0.5, add(low, high)))), p)
    x, y, z = dot(column(R, 0), centre), dot(column(R, 1), centre), dot(column(R, 2), centre)
    box = (x - reach, y - reach, z - reach, x + reach, y + reach, z + reach)
    leaves, bounds = indices[data + LEAVES], indices[data + FIRST_BOUND]
    triangles, first = indices[data + TRIANGLES], indices[data + FIRST_TRIANGLE]
    count = NONE
    work_indices[OTHER_STACK] = 0
    waiting = 1
    while waiting > 0:
        waiting -= 1
        node = work_indices[OTHER_STACK + waiting]
        if not meet(box, numbers, bounds + 6 * node):
            continue
        if node < leaves - 1:
            work_indices[OTHER_STACK + waiting] = 2 * node + 2
            work_indices[OTHER_STACK + waiting + 1] = 2 * node + 1
            waiting += 2
            continue
        leaf = LEAF * (node - leaves + 1)
        for k in range(leaf, min(leaf + LEAF, triangles)):
            if near_triangle(box, numbers, first + 9 * k):
                triangle = (A_TRIANGLE, a[1], R, p, first + 9 * k)
                # Features stay below 2⁴⁸ for meshes of any size; of large ones two may share a number.
                number = (k % (1 << 13)) << 34
                count = collide_mesh(count, triangle, b, numbers, indices, margin, number, work, work_indices)
    return int(count)
