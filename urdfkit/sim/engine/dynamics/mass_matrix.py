"""Mass matrix, bias forces and motion subspaces of all bodies in two sweeps.

All spatial quantities of a step have the directions of the world's axes and are of one point, `P`: the origin of the
floating base. So they need no transforms from body to body, a contact Jacobian is read off the subspaces, and nothing
loses precision far from the world's origin. M and v are in Pinocchio's convention; the bias differs from Pinocchio's
for joints with a linear velocity in their own axes (planar, floating): here it keeps that velocity constant in space.

Sources: R. Featherstone, Rigid Body Dynamics Algorithms, 2008: tables 5.1 (recursive Newton-Euler), 6.2 (composite
rigid bodies), 6.3 (factorisation M = LᵀL that keeps the tree's sparsity) and 6.5 (its solves).
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.simd import LANES, load16, store
from urdfkit.sim.engine.math.spatial_algebra import (
    ZERO,
    Vector,
    add,
    compose,
    cross,
    dot,
    force_cross,
    load_rotation,
    load_spatial,
    load_tensor,
    load_vector,
    momentum,
    motion_cross,
    rotate,
    scale,
    spatial_add,
    spatial_dot,
    store_rotation,
    store_spatial,
    store_tensor,
    store_vector,
    sub,
    tensor_turned,
    turn_about,
    turn_of,
    turned_further,
)

REVOLUTE, PRISMATIC, PLANAR, FREE = range(4)
"""Kinds of joint. Coordinates: an angle; a length; x, y, angle; x, y, z and quaternion x, y, z, w."""


@inlined
def place(w: KernelWorld, tree: int, s: Any, ahead: bool) -> None:
    """Place the bodies of a tree and their motion subspaces at the coordinates `s`.

    With `ahead`, `s` is the predicted configuration, but velocities are the present ones: the axes of a free body's
    velocity are unchanged, so that an impulse adds exactly the momentum that it removes from other bodies. The
    predicted configuration is near the last one, which saves the evaluation of sines and cosines.
    """
    now = w.s
    point = load_vector(w.P, tree)
    for i in range(w.tree_body[tree], w.tree_body[tree + 1]):
        above = w.parent[i]
        at, dof, beyond = w.first_s[i], w.first_v[i], w.first_v[i + 1]
        R0, r0 = load_rotation(w.place_R, i), load_vector(w.place_p, i)
        if above < 0:
            r0 = sub(r0, point)
        else:
            R_above = load_rotation(w.R, above)
            r0 = add(load_vector(w.r, above), rotate(R_above, r0))
            R0 = compose(R_above, R0)
        if above < 0 and w.kind[i] == FREE:
            place_free(w, i, R0, r0, s, ahead)
            continue
        axes = load_rotation(w.R, i)
        lin, ang = load_spatial(w.subspace, dof)
        if w.kind[i] == REVOLUTE:
            if ahead:
                sine, cosine = turned_further(w.turn[2 * i], w.turn[2 * i + 1], s[at] - now[at])
            else:
                sine, cosine = sine_cosine(s[at])
                w.turn[2 * i], w.turn[2 * i + 1] = sine, cosine
            R0 = compose(R0, turn_about(ang, sine, cosine))
        elif w.kind[i] == PRISMATIC:
            r0 = add(r0, rotate(R0, scale(s[at], lin)))
        elif w.kind[i] == PLANAR:
            r0 = add(r0, rotate(R0, (s[at], s[at + 1], 0.0)))
            R0 = compose(R0, turn_about((0.0, 0.0, 1.0), *sine_cosine(s[at + 2])))
            dof += 2 if ahead else 0
        else:
            r0 = add(r0, rotate(R0, (s[at], s[at + 1], s[at + 2])))
            R0 = compose(R0, turn_of(s[at + 3], s[at + 4], s[at + 5], s[at + 6]))
            dof += 3 if ahead else 0
        store_rotation(w.R, i, R0)
        store_vector(w.r, i, r0)
        if w.kind[i] != FREE or not ahead:
            axes = R0
        for d in range(dof, beyond):
            lin, ang = load_spatial(w.subspace, d)
            ang = rotate(axes, ang)
            store_spatial(w.S, d, (add(rotate(axes, lin), cross(r0, ang)), ang))


@inlined
def place_free(w: KernelWorld, i: int, R0: Any, r0: Vector, s: Any, ahead: bool) -> None:
    """Do what `place` does for a body that nothing holds, whose motion subspaces are its axes.

    Args:
        w: the world's arrays.
        i: the body.
        R0: rotation of its joint.
        r0: its place [m].
        s: coordinates.
        ahead: as in `place`.
    """
    at, dof = w.first_s[i], w.first_v[i]
    r0 = add(r0, rotate(R0, (s[at], s[at + 1], s[at + 2])))
    before = load_rotation(w.R, i)
    R0 = compose(R0, turn_of(s[at + 3], s[at + 4], s[at + 5], s[at + 6]))
    store_rotation(w.R, i, R0)
    store_vector(w.r, i, r0)
    axes = before if ahead else R0
    for k in range(3):
        axis = (axes[k], axes[3 + k], axes[6 + k])
        if not ahead:
            store_spatial(w.S, dof + k, (axis, ZERO))
        store_spatial(w.S, dof + 3 + k, (cross(r0, axis), axis))


@inlined
def forward_sweep(w: KernelWorld, tree: int, inertias: bool) -> None:
    """Compute velocities and the forces that make the bodies follow at zero joint acceleration; store `inertias`."""
    v = w.v
    g = load_vector(w.gravity, 0)
    for i in range(w.tree_body[tree], w.tree_body[tree + 1]):
        above = w.parent[i]
        velocity, acceleration = (ZERO, ZERO), (ZERO, ZERO)
        if above >= 0:
            velocity, acceleration = load_spatial(w.twist, above), load_spatial(w.bias_acceleration, above)
        R0, r0 = load_rotation(w.R, i), load_vector(w.r, i)
        dof = w.first_v[i]
        joint = (ZERO, ZERO)
        for d in range(dof, w.first_v[i + 1]):
            lin, ang = load_spatial(w.S, d)
            joint = spatial_add(joint, (scale(v[d], lin), scale(v[d], ang)))
        velocity = spatial_add(velocity, joint)
        acceleration = spatial_add(acceleration, motion_cross(velocity, joint))
        if w.kind[i] >= PLANAR:
            # Without acceleration, a body moves straight, but its velocity in its own rotating axes changes.
            turning = (0.0, 0.0, v[dof + 2]) if w.kind[i] == PLANAR else (v[dof + 3], v[dof + 4], v[dof + 5])
            linear = (v[dof], v[dof + 1], 0.0 if w.kind[i] == PLANAR else v[dof + 2])
            acceleration = (sub(acceleration[0], rotate(R0, cross(turning, linear))), acceleration[1])
        store_spatial(w.twist, i, velocity)
        store_spatial(w.bias_acceleration, i, acceleration)
        m = w.mass[i]
        c = add(r0, rotate(R0, load_vector(w.centre, i)))
        h = scale(m, c)
        T = tensor_turned(R0, load_tensor(w.tensor, i))
        square = dot(h, c)
        T = (
            T[0] + square - h[0] * c[0],
            T[1] - h[0] * c[1],
            T[2] - h[0] * c[2],
            T[3] + square - h[1] * c[1],
            T[4] - h[1] * c[2],
            T[5] + square - h[2] * c[2],
        )
        if inertias:
            w.composite_mass[i] = m
            store_vector(w.composite_h, i, h)
            store_tensor(w.composite_T, i, T)
        needed = spatial_add(momentum(m, h, T, acceleration), force_cross(velocity, momentum(m, h, T, velocity)))
        weight = scale(m, g)
        needed = (sub(needed[0], weight), sub(needed[1], cross(c, weight)))
        if w.weightless[i] != 0.0:
            lift = scale(w.weightless[i], g)
            at = add(r0, rotate(R0, load_vector(w.weightless_centre, i)))
            needed = spatial_add(needed, (lift, cross(at, lift)))
        store_spatial(w.force, i, needed)


@inlined
def backward_sweep(w: KernelWorld, tree: int) -> None:
    """Gather inertias and forces from the tips to the root: the lower triangle of M, and bias."""
    for i in range(w.tree_body[tree + 1] - 1, w.tree_body[tree] - 1, -1):
        m, h, T = w.composite_mass[i], load_vector(w.composite_h, i), load_tensor(w.composite_T, i)
        f = load_spatial(w.force, i)
        for d in range(w.first_v[i], w.first_v[i + 1]):
            subspace = load_spatial(w.S, d)
            w.bias[d] = spatial_dot(subspace, f)
            F = momentum(m, h, T, subspace)
            row = w.dof_row[d]
            e = d
            while e >= 0:
                w.M[row + e] = spatial_dot(load_spatial(w.S, e), F)
                e = w.dof_parent[e]
        above = w.parent[i]
        if above >= 0:
            w.composite_mass[above] += m
            store_vector(w.composite_h, above, add(load_vector(w.composite_h, above), h))
            U = load_tensor(w.composite_T, above)
            store_tensor(
                w.composite_T,
                above,
                (U[0] + T[0], U[1] + T[1], U[2] + T[2], U[3] + T[3], U[4] + T[4], U[5] + T[5]),
            )
            store_spatial(w.force, above, spatial_add(load_spatial(w.force, above), f))


@inlined
def terms(w: KernelWorld, tree: int) -> None:
    """Compute M and bias of a tree whose bodies have been placed."""
    forward_sweep(w, tree, True)
    backward_sweep(w, tree)


@inlined
def bias_forces(w: KernelWorld, tree: int) -> None:
    """Compute the bias of a tree at other velocities than before, where its bodies have not moved: M is the same."""
    forward_sweep(w, tree, False)
    for i in range(w.tree_body[tree + 1] - 1, w.tree_body[tree] - 1, -1):
        f = load_spatial(w.force, i)
        for d in range(w.first_v[i], w.first_v[i + 1]):
            w.bias[d] = spatial_dot(load_spatial(w.S, d), f)
        above = w.parent[i]
        if above >= 0:
            store_spatial(w.force, above, spatial_add(load_spatial(w.force, above), f))


@inlined
def is_chain(w: KernelWorld, first: int, beyond: int) -> bool:
    """Return whether every dof of a tree carries the next one: dofs then follow each other without being looked up."""
    return bool(w.dof_depth[beyond - 1] == beyond - 1 - first)


@inlined
def factor_chain(w: KernelWorld, first: int, beyond: int) -> None:
    """Do what `factor` does for a tree without branches."""
    for k in range(beyond - 1, first - 1, -1):
        row = w.dof_row[k]
        inverse = 1.0 / w.L[row + k]
        for i in range(k - 1, first - 1, -1):
            ki, above = w.L[row + i] * inverse, w.dof_row[i]
            for j in range(first, i + 1):
                w.L[above + j] -= ki * w.L[row + j]
        inverse = math.sqrt(inverse)
        w.inverse_diagonal[k] = inverse
        for i in range(first, k):
            w.L[row + i] *= inverse


@inlined
def factor(w: KernelWorld, first: int, beyond: int) -> None:
    """Factor M = LᵀL of a tree in place, lower triangle; entries between branches are never touched."""
    if beyond > first and is_chain(w, first, beyond):
        factor_chain(w, first, beyond)
        return
    for k in range(beyond - 1, first - 1, -1):
        row = w.dof_row[k]
        inverse = 1.0 / w.L[row + k]
        i = w.dof_parent[k]
        while i >= 0:
            ki = w.L[row + i] * inverse
            above = w.dof_row[i]
            j = i
            while j >= 0:
                w.L[above + j] -= ki * w.L[row + j]
                j = w.dof_parent[j]
            i = w.dof_parent[i]
        # The next pivot does not wait for the root.
        inverse = math.sqrt(inverse)
        w.inverse_diagonal[k] = inverse
        i = w.dof_parent[k]
        while i >= 0:
            w.L[row + i] *= inverse
            i = w.dof_parent[i]


@inlined
def solve_transposed(w: KernelWorld, first: int, beyond: int, x: Any, start: int) -> None:
    """Turn the entries of x for a tree's dofs, from `start` + the number of its first dof on, into L⁻ᵀ·x."""
    chain = beyond > first and is_chain(w, first, beyond)
    for i in range(beyond - 1, first - 1, -1):
        xi = x[start + i] * w.inverse_diagonal[i]
        x[start + i] = xi
        if chain:
            row = w.dof_row[i]
            for j in range(first, i):
                x[start + j] -= w.L[row + j] * xi
        elif xi != 0.0:
            row = w.dof_row[i]
            j = w.dof_parent[i]
            while j >= 0:
                x[start + j] -= w.L[row + j] * xi
                j = w.dof_parent[j]


