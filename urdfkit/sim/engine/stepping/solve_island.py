"""Step of one island: smooth motion, rows, impulses, and new velocities."""

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.constraints.constraint_rows import joint_rows
from urdfkit.sim.engine.constraints.contact_rows import contact_rows
from urdfkit.sim.engine.constraints.joint_servos import (
    NO_SERVO,
    SERVO_ATTEMPTS,
    SERVOS,
    is_undamped,
    limited,
    overloaded,
    smooth_motion,
)
from urdfkit.sim.engine.constraints.limit_crossings import passes_limits, whirls
from urdfkit.sim.engine.dynamics.free_body_terms import has_factors
from urdfkit.sim.engine.dynamics.mass_matrix import bias_forces, place, solve_forward
from urdfkit.sim.engine.island_solver.gauss_seidel import sweep
from urdfkit.sim.engine.island_solver.velocity_blocks import hold
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import (
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
)
from urdfkit.sim.engine.sleep.rolling_resistance import resist_rolling
from urdfkit.sim.engine.sleep.sleep_criteria import is_free_body
from urdfkit.sim.engine.solver.active_set_newton import MOST_GUESSES, fastest_row, guess, iterate
from urdfkit.sim.engine.solver.augmented_newton import (
    ATTEMPTS,
    FEW_DOFS,
    FEW_ROWS,
    MOST_ROWS,
    list_contacts,
    solve_single_tree,
    touches_fixed,
)
from urdfkit.sim.engine.solver.delassus import apply_impulses, build_delassus
from urdfkit.sim.engine.stepping.ballistic import is_ballistic, is_flying, rk4_step
from urdfkit.sim.engine.stepping.islands import contact_count

FEW = 8
"""Rows more than dofs up to which the matrix of the rows is the faster one for a single tree."""


@compiled
def solve_island(w: KernelWorld, root: int) -> int:
    """Compute the impulses of an island and the velocities of its trees at the end of the step.

    Args:
        w: the world's arrays.
        root: first tree of the island.

    Returns:
        How many rows it took; -1 if there are more than there is room for.
    """
    dofs, mimics, most_contacts, most_rows = w.sizes[DOFS], w.sizes[MIMICS], w.sizes[CONTACTS], w.sizes[ROWS]
    slots, width = w.sizes[SLOTS], w.sizes[WIDTH]
    tree_dof, counts = w.tree_dof, w.counts
    dt = w.numbers[DT]
    first_contact_slot, first_pair_slot = 2 * dofs + mimics, slots - 3 * most_contacts
    single = root if w.island_next[root] < 0 else -1
    rows = 0
    # Without contacts and servos, the velocity is computed twice, the second time from the velocity at half the step,
    # unless a limit is near and all joints are slow; ballistic trees use RK4. If servos saturate, or limits are near,
    # the second part is repeated.
    halfway = factored = False
    attempt = 0
    # Islands with too many trees or rows for `velocity_blocks` are solved by Gauss-Seidel sweeps.
    swept = False
    if is_flying(w, single, w.island_contact[root]):
        rk4_step(w, root, dt)
        return 0
    resist_rolling(w, root, dt)
    while True:
        servos = NO_SERVO
        rows = island_dofs = 0
        tree = root
        while tree >= 0:
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            kept = factored
            if not factored and is_free_body(w, tree) and w.weightless[w.tree_body[tree]] == 0.0:
                kept = has_factors(w, w.tree_body[tree], is_undamped(w, first, beyond))
            servos = max(servos, smooth_motion(w, first, beyond, dt, kept))
            island_dofs += beyond - first
            rows = joint_rows(w, rows, tree, dofs, width, dt, False)
            tree = w.island_next[tree]
        factored = False
        # An island without contacts is one tree.
        free = not halfway and w.island_contact[root] < 0 and servos != SERVOS
        if free and limited(w, rows, dofs):
            free = whirls(w, tree_dof[root], tree_dof[root + 1], dt)
        if free and is_ballistic(w, tree_dof[root], tree_dof[root + 1], rows):
            rk4_step(w, root, dt)
            break
        if rows + 3 * contact_count(w, w.island_contact[root]) > most_rows:
            counts[OVERFULL] = 1
            return -1
        rows = contact_rows(w, rows, w.island_contact[root], 0, width, first_contact_slot, first_pair_slot, dt, False)
        for k in range(rows):
            w.before[k] = w.last[w.slot[k]]
        # Islands without room for their matrix are solved by Gauss-Seidel sweeps, too.
        dense = rows * rows <= w.sizes[MATRIX]
        held = done = False
        if rows > FEW_ROWS and island_dofs > FEW_DOFS and touches_fixed(w, single, w.island_contact[root]):
            guesses = 0
            if rows <= min(MOST_ROWS, island_dofs):
                build_delassus(w, rows, single, width, False)
                guesses = guess(w, rows, fastest_row(w, rows), ATTEMPTS)
            if guesses != 0:
                apply_impulses(w, rows, single, width, False)
            else:
                for k in range(rows):
                    w.before[k] = w.last[w.slot[k]]
                there = list_contacts(w, w.island_contact[root], 0, False)
                guesses = solve_single_tree(w, single, width, rows, there)
                held = True
            counts[GUESSES] = guesses
            counts[ITERATED] += guesses <= 0
            done = True
        elif rows > 0 and not swept and (single < 0 or rows > island_dofs + FEW):
            guesses = hold(w, root, rows)
            held = guesses != 0
            if held:
                counts[GUESSES] = guesses
                counts[ITERATED] += guesses <= 0
            else:
                swept = single < 0 or not dense
        if swept:
            counts[GUESSES] = -sweep(w, root, rows)
            counts[ITERATED] += 1
        elif rows > 0 and not held and not done:
            build_delassus(w, rows, single, width, False)
            largest = fastest_row(w, rows)
            guesses = guess(w, rows, largest, MOST_GUESSES)
            if guesses == 0 and is_free_body(w, single):
                for k in range(rows):
                    w.before[k] = w.last[w.slot[k]]
                guesses = hold(w, root, rows)
                held = guesses != 0
            if guesses == 0:
                guesses = iterate(w, rows, largest)
            if not held:
                apply_impulses(w, rows, single, width, False)
            counts[GUESSES] = guesses
            counts[ITERATED] += guesses <= 0
        again = False
        tree = root
        if not free:
            attempt += 1
        while tree >= 0:
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            if not held:
                solve_forward(w, first, beyond)
            for d in range(first, beyond):
                w.v[d] = w.v_start[d] + (0.5 * w.u[d] if free else w.u[d])
            if servos != NO_SERVO and overloaded(w, first, beyond, dt, attempt < SERVO_ATTEMPTS):
                again = True
            if not free and passes_limits(w, first, beyond, dt):
                again = True
            tree = w.island_next[tree]
        if free:
            if w.near[root] != 0:  # contacts were searched for at the predicted poses
                place(w, root, w.s, False)
            bias_forces(w, root)
            halfway = factored = True
        elif not again:
            break
    for k in range(rows):
        w.memory[w.slot[k]] = w.x[k]
    k = w.island_contact[root]
    while k >= 0:
        at = w.contact_row[k]
        for j in range(3):
            # Normal first among the rows, last in the frame.
            wanted = at >= 0 and (j == 2 or w.contact_mu[k] > 0.0)
            w.contact_impulse[3 * k + j] = w.x[at + (j + 1) % 3] if wanted else 0.0
        k = w.contact_next[k]
    return rows
