"""What constrains the next velocity, as rows: each asks for J·v + bias and has an impulse between two bounds.

Order: mimic joints, motors and dry friction, joint limits, contacts without friction, then contacts with friction in
threes (normal and two tangents). A slot tells where the impulse of the last step is remembered.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.dynamics import solve_transposed
from urdfkit.sim.engine.spatial import add, cross, dot, load_spatial, load_vector

RECOVERY = 0.2
"""Part of a penetration, or of another violation, that is taken back in a step."""
MOBILITY = 1e-18
"""Square of the share of a point's velocities along the normal below which nothing can move it that way.

A wheel of a bolted robot that touches the ground is such a case: no impulse along the normal changes anything, so the
contact is left out, and with it its friction.
"""


@inlined
def recovery_speed(gap: float, dt: float) -> float:
    """Return the bias of a gap: it may close within the step when open, is taken back slowly when violated [m/s]."""
    return gap / dt if gap > 0.0 else RECOVERY * gap / dt


@inlined
def open_row(floats: Any, integers: Any, row: int, dofs: int, b: float, lo: float, hi: float, at: int) -> int:
    """Clear a row and give it its bias, bounds and slot; return its number."""
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    slot = field(integers, integers, At.slot)
    for d in range(dofs):
        Y[row * dofs + d] = 0.0
    bias[row], low[row], high[row], mu[row], slot[row] = b, lo, hi, 0.0, at
    return row


@inlined
def joint_rows(floats: Any, integers: Any, dofs: int, mimics: int, dt: float) -> int:
    """Write the rows of mimic joints, motors, dry friction and limits; return how many."""
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
    Y = field(floats, integers, At.Y)
    rows = 0
    for k in range(mimics):
        d, m, factor = mimic_dof[k], mimic_master[k], mimic_factor[k]
        target = mimic_offset[k] + (factor * s[dof_s[m]] if m >= 0 else 0.0)
        b = RECOVERY * (s[dof_s[d]] - target) / dt
        open_row(floats, integers, rows, dofs, b, -math.inf, math.inf, 2 * dofs + k)
        Y[rows * dofs + d] = 1.0
        if m >= 0:
            Y[rows * dofs + m] = -factor
        rows += 1
    for d in range(dofs):
        effort, rub = motor_effort[d], friction[d]
        if effort > 0.0 and (rub == 0.0 or (effort > rub and motor_velocity[d] != 0.0)):
            open_row(floats, integers, rows, dofs, -motor_velocity[d], -effort * dt, effort * dt, d)
        elif rub > 0.0:
            # Where a motor holds still, or is too weak to move the joint, motor and friction pull at one rope.
            hold = rub + effort if motor_velocity[d] == 0.0 else rub
            open_row(floats, integers, rows, dofs, 0.0, -hold * dt, hold * dt, d)
        else:
            continue
        Y[rows * dofs + d] = 1.0
        rows += 1
    for d in range(dofs):
        if lower[d] == -math.inf and upper[d] == math.inf:
            continue
        position = s[dof_s[d]]
        near = 2.0 * dt * abs(v[d]) + 1e-3
        if position - lower[d] < near and position - lower[d] <= upper[d] - position:
            b = recovery_speed(position - lower[d], dt)
            open_row(floats, integers, rows, dofs, b, 0.0, math.inf, dofs + d)
            Y[rows * dofs + d] = 1.0
            rows += 1
        elif upper[d] - position < near:
            b = recovery_speed(upper[d] - position, dt)
            open_row(floats, integers, rows, dofs, b, 0.0, math.inf, dofs + d)
            Y[rows * dofs + d] = -1.0
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
def contact_rows(floats: Any, integers: Any, rows: int, contacts: int, dofs: int, first_slot: int, dt: float) -> int:
    """Write the rows of contacts after the first `rows`, those without friction first; return how many there are."""
    body_last_dof = field(integers, integers, At.body_last_dof)
    dof_parent = field(integers, integers, At.dof_parent)
    S = field(floats, integers, At.S)
    contact_body = field(integers, integers, At.contact_body)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    contact_row = field(integers, integers, At.contact_row)
    v = field(floats, integers, At.v_start)
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    mu = field(floats, integers, At.mu)
    for rubbing in range(2):
        for k in range(contacts):
            if (contact_mu[k] > 0.0) != (rubbing == 1):
                continue
            contact_row[k] = rows
            at = first_slot + 3 * contact_feature[k]
            open_row(floats, integers, rows, dofs, 0.0, 0.0, math.inf, at)
            mu[rows] = contact_mu[k]
            if rubbing == 1:
                open_row(floats, integers, rows + 1, dofs, 0.0, -math.inf, math.inf, at + 1)
                open_row(floats, integers, rows + 2, dofs, 0.0, -math.inf, math.inf, at + 2)
            point = load_vector(contact_point, k)
            first = load_vector(contact_frame, 3 * k)
            second = load_vector(contact_frame, 3 * k + 1)
            normal = load_vector(contact_frame, 3 * k + 2)
            closing = along_normal = in_all = 0.0
            d = body_last_dof[contact_body[k]]
            while d >= 0:
                lin, ang = load_spatial(S, d)
                lin = add(lin, cross(ang, point))
                Y[rows * dofs + d] = dot(normal, lin)
                along_normal += Y[rows * dofs + d] * Y[rows * dofs + d]
                in_all += dot(lin, lin)
                closing -= Y[rows * dofs + d] * v[d]
                if rubbing == 1:
                    Y[(rows + 1) * dofs + d] = dot(first, lin)
                    Y[(rows + 2) * dofs + d] = dot(second, lin)
                d = dof_parent[d]
            if along_normal <= MOBILITY * in_all:
                contact_row[k] = -1
                continue
            # The gap was taken at the end of the step, if the velocity stays; its half is where the velocity changes.
            bias[rows] = recovery_speed(contact_gap[k] + 0.5 * dt * closing, dt)
            rows += 3 if rubbing == 1 else 1
    return rows


@inlined
def whiten(floats: Any, integers: Any, rows: int, dofs: int) -> None:
    """Turn rows J into Y = J·L⁻¹, their biases into velocities g with no impulse, and get A = J·M⁻¹·Jᵀ.

    The velocity with no impulse is v + L⁻¹·u.
    """
    v = field(floats, integers, At.v_start)
    u = field(floats, integers, At.u)
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.g)
    A = field(floats, integers, At.A)
    for k in range(rows):
        at = k * dofs
        free = bias[k]
        for d in range(dofs):
            free += Y[at + d] * v[d]
        solve_transposed(floats, integers, 0, dofs, Y, at)
        for d in range(dofs):
            free += Y[at + d] * u[d]
        g[k] = free
        for j in range(k + 1):
            total = 0.0
            for d in range(dofs):
                total += Y[at + d] * Y[j * dofs + d]
            A[k * rows + j] = total
            A[j * rows + k] = total
