"""What constrains the next velocity, as rows: each asks for J·v + bias and has an impulse between two bounds.

Order: mimic joints, motors and dry friction, joint limits, contacts without friction, then contacts with friction in
threes (normal and two tangents). A slot tells where the impulse of the last step is remembered.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.dynamics import solve_transposed, solve_transposed_by_four
from urdfkit.sim.engine.exchange import exchange
from urdfkit.sim.engine.linear import gram_row
from urdfkit.sim.engine.spatial import add, cross, dot, load_spatial, load_vector, sub

RECOVERY = 0.2
"""Part of a penetration, or of another violation, that is taken back in a step."""
FASTEST_RECOVERY = 0.1
"""Fastest that bodies found in each other are pushed apart [m/s]: what starts in the ground rises, it does not jump.

Gazebo's counterpart is ``<max_vel>``, 0.01 m/s where nothing is said.
"""
FASTEST_JOINT = 1.0
"""The same for joints far beyond a limit, or off the position that they mimic [rad/s or m/s]."""
MOBILITY = 1e-18
"""Square of the share of a point's velocities along the normal below which nothing can move it that way.

A wheel of a bolted robot that touches the ground is such a case: no impulse along the normal changes anything, so the
contact is left out, and with it its friction.
"""


@inlined
def recovery_speed(gap: float, dt: float) -> float:
    """Return the bias of a gap: it may close within the step when open, is taken back slowly when violated [m/s]."""
    return gap / dt if gap > 0.0 else max(RECOVERY * gap / dt, -FASTEST_JOINT)


@inlined
def open_row(
    floats: Any, integers: Any, row: int, clear: int, width: int, tree: int, b: float, lo: float, hi: float, at: int
) -> None:
    """Give a row its tree (-1: there is but one), bias, bounds and slot; clear it, and more in all, if need be."""
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    slot = field(integers, integers, At.slot)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    for d in range(row * width, (row + clear) * width):
        Y[d] = 0.0
    bias[row], low[row], high[row], mu[row], slot[row] = b, lo, hi, 0.0, at
    if tree >= 0:
        row_a[row], row_b[row] = tree, -1


@inlined
def joint_rows(floats: Any, integers: Any, rows: int, tree: int, dofs: int, width: int, dt: float, alone: bool) -> int:
    """Write the rows of a tree's mimic joints, motors, dry friction and limits after the first `rows`.

    Returns:
        How many rows there are.
    """
    tree_dof = field(integers, integers, At.tree_dof)
    tree_mimic = field(integers, integers, At.tree_mimic)
    mimic_dof = field(integers, integers, At.mimic_dof)
    mimic_master = field(integers, integers, At.mimic_master)
    mimic_factor = field(floats, integers, At.mimic_factor)
    mimic_offset = field(floats, integers, At.mimic_offset)
    dof_s = field(integers, integers, At.dof_s)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v_start)
    friction = field(floats, integers, At.friction)
    lower = field(floats, integers, At.lower)
    upper = field(floats, integers, At.upper)
    motor_velocity = field(floats, integers, At.motor_velocity)
    motor_effort = field(floats, integers, At.motor_effort)
    pressed = field(integers, integers, At.pressed)
    Y = field(floats, integers, At.Y)
    first, beyond, row_tree = tree_dof[tree], tree_dof[tree + 1], tree
    if alone:
        first, beyond, row_tree = 0, dofs, -1
    for k in range(tree_mimic[tree], tree_mimic[tree + 1]):
        d, m, factor = mimic_dof[k], mimic_master[k], mimic_factor[k]
        target = mimic_offset[k] + (factor * s[dof_s[m]] if m >= 0 else 0.0)
        b = min(FASTEST_JOINT, max(-FASTEST_JOINT, RECOVERY * (s[dof_s[d]] - target) / dt))
        at = 2 * dofs + k
        open_row(floats, integers, rows, 1, width, row_tree, b, -math.inf, math.inf, at)
        Y[rows * width + d - first] = 1.0
        if m >= 0:
            Y[rows * width + m - first] = -factor
        rows += 1
    for d in range(first, beyond):
        effort, rub = motor_effort[d], friction[d]
        if effort > 0.0 and (rub == 0.0 or (effort > rub and motor_velocity[d] != 0.0)):
            hold = effort
            b = -motor_velocity[d]
        elif rub > 0.0:
            # Where a motor holds still, or is too weak to move the joint, motor and friction pull at one rope.
            hold = rub + effort if motor_velocity[d] == 0.0 else rub
            b = 0.0
        else:
            continue
        open_row(floats, integers, rows, 1, width, row_tree, b, -hold * dt, hold * dt, d)
        Y[rows * width + d - first] = 1.0
        rows += 1
    for d in range(first, beyond):
        if lower[d] == -math.inf and upper[d] == math.inf:
            continue
        position = s[dof_s[d]]
        near = 2.0 * dt * abs(v[d]) + 1e-3
        gap, sign = position - lower[d], 1.0
        if pressed[d] > 0 or (pressed[d] == 0 and not (gap < near and gap <= upper[d] - position)):
            gap, sign = upper[d] - position, -1.0
        if gap < near or pressed[d] != 0:
            b = recovery_speed(gap, dt)
            open_row(floats, integers, rows, 1, width, row_tree, b, 0.0, math.inf, dofs + d)
            Y[rows * width + d - first] = sign
            rows += 1
    return rows


@inlined
def friction_beside_motor(floats: Any, integers: Any, d: int, v: Any) -> float:
    """Return the effort [N·m] beside the row that `joint_rows` writes for a dof with motor and dry friction."""
    friction = field(floats, integers, At.friction)
    motor_velocity = field(floats, integers, At.motor_velocity)
    motor_effort = field(floats, integers, At.motor_effort)
    effort, rub, target = motor_effort[d], friction[d], motor_velocity[d]
    if effort == 0.0 or rub == 0.0 or target == 0.0:
        return 0.0
    if effort > rub:
        # The motor wins: friction acts against the motion, or against the one about to begin.
        return -math.copysign(rub, v[d] if abs(v[d]) > 1e-9 else target)
    return math.copysign(effort, target - v[d])


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
                exchange(floats, integers, here, rows, rubbing == 1, width, dt)
            rows += 3 if rubbing == 1 else 1
    return rows


@inlined
def row_product(floats: Any, integers: Any, i: int, j: int, width: int) -> float:
    """Return the product of two whitened rows; those of different trees meet nowhere."""
    tree_dof = field(integers, integers, At.tree_dof)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    total = 0.0
    a, b = row_a[i], row_b[i]
    n = tree_dof[a + 1] - tree_dof[a]
    at, to = i * width, j * width
    if row_a[j] == a:
        for d in range(n):
            total += Y[at + d] * Y[to + d]
    elif row_b[j] == a:
        to += tree_dof[row_a[j] + 1] - tree_dof[row_a[j]]
        for d in range(n):
            total += Y[at + d] * Y[to + d]
    if b >= 0:
        at += n
        to = j * width
        m = tree_dof[b + 1] - tree_dof[b]
        if row_a[j] == b:
            for d in range(m):
                total += Y[at + d] * Y[to + d]
        elif row_b[j] == b:
            to += tree_dof[row_a[j] + 1] - tree_dof[row_a[j]]
            for d in range(m):
                total += Y[at + d] * Y[to + d]
    return total


@inlined
def whiten(floats: Any, integers: Any, rows: int, single: int, width: int, alone: bool) -> None:
    """Turn rows J into Y = J·L⁻¹, their biases into velocities g with no impulse, and get A = J·M⁻¹·Jᵀ.

    The velocity with no impulse is v + L⁻¹·u. Most islands are a `single` tree, whose number this is; otherwise it is
    -1.
    """
    tree_dof = field(integers, integers, At.tree_dof)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    v = field(floats, integers, At.v_start)
    u = field(floats, integers, At.u)
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.g)
    A = field(floats, integers, At.A)
    if single >= 0:
        first, beyond = tree_dof[single], tree_dof[single + 1]
        if alone:
            first, beyond = 0, width
        for k in range(rows):
            start = k * width - first
            free = bias[k]
            for d in range(first, beyond):
                free += Y[start + d] * v[d]
            g[k] = free
        k = 0
        while k + 4 <= rows:
            solve_transposed_by_four(floats, integers, first, beyond, Y, k * width - first, width)
            k += 4
        while k < rows:
            solve_transposed(floats, integers, first, beyond, Y, k * width - first)
            k += 1
        for k in range(rows):
            start = k * width - first
            free = g[k]
            for d in range(first, beyond):
                free += Y[start + d] * u[d]
            g[k] = free
            gram_row(rows, k, beyond - first, width, Y, A)
        return
    for k in range(rows):
        free = bias[k]
        at = k * width
        for side in range(2):
            tree = row_a[k] if side == 0 else row_b[k]
            if tree < 0:
                continue
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            start = at - first
            for d in range(first, beyond):
                free += Y[start + d] * v[d]
            solve_transposed(floats, integers, first, beyond, Y, start)
            for d in range(first, beyond):
                free += Y[start + d] * u[d]
            at += beyond - first
        g[k] = free
        for j in range(k + 1):
            total = row_product(floats, integers, k, j, width)
            A[k * rows + j] = total
            A[j * rows + k] = total


@inlined
def push(floats: Any, integers: Any, rows: int, single: int, width: int, alone: bool) -> None:
    """Add what the impulses x do to u."""
    tree_dof = field(integers, integers, At.tree_dof)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    x = field(floats, integers, At.x)
    u = field(floats, integers, At.u)
    if single >= 0:
        first, beyond = tree_dof[single], tree_dof[single + 1]
        if alone:
            first, beyond = 0, width
        for k in range(rows):
            xk = x[k]
            for d in range(beyond - first):
                u[first + d] += Y[k * width + d] * xk
        return
    for k in range(rows):
        xk = x[k]
        at = k * width
        for side in range(2):
            tree = row_a[k] if side == 0 else row_b[k]
            if tree < 0:
                continue
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            for d in range(first, beyond):
                u[d] += Y[at - first + d] * xk
            at += beyond - first
