"""Contacts of two convex shapes of any kind."""

import math
from typing import Any

from urdfkit.sim.engine.collision.box_box import FOUND, UNSURE, box_and_box
from urdfkit.sim.engine.collision.epa import across, depth
from urdfkit.sim.engine.collision.face_clipping import face_contacts
from urdfkit.sim.engine.collision.gjk import FAR, SEPARATED, distance, support_of_difference
from urdfkit.sim.engine.collision.support_faces import column
from urdfkit.sim.engine.collision.support_points import BOX, CAPSULE, CYLINDER, SPHERE, WHEEL, radius_of, unrotate
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.spatial_algebra import Vector, add, cross, dot, rotate, scale, sub


@inlined
def point_and_cylinder(a: Any, b: Any) -> tuple[Vector, float, Vector]:
    """Return normal, gap and point half-way of a point and a cylinder.

    Inside a cylinder all directions may be equally good, and EPA does not converge.
    """
    sign = 1.0 if a[0] == SPHERE else -1.0
    point, size, R, p = (a[3], b[1], b[2], b[3]) if a[0] == SPHERE else (b[3], a[1], a[2], a[3])
    x, y, z = unrotate(R, sub(point, p))
    off = math.sqrt(x * x + y * y)
    outward = (x / off, y / off, 0.0) if off > 1e-12 * size[0] else (1.0, 0.0, 0.0)
    up = (0.0, 0.0, 1.0 if z >= 0.0 else -1.0)
    radial, axial = off - size[0], abs(z) - size[1]
    if radial > 0.0 and axial > 0.0:
        gap = math.sqrt(radial * radial + axial * axial)
        normal = scale(1.0 / gap, add(scale(radial, outward), scale(axial, up)))
    elif radial > axial:
        gap, normal = radial, outward
    else:
        gap, normal = axial, up
    normal = rotate(R, normal)
    return scale(sign, normal), gap, sub(point, scale(0.5 * gap, normal))


@inlined
def side_by_side(
    a: Any, b: Any, normal: Vector, separation: Vector, numbers: Any, indices: Any
) -> tuple[Vector, Vector]:
    """Return the better separation of two overlapping round shapes: the given one, or the one across their sides.

    Shapes around a common axis separate equally well in all directions across it, where EPA does not converge.
    """
    axis_a, axis_b = column(a[2], 2), column(b[2], 2)
    offset = sub(a[3], b[3])
    across_both = cross(axis_a, axis_b)
    if dot(across_both, across_both) < 1e-20:
        across_both = sub(offset, scale(dot(offset, axis_b), axis_b))
    if dot(across_both, across_both) < 1e-20:
        across_both = across(axis_b)
    length = math.sqrt(dot(across_both, across_both))
    sideways = scale((1.0 if dot(across_both, offset) >= 0.0 else -1.0) / length, across_both)
    w, _ = support_of_difference(a, b, numbers, indices, scale(-1.0, sideways))
    gap = dot(sideways, w)
    if gap > dot(normal, separation):
        return sideways, scale(gap, sideways)
    return normal, separation


@compiled
def nearest(
    a: Any, b: Any, numbers: Any, indices: Any, limit: float, work: Any, work_indices: Any
) -> tuple[bool, Vector, float, Vector]:
    """Find the normal and the gap of two cores.

    Args:
        a: the first shape: kind, size, rotation, centre, data.
        b: the second.
        numbers: of hulls and meshes.
        indices: of hulls and meshes.
        limit: gap beyond which nothing is found [m].
        work: working memory.
        work_indices: working memory.

    Returns:
        Whether they are nearer than the limit, the unit normal from b to a, the gap [m], and the point half-way [m].
    """
    if (a[0] == SPHERE and b[0] in (CYLINDER, WHEEL)) or (b[0] == SPHERE and a[0] in (CYLINDER, WHEEL)):
        normal, gap, between = point_and_cylinder(a, b)
        return gap < limit, normal, gap, between
    if a[0] == BOX and b[0] == BOX:
        # Boxes mostly lie on each other with a face.
        result, normal, gap, between = box_and_box(a, b, limit)
        if result != UNSURE:
            return result == FOUND and gap < limit, normal, gap, between
    state, count, separation, on_a = distance(a, b, numbers, indices, limit, work)
    if state == FAR:
        return False, separation, limit, on_a
    if state == SEPARATED:
        gap = math.sqrt(dot(separation, separation))
        normal = scale(1.0 / gap, separation)
    else:
        normal, separation, on_a = depth(count, a, b, numbers, indices, work, work_indices)
        if a[0] in (CYLINDER, WHEEL, CAPSULE) and b[0] in (CYLINDER, WHEEL, CAPSULE):
            normal, separation = side_by_side(a, b, normal, separation, numbers, indices)
        gap = dot(normal, separation)
    return gap < limit, normal, gap, sub(on_a, scale(0.5, separation))


@compiled
def collide_convex(
    count: int, a: Any, b: Any, numbers: Any, indices: Any, margin: float, feature: int, work: Any, work_indices: Any
) -> int:
    """Note the contacts of two convex shapes; return how many candidates there are then."""
    limit = margin + radius_of(a[0], a[1]) + radius_of(b[0], b[1])
    near, normal, gap, between = nearest(a, b, numbers, indices, limit, work, work_indices)
    if not near:
        return count
    return face_contacts(count, a, b, numbers, indices, normal, gap, between, near, margin, feature, work, work_indices)
