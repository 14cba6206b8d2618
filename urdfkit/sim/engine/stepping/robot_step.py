"""The step of one robot on its plane: from one configuration and velocity to the next, all in one compiled call.

`world_step` does the same for several robots and bodies; this version is specialised for one tree and is 1.5 times as
fast.
"""

import math
from typing import Any

from urdfkit.sim.engine.constraints.constraint_rows import joint_rows
from urdfkit.sim.engine.constraints.contact_rows import contact_rows
from urdfkit.sim.engine.constraints.joint_servos import (
    NO_SERVO,
    SERVO_ATTEMPTS,
    SERVOS,
    account,
    limited,
    overloaded,
    smooth_motion,
)
from urdfkit.sim.engine.constraints.limit_crossings import passes_limits, whirls
from urdfkit.sim.engine.constraints.position_goals import approach_goals
from urdfkit.sim.engine.contacts.anisotropic_friction import orient_friction
from urdfkit.sim.engine.contacts.ground_contacts import collide_with_plane, near_plane
from urdfkit.sim.engine.dynamics.integration import move
from urdfkit.sim.engine.dynamics.link_poses import place_links
from urdfkit.sim.engine.dynamics.mass_matrix import bias_forces, place, solve_forward, terms
from urdfkit.sim.engine.dynamics.odometry import update_odometry
from urdfkit.sim.engine.kernel_world import world
from urdfkit.sim.engine.simulation_memory import (
    BODIES,
    CONTACTS,
    COORDINATES,
    DOFS,
    DT,
    FLOOR,
    FOUND_CONTACTS,
    FOUND_ROWS,
    GUESSES,
    HAS_FLOOR,
    ITERATED,
    LINK_POSES,
    MIMICS,
    NEXT_UPDATE,
    SHAPES,
    SLOTS,
    STEPS,
    TERMS,
)
from urdfkit.sim.engine.sleep.robot_sleep import let_robot_sleep, pass_time, wake_if_disturbed
from urdfkit.sim.engine.solver.active_set_newton import MOST_GUESSES, fastest_row, guess, iterate
from urdfkit.sim.engine.solver.augmented_newton import (
    ATTEMPTS,
    FEW_DOFS,
    FEW_ROWS,
    MOST_ROWS,
    list_contacts,
    solve_single_tree,
)
from urdfkit.sim.engine.solver.delassus import apply_impulses, build_delassus
from urdfkit.sim.engine.stepping.ballistic import is_ballistic, rk4_step

ALONE = True
"""Compile-time constant: there is one tree, so code for several trees is removed by the compiler."""


