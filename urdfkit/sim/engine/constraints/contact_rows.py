"""Constraint rows of contacts: relative velocity at the contact point along the normal and the tangents."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.constraints.constraint_rows import open_row, recovery_speed
from urdfkit.sim.engine.contacts.contact_point_correction import (
    contact_point_velocity,
    correct_contact_point,
    first_of_pair,
)
from urdfkit.sim.engine.dynamics.mass_matrix import FREE
from urdfkit.sim.engine.math.spatial_algebra import ZERO, add, cross, dot, load_spatial, load_vector, scale, sub

FASTEST_RECOVERY = 0.1
"""Fastest that bodies found in each other are pushed apart [m/s]: what starts in the ground rises, it does not jump.

Gazebo's counterpart is ``<max_vel>``, with a default of 0.01 m/s.
"""
MOBILITY = 1e-18
"""Square of the share of a point's velocities along the normal below which nothing can move it that way.

An example is a wheel on the ground of a robot with a fixed base: no impulse along the normal has an effect, so the
contact and its friction are left out.
"""


@inlined
def is_free(kind: int, parent: int) -> bool:
    """Return whether a body is the first of a tree that nothing holds, by its joint and its parent."""
    return kind == FREE and parent < 0


@inlined
def write_free(
    floats: Any, integers: Any, body: int, k: int, rubs: bool, row: int, at: int, sign: float, arm: Any, lag: Any
) -> float:
    """Write the entries of a free body in the rows of a contact; return how fast it approaches there [m/s].

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        body: which.
        k: number of the contact.
        rubs: whether it has rows of its tangents.
        row: of its normal.
        at: where in Y the entries of the body begin in that row.
        sign: 1 or -1.
        arm: from the body's origin to where it has the impulse [m].
        lag: from there to the contact: the velocities of now are those of the contact.
    """
    width = integers[WIDTH]
    S = field(floats, integers, At.S)
    v = field(floats, integers, At.v_start)
    contact_frame = field(floats, integers, At.contact_frame)
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    d = field(integers, integers, At.body_last_dof)[body] - 5
    # A free body's velocities are written in its own axes, the linear ones first.
    i, j, m = load_spatial(S, d)[0], load_spatial(S, d + 1)[0], load_spatial(S, d + 2)[0]
    turning = add(scale(v[d + 3], i), add(scale(v[d + 4], j), scale(v[d + 5], m)))
    speed = 0.0
    for row_of in range(3 if rubs else 1):
        # The normal is first among the rows and last in the frame.
        along = scale(sign, load_vector(contact_frame, 3 * k + (row_of + 2) % 3))
        moment = cross(arm, along)
        to = at + row_of * width
        Y[to], Y[to + 1], Y[to + 2] = dot(along, i), dot(along, j), dot(along, m)
        Y[to + 3], Y[to + 4], Y[to + 5] = dot(moment, i), dot(moment, j), dot(moment, m)
        later = dot(cross(lag, along), turning)
        bias[row + row_of] += later
        if row_of == 0:
            speed = Y[to] * v[d] + Y[to + 1] * v[d + 1] + Y[to + 2] * v[d + 2] + dot(moment, turning) + later
    return speed


@compiled
def free_rows(floats: Any, integers: Any, k: int, row: int, width: int, dt: float) -> bool:
    """Write the rows of a contact of a free body with a static shape or another free body; return whether it is one.

    The rows are those of `contact_rows` and `contact_point_correction`, computed from the axes of the bodies instead of
    the motion subspaces.
    """
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_origin = field(floats, integers, At.contact_origin)
    contact_point = field(floats, integers, At.contact_point)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    body_tree = field(integers, integers, At.body_tree)
    tree_dof = field(integers, integers, At.tree_dof)
    kind = field(integers, integers, At.kind)
    parent = field(integers, integers, At.parent)
    row_b = field(integers, integers, At.row_b)
    r = field(floats, integers, At.r)
    bias = field(floats, integers, At.row_bias)
    body, other = contact_body[k], contact_other[k]
    if not is_free(kind[body], parent[body]) or (other >= 0 and not is_free(kind[other], parent[other])):
        return False
    tree, rubs = body_tree[body], contact_mu[k] > 0.0
    point = load_vector(contact_point, k)
    arm, lag = sub(point, load_vector(r, body)), ZERO
    speed = 0.0
    if other >= 0:
        one = body_tree[other]
        shift = sub(load_vector(contact_origin, tree), load_vector(contact_origin, one))
        # Both have the impulse where it is halfway through the step: see `contact_point_correction`.
        first = load_vector(contact_point, first_of_pair(integers, k))
        way = scale(0.5 * dt, contact_point_velocity(floats, integers, k, first, add(first, shift)))
        for j in range(3 if rubs else 1):
            row_b[row + j] = one
        lag = sub(way, load_vector(r, body))
        arm = sub(point, way)
        other_lag = sub(way, load_vector(r, other))
        other_arm = sub(add(point, shift), way)
        at = row * width + tree_dof[tree + 1] - tree_dof[tree]
        speed += write_free(floats, integers, other, k, rubs, row, at, -1.0, other_arm, other_lag)
    speed += write_free(floats, integers, body, k, rubs, row, row * width, 1.0, arm, lag)
    # The gap was taken at the end of the step, if the velocity stays; its half is where the velocity changes.
    bias[row] += max(recovery_speed(contact_gap[k] - 0.5 * dt * speed, dt), -FASTEST_RECOVERY)
    return True


@inlined
def contact_rows(
    floats: Any,
    integers: Any,
    rows: int,
    first_contact: int,
    contacts: int,
    width: int,
    first_slot: int,
    first_pair_slot: int,
    dt: float,
    alone: bool,
) -> int:
    """Write the rows of an island's contacts after the first `rows`, those without friction first.

    Returns:
        How many rows there are.
    """
    tree_dof = field(integers, integers, At.tree_dof)
    body_tree = field(integers, integers, At.body_tree)
    body_last_dof = field(integers, integers, At.body_last_dof)
    dof_parent = field(integers, integers, At.dof_parent)
    S = field(floats, integers, At.S)
    contact_next = field(integers, integers, At.contact_next)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_origin = field(floats, integers, At.contact_origin)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    contact_row = field(integers, integers, At.contact_row)
    v = field(floats, integers, At.v_start)
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    mu = field(floats, integers, At.mu)
    row_b = field(integers, integers, At.row_b)
    for rubbing in range(2):
        k = first_contact
        while (k < contacts) if alone else (k >= 0):
            here = k
            k = k + 1 if alone else contact_next[k]
            if (contact_mu[here] > 0.0) != (rubbing == 1):
                continue
            contact_row[here] = rows
            tree = -1 if alone else body_tree[contact_body[here]]
            # What two shapes touch with is remembered by the number of the contact, see `remember_pairs`.
            at = (
                first_slot + 3 * contact_feature[here]
                if alone or contact_against[here] < 0
                else first_pair_slot + 3 * here
            )
            open_row(floats, integers, rows, 3 if rubbing == 1 else 1, width, tree, 0.0, 0.0, math.inf, at)
            mu[rows] = contact_mu[here]
            if rubbing == 1:
                for j in range(1, 3):
                    open_row(floats, integers, rows + j, 0, width, tree, 0.0, -math.inf, math.inf, at + j)
            point = load_vector(contact_point, here)
            first = load_vector(contact_frame, 3 * here)
            second = load_vector(contact_frame, 3 * here + 1)
            normal = load_vector(contact_frame, 3 * here + 2)
            if not alone and free_rows(floats, integers, here, rows, width, dt):
                rows += 3 if rubbing == 1 else 1
                continue
            speed, along, in_all = 0.0, 0.0, 0.0
            shift = rows * width - (0 if alone else tree_dof[tree])
            d = body_last_dof[contact_body[here]]
            while d >= 0:
                lin, ang = load_spatial(S, d)
                lin = add(lin, cross(ang, point))
                entry = dot(normal, lin)
                Y[shift + d] = entry
                along += entry * entry
                in_all += dot(lin, lin)
                speed += entry * v[d]
                if rubbing == 1:
                    Y[shift + width + d] = dot(first, lin)
                    Y[shift + 2 * width + d] = dot(second, lin)
                d = dof_parent[d]
            other = -1 if alone else contact_other[here]
            if other >= 0:
                one = body_tree[other]
                if one != tree:
                    shift += tree_dof[tree + 1] - tree_dof[one]
                    row_b[rows] = one
                    if rubbing == 1:
                        row_b[rows + 1] = row_b[rows + 2] = one
                    point = add(point, sub(load_vector(contact_origin, tree), load_vector(contact_origin, one)))
                d = body_last_dof[other]
                while d >= 0:
                    lin, ang = load_spatial(S, d)
                    lin = add(lin, cross(ang, point))
                    entry = dot(normal, lin)
                    Y[shift + d] -= entry
                    along += entry * entry
                    in_all += dot(lin, lin)
                    speed -= entry * v[d]
                    if rubbing == 1:
                        Y[shift + width + d] -= dot(first, lin)
                        Y[shift + 2 * width + d] -= dot(second, lin)
                    d = dof_parent[d]
            if along <= MOBILITY * in_all:
                contact_row[here] = -1
                continue
            # The gap was taken at the end of the step, if the velocity stays; its half is where the velocity changes.
            bias[rows] = max(recovery_speed(contact_gap[here] - 0.5 * dt * speed, dt), -FASTEST_RECOVERY)
            if other >= 0 and body_tree[other] != tree:
                correct_contact_point(floats, integers, here, rows, rubbing == 1, width, dt)
            rows += 3 if rubbing == 1 else 1
    return rows
