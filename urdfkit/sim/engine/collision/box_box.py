"""Normal and gap of two boxes, where one touches with a face: by the axes that can separate them.

After S. Gottschalk, M. Lin and D. Manocha, OBBTree, SIGGRAPH 1996: two boxes overlap unless an axis of one, or one
square to an edge of each, separates them.
"""

from typing import Any

from urdfkit.sim.engine.collision.support_faces import column
from urdfkit.sim.engine.collision.support_points import unrotate
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.spatial_algebra import ZERO, Vector, add, dot, scale, sub

FAR, FOUND, UNSURE = range(3)
"""Results: farther apart than the limit, found, and not decidable by these axes alone."""
PARALLEL = 1e-14
"""One minus the cosine of the angle below which faces count as parallel."""
TOLERANCE = 1e-9
"""Tolerance [m] for a corner to be over a face, and by which an edge must be better than a face."""
SAME_EDGE = 1e-8
"""Square of the sine between two edges below which they have no axis of their own."""


@inlined
def corner_towards(box: Any, direction: Vector) -> Vector:
    """Return the corner of a box that lies furthest in a direction."""
    _, size, R, p, _ = box
    d = unrotate(R, direction)
    x = scale(size[0] if d[0] >= 0.0 else -size[0], column(R, 0))
    y = scale(size[1] if d[1] >= 0.0 else -size[1], column(R, 1))
    z = scale(size[2] if d[2] >= 0.0 else -size[2], column(R, 2))
    return add(add(p, x), add(y, z))


@inlined
def over_face(box: Any, k: int, point: Vector) -> bool:
    """Return whether a point lies over the faces of a box that look along its k-th axis."""
    _, size, R, p, _ = box
    x, y, z = unrotate(R, sub(point, p))
    return bool(
        (k == 0 or abs(x) <= size[0] + TOLERANCE)
        and (k == 1 or abs(y) <= size[1] + TOLERANCE)
        and (k == 2 or abs(z) <= size[2] + TOLERANCE)
    )


@inlined
def edge_gap(
    t: float, s: float, c_t: float, c_s: float, a_t: float, a_s: float, b_u: float, b_w: float, c_u: float, c_w: float
) -> float:
    """Return the gap along an axis square to an edge of each, times the sine between them."""
    return abs(s * c_t - t * c_s) - (a_t * abs(c_s) + a_s * abs(c_t) + b_u * abs(c_w) + b_w * abs(c_u))


