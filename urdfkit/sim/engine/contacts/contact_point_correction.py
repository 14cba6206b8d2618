"""What two trees swap where they touch, they swap at one place, so that nothing of it is lost.

Contacts are those of where the step is expected to end, and so are a tree's arms to them; but impulses act halfway
through it. Two trees that pass by each other would have the impulse at places that are half a step's way apart, and
together gain an angular momentum of that way times the impulse. Therefore both have it where the contact is halfway
through the step; the velocities that it is to bring about stay those at its end, by the bias of its rows, which is
right to second order as the rest is.
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
    """Return whether a place where a shape touches goes where the shape goes, not with what is there."""
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
def wandering(floats: Any, integers: Any, k: int, point: Any, other_point: Any) -> Any:
    """Return how fast the place where two shapes touch moves through the world [m/s].

    Under a ball it goes with the ball, between two with what is nearer its middle; at a corner with the corner. Where
    it is halfway a load on it has no arm to a ball that rolls, which would brake it. Where they touch at several
    points, all go with the first: rows of more points than it takes would contradict each other otherwise.

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
def exchange(floats: Any, integers: Any, k: int, row: int, rubs: bool, width: int, dt: float) -> None:
    """Let both trees of a contact, if they are free, have its impulse at one place.

    Changes the entries of the floating bases in its rows, and their biases by as much as that changes their velocities
    of now. What joints have of the impulse stays.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        k: number of the contact, between bodies of two trees.
        row: of its normal.
        rubs: whether two more, of its tangents, follow.
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
    way = scale(0.5 * dt, wandering(floats, integers, k, point, other_point))
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
