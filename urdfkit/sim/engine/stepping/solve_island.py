"""Step of one island: smooth motion, rows, impulses, and new velocities."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import (
    CONTACTS,
    DOFS,
    DT,
    GUESSES,
    ITERATED,
    MATRIX,
    MIMICS,
    OVERFULL,
    ROWS,
    SLOTS,
    WIDTH,
    At,
)
from urdfkit.sim.engine.compilation import compiled, field
from urdfkit.sim.engine.constraints.constraint_rows import joint_rows
from urdfkit.sim.engine.constraints.contact_rows import contact_rows
from urdfkit.sim.engine.constraints.joint_limits import passes_limits, whirls
from urdfkit.sim.engine.constraints.joint_servos import SERVO_ATTEMPTS, limited, overloaded, smooth_motion
from urdfkit.sim.engine.dynamics.mass_matrix import solve_forward
from urdfkit.sim.engine.dynamics.tree_motion import evaluate
from urdfkit.sim.engine.island_solver.gauss_seidel import sweep
from urdfkit.sim.engine.island_solver.velocity_blocks import hold
from urdfkit.sim.engine.sleep.rolling_resistance import resist_rolling
from urdfkit.sim.engine.solver.active_set_newton import solve
from urdfkit.sim.engine.solver.delassus import apply_impulses, build_delassus
from urdfkit.sim.engine.stepping.ballistic import is_ballistic, rk4_step
from urdfkit.sim.engine.stepping.islands import contact_count

FEW = 8
"""Rows more than dofs up to which the matrix of the rows is the faster one for a single tree."""


@compiled
def solve_island(floats: Any, integers: Any, root: int) -> int:
    """Compute the impulses of an island and the velocities of its trees at the end of the step.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        root: first tree of the island.

    Returns:
        How many rows it took; -1 if there are more than there is room for.
    """
    dofs, mimics, most_contacts, most_rows = integers[DOFS], integers[MIMICS], integers[CONTACTS], integers[ROWS]
    slots, width = integers[SLOTS], integers[WIDTH]
    numbers = field(floats, integers, At.numbers)
    v = field(floats, integers, At.v)
    memory = field(floats, integers, At.memory)
    last = field(floats, integers, At.last)
    u = field(floats, integers, At.u)
    v_start = field(floats, integers, At.v_start)
    contact_mu = field(floats, integers, At.contact_mu)
    contact_impulse = field(floats, integers, At.contact_impulse)
    before = field(floats, integers, At.before)
    x = field(floats, integers, At.x)
    tree_dof = field(integers, integers, At.tree_dof)
    island_next = field(integers, integers, At.island_next)
    island_contact = field(integers, integers, At.island_contact)
    contact_next = field(integers, integers, At.contact_next)
    contact_row = field(integers, integers, At.contact_row)
    slot = field(integers, integers, At.slot)
    counts = field(integers, integers, At.counts)
    dt = numbers[DT]
    first_contact_slot, first_pair_slot = 2 * dofs + mimics, slots - 3 * most_contacts
    single = root if island_next[root] < 0 else -1
    rows = 0
    # Without contacts and servos, the velocity is computed twice, the second time from the velocity at half the step,
    # unless a limit is near and all joints are slow; ballistic trees use RK4. If servos saturate, or limits are near,
    # the second part is repeated.
    halfway = False
    attempt = 0
    # Islands with too many trees or rows for `velocity_blocks` are solved by Gauss-Seidel sweeps.
    swept = False
    resist_rolling(floats, integers, root, dt)
    while True:
        has_servo = False
        rows = island_dofs = 0
        tree = root
        while tree >= 0:
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            if smooth_motion(floats, integers, first, beyond, dt):
                has_servo = True
            island_dofs += beyond - first
            rows = joint_rows(floats, integers, rows, tree, dofs, width, dt, False)
            tree = island_next[tree]
        # An island without contacts is one tree.
        free = not halfway and island_contact[root] < 0 and not has_servo
        if free and limited(floats, integers, rows, dofs):
            free = whirls(floats, integers, tree_dof[root], tree_dof[root + 1], dt)
        if free and is_ballistic(floats, integers, tree_dof[root], tree_dof[root + 1], rows):
            rk4_step(floats, integers, root, dt)
            break
        if rows + 3 * contact_count(floats, integers, island_contact[root]) > most_rows:
            counts[OVERFULL] = 1
            return -1
        rows = contact_rows(
            floats, integers, rows, island_contact[root], 0, width, first_contact_slot, first_pair_slot, dt, False
        )
        for k in range(rows):
            before[k] = last[slot[k]]
        # Islands without room for their matrix are solved by Gauss-Seidel sweeps, too.
        dense = rows * rows <= integers[MATRIX]
        held = False
        if rows > 0 and not swept and (single < 0 or rows > island_dofs + FEW):
            guesses = hold(floats, integers, root, rows)
            held = guesses != 0
            if held:
                counts[GUESSES] = guesses
                counts[ITERATED] += guesses <= 0
            elif single < 0 or not dense:
                swept = True
                continue
        if swept:
            counts[GUESSES] = -sweep(floats, integers, root, rows)
            counts[ITERATED] += 1
        elif rows > 0 and not held:
            build_delassus(floats, integers, rows, single, width, False)
            guesses = solve(floats, integers, rows)
            apply_impulses(floats, integers, rows, single, width, False)
            counts[GUESSES] = guesses
            counts[ITERATED] += guesses <= 0
        again = False
        tree = root
        if not free:
            attempt += 1
        while tree >= 0:
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            if not held:
                solve_forward(floats, integers, first, beyond)
            for d in range(first, beyond):
                v[d] = v_start[d] + (0.5 * u[d] if free else u[d])
            if has_servo and overloaded(floats, integers, first, beyond, dt, attempt < SERVO_ATTEMPTS):
                again = True
            if not free and passes_limits(floats, integers, first, beyond, dt):
                again = True
            tree = island_next[tree]
        if free:
            evaluate(floats, integers, root)
            halfway = True
        elif not again:
            break
    for k in range(rows):
        memory[slot[k]] = x[k]
    k = island_contact[root]
    while k >= 0:
        at = contact_row[k]
        for j in range(3):
            # Normal first among the rows, last in the frame.
            wanted = at >= 0 and (j == 2 or contact_mu[k] > 0.0)
            contact_impulse[3 * k + j] = x[at + (j + 1) % 3] if wanted else 0.0
        k = contact_next[k]
    return rows
