"""Step of a ballistic tree: no contact, limit, motor, servo, effort, dry friction or damping.

The step uses the classical Runge-Kutta method of fourth order, because the energy of such a tree shows every error.
The rotation of a floating joint is R = R₀·exp(θ), and θ is integrated: θ̇ = ω + θ×ω/2 + θ×(θ×ω)/12 to sufficient
order (H. Munthe-Kaas, High order Runge-Kutta methods on manifolds, 1999). Its linear velocity is in the axes of the
parent.
"""

from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.constraints.joint_servos import is_undamped, smooth_motion
from urdfkit.sim.engine.dynamics.integration import move, turned_by
from urdfkit.sim.engine.dynamics.mass_matrix import FREE, PLANAR, place, solve_forward, terms
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.spatial_algebra import (
    ZERO,
    add,
    cross,
    load_tensor,
    load_vector,
    rotate,
    scale,
    sub,
    tensor_inverse,
    tensor_times,
    turn_of,
)
from urdfkit.sim.engine.sleep.sleep_criteria import is_free_body


@inlined
def is_ballistic(w: KernelWorld, first: int, beyond: int, rows: int) -> bool:
    """Return whether no row, effort, friction or damping acts on a tree without contacts and servos."""
    if rows > 0:
        return False
    for d in range(first, beyond):
        if w.damping[d] != 0.0 or w.applied[d] != 0.0 or w.approach_rate[d] != 0.0:
            return False
    return True


@inlined
def is_flying(w: KernelWorld, tree: int, contact: int) -> bool:
    """Return whether only gravity acts on a free body: it is ballistic, which this finds without its forces and rows.

    Args:
        w: the world's arrays.
        tree: the only one of its island, or -1.
        contact: first of the island, or -1.
    """
    if tree < 0 or contact >= 0 or not is_free_body(w, tree) or w.weightless[w.tree_body[tree]] != 0.0:
        return False
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    for d in range(first, beyond):
        if w.motor_effort[d] != 0.0 or w.friction[d] != 0.0:
            return False
    return is_undamped(w, first, beyond) and is_ballistic(w, first, beyond, 0)


@compiled
def rk4_step(w: KernelWorld, tree: int, dt: float) -> None:
    """Advance a tree by a step.

    Half of it, at the velocities of the start, has been gone already; and half, at those of the end, is left to go.
    """
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    if is_free_body(w, tree) and w.weightless[w.tree_body[tree]] == 0.0:
        fly(w, w.tree_body[tree], dt)
        return
    move(w, w.tree_body[tree], w.tree_body[tree + 1], w.s, w.v, -0.5 * dt)
    for k in range(w.tree_s[tree], w.tree_s[tree + 1]):
        w.s_ahead[k] = w.s[k]
    store_velocities(w, tree)
    for d in range(first, beyond):
        w.sum_s[d] = w.sum_v[d] = w.slope_s[d] = w.slope_v[d] = 0.0
    for evaluation in range(4):
        ahead = 0.5 * dt
        if evaluation == 0:
            ahead = 0.0
        elif evaluation == 3:
            ahead = dt
        set_ahead(w, tree, w.slope_s, w.slope_v, ahead)
        for k in range(3):
            w.P[3 * tree + k] = w.s[w.tree_s[tree] + k] if w.tree_floats[tree] != 0 else w.base[3 * tree + k]
        for d in range(first, beyond):
            w.v_start[d] = w.v[d]
        place(w, tree, w.s, False)
        terms(w, tree)
        smooth_motion(w, first, beyond, dt, False)
        solve_forward(w, first, beyond)
        time_derivatives(w, tree, ahead, dt)
        weight = 1.0 / 6.0 if evaluation in (0, 3) else 1.0 / 3.0
        for d in range(first, beyond):
            w.sum_s[d] += weight * w.slope_s[d]
            w.sum_v[d] += weight * w.slope_v[d]
    set_ahead(w, tree, w.sum_s, w.sum_v, dt)
    move(w, w.tree_body[tree], w.tree_body[tree + 1], w.s, w.v, -0.5 * dt)


@compiled
def fly(w: KernelWorld, i: int, dt: float) -> None:
    """Do what `rk4_step` does for a single free body, written out: M and the bias are not needed."""
    s, v = w.s, w.v
    at, d = w.first_s[i], w.first_v[i]
    move(w, i, i + 1, s, v, -0.5 * dt)
    x, y, z, scalar = s[at + 3], s[at + 4], s[at + 5], s[at + 6]
    linear, angular = rotate(turn_of(x, y, z, scalar), (v[d], v[d + 1], v[d + 2])), (v[d + 3], v[d + 4], v[d + 5])
    centre, inertia, gravity = load_vector(w.centre, i), load_tensor(w.tensor, i), load_vector(w.gravity, 0)
    inverse = tensor_inverse(inertia)
    # Slopes, and their sums: rotation and angular velocity in the axes of the body, linear velocity in the world's.
    turning = spin_up = speed_up = ZERO
    moved = turned = spun_up = sped_up = ZERO
    for evaluation in range(4):
        ahead = 0.5 * dt
        if evaluation == 0:
            ahead = 0.0
        elif evaluation == 3:
            ahead = dt
        turn, spin = scale(ahead, turning), add(angular, scale(ahead, spin_up))
        speed = add(linear, scale(ahead, speed_up))
        R = turn_of(*turned_by(x, y, z, scalar, turn))
        turning = rotation_rate(turn, spin)
        spin_up = scale(-1.0, tensor_times(inverse, cross(spin, tensor_times(inertia, spin))))
        about = add(cross(spin_up, centre), cross(spin, cross(spin, centre)))
        speed_up = sub(gravity, rotate(R, about))
        weight = 1.0 / 6.0 if evaluation in (0, 3) else 1.0 / 3.0
        moved, turned = add(moved, scale(weight, speed)), add(turned, scale(weight, turning))
        spun_up, sped_up = add(spun_up, scale(weight, spin_up)), add(sped_up, scale(weight, speed_up))
    s[at], s[at + 1], s[at + 2] = add((s[at], s[at + 1], s[at + 2]), scale(dt, moved))
    x, y, z, scalar = turned_by(x, y, z, scalar, scale(dt, turned))
    s[at + 3], s[at + 4], s[at + 5], s[at + 6] = x, y, z, scalar
    v[d], v[d + 1], v[d + 2] = rotate(turn_of(-x, -y, -z, scalar), add(linear, scale(dt, sped_up)))
    v[d + 3], v[d + 4], v[d + 5] = add(angular, scale(dt, spun_up))
    move(w, i, i + 1, s, v, -0.5 * dt)


