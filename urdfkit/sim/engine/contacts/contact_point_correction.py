"""Correction of contact points, so that impulses between two trees conserve angular momentum.

Contacts, and the lever arms of the trees to them, are those at the expected end of the step, but impulses act at its
middle. For two trees that pass each other, the impulse would act at two points that are half a step's motion apart, and
the trees would gain the angular momentum of that distance times the impulse. Therefore, both impulses act at the
contact point in the middle of the step. The constrained velocities remain those at the end of the step, by the bias of
the rows, which is accurate to second order like the rest of the step.
"""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.contacts.ground_contacts import CAPSULE, CYLINDER, SPHERE, WHEEL
from urdfkit.sim.engine.math.spatial_algebra import (
    add,
    cross,
    dot,
    load_rotation,
    load_spatial,
    load_vector,
    rotate,
    scale,
    sub,
)


@inlined
def point_velocity(floats: Any, integers: Any, body: int, point: Any) -> Any:
    """Return the velocity [m/s] of a point of a body, reckoned from its tree's origin."""
    linear, angular = load_spatial(field(floats, integers, At.twist), body)
    return add(linear, cross(angular, point))


@inlined
def is_round(kind: int) -> bool:
    """Return whether the contact point of a shape follows the shape's centre instead of a material point."""
    return kind in (SPHERE, CYLINDER, WHEEL, CAPSULE)


@inlined
def centre_velocity(floats: Any, integers: Any, shape: int, body: int) -> Any:
    """Return the velocity [m/s] of the centre of a shape."""
    R = load_rotation(field(floats, integers, At.R), body)
    at = load_vector(field(floats, integers, At.r), body)
    at = add(at, rotate(R, load_vector(field(floats, integers, At.shape_p), shape)))
    return point_velocity(floats, integers, body, at)


@inlined
def first_of_pair(integers: Any, k: int) -> int:
    """Return the number of the first contact between the same two shapes."""
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    while k > 0 and contact_shape[k - 1] == contact_shape[k] and contact_against[k - 1] == contact_against[k]:
        k -= 1
    return k


@inlined
def contact_point_velocity(floats: Any, integers: Any, k: int, point: Any, other_point: Any) -> Any:
    """Return the velocity of the contact point of two shapes in the world [m/s].

    The contact point of a ball follows the ball, between two balls the nearer centre; that of a corner follows the
    corner. At the middle of the step, the load then has no lever arm to a rolling ball, which would brake it. If two
    shapes have several contacts, all follow the first one; otherwise redundant rows would contradict each other.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        k: number of the contact.
        point: where it is, from the origin of the one tree [m].
        other_point: the same from that of the other.
    """
    shape_kind = field(integers, integers, At.shape_kind)
    shape_size = field(floats, integers, At.shape_size)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    a, b = contact_shape[k], contact_against[k]
    one, other = is_round(shape_kind[a]), is_round(shape_kind[b])
    share = 0.5
    if one and other:
        share = shape_size[3 * b] / (shape_size[3 * a] + shape_size[3 * b])
    elif one or other:
        share = 1.0 if one else 0.0
    first = point_velocity(floats, integers, contact_body[k], point)
    if one:
        first = centre_velocity(floats, integers, a, contact_body[k])
    second = point_velocity(floats, integers, contact_other[k], other_point)
    if other:
        second = centre_velocity(floats, integers, b, contact_other[k])
    return add(scale(share, first), scale(1.0 - share, second))


@compiled
def correct_contact_point(floats: Any, integers: Any, k: int, row: int, rubs: bool, width: int, dt: float) -> None:
    """Apply the impulse of a contact at the same point of both trees, if they have floating bases.

    Changes the entries of the floating bases in the contact's rows, and the biases by the change of the present
    velocities. Entries of joints are unchanged.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        k: number of the contact, between bodies of two trees.
        row: of its normal.
        rubs: whether two rows for its tangents follow.
        width: entries of a row.
        dt: length of the step [s].
    """
    tree_body = field(integers, integers, At.tree_body)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_floats = field(integers, integers, At.tree_floats)
    body_tree = field(integers, integers, At.body_tree)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_origin = field(floats, integers, At.contact_origin)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    r = field(floats, integers, At.r)
    S = field(floats, integers, At.S)
    v = field(floats, integers, At.v_start)
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    tree, other = body_tree[contact_body[k]], body_tree[contact_other[k]]
    if tree_floats[tree] == 0 or tree_floats[other] == 0:
        return
    point = load_vector(contact_point, first_of_pair(integers, k))
    other_point = add(point, sub(load_vector(contact_origin, tree), load_vector(contact_origin, other)))
    # How far the place goes in the second half of the step; a base is placed where it will be by then.
    way = scale(0.5 * dt, contact_point_velocity(floats, integers, k, point, other_point))
    at = row * width
    sign = 1.0
    for side in range(2):
        which = tree if side == 0 else other
        first = tree_dof[which]
        lag = sub(load_vector(r, tree_body[which]), way)
        for j in range(3 if rubs else 1):
            # The normal is first among the rows and last in the frame.
            moment = scale(sign, cross(lag, load_vector(contact_frame, 3 * k + (j + 2) % 3)))
            for d in range(3, 6):
                change = dot(load_spatial(S, first + d)[1], moment)
                Y[at + j * width + d] += change
                bias[row + j] -= change * v[first + d]
        at += tree_dof[which + 1] - first
        sign = -1.0
