"""The step of one robot on its plane: from one configuration and velocity to the next, all in one compiled call.

`world_step` does the same for several robots and bodies; this version is specialised for one tree and is 1.5 times as
fast.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import (
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
    MIMICS,
    SHAPES,
    SLOTS,
    STEPS,
    At,
)
from urdfkit.sim.engine.compilation import field
from urdfkit.sim.engine.constraints.constraint_rows import joint_rows
from urdfkit.sim.engine.constraints.contact_rows import contact_rows
from urdfkit.sim.engine.constraints.joint_limits import passes_limits, whirls
from urdfkit.sim.engine.constraints.joint_servos import SERVO_ATTEMPTS, account, limited, overloaded, smooth_motion
from urdfkit.sim.engine.contacts.friction_directions import orient_friction
from urdfkit.sim.engine.contacts.ground_contacts import collide_with_plane, near_plane
from urdfkit.sim.engine.dynamics.integration import move
from urdfkit.sim.engine.dynamics.mass_matrix import place, solve_forward, terms
from urdfkit.sim.engine.solver.active_set_newton import solve
from urdfkit.sim.engine.solver.delassus import apply_impulses, build_delassus
from urdfkit.sim.engine.stepping.ballistic import is_ballistic, rk4_step

ALONE = True
"""Compile-time constant: there is one tree, so code for several trees is removed by the compiler."""


def advance(floats: Any, integers: Any, steps: int, only_terms: bool) -> int:
    """Advance by `steps`; return how many were done: fewer only if the state stopped being finite.

    A step integrates the first half with the old velocity, computes the new velocity there, and integrates the second
    half with it (Moreau's midpoint scheme; leapfrog without contacts): positions are accurate to second order with one
    evaluation. Contacts are those at the expected end of the step, so that the velocity of a wheel has the direction
    that the wheel has then.

    With `only_terms`, compute poses, M and bias of the present state without advancing.
    """
    bodies, dofs, coordinates = integers[BODIES], integers[DOFS], integers[COORDINATES]
    shapes, mimics, most_contacts = integers[SHAPES], integers[MIMICS], integers[CONTACTS]
    slots = integers[SLOTS]
    base = field(floats, integers, At.base)
    numbers = field(floats, integers, At.numbers)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    memory = field(floats, integers, At.memory)
    P = field(floats, integers, At.P)
    u = field(floats, integers, At.u)
    v_start = field(floats, integers, At.v_start)
    s_ahead = field(floats, integers, At.s_ahead)
    v_ahead = field(floats, integers, At.v_ahead)
    contact_origin = field(floats, integers, At.contact_origin)
    before = field(floats, integers, At.before)
    x = field(floats, integers, At.x)
    slot = field(integers, integers, At.slot)
    saturated = field(integers, integers, At.saturated)
    pressed = field(integers, integers, At.pressed)
    counts = field(integers, integers, At.counts)
    floating = field(integers, integers, At.tree_floats)[0] != 0
    dt, floor = numbers[DT], numbers[FLOOR]
    first_contact_slot = 2 * dofs + mimics
    for done in range(steps):
        move(floats, integers, 0, bodies, s, v, 0.0 if only_terms else 0.5 * dt)
        for d in range(dofs):
            v_start[d] = v[d]
            saturated[d] = pressed[d] = 0
        contacts = rows = 0
        # Without contacts and servos, the velocity is computed twice, the second time from the velocity at half the
        # step, unless a limit is near and all joints are slow; ballistic trees use RK4. If servos saturate, or limits
        # are near, the second part is repeated.
        halfway = False
        attempt = 0
        while True:
            if attempt == 0:
                for k in range(3):
                    P[k] = s[k] if floating else base[k]
                place(floats, integers, 0, s, False)
                terms(floats, integers, 0)
                if only_terms:
                    return 0
                if (
                    not halfway
                    and numbers[HAS_FLOOR] != 0.0
                    and near_plane(floats, integers, 0, shapes, floor - P[2], dt)
                ):
                    for k in range(coordinates):
                        s_ahead[k] = s[k]
                    for d in range(dofs):
                        v_ahead[d] = v[d]
                    move(floats, integers, 0, bodies, s_ahead, v_ahead, 0.5 * dt)
                    place(floats, integers, 0, s_ahead, True)
                    for k in range(3):
                        contact_origin[k] = P[k]
                    contacts = collide_with_plane(floats, integers, 0, 0, shapes, most_contacts, floor - P[2], dt)
                    orient_friction(floats, integers, contacts, first_contact_slot, 0, memory, dt)
            has_servo = smooth_motion(floats, integers, 0, dofs, dt)
            rows = joint_rows(floats, integers, 0, 0, dofs, dofs, dt, ALONE)
            free = not halfway and contacts == 0 and not has_servo
            if free and limited(floats, integers, rows, dofs):
                free = whirls(floats, integers, 0, dofs, dt)
            if free and is_ballistic(floats, integers, 0, dofs, rows):
                rk4_step(floats, integers, 0, dt)
                break
            rows = contact_rows(floats, integers, rows, 0, contacts, dofs, first_contact_slot, 0, dt, ALONE)
            if rows > 0:
                build_delassus(floats, integers, rows, 0, dofs, ALONE)
                for k in range(rows):
                    before[k] = memory[slot[k]]
                guesses = solve(floats, integers, rows)
                apply_impulses(floats, integers, rows, 0, dofs, ALONE)
                counts[GUESSES] = guesses
                counts[ITERATED] += guesses <= 0
            solve_forward(floats, integers, 0, dofs)
            for d in range(dofs):
                v[d] = v_start[d] + (0.5 * u[d] if free else u[d])
            if free:
                halfway = True
                continue
            attempt += 1
            again = has_servo and overloaded(floats, integers, 0, dofs, dt, attempt < SERVO_ATTEMPTS)
            if not passes_limits(floats, integers, 0, dofs, dt) and not again:
                break
        for k in range(slots):
            memory[k] = 0.0
        for k in range(rows):
            memory[slot[k]] = x[k]
        account(floats, integers, 0, dofs, dt)
        total = 0.0
        for d in range(dofs):
            total += v[d]
        move(floats, integers, 0, bodies, s, v, 0.5 * dt)
        counts[FOUND_CONTACTS], counts[FOUND_ROWS] = contacts, rows
        if not math.isfinite(total):
            return done
        counts[STEPS] += 1
    return steps
