"""Correction of contact points, so that impulses between two trees conserve angular momentum.

Contacts, and the lever arms of the trees to them, are those at the expected end of the step, but impulses act at its
middle. For two trees that pass each other, the impulse would act at two points that are half a step's motion apart, and
the trees would gain the angular momentum of that distance times the impulse. Therefore, both impulses act at the
contact point in the middle of the step. The constrained velocities remain those at the end of the step, by the bias of
the rows, which is accurate to second order like the rest of the step.
"""

from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.contacts.ground_contacts import CAPSULE, CYLINDER, SPHERE, WHEEL
from urdfkit.sim.engine.kernel_world import KernelWorld
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
def point_velocity(w: KernelWorld, body: int, point: Any) -> Any:
    """Return the velocity [m/s] of a point of a body, reckoned from its tree's origin."""
    linear, angular = load_spatial(w.twist, body)
    return add(linear, cross(angular, point))


@inlined
def is_round(kind: int) -> bool:
    """Return whether the contact point of a shape follows the shape's centre instead of a material point."""
    return kind in (SPHERE, CYLINDER, WHEEL, CAPSULE)


@inlined
def centre_velocity(w: KernelWorld, shape: int, body: int) -> Any:
    """Return the velocity [m/s] of the centre of a shape."""
    R = load_rotation(w.R, body)
    at = load_vector(w.r, body)
    at = add(at, rotate(R, load_vector(w.shape_p, shape)))
    return point_velocity(w, body, at)


@inlined
def first_of_pair(w: KernelWorld, k: int) -> int:
    """Return the number of the first contact between the same two shapes."""
    while k > 0 and w.contact_shape[k - 1] == w.contact_shape[k] and w.contact_against[k - 1] == w.contact_against[k]:
        k -= 1
    return k


@inlined
def contact_point_velocity(w: KernelWorld, k: int, point: Any, other_point: Any) -> Any:
    """Return the velocity of the contact point of two shapes in the world [m/s].

    The contact point of a ball follows the ball, between two balls the nearer centre; that of a corner follows the
    corner. At the middle of the step, the load then has no lever arm to a rolling ball, which would brake it. If two
    shapes have several contacts, all follow the first one; otherwise redundant rows would contradict each other.

    Args:
        w: the world's arrays.
        k: number of the contact.
        point: where it is, from the origin of the one tree [m].
        other_point: the same from that of the other.
    """
    a, b = w.contact_shape[k], w.contact_against[k]
    one, other = is_round(w.shape_kind[a]), is_round(w.shape_kind[b])
    share = 0.5
    if one and other:
        share = w.shape_size[3 * b] / (w.shape_size[3 * a] + w.shape_size[3 * b])
    elif one or other:
        share = 1.0 if one else 0.0
    first = point_velocity(w, w.contact_body[k], point)
    if one:
        first = centre_velocity(w, a, w.contact_body[k])
    second = point_velocity(w, w.contact_other[k], other_point)
    if other:
        second = centre_velocity(w, b, w.contact_other[k])
    return add(scale(share, first), scale(1.0 - share, second))


@compiled
def correct_contact_point(w: KernelWorld, k: int, row: int, rubs: bool, width: int, dt: float) -> None:
    """Apply the impulse of a contact at the same point of both trees, if they have floating bases.

    Changes the entries of the floating bases in the contact's rows, and the biases by the change of the present
    velocities. Entries of joints are unchanged.

    Args:
        w: the world's arrays.
        k: number of the contact, between bodies of two trees.
        row: of its normal.
        rubs: whether two rows for its tangents follow.
        width: entries of a row.
        dt: length of the step [s].
    """
    tree, other = w.body_tree[w.contact_body[k]], w.body_tree[w.contact_other[k]]
    if w.tree_floats[tree] == 0 or w.tree_floats[other] == 0:
        return
    point = load_vector(w.contact_point, first_of_pair(w, k))
    other_point = add(point, sub(load_vector(w.contact_origin, tree), load_vector(w.contact_origin, other)))
    # How far the place goes in the second half of the step; a base is placed where it will be by then.
    way = scale(0.5 * dt, contact_point_velocity(w, k, point, other_point))
    at = row * width
    sign = 1.0
    for side in range(2):
        which = tree if side == 0 else other
        first = w.tree_dof[which]
        lag = sub(load_vector(w.r, w.tree_body[which]), way)
        for j in range(3 if rubs else 1):
            # The normal is first among the rows and last in the frame.
            moment = scale(sign, cross(lag, load_vector(w.contact_frame, 3 * k + (j + 2) % 3)))
            for d in range(3, 6):
                change = dot(load_spatial(w.S, first + d)[1], moment)
                w.Y[at + j * width + d] += change
                w.row_bias[row + j] -= change * w.v_start[first + d]
        at += w.tree_dof[which + 1] - first
        sign = -1.0
