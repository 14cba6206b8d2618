"""Constraint rows on the next velocity: each has a Jacobian row J, a bias, and bounds of its impulse.

Order: mimic joints, motors and dry friction, joint limits; then contacts without friction, and with friction in threes
(normal and two tangents), see `contact_rows`. A slot is the index of the impulse of the last step, for the warm start.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined

RECOVERY = 0.2
"""Part of a penetration, or of another violation, that is corrected in a step."""
FASTEST_JOINT = 1.0
"""Maximum correction velocity of joints beyond a limit, or off the position that they mimic [rad/s or m/s]."""


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
            # If a motor holds the joint, or is too weak to move it, motor and friction act as one row.
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
def friction_with_motor(floats: Any, integers: Any, d: int, v: Any) -> float:
    """Return the effort [N·m] in addition to the row that `joint_rows` writes for a dof with motor and friction."""
    friction = field(floats, integers, At.friction)
    motor_velocity = field(floats, integers, At.motor_velocity)
    motor_effort = field(floats, integers, At.motor_effort)
    effort, rub, target = motor_effort[d], friction[d], motor_velocity[d]
    if effort == 0.0 or rub == 0.0 or target == 0.0:
        return 0.0
    if effort > rub:
        # The motor is stronger: friction opposes the motion, or the motion that is about to begin.
        return -math.copysign(rub, v[d] if abs(v[d]) > 1e-9 else target)
    return math.copysign(effort, target - v[d])
