"""The step of one robot on its plane: from one configuration and velocity to the next, all in one compiled call.

`world.step` does the same for several robots, bodies and what they meet; this one knows that there is but one tree and
is half as fast again.
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
from urdfkit.sim.engine.collide import collide_with_plane, near_plane
from urdfkit.sim.engine.compilation import field
from urdfkit.sim.engine.dynamics import (
    backward_sweep,
    forward_sweep,
    place,
    solve_forward,
)
from urdfkit.sim.engine.integrate import move
from urdfkit.sim.engine.rows import contact_rows, joint_rows, whiten
from urdfkit.sim.engine.servo import SERVO_ATTEMPTS, account, limited, overloaded, smooth_motion
from urdfkit.sim.engine.solve import solve


def advance(floats: Any, integers: Any, steps: int, only_terms: bool) -> int:
    """Advance by `steps`; return how many were done: fewer only if the state stopped being finite.

    A step moves half its way with the old velocity, finds there the new one, and moves the other half with that
    (Moreau's scheme; without contacts, the leapfrog): positions are right to second order, at the cost of one
    evaluation. Contacts are those of where the step is expected to end, so that a wheel's velocity points where the
    wheel then does.

    With `only_terms`, compute poses, M and bias of the state as it is, and advance nothing.
    """
    bodies, dofs, coordinates = integers[BODIES], integers[DOFS], integers[COORDINATES]
    shapes, mimics, most_contacts = integers[SHAPES], integers[MIMICS], integers[CONTACTS]
    slots = integers[SLOTS]
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
    shape_R = field(floats, integers, At.shape_R)
    shape_p = field(floats, integers, At.shape_p)
    shape_size = field(floats, integers, At.shape_size)
    shape_radius = field(floats, integers, At.shape_radius)
    vertices = field(floats, integers, At.vertices)
    extreme = field(floats, integers, At.extreme)
    extreme_vertex = field(integers, integers, At.extreme_vertex)
    base = field(floats, integers, At.base)
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
    effort = field(floats, integers, At.effort)
    tau = field(floats, integers, At.tau)
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
    s_ahead = field(floats, integers, At.s_ahead)
    v_ahead = field(floats, integers, At.v_ahead)
    contact_origin = field(floats, integers, At.contact_origin)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
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
    kind = field(integers, integers, At.kind)
    parent = field(integers, integers, At.parent)
    first_s = field(integers, integers, At.first_s)
    first_v = field(integers, integers, At.first_v)
    body_last_dof = field(integers, integers, At.body_last_dof)
    dof_parent = field(integers, integers, At.dof_parent)
    dof_s = field(integers, integers, At.dof_s)
    mimic_dof = field(integers, integers, At.mimic_dof)
    mimic_master = field(integers, integers, At.mimic_master)
    shape_kind = field(integers, integers, At.shape_kind)
    shape_body = field(integers, integers, At.shape_body)
    shape_feature = field(integers, integers, At.shape_feature)
    shape_vertex = field(integers, integers, At.shape_vertex)
    contact_body = field(integers, integers, At.contact_body)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_row = field(integers, integers, At.contact_row)
    slot = field(integers, integers, At.slot)
    state = field(integers, integers, At.state)
    index = field(integers, integers, At.index)
    saturated = field(integers, integers, At.saturated)
    counts = field(integers, integers, At.counts)
    floating = field(integers, integers, At.tree_floats)[0] != 0
    floor_mu = field(floats, integers, At.floor_mu)
    contact_other = field(integers, integers, At.contact_other)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    dt, floor = numbers[DT], numbers[FLOOR]
    first_contact_slot = 2 * dofs + mimics
    for done in range(steps):
        move(bodies, kind, first_s, first_v, s, v, 0.0 if only_terms else 0.5 * dt)
        for d in range(dofs):
            v_start[d] = v[d]
            saturated[d] = 0
        contacts = rows = 0
        # In free motion all is done twice, the second time with the velocity half a step on; where servos turn out too
        # weak, the second part is done again.
        halfway = False
        attempt = 0
        while True:
            if attempt == 0:
                for k in range(3):
                    P[k] = s[k] if floating else base[k]
                place(bodies, kind, parent, first_s, first_v, place_R, place_p, subspace, P, s, R, r, S, False)
                forward_sweep(
                    bodies,
                    kind,
                    parent,
                    first_v,
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
                )
                backward_sweep(
                    bodies,
                    dofs,
                    parent,
                    first_v,
                    dof_parent,
                    S,
                    composite_mass,
                    composite_h,
                    composite_T,
                    force,
                    M,
                    bias,
                )
                if only_terms:
                    return 0
                if (
                    not halfway
                    and numbers[HAS_FLOOR] != 0.0
                    and near_plane(0, shapes, shape_body, shape_p, shape_radius, floor - P[2], dt, R, r, twist)
                ):
                    for k in range(coordinates):
                        s_ahead[k] = s[k]
                    for d in range(dofs):
                        v_ahead[d] = v[d]
                    move(bodies, kind, first_s, first_v, s_ahead, v_ahead, 0.5 * dt)
                    place(bodies, kind, parent, first_s, first_v, place_R, place_p, subspace, P, s_ahead, R, r, S, True)
                    for k in range(3):
                        contact_origin[k] = P[k]
                    contacts = collide_with_plane(
                        0,
                        0,
                        shapes,
                        most_contacts,
                        shape_kind,
                        shape_body,
                        shape_feature,
                        shape_vertex,
                        shape_R,
                        shape_p,
                        shape_size,
                        shape_radius,
                        floor_mu,
                        vertices,
                        extreme,
                        extreme_vertex,
                        floor - P[2],
                        dt,
                        R,
                        r,
                        twist,
                        contact_body,
                        contact_other,
                        contact_shape,
                        contact_against,
                        contact_feature,
                        contact_point,
                        contact_frame,
                        contact_gap,
                        contact_mu,
                    )
            has_servo = smooth_motion(
                dofs,
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
            )
            rows = joint_rows(
                dofs,
                mimics,
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
            )
            if not halfway and contacts == 0 and not has_servo and not limited(rows, dofs, slot):
                solve_forward(dofs, dof_parent, L, inverse_diagonal, u)
                for d in range(dofs):
                    v[d] = v_start[d] + 0.5 * u[d]
                halfway = True
                continue
            rows = contact_rows(
                rows,
                contacts,
                dofs,
                first_contact_slot,
                body_last_dof,
                dof_parent,
                S,
                contact_body,
                contact_feature,
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
            )
            if rows > 0:
                whiten(rows, dofs, dof_parent, L, inverse_diagonal, v_start, u, Y, row_bias, g, A)
                for k in range(rows):
                    before[k] = memory[slot[k]]
                guesses = solve(rows, A, g, low, high, mu, before, state, slip, B, y, index, x)
                for k in range(rows):
                    xk = x[k]
                    for d in range(dofs):
                        u[d] += Y[k * dofs + d] * xk
                counts[GUESSES] = guesses
                counts[ITERATED] += guesses < 0
            solve_forward(dofs, dof_parent, L, inverse_diagonal, u)
            for d in range(dofs):
                v[d] = v_start[d] + u[d]
            attempt += 1
            if not has_servo or not overloaded(
                dofs,
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
                break
        for k in range(slots):
            memory[k] = 0.0
        for k in range(rows):
            memory[slot[k]] = x[k]
        account(
            dofs,
            dof_s,
            s,
            v,
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
            memory,
            dt,
            effort,
            tau,
        )
        total = 0.0
        for d in range(dofs):
            total += v[d]
        move(bodies, kind, first_s, first_v, s, v, 0.5 * dt)
        counts[FOUND_CONTACTS], counts[FOUND_ROWS] = contacts, rows
        if not math.isfinite(total):
            return done
        counts[STEPS] += 1
    return steps
