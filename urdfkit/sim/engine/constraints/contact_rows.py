"""Constraint rows of contacts: relative velocity at the contact point along the normal and the tangents."""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.constraints.constraint_rows import open_row, recovery_speed
from urdfkit.sim.engine.contacts.midstep_contact_points import (
    contact_point_velocity,
    correct_contact_point,
    first_of_pair,
)
from urdfkit.sim.engine.dynamics.mass_matrix import FREE
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import ZERO, add, cross, dot, load_spatial, load_vector, scale, sub
from urdfkit.sim.engine.simulation_memory import WIDTH

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
    w: KernelWorld, body: int, k: int, rubs: bool, row: int, at: int, sign: float, arm: Any, lag: Any
) -> float:
    """Write the entries of a free body in the rows of a contact; return how fast it approaches there [m/s].

    Args:
        w: the world's arrays.
        body: which.
        k: number of the contact.
        rubs: whether it has rows of its tangents.
        row: of its normal.
        at: where in Y the entries of the body begin in that row.
        sign: 1 or -1.
        arm: from the body's origin to where it has the impulse [m].
        lag: from there to the contact: the velocities of now are those of the contact.
    """
    width = w.sizes[WIDTH]
    v, Y = w.v_start, w.Y
    d = w.body_last_dof[body] - 5
    # A free body's velocities are written in its own axes, the linear ones first.
    i, j, m = load_spatial(w.S, d)[0], load_spatial(w.S, d + 1)[0], load_spatial(w.S, d + 2)[0]
    turning = add(scale(v[d + 3], i), add(scale(v[d + 4], j), scale(v[d + 5], m)))
    speed = 0.0
    for row_of in range(3 if rubs else 1):
        # The normal is first among the rows and last in the frame.
        along = scale(sign, load_vector(w.contact_frame, 3 * k + (row_of + 2) % 3))
        moment = cross(arm, along)
        to = at + row_of * width
        Y[to], Y[to + 1], Y[to + 2] = dot(along, i), dot(along, j), dot(along, m)
        Y[to + 3], Y[to + 4], Y[to + 5] = dot(moment, i), dot(moment, j), dot(moment, m)
        later = dot(cross(lag, along), turning)
        w.row_bias[row + row_of] += later
        if row_of == 0:
            speed = Y[to] * v[d] + Y[to + 1] * v[d + 1] + Y[to + 2] * v[d + 2] + dot(moment, turning) + later
    return speed


@compiled
def free_rows(w: KernelWorld, k: int, row: int, width: int, dt: float) -> bool:
    """Write the rows of a contact of a free body with a static shape or another free body; return whether it is one.

    The rows are those of `contact_rows` and `midstep_contact_points`, computed from the axes of the bodies instead of
    the motion subspaces.
    """
    body, other = w.contact_body[k], w.contact_other[k]
    if not is_free(w.kind[body], w.parent[body]) or (other >= 0 and not is_free(w.kind[other], w.parent[other])):
        return False
    tree, rubs = w.body_tree[body], w.contact_mu[k] > 0.0
    point = load_vector(w.contact_point, k)
    arm, lag = sub(point, load_vector(w.r, body)), ZERO
    speed = 0.0
    if other >= 0:
        one = w.body_tree[other]
        shift = sub(load_vector(w.contact_origin, tree), load_vector(w.contact_origin, one))
        # Both have the impulse where it is halfway through the step: see `midstep_contact_points`.
        first = load_vector(w.contact_point, first_of_pair(w, k))
        way = scale(0.5 * dt, contact_point_velocity(w, k, first, add(first, shift)))
        for j in range(3 if rubs else 1):
            w.row_b[row + j] = one
        lag = sub(way, load_vector(w.r, body))
        arm = sub(point, way)
        other_lag = sub(way, load_vector(w.r, other))
        other_arm = sub(add(point, shift), way)
        at = row * width + w.tree_dof[tree + 1] - w.tree_dof[tree]
        speed += write_free(w, other, k, rubs, row, at, -1.0, other_arm, other_lag)
    speed += write_free(w, body, k, rubs, row, row * width, 1.0, arm, lag)
    # The gap was taken at the end of the step, if the velocity stays; its half is where the velocity changes.
    w.row_bias[row] += max(recovery_speed(w.contact_gap[k] - 0.5 * dt * speed, dt), -FASTEST_RECOVERY)
    return True


