"""The distance of two convex shapes: the algorithm of Gilbert, Johnson and Keerthi.

The shapes are as far apart as the origin is from their Minkowski difference. A simplex of support points of the
difference moves towards the origin until no support point is nearer. After C. Ericson, Real-Time Collision Detection,
2005, sections 5.1 and 9.5.
"""

import math
from typing import Any

from urdfkit.sim.engine.collision.support_points import support, vertex_at
from urdfkit.sim.engine.collision.workspace import DIFFERENCE, ON_A
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.spatial_algebra import Vector, add, cross, dot, scale, sub

FAR, SEPARATED, OVERLAPPING = range(3)
"""Results: farther apart than the limit, separated, and overlapping or touching."""

ITERATIONS = 100
TOUCHING = 1e-9
"""Distance over extent of the difference below which two shapes count as touching."""
EXACT = 1e-11
"""Error of the distance, over the extent of the difference, at which the search ends."""


@inlined
def store_vector_at(work: Any, start: int, k: int, x: Vector) -> None:
    """Write the k-th of the vectors that start at `start`."""
    work[start + 3 * k], work[start + 3 * k + 1], work[start + 3 * k + 2] = x


@inlined
def support_of_difference(a: Any, b: Any, numbers: Any, indices: Any, direction: Vector) -> tuple[Vector, Vector]:
    """Return the point of a - b furthest in a direction, and the point of a that makes it."""
    on_a = support(a[0], a[1], a[2], a[3], a[4], numbers, indices, direction)
    on_b = support(b[0], b[1], b[2], b[3], b[4], numbers, indices, scale(-1.0, direction))
    return sub(on_a, on_b), on_a


@inlined
def segment_weight(p: Vector, q: Vector) -> float:
    """Return how far along from p to q the point nearest to the origin is, 0 to 1."""
    along = sub(q, p)
    square = dot(along, along)
    return min(1.0, max(0.0, -dot(p, along) / square)) if square > 0.0 else 0.0


@compiled
def triangle_weights(p: Vector, q: Vector, r: Vector) -> Vector:
    """Return the weights of the corners that make the point of a triangle nearest to the origin."""
    normal = cross(sub(q, p), sub(r, p))
    u, v, w = dot(normal, cross(q, r)), dot(normal, cross(r, p)), dot(normal, cross(p, q))
    if u > 0.0 and v > 0.0 and w > 0.0:
        total = u + v + w
        return (u / total, v / total, w / total)
    # Else the nearest point is on an edge.
    t = segment_weight(p, q)
    best = (1.0 - t, t, 0.0)
    nearest = add(scale(1.0 - t, p), scale(t, q))
    least = dot(nearest, nearest)
    t = segment_weight(q, r)
    nearest = add(scale(1.0 - t, q), scale(t, r))
    if dot(nearest, nearest) < least:
        least, best = dot(nearest, nearest), (0.0, 1.0 - t, t)
    t = segment_weight(r, p)
    nearest = add(scale(1.0 - t, r), scale(t, p))
    if dot(nearest, nearest) < least:
        best = (t, 0.0, 1.0 - t)
    return best