@compiled
def box_and_box(a: Any, b: Any, limit: float) -> tuple[int, Vector, float, Vector]:
    """Find the normal and the gap of two boxes.

    Args:
        a: the first: kind, size, rotation, centre, data.
        b: the second.
        limit: gap beyond which nothing is found [m].

    Returns:
        `FAR`, `FOUND` or `UNSURE`; the unit normal from b to a, the gap [m], and the point half-way [m].
    """
    e, f = a[1], b[1]
    t = unrotate(a[2], sub(b[3], a[3]))
    x, y, z = unrotate(a[2], column(b[2], 0)), unrotate(a[2], column(b[2], 1)), unrotate(a[2], column(b[2], 2))
    s = (dot(x, t), dot(y, t), dot(z, t))
    on_a = (
        abs(t[0]) - e[0] - f[0] * abs(x[0]) - f[1] * abs(y[0]) - f[2] * abs(z[0]),
        abs(t[1]) - e[1] - f[0] * abs(x[1]) - f[1] * abs(y[1]) - f[2] * abs(z[1]),
        abs(t[2]) - e[2] - f[0] * abs(x[2]) - f[1] * abs(y[2]) - f[2] * abs(z[2]),
    )
    on_b = (
        abs(s[0]) - f[0] - e[0] * abs(x[0]) - e[1] * abs(x[1]) - e[2] * abs(x[2]),
        abs(s[1]) - f[1] - e[0] * abs(y[0]) - e[1] * abs(y[1]) - e[2] * abs(y[2]),
        abs(s[2]) - f[2] - e[0] * abs(z[0]) - e[1] * abs(z[1]) - e[2] * abs(z[2]),
    )
    gap, best = on_a[0], 0
    if on_a[1] > gap:
        gap, best = on_a[1], 1
    if on_a[2] > gap:
        gap, best = on_a[2], 2
    if on_b[0] > gap + TOLERANCE:
        gap, best = on_b[0], 3
    if on_b[1] > gap + TOLERANCE:
        gap, best = on_b[1], 4
    if on_b[2] > gap + TOLERANCE:
        gap, best = on_b[2], 5
    if gap > limit:
        return FAR, ZERO, gap, ZERO
    for j in range(3):
        c = x if j == 0 else (y if j == 1 else z)
        u, w = (y, z) if j == 0 else ((z, x) if j == 1 else (x, y))
        f_u, f_w = (f[1], f[2]) if j == 0 else ((f[2], f[0]) if j == 1 else (f[0], f[1]))
        square = 1.0 - c[0] * c[0]
        if square > SAME_EDGE:
            here = edge_gap(t[1], t[2], c[1], c[2], e[1], e[2], f_u, f_w, u[0], w[0])
            if here > (gap + TOLERANCE) * square**0.5:
                return UNSURE, ZERO, gap, ZERO
        square = 1.0 - c[1] * c[1]
        if square > SAME_EDGE:
            here = edge_gap(t[2], t[0], c[2], c[0], e[2], e[0], f_u, f_w, u[1], w[1])
            if here > (gap + TOLERANCE) * square**0.5:
                return UNSURE, ZERO, gap, ZERO
        square = 1.0 - c[2] * c[2]
        if square > SAME_EDGE:
            here = edge_gap(t[0], t[1], c[0], c[1], e[0], e[1], f_u, f_w, u[2], w[2])
            if here > (gap + TOLERANCE) * square**0.5:
                return UNSURE, ZERO, gap, ZERO
    if best < 3:
        along = t[0] if best == 0 else (t[1] if best == 1 else t[2])
        axis = column(a[2], 0) if best == 0 else (column(a[2], 1) if best == 1 else column(a[2], 2))
        normal = scale(-1.0 if along >= 0.0 else 1.0, axis)
        corner = corner_towards(b, normal)
        between = add(corner, scale(0.5 * gap, normal))
        is_over = gap <= 0.0 or over_face(a, best, corner)
    else:
        along = s[0] if best == 3 else (s[1] if best == 4 else s[2])
        axis = column(b[2], 0) if best == 3 else (column(b[2], 1) if best == 4 else column(b[2], 2))
        normal = scale(-1.0 if along >= 0.0 else 1.0, axis)
        corner = corner_towards(a, scale(-1.0, normal))
        between = sub(corner, scale(0.5 * gap, normal))
        is_over = gap <= 0.0 or over_face(b, best - 3, corner)
    if not is_over:
        # Parallel faces may overlap partly, with the corner outside the overlap.
        count = 0
        for k in range(3):
            count += (on_a[0] if k == 0 else (on_a[1] if k == 1 else on_a[2])) > 0.0
            count += (on_b[0] if k == 0 else (on_b[1] if k == 1 else on_b[2])) > 0.0
        cosine = max(abs(dot(normal, column(b[2], 0))), abs(dot(normal, column(b[2], 1))))
        cosine = max(cosine, abs(dot(normal, column(b[2], 2))))
        if best >= 3:
            cosine = max(abs(dot(normal, column(a[2], 0))), abs(dot(normal, column(a[2], 1))))
            cosine = max(cosine, abs(dot(normal, column(a[2], 2))))
        if count > 2 or cosine < 1.0 - PARALLEL:
            return UNSURE, ZERO, gap, ZERO
    return FOUND, normal, gap, between