@inlined
def contact_rows(
    w: KernelWorld,
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
    for rubbing in range(2):
        k = first_contact
        while (k < contacts) if alone else (k >= 0):
            here = k
            k = k + 1 if alone else w.contact_next[k]
            if (w.contact_mu[here] > 0.0) != (rubbing == 1):
                continue
            w.contact_row[here] = rows
            tree = -1 if alone else w.body_tree[w.contact_body[here]]
            # What two shapes touch with is remembered by the number of the contact, see `remember_pairs`.
            at = (
                first_slot + 3 * w.contact_feature[here]
                if alone or w.contact_against[here] < 0
                else first_pair_slot + 3 * here
            )
            open_row(w, rows, 3 if rubbing == 1 else 1, width, tree, 0.0, 0.0, math.inf, at)
            w.mu[rows] = w.contact_mu[here]
            if rubbing == 1:
                for j in range(1, 3):
                    open_row(w, rows + j, 0, width, tree, 0.0, -math.inf, math.inf, at + j)
            point = load_vector(w.contact_point, here)
            first = load_vector(w.contact_frame, 3 * here)
            second = load_vector(w.contact_frame, 3 * here + 1)
            normal = load_vector(w.contact_frame, 3 * here + 2)
            if not alone and free_rows(w, here, rows, width, dt):
                rows += 3 if rubbing == 1 else 1
                continue
            speed, along, in_all = 0.0, 0.0, 0.0
            shift = rows * width - (0 if alone else w.tree_dof[tree])
            d = w.body_last_dof[w.contact_body[here]]
            while d >= 0:
                lin, ang = load_spatial(w.S, d)
                lin = add(lin, cross(ang, point))
                entry = dot(normal, lin)
                w.Y[shift + d] = entry
                along += entry * entry
                in_all += dot(lin, lin)
                speed += entry * w.v_start[d]
                if rubbing == 1:
                    w.Y[shift + width + d] = dot(first, lin)
                    w.Y[shift + 2 * width + d] = dot(second, lin)
                d = w.dof_parent[d]
            other = -1 if alone else w.contact_other[here]
            if other >= 0:
                one = w.body_tree[other]
                if one != tree:
                    shift += w.tree_dof[tree + 1] - w.tree_dof[one]
                    w.row_b[rows] = one
                    if rubbing == 1:
                        w.row_b[rows + 1] = w.row_b[rows + 2] = one
                    point = add(point, sub(load_vector(w.contact_origin, tree), load_vector(w.contact_origin, one)))
                d = w.body_last_dof[other]
                while d >= 0:
                    lin, ang = load_spatial(w.S, d)
                    lin = add(lin, cross(ang, point))
                    entry = dot(normal, lin)
                    w.Y[shift + d] -= entry
                    along += entry * entry
                    in_all += dot(lin, lin)
                    speed -= entry * w.v_start[d]
                    if rubbing == 1:
                        w.Y[shift + width + d] -= dot(first, lin)
                        w.Y[shift + 2 * width + d] -= dot(second, lin)
                    d = w.dof_parent[d]
            if along <= MOBILITY * in_all:
                w.contact_row[here] = -1
                continue
            # The gap was taken at the end of the step, if the velocity stays; its half is where the velocity changes.
            w.row_bias[rows] = max(recovery_speed(w.contact_gap[here] - 0.5 * dt * speed, dt), -FASTEST_RECOVERY)
            if other >= 0 and w.body_tree[other] != tree:
                correct_contact_point(w, here, rows, rubbing == 1, width, dt)
            rows += 3 if rubbing == 1 else 1
    return rows