@compiled
def nearest_weights(count: int, work: Any) -> tuple[float, float, float, float]:
    """Return the weights of the simplex's points that make its point nearest to the origin."""
    p = vertex_at(work, DIFFERENCE, 0)
    if count == 1:
        return (1.0, 0.0, 0.0, 0.0)
    q = vertex_at(work, DIFFERENCE, 1)
    if count == 2:
        t = segment_weight(p, q)
        return (1.0 - t, t, 0.0, 0.0)
    r = vertex_at(work, DIFFERENCE, 2)
    if count == 3:
        weights = triangle_weights(p, q, r)
        return (weights[0], weights[1], weights[2], 0.0)
    s = vertex_at(work, DIFFERENCE, 3)
    volume = dot(cross(sub(q, p), sub(r, p)), sub(s, p))
    least = math.inf
    best = (0.25, 0.25, 0.25, 0.25)
    # The origin is outside a face when it and the fourth point are on different sides.
    if -dot(cross(sub(q, p), sub(r, p)), p) * volume <= 0.0:
        w = triangle_weights(p, q, r)
        nearest = add(add(scale(w[0], p), scale(w[1], q)), scale(w[2], r))
        least, best = dot(nearest, nearest), (w[0], w[1], w[2], 0.0)
    if dot(cross(sub(q, p), sub(s, p)), p) * volume <= 0.0:
        w = triangle_weights(p, q, s)
        nearest = add(add(scale(w[0], p), scale(w[1], q)), scale(w[2], s))
        if dot(nearest, nearest) < least:
            least, best = dot(nearest, nearest), (w[0], w[1], 0.0, w[2])
    if -dot(cross(sub(r, p), sub(s, p)), p) * volume <= 0.0:
        w = triangle_weights(p, r, s)
        nearest = add(add(scale(w[0], p), scale(w[1], r)), scale(w[2], s))
        if dot(nearest, nearest) < least:
            least, best = dot(nearest, nearest), (w[0], 0.0, w[1], w[2])
    if dot(cross(sub(r, q), sub(s, q)), q) * volume <= 0.0:
        w = triangle_weights(q, r, s)
        nearest = add(add(scale(w[0], q), scale(w[1], r)), scale(w[2], s))
        if dot(nearest, nearest) < least:
            best = (0.0, w[0], w[1], w[2])
    return best


@compiled
def distance(a: Any, b: Any, numbers: Any, indices: Any, limit: float, work: Any) -> tuple[int, int, Vector, Vector]:
    """Find the points of two cores nearest to each other.

    Args:
        a: the first shape: kind, size, rotation, centre, data.
        b: the second.
        numbers: of hulls and meshes.
        indices: of hulls and meshes.
        limit: the search ends when the distance is known to be larger [m].
        work: working memory; the simplex is left there.

    Returns:
        `FAR`, `SEPARATED` or `OVERLAPPING`; number of points of the simplex; vector from the point on b to that on a;
        the point on a.
    """
    away = sub(a[3], b[3])
    if dot(away, away) == 0.0:
        away = (1.0, 0.0, 0.0)
    v, on_a = support_of_difference(a, b, numbers, indices, scale(-1.0, away))
    store_vector_at(work, DIFFERENCE, 0, v)
    store_vector_at(work, ON_A, 0, on_a)
    count = 1
    largest = dot(v, v)
    for _ in range(ITERATIONS):
        square = dot(v, v)
        if square <= TOUCHING * TOUCHING * largest or square < 1e-280:
            return OVERLAPPING, count, v, on_a
        w, new_on_a = support_of_difference(a, b, numbers, indices, scale(-1.0, v))
        reach = dot(v, w)
        if reach > 0.0 and reach * reach > limit * limit * square:
            return FAR, count, v, on_a
        largest = max(largest, dot(w, w))
        if square - reach <= EXACT * math.sqrt(square * largest):
            return SEPARATED, count, v, on_a
        store_vector_at(work, DIFFERENCE, count, w)
        store_vector_at(work, ON_A, count, new_on_a)
        count += 1
        weights = nearest_weights(count, work)
        kept = 0
        new_v, new_on_a = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        for k in range(count):
            if weights[k] > 0.0:
                w, from_a = vertex_at(work, DIFFERENCE, k), vertex_at(work, ON_A, k)
                new_v = add(new_v, scale(weights[k], w))
                new_on_a = add(new_on_a, scale(weights[k], from_a))
                store_vector_at(work, DIFFERENCE, kept, w)
                store_vector_at(work, ON_A, kept, from_a)
                kept += 1
        count = kept
        if count == 4:
            return OVERLAPPING, count, new_v, new_on_a
        if dot(new_v, new_v) >= square:
            # As near as rounding allows.
            return SEPARATED, count, v, on_a
        v, on_a = new_v, new_on_a
    return SEPARATED, count, v, on_a
