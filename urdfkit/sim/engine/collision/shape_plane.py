"""Contacts of a shape with the half-space below a plane."""

from typing import Any

import numpy as np

from urdfkit.sim.engine.collision.contact_candidates import add_candidate, keep_spread, keep_widest
from urdfkit.sim.engine.collision.face_clipping import NEAREST, REACHED
from urdfkit.sim.engine.collision.support_faces import column, touching_face
from urdfkit.sim.engine.collision.support_points import (
    FIRST_TRIANGLE,
    FIRST_VERTEX,
    HULL,
    MESH,
    TRIANGLES,
    VERTICES,
    WHEEL,
    radius_of,
    support,
    vertex_at,
)
from urdfkit.sim.engine.collision.workspace import ID_A, MOST_CANDIDATES, NONE, POLYGON_A
from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.math.spatial_algebra import add, dot, rotate, scale, sub

HALF = np.int64(MOST_CANDIDATES // 2)
"""Contacts kept when there is no room for more."""


@compiled
def collide_plane(a: Any, b: Any, numbers: Any, indices: Any, margin: float, work: Any, work_indices: Any) -> int:
    """Note the contacts of a shape with a plane, the second; return how many there are.

    A hull or mesh touches with its vertices, anything else with the corners of its lowest face and its lowest point.
    """
    kind, size, R, p, data = a
    normal = column(b[2], 2)
    down = scale(-1.0, normal)
    radius = radius_of(kind, size)
    count = 0
    if kind in (HULL, MESH):
        first = indices[data + (FIRST_VERTEX if kind == HULL else FIRST_TRIANGLE)]
        for k in range(indices[data + VERTICES] if kind == HULL else 3 * indices[data + TRIANGLES]):
            point = add(p, rotate(R, vertex_at(numbers, first, k)))
            height = dot(normal, sub(point, b[3]))
            if height < margin:
                if count == MOST_CANDIDATES:
                    count = keep_spread(count, HALF, 1.0, work, work_indices)
                count = add_candidate(
                    count, sub(point, scale(0.5 * height, normal)), normal, height, k, work, work_indices
                )
        return keep_widest(NONE, count, work, work_indices)
    lowest = support(kind, size, R, p, data, numbers, indices, down)
    gap = dot(normal, sub(lowest, b[3])) - radius
    if gap >= margin:
        return 0
    corners, _ = touching_face(a, numbers, indices, down, work, POLYGON_A, work_indices, ID_A)
    reached = kind == WHEEL and corners == 1
    for k in range(corners):
        point = vertex_at(work, POLYGON_A, k)
        height = dot(normal, sub(point, b[3]))
        if height - radius < margin:
            middle = sub(point, scale(0.5 * (height + radius), normal))
            count = add_candidate(count, middle, normal, height - radius, work_indices[ID_A + k], work, work_indices)
            reached = reached or height - radius <= gap + REACHED
    if not reached:
        middle = sub(lowest, scale(0.5 * gap + radius, normal))
        count = add_candidate(count, middle, normal, gap, NEAREST, work, work_indices)
    return keep_widest(NONE, count, work, work_indices)