@inlined
def rotation_rate(turn: Any, rate: Any) -> Any:
    """Return how the rotation vector `turn` grows at an angular velocity."""
    once = cross(turn, rate)
    return add(rate, add(scale(0.5, once), scale(1.0 / 12.0, cross(turn, once))))


@inlined
def store_velocities(w: KernelWorld, tree: int) -> None:
    """Store the velocities in ``v_ahead``, linear ones in the axes of the joint's parent."""
    s, v = w.s, w.v
    v_first = w.v_ahead
    for i in range(w.tree_body[tree], w.tree_body[tree + 1]):
        at, d = w.first_s[i], w.first_v[i]
        for k in range(d, w.first_v[i + 1]):
            v_first[k] = v[k]
        if w.kind[i] == FREE:
            linear = rotate(turn_of(s[at + 3], s[at + 4], s[at + 5], s[at + 6]), (v[d], v[d + 1], v[d + 2]))
            v_first[d], v_first[d + 1], v_first[d + 2] = linear
        elif w.kind[i] == PLANAR:
            sine, cosine = sine_cosine(s[at + 2])
            v_first[d], v_first[d + 1] = cosine * v[d] - sine * v[d + 1], sine * v[d] + cosine * v[d + 1]


@compiled
def set_ahead(w: KernelWorld, tree: int, slope_s: Any, slope_v: Any, ahead: float) -> None:
    """Set coordinates and velocities to those at the start plus `ahead` times the slopes."""
    s, v = w.s, w.v
    s_first, v_first = w.s_ahead, w.v_ahead
    for i in range(w.tree_body[tree], w.tree_body[tree + 1]):
        at, d = w.first_s[i], w.first_v[i]
        for k in range(d, w.first_v[i + 1]):
            v[k] = v_first[k] + ahead * slope_v[k]
        for k in range(3 if w.kind[i] >= PLANAR else 1):
            s[at + k] = s_first[at + k] + ahead * slope_s[d + k]
        if w.kind[i] == FREE:
            turn = (ahead * slope_s[d + 3], ahead * slope_s[d + 4], ahead * slope_s[d + 5])
            x, y, z, scalar = turned_by(s_first[at + 3], s_first[at + 4], s_first[at + 5], s_first[at + 6], turn)
            s[at + 3], s[at + 4], s[at + 5], s[at + 6] = x, y, z, scalar
            v[d], v[d + 1], v[d + 2] = rotate(turn_of(-x, -y, -z, scalar), (v[d], v[d + 1], v[d + 2]))
        elif w.kind[i] == PLANAR:
            sine, cosine = sine_cosine(s[at + 2])
            v[d], v[d + 1] = cosine * v[d] + sine * v[d + 1], cosine * v[d + 1] - sine * v[d]


@inlined
def time_derivatives(w: KernelWorld, tree: int, ahead: float, dt: float) -> None:
    """Find how coordinates and velocities change, from v and from what they gain in a step, in u."""
    s, v, u = w.s, w.v, w.u
    slope_s, slope_v = w.slope_s, w.slope_v
    for i in range(w.tree_body[tree], w.tree_body[tree + 1]):
        at, d = w.first_s[i], w.first_v[i]
        if w.kind[i] == FREE:
            R = turn_of(s[at + 3], s[at + 4], s[at + 5], s[at + 6])
            turn = (ahead * slope_s[d + 3], ahead * slope_s[d + 4], ahead * slope_s[d + 5])
            rate = (v[d + 3], v[d + 4], v[d + 5])
            rate = rotation_rate(turn, rate)
            slope_s[d], slope_s[d + 1], slope_s[d + 2] = rotate(R, (v[d], v[d + 1], v[d + 2]))
            slope_s[d + 3], slope_s[d + 4], slope_s[d + 5] = rate
            slope_v[d], slope_v[d + 1], slope_v[d + 2] = rotate(R, (u[d] / dt, u[d + 1] / dt, u[d + 2] / dt))
            for k in range(d + 3, d + 6):
                slope_v[k] = u[k] / dt
            continue
        for k in range(d, w.first_v[i + 1]):
            slope_s[k], slope_v[k] = v[k], u[k] / dt
        if w.kind[i] == PLANAR:
            sine, cosine = sine_cosine(s[at + 2])
            for one in (slope_s, slope_v):
                one[d], one[d + 1] = cosine * one[d] - sine * one[d + 1], sine * one[d] + cosine * one[d + 1]
