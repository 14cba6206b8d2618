"""Constraint rows on the next velocity: each has a Jacobian row J, a bias, and bounds of its impulse.

Order: mimic joints, motors and dry friction, joint limits; then contacts without friction, and with friction in threes
(normal and two tangents), see `contact_rows`. A slot is the index of the impulse of the last step, for the warm start.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.constraints.position_goals import has_rigid_motor
from urdfkit.sim.engine.kernel_world import KernelWorld

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
    w: KernelWorld, row: int, clear: int, width: int, tree: int, b: float, lo: float, hi: float, at: int
) -> None:
    """Give a row its tree (-1: there is but one), bias, bounds and slot; clear it, and more in all, if need be."""
    for d in range(row * width, (row + clear) * width):
        w.Y[d] = 0.0
    w.row_bias[row], w.low[row], w.high[row], w.mu[row], w.slot[row] = b, lo, hi, 0.0, at
    if tree >= 0:
        w.row_a[row], w.row_b[row] = tree, -1


@inlined
def joint_rows(w: KernelWorld, rows: int, tree: int, dofs: int, width: int, dt: float, alone: bool) -> int:
    """Write the rows of a tree's mimic joints, motors, dry friction and limits after the first `rows`.

    Returns:
        How many rows there are.
    """
    first, beyond, row_tree = w.tree_dof[tree], w.tree_dof[tree + 1], tree
    if alone:
        first, beyond, row_tree = 0, dofs, -1
    for k in range(w.tree_mimic[tree], w.tree_mimic[tree + 1]):
        d, m, factor = w.mimic_dof[k], w.mimic_master[k], w.mimic_factor[k]
        target = w.mimic_offset[k] + (factor * w.s[w.dof_s[m]] if m >= 0 else 0.0)
        b = min(FASTEST_JOINT, max(-FASTEST_JOINT, RECOVERY * (w.s[w.dof_s[d]] - target) / dt))
        at = 2 * dofs + k
        open_row(w, rows, 1, width, row_tree, b, -math.inf, math.inf, at)
        w.Y[rows * width + d - first] = 1.0
        if m >= 0:
            w.Y[rows * width + m - first] = -factor
        rows += 1
    for d in range(first, beyond):
        if has_rigid_motor(w, d):
            continue
        effort, rub = w.motor_effort[d], w.friction[d]
        if effort > 0.0 and (rub == 0.0 or (effort > rub and w.motor_velocity[d] != 0.0)):
            hold = effort
            b = -w.motor_velocity[d]
        elif rub > 0.0:
            # If a motor holds the joint, or is too weak to move it, motor and friction act as one row.
            hold = rub + effort if w.motor_velocity[d] == 0.0 else rub
            b = 0.0
        else:
            continue
        open_row(w, rows, 1, width, row_tree, b, -hold * dt, hold * dt, d)
        w.Y[rows * width + d - first] = 1.0
        rows += 1
    for d in range(first, beyond):
        if w.lower[d] == -math.inf and w.upper[d] == math.inf:
            continue
        position = w.s[w.dof_s[d]]
        near = 2.0 * dt * abs(w.v_start[d]) + 1e-3
        gap, sign = position - w.lower[d], 1.0
        if w.pressed[d] > 0 or (w.pressed[d] == 0 and not (gap < near and gap <= w.upper[d] - position)):
            gap, sign = w.upper[d] - position, -1.0
        if gap < near or w.pressed[d] != 0:
            b = recovery_speed(gap, dt)
            open_row(w, rows, 1, width, row_tree, b, 0.0, math.inf, dofs + d)
            w.Y[rows * width + d - first] = sign
            rows += 1
    return rows


@inlined
def friction_with_motor(w: KernelWorld, d: int, v: Any) -> float:
    """Return the effort [N·m] in addition to the row that `joint_rows` writes for a dof with motor and friction."""
    effort, rub, target = w.motor_effort[d], w.friction[d], w.motor_velocity[d]
    if effort == 0.0 or rub == 0.0 or target == 0.0:
        return 0.0
    if effort > rub:
        # The motor is stronger: friction opposes the motion, or the motion that is about to begin.
        return -math.copysign(rub, v[d] if abs(v[d]) > 1e-9 else target)
    return math.copysign(effort, target - v[d])