def advance(floats: Any, integers: Any, steps: int, action: int) -> int:
    """Advance by `steps`; return how many were done: fewer only if the state stopped being finite.

    A step integrates the first half with the old velocity, computes the new velocity there, and integrates the second
    half with it (Moreau's midpoint scheme; leapfrog without contacts): positions are accurate to second order with one
    evaluation. Contacts are those at the expected end of the step, so that the velocity of a wheel has the direction
    that the wheel has then.

    Args:
        floats: block of floats.
        integers: block of integers.
        steps: number of steps; for `LINK_POSES`, the number of the tree.
        action: `ADVANCE`; `TERMS`: compute poses, M and bias of the present state; or `LINK_POSES`, see `place_links`.
    """
    w = world(floats, integers)
    if action == LINK_POSES:
        place_links(w, steps)
        return 0
    only_terms = action == TERMS
    bodies, dofs, coordinates = w.sizes[BODIES], w.sizes[DOFS], w.sizes[COORDINATES]
    shapes, mimics, most_contacts = w.sizes[SHAPES], w.sizes[MIMICS], w.sizes[CONTACTS]
    slots = w.sizes[SLOTS]
    floating = w.tree_floats[0] != 0
    dt, floor = w.numbers[DT], w.numbers[FLOOR]
    first_contact_slot = 2 * dofs + mimics
    if not only_terms:
        wake_if_disturbed(w)
    for done in range(steps):
        if not only_terms and w.asleep[0] != 0:
            pass_time(w, steps - done)
            return steps
        move(w, 0, bodies, w.s, w.v, 0.0 if only_terms else 0.5 * dt)
        for d in range(dofs):
            w.v_start[d] = w.v[d]
            w.saturated[d] = w.pressed[d] = 0
        if not only_terms:
            approach_goals(w, 0, dofs, dt)
        contacts = rows = 0
        # Without contacts and servos, the velocity is computed twice, the second time from the velocity at half the
        # step, unless a limit is near and all joints are slow; ballistic trees use RK4. If servos saturate, or limits
        # are near, the second part is repeated.
        halfway = factored = ahead = False
        solved = True
        attempt = 0
        moved = True
        while True:
            if factored:
                if ahead:
                    place(w, 0, w.s, False)
                bias_forces(w, 0)
            elif moved:
                moved = False
                for k in range(3):
                    w.P[k] = w.s[k] if floating else w.base[k]
                place(w, 0, w.s, False)
                terms(w, 0)
                if only_terms:
                    return 0
                ahead = w.numbers[HAS_FLOOR] != 0.0 and near_plane(w, 0, shapes, floor - w.P[2], dt)
                if ahead:
                    for k in range(coordinates):
                        w.s_ahead[k] = w.s[k]
                    for d in range(dofs):
                        w.v_ahead[d] = w.v[d]
                    move(w, 0, bodies, w.s_ahead, w.v_ahead, 0.5 * dt)
                    place(w, 0, w.s_ahead, True)
                    for k in range(3):
                        w.contact_origin[k] = w.P[k]
                    contacts = collide_with_plane(w, 0, 0, shapes, most_contacts, floor - w.P[2], dt)
                    orient_friction(w, contacts, first_contact_slot, 0, w.memory, dt)
            servos = smooth_motion(w, 0, dofs, dt, factored)
            factored = False
            rows = joint_rows(w, 0, 0, dofs, dofs, dt, ALONE)
            free = not halfway and contacts == 0 and servos != SERVOS
            if free and limited(w, rows, dofs):
                free = whirls(w, 0, dofs, dt)
            if free and is_ballistic(w, 0, dofs, rows):
                rk4_step(w, 0, dt)
                break
            rows = contact_rows(w, rows, 0, contacts, dofs, first_contact_slot, 0, dt, ALONE)
            if rows > 0:
                for k in range(rows):
                    w.before[k] = w.memory[w.slot[k]]
                guesses, few = 0, rows <= FEW_ROWS or dofs <= FEW_DOFS or mimics > 0
                if few or rows <= min(MOST_ROWS, dofs):
                    build_delassus(w, rows, 0, dofs, ALONE)
                    largest = fastest_row(w, rows)
                    guesses = guess(w, rows, largest, MOST_GUESSES if few else ATTEMPTS)
                    if few and guesses == 0:
                        guesses = iterate(w, rows, largest)
                solved = few or guesses != 0
                if solved:
                    apply_impulses(w, rows, 0, dofs, ALONE)
                else:
                    for k in range(rows):
                        w.before[k] = w.memory[w.slot[k]]
                    guesses = solve_single_tree(w, 0, dofs, rows, list_contacts(w, 0, contacts, True))
                w.counts[GUESSES] = guesses
                w.counts[ITERATED] += guesses <= 0
            if rows == 0 or solved:
                solve_forward(w, 0, dofs)
            for d in range(dofs):
                w.v[d] = w.v_start[d] + (0.5 * w.u[d] if free else w.u[d])
            if free:
                halfway = factored = True
                continue
            attempt += 1
            again = servos != NO_SERVO and overloaded(w, 0, dofs, dt, attempt < SERVO_ATTEMPTS)
            if not passes_limits(w, 0, dofs, dt) and not again:
                break
        for k in range(slots):
            w.memory[k] = 0.0
        for k in range(rows):
            w.memory[w.slot[k]] = w.x[k]
        account(w, 0, dofs, dt)
        total = 0.0
        for d in range(dofs):
            total += w.v[d]
        move(w, 0, bodies, w.s, w.v, 0.5 * dt)
        w.counts[FOUND_CONTACTS], w.counts[FOUND_ROWS] = contacts, rows
        if not math.isfinite(total):
            return done
        w.counts[STEPS] += 1
        if w.odometer[0] != 0 and w.counts[STEPS] >= w.odometer[NEXT_UPDATE]:
            update_odometry(w, 0, w.counts[STEPS])
        let_robot_sleep(w, contacts)
    return steps
