"""Contacts of a pair of shapes of any kind."""

from typing import Any

import numpy as np

from urdfkit.sim.engine.collision import workspace
from urdfkit.sim.engine.collision.contact_candidates import keep_few, write
from urdfkit.sim.engine.collision.convex_convex import collide_convex
from urdfkit.sim.engine.collision.convex_mesh import collide_mesh, collide_meshes
from urdfkit.sim.engine.collision.shape_plane import collide_plane
from urdfkit.sim.engine.collision.support_points import MESH, PLANE
from urdfkit.sim.engine.collision.workspace import NONE
from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.math.spatial_algebra import Vector

MOST = 8
"""Most contacts of one pair; the outputs have room for so many."""
NORMAL_WEIGHT = 0.1
"""Distance [m] between contacts with a mesh that weighs as much as a difference of one between their normals."""
WORK, WORK_INDICES = workspace.WORK, workspace.WORK_INDICES
"""Floats and integers of working memory, which the caller allocates once."""


@compiled
def collide_pair(
    kind_a: int,
    size_a: Vector,
    R_a: Any,
    p_a: Vector,
    data_a: int,
    kind_b: int,
    size_b: Vector,
    R_b: Any,
    p_b: Vector,
    data_b: int,
    numbers: Any,
    indices: Any,
    margin: float,
    work: Any,
    work_indices: Any,
    out_point: Any,
    out_normal: Any,
    out_gap: Any,
    out_feature: Any,
) -> int:
    """Find the contacts of two shapes whose gap is below `margin`; return how many.

    Args:
        kind_a: kind of the first shape (`support_points.SPHERE` and so on).
        size_a: its sizes [m].
        R_a: its rotation, nine numbers row by row.
        p_a: its centre [m].
        data_a: where the head of its hull or mesh is among `indices`; any number for other shapes.
        kind_b: the same of the second shape.
        size_b: the same.
        R_b: the same.
        p_b: the same.
        data_b: the same.
        numbers: vertices and so on of all hulls and meshes (`geometry_arrays.Geometry`).
        indices: their heads and so on.
        margin: gap below which a contact is found [m].
        work: working memory, `WORK` floats.
        work_indices: working memory, `WORK_INDICES` integers.
        out_point: flat, three each: half-way between the two surfaces [m].
        out_normal: flat, three each: unit vectors from b to a.
        out_gap: distance along the normal [m], negative where the shapes overlap.
        out_feature: number of what touches; it stays as long as the same parts touch, and is below 2⁴⁸.

    Returns:
        How many contacts, at most `MOST`.
    """
    a = (kind_a, size_a, R_a, p_a, data_a)
    b = (kind_b, size_b, R_b, p_b, data_b)
    sign = 1.0
    # Planes come second, meshes second before anything but a plane.
    if kind_a == PLANE or (kind_a == MESH and kind_b != PLANE):
        a, b = b, a
        sign = -1.0
    if b[0] == PLANE:
        count = 0 if a[0] == PLANE else collide_plane(a, b, numbers, indices, margin, work, work_indices)
    elif b[0] == MESH:
        if a[0] == MESH:
            count = collide_meshes(a, b, numbers, indices, margin, work, work_indices)
        else:
            count = collide_mesh(NONE, a, b, numbers, indices, margin, NONE, work, work_indices)
        count = keep_few(count, np.int64(MOST), NORMAL_WEIGHT, work, work_indices)
    else:
        count = collide_convex(NONE, a, b, numbers, indices, margin, NONE, work, work_indices)
    write(count, sign, work, work_indices, out_point, out_normal, out_gap, out_feature)
    return count