@inlined
def solve_transposed_rows(w: KernelWorld, first: int, beyond: int, x: Any, start: int) -> None:
    """Do what `solve_transposed` does for `LANES` rows at once: their entries for a dof stand side by side.

    Args:
        w: the world's arrays.
        first: dof of the tree.
        beyond: its last dof, and one.
        x: the rows.
        start: where in x their entries for the first dof are; those for the next follow.
    """
    for i in range(beyond - 1, first - 1, -1):
        at = start + (i - first) * LANES
        xi = w.inverse_diagonal[i] * load16(x, at)
        store(x, at, xi)
        row = w.dof_row[i]
        j = w.dof_parent[i]
        while j >= 0:
            at = start + (j - first) * LANES
            store(x, at, load16(x, at) - w.L[row + j] * xi)
            j = w.dof_parent[j]


@inlined
def solve_forward(w: KernelWorld, first: int, beyond: int) -> None:
    """Turn the entries of x for a tree's dofs into L⁻¹·x."""
    x = w.u
    chain = beyond > first and is_chain(w, first, beyond)
    for i in range(first, beyond):
        row = w.dof_row[i]
        xi = x[i]
        if chain:
            for j in range(i - 1, first - 1, -1):
                xi -= w.L[row + j] * x[j]
            x[i] = xi * w.inverse_diagonal[i]
            continue
        j = w.dof_parent[i]
        while j >= 0:
            xi -= w.L[row + j] * x[j]
            j = w.dof_parent[j]
        x[i] = xi * w.inverse_diagonal[i]
