"""One island through one step: smooth motion, rows, impulses, and the velocities that come of them."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import (
    CONTACTS,
    DOFS,
    DT,
    GUESSES,
    ITERATED,
    MIMICS,
    OVERFULL,
    ROWS,
    SLOTS,
    WIDTH,
    At,
)
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.solve import solve
from urdfkit.sim.engine.world.dynamics import place, solve_forward, terms
from urdfkit.sim.engine.world.islands import contacts_of
from urdfkit.sim.engine.world.rows import contact_rows, joint_rows, push, whiten
from urdfkit.sim.engine.world.servo import SERVO_ATTEMPTS, limited, overloaded, smooth_motion


@inlined
def settle(floats: Any, integers: Any, root: int) -> int:
    """Find the velocities at the end of the step of the trees of an island, and their impulses.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        root: first tree of the island.

    Returns:
        How many rows it took; -1 if there are more than there is room for.
    """
    dofs, mimics, most_contacts, most_rows = integers[DOFS], integers[MIMICS], integers[CONTACTS], integers[ROWS]
    slots, width = integers[SLOTS], integers[WIDTH]
    place_R = field(floats, integers, At.place_R)
    place_p = field(floats, integers, At.place_p)
    mass = field(floats, integers, At.mass)
    centre = field(floats, integers, At.centre)
    tensor = field(floats, integers, At.tensor)
    subspace = field(floats, integers, At.subspace)
    damping = field(floats, integers, At.damping)
    friction = field(floats, integers, At.friction)
    lower = field(floats, integers, At.lower)
    upper = field(floats, integers, At.upper)
    mimic_factor = field(floats, integers, At.mimic_factor)
    mimic_offset = field(floats, integers, At.mimic_offset)
    gravity = field(floats, integers, At.gravity)
    numbers = field(floats, integers, At.numbers)
    motor_velocity = field(floats, integers, At.motor_velocity)
    motor_effort = field(floats, integers, At.motor_effort)
    applied = field(floats, integers, At.applied)
    position_target = field(floats, integers, At.position_target)
    velocity_target = field(floats, integers, At.velocity_target)
    kp = field(floats, integers, At.kp)
    kd = field(floats, integers, At.kd)
    servo_effort = field(floats, integers, At.servo_effort)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    memory = field(floats, integers, At.memory)
    last = field(floats, integers, At.last)
    R = field(floats, integers, At.R)
    r = field(floats, integers, At.r)
    P = field(floats, integers, At.P)
    S = field(floats, integers, At.S)
    twist = field(floats, integers, At.twist)
    bias_acceleration = field(floats, integers, At.bias_acceleration)
    composite_mass = field(floats, integers, At.composite_mass)
    composite_h = field(floats, integers, At.composite_h)
    composite_T = field(floats, integers, At.composite_T)
    force = field(floats, integers, At.force)
    M = field(floats, integers, At.M)
    bias = field(floats, integers, At.bias)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    u = field(floats, integers, At.u)
    v_start = field(floats, integers, At.v_start)
    contact_origin = field(floats, integers, At.contact_origin)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    contact_impulse = field(floats, integers, At.contact_impulse)
    Y = field(floats, integers, At.Y)
    row_bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.g)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    before = field(floats, integers, At.before)
    slip = field(floats, integers, At.slip)
    x = field(floats, integers, At.x)
    y = field(floats, integers, At.y)
    A = field(floats, integers, At.A)
    B = field(floats, integers, At.B)
    tree_body = field(integers, integers, At.tree_body)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_mimic = field(integers, integers, At.tree_mimic)
    island_next = field(integers, integers, At.island_next)
    island_contact = field(integers, integers, At.island_contact)
    body_tree = field(integers, integers, At.body_tree)
    kind = field(integers, integers, At.kind)
    parent = field(integers, integers, At.parent)
    first_s = field(integers, integers, At.first_s)
    first_v = field(integers, integers, At.first_v)
    body_last_dof = field(integers, integers, At.body_last_dof)
    dof_parent = field(integers, integers, At.dof_parent)
    dof_s = field(integers, integers, At.dof_s)
    dof_row = field(integers, integers, At.dof_row)
    mimic_dof = field(integers, integers, At.mimic_dof)
    mimic_master = field(integers, integers, At.mimic_master)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_against = field(integers, integers, At.contact_against)
    contact_next = field(integers, integers, At.contact_next)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_row = field(integers, integers, At.contact_row)
    slot = field(integers, integers, At.slot)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    state = field(integers, integers, At.state)
    index = field(integers, integers, At.index)
    saturated = field(integers, integers, At.saturated)
    counts = field(integers, integers, At.counts)
    dt = numbers[DT]
    first_contact_slot, first_pair_slot = 2 * dofs + mimics, slots - 3 * most_contacts
    single = root if island_next[root] < 0 else -1
    rows = 0
    # In free motion all is done twice, the second time with the velocity half a step on; where servos turn out
    # too weak, the second part is done again.
    halfway = False
    attempt = 0
    while True:
        has_servo = False
        rows = 0
        tree = root
        while tree >= 0:
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            if smooth_motion(
                first,
                beyond,
                dof_row,
                dof_parent,
                dof_s,
                s,
                v_start,
                M,
                bias,
                damping,
                friction,
                applied,
                motor_velocity,
                motor_effort,
                position_target,
                velocity_target,
                kp,
                kd,
                servo_effort,
                saturated,
                dt,
                L,
                inverse_diagonal,
                u,
            ):
                has_servo = True
            rows = joint_rows(
                rows,
                tree,
                dofs,
                width,
                tree_dof,
                tree_mimic,
                mimic_dof,
                mimic_master,
                mimic_factor,
                mimic_offset,
                dof_s,
                s,
                v_start,
                friction,
                lower,
                upper,
                motor_velocity,
                motor_effort,
                dt,
                Y,
                row_bias,
                low,
                high,
                mu,
                slot,
                row_a,
                row_b,
            )
            tree = island_next[tree]
        if not halfway and island_contact[root] < 0 and not has_servo and not limited(rows, dofs, slot):
            # It touches nothing, so it is one tree.
            tree = root
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            solve_forward(first, beyond, dof_row, dof_parent, L, inverse_diagonal, u)
            for d in range(first, beyond):
                v[d] = v_start[d] + 0.5 * u[d]
            place(tree, tree_body, kind, parent, first_s, first_v, place_R, place_p, subspace, P, s, R, r, S, False)
            terms(
                tree,
                tree_body,
                dof_row,
                kind,
                parent,
                first_v,
                dof_parent,
                mass,
                centre,
                tensor,
                gravity,
                v,
                R,
                r,
                S,
                twist,
                bias_acceleration,
                composite_mass,
                composite_h,
                composite_T,
                force,
                M,
                bias,
            )
            halfway = True
            continue
        if rows + 3 * contacts_of(island_contact[root], contact_next) > most_rows:
            counts[OVERFULL] = 1
            return -1
        rows = contact_rows(
            rows,
            island_contact[root],
            width,
            first_contact_slot,
            first_pair_slot,
            tree_dof,
            body_tree,
            body_last_dof,
            dof_parent,
            S,
            contact_next,
            contact_body,
            contact_other,
            contact_against,
            contact_feature,
            contact_origin,
            contact_point,
            contact_frame,
            contact_gap,
            contact_mu,
            contact_row,
            v_start,
            dt,
            Y,
            row_bias,
            low,
            high,
            mu,
            slot,
            row_a,
            row_b,
        )
        if rows > 0:
            whiten(
                rows,
                single,
                width,
                tree_dof,
                dof_row,
                dof_parent,
                L,
                inverse_diagonal,
                row_a,
                row_b,
                v_start,
                u,
                Y,
                row_bias,
                g,
                A,
            )
            for k in range(rows):
                before[k] = last[slot[k]]
            guesses = solve(rows, A, g, low, high, mu, before, state, slip, B, y, index, x)
            push(rows, single, width, tree_dof, row_a, row_b, Y, x, u)
            counts[GUESSES] = guesses
            counts[ITERATED] += guesses < 0
        again = False
        tree = root
        attempt += 1
        while tree >= 0:
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            solve_forward(first, beyond, dof_row, dof_parent, L, inverse_diagonal, u)
            for d in range(first, beyond):
                v[d] = v_start[d] + u[d]
            if has_servo and overloaded(
                first,
                beyond,
                dof_s,
                s,
                v,
                position_target,
                velocity_target,
                kp,
                kd,
                servo_effort,
                saturated,
                dt,
                attempt < SERVO_ATTEMPTS,
            ):
                again = True
            tree = island_next[tree]
        if not again:
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
