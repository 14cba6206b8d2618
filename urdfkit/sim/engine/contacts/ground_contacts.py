"""Contacts of boxes, spheres, cylinders, capsules and convex hulls with the ground plane.

A contact is worth a row in the solver when its gap could close within a step. Its point lies on the body. Each point a
shape can touch with has a number of its own, its feature, by which the solver finds last step's force again.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.spatial_algebra import (
    add,
    compose,
    cross,
    load_rotation,
    load_spatial,
    load_vector,
    rotate,
    scale,
    store_rotation,
    store_vector,
)

SPHERE, BOX, CYLINDER, WHEEL, CAPSULE, HULL = range(6)
"""Kinds of shape. Sizes: radius; half edges; radius and half length (three times); none (vertices).

A wheel is a cylinder that turns about its own axis: it touches in the middle of its rim, because two points, one at
either edge, would scrub whenever the robot turns. Any other cylinder lies on both ends of its line of contact.
"""
FEATURES = (1, 8, 6, 6, 2, 0)
"""Features of each kind; a hull has one for each vertex."""
MOST = (1, 4, 6, 5, 2, 9)
"""Most contacts each kind can have at once."""

DIRECTIONS = 8
"""Number of directions in which the farthest touching vertices of a hull are contacts, in addition to the lowest."""
LOWEST = 1e-7
"""How much lower a vertex must be to count as the lowest [m]."""
LEANING = 0.02
"""Tilt [rad] over which the contact of a leaning wheel moves from the middle of its rim to the edge."""
STANDING = 0.5
"""Sine of the tilt above which a cylinder can touch with its flat face."""
REACH = 100.0
"""Acceleration [m/s²] that a contact must not miss within a step."""


@inlined
def near_plane(w: KernelWorld, first: int, beyond: int, floor: float, dt: float) -> bool:
    """Return whether any of some shapes can reach the plane within a step."""
    for k in range(first, beyond):  # noqa: SIM110
        if reaches(w, k, floor, dt):
            return True
    return False


@inlined
def reaches(w: KernelWorld, k: int, floor: float, dt: float) -> bool:
    """Return whether a shape, taken for a ball, can reach the plane within a step."""
    body = w.shape_body[k]
    centre = add(load_vector(w.r, body), rotate(load_rotation(w.R, body), load_vector(w.shape_p, k)))
    velocity = load_spatial(w.twist, body)
    # No point of it moves faster down than this.
    rate = abs(velocity[0][2] + cross(velocity[1], centre)[2])
    rate += w.shape_radius[k] * (abs(velocity[1][0]) + abs(velocity[1][1]))
    return bool(centre[2] - w.shape_radius[k] - floor <= 2.0 * dt * rate + dt * dt * REACH)


@inlined
def can_close(gap: float, point: Any, velocity: Any, dt: float) -> bool:
    """Return whether a point of a body that moves with `velocity` can reach the plane within a step."""
    speed = velocity[0][2] + cross(velocity[1], point)[2]
    return bool(gap <= 2.0 * dt * abs(speed) + dt * dt * REACH)


@compiled
def find_extremes(
    w: KernelWorld, first: int, beyond: int, axes: Any, centre: Any, floor: float, dt: float, velocity: Any
) -> None:
    """Find, of the vertices of a hull that can touch, the lowest and those furthest out in each direction."""
    for j in range(DIRECTIONS + 1):
        w.extreme[j], w.extreme_vertex[j] = -math.inf, -1
    for k in range(first, beyond):
        offset = rotate(axes, load_vector(w.vertices, k))
        point = add(centre, offset)
        if can_close(point[2] - floor, point, velocity, dt):
            for j in range(DIRECTIONS):
                # Off the axes, along which edges of parts tend to lie.
                sine, cosine = sine_cosine(2.0 * math.pi * j / DIRECTIONS + 0.2)
                reach = cosine * offset[0] + sine * offset[1]
                if reach > w.extreme[j]:
                    w.extreme[j], w.extreme_vertex[j] = reach, k - first
            if -offset[2] > w.extreme[DIRECTIONS]:
                w.extreme[DIRECTIONS], w.extreme_vertex[DIRECTIONS] = -offset[2], k - first
    for j in range(DIRECTIONS):
        # Most often one of the others is as low.
        if w.extreme_vertex[j] >= 0:
            offset = rotate(axes, load_vector(w.vertices, first + w.extreme_vertex[j]))
            if -offset[2] > w.extreme[DIRECTIONS] - LOWEST:
                w.extreme_vertex[DIRECTIONS] = -1


@inlined
def has_feature(w: KernelWorld, count: int, feature: int) -> bool:
    """Return whether a contact of this feature has been noted."""
    for k in range(count):  # noqa: SIM110
        if w.contact_feature[k] == feature:
            return True
    return False


@inlined
def add_contact(
    w: KernelWorld, count: int, most: int, body: int, feature: int, point: Any, floor: float, mu: float, dt: float
) -> int:
    """Note a contact at `point` if it can close within a step; return how many there are."""
    gap = point[2] - floor
    # This order matters: if `count` is tested first, LLVM's code for a step of a wheeled robot is a third slower.
    if not can_close(gap, point, load_spatial(w.twist, body), dt) or count >= most:
        return count
    w.contact_body[count] = body
    w.contact_other[count] = w.contact_against[count] = -1
    w.contact_feature[count] = feature
    w.contact_gap[count] = gap
    w.contact_mu[count] = mu
    store_vector(w.contact_point, count, point)
    # Two tangents, then the normal, row by row.
    store_rotation(w.contact_frame, count, (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0))
    return count + 1


@inlined
def collide_with_plane(w: KernelWorld, count: int, first: int, beyond: int, most: int, floor: float, dt: float) -> int:
    """Find the contacts of some shapes with the plane z = `floor` (of the same point as `r`).

    Returns:
        How many contacts there are now, after `count`.
    """
    shape_mu = w.floor_mu
    for k in range(first, beyond):
        if not reaches(w, k, floor, dt):
            continue
        body = w.shape_body[k]
        body_R = load_rotation(w.R, body)
        centre = add(load_vector(w.r, body), rotate(body_R, load_vector(w.shape_p, k)))
        mu, feature, kind = shape_mu[k], w.shape_feature[k], w.shape_kind[k]
        size = load_vector(w.shape_size, k)
        found = 0
        if kind == SPHERE:
            found = 1
        else:
            axes = compose(body_R, load_rotation(w.shape_R, k))
            if kind == BOX:
                found = 4
            elif kind == CAPSULE:
                found = 2
            elif kind == HULL:
                find_extremes(
                    w, w.shape_vertex[k], w.shape_vertex[k + 1], axes, centre, floor, dt, load_spatial(w.twist, body)
                )
                found = DIRECTIONS + 1
            else:
                found = 5 if kind == WHEEL else 6
        for j in range(found):
            part = j
            if kind == SPHERE:
                point = add(centre, (0.0, 0.0, -size[0]))
            elif kind == BOX:
                part, offset = box_corner(j, axes, size)
                point = add(centre, rotate(axes, offset))
            elif kind == CAPSULE:
                end = size[1] if j == 0 else -size[1]
                point = add(centre, (end * axes[2], end * axes[5], end * axes[8] - size[0]))
            elif kind == HULL:
                # Two directions may find the same vertex.
                part = w.extreme_vertex[j]
                if part < 0 or has_feature(w, count, feature + part):
                    continue
                point = add(centre, rotate(axes, load_vector(w.vertices, w.shape_vertex[k] + part)))
            else:
                valid, offset = cylinder_point(j, kind == WHEEL, axes, size[0], size[1])
                if not valid:
                    continue
                point = add(centre, offset)
            found_now = add_contact(w, count, most, body, feature + part, point, floor, mu, dt)
            if found_now > count:
                w.contact_shape[count] = k
            count = found_now
    return count


@inlined
def box_corner(j: int, axes: Any, half: Any) -> tuple[int, Any]:
    """Return number and place, in the box, of the j-th corner of the face that looks down most."""
    down = (axes[6], axes[7], axes[8])
    a = 0 if abs(down[0]) >= abs(down[1]) else 1
    if abs(down[2]) > abs(down[a]):
        a = 2
    x = j & 1 if a != 0 else (1 if down[0] < 0.0 else 0)
    y = ((j if a == 0 else j >> 1) & 1) if a != 1 else (1 if down[1] < 0.0 else 0)
    z = j >> 1 if a != 2 else (1 if down[2] < 0.0 else 0)
    offset = (
        half[0] if x == 1 else -half[0],
        half[1] if y == 1 else -half[1],
        half[2] if z == 1 else -half[2],
    )
    return x + 2 * y + 4 * z, offset


@inlined
def cylinder_point(j: int, is_wheel: bool, axes: Any, radius: float, half: float) -> tuple[bool, Any]:
    """Return whether the j-th feature of a cylinder can touch, and where it is from its centre.

    Features 0 to 3 are on the rim of the lower face, at the lowest point and a quarter, half and three quarters on;
    4 and 5 are the ends of the lowest line. A wheel has but 4, between the ends.
    """
    axis = (axes[2], axes[5], axes[8])
    rise = axis[2]
    level = math.sqrt(axes[6] * axes[6] + axes[7] * axes[7])
    if j >= 4:
        if level < STANDING:
            return False, axis
        down = (rise * axis[0] / level, rise * axis[1] / level, (rise * axis[2] - 1.0) / level)
        along = half if j == 4 else -half
        if is_wheel:
            along = -half * min(1.0, max(-1.0, rise / LEANING))
        return True, add(scale(radius, down), scale(along, axis))
    if abs(rise) < STANDING or (j == 0 and level >= STANDING):
        return False, axis
    # Upright there is no lowest point: then the quarters are those of the cylinder's own axes.
    low_x, low_y = (-axes[6] / level, -axes[7] / level) if level > 1e-4 else (1.0, 0.0)
    x, y = low_x, low_y
    if j == 1:
        x, y = -low_y, low_x
    elif j == 2:
        x, y = -low_x, -low_y
    elif j == 3:
        x, y = low_y, -low_x
    along = -half if rise > 0.0 else half
    return True, rotate(axes, (radius * x, radius * y, along))
