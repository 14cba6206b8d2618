"""Mass matrix, bias forces and motion subspaces of all bodies in two sweeps.

All spatial quantities of a step have the directions of the world's axes and are of one point, `P`: the origin of the
floating base. So they need no transforms from body to body, a contact Jacobian is read off the subspaces, and nothing
loses precision far from the world's origin. M and v are in Pinocchio's convention; the bias differs from Pinocchio's
for joints with a linear velocity in their own axes (planar, floating): here it keeps that velocity constant in space.

Sources: R. Featherstone, Rigid Body Dynamics Algorithms, 2008: tables 5.1 (recursive Newton-Euler), 6.2 (composite
rigid bodies), 6.3 (factorisation M = LᵀL that keeps the tree's sparsity) and 6.5 (its solves).
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.simd import LANES, load16, store
from urdfkit.sim.engine.math.spatial_algebra import (
    IDENTITY,
    ZERO,
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
def place(floats: Any, integers: Any, tree: int, s: Any, ahead: bool) -> None:
    """Place the bodies of a tree and their motion subspaces at the coordinates `s`.

    With `ahead`, `s` is the predicted configuration, but velocities are the present ones: the axes of a free body's
    velocity are unchanged, so that an impulse adds exactly the momentum that it removes from other bodies. The
    predicted configuration is near the last one, which saves the evaluation of sines and cosines.
    """
    tree_body = field(integers, integers, At.tree_body)
    kind = field(integers, integers, At.kind)
    parent = field(integers, integers, At.parent)
    first_s = field(integers, integers, At.first_s)
    first_v = field(integers, integers, At.first_v)
    place_R = field(floats, integers, At.place_R)
    place_p = field(floats, integers, At.place_p)
    subspace = field(floats, integers, At.subspace)
    P = field(floats, integers, At.P)
    R = field(floats, integers, At.R)
    r = field(floats, integers, At.r)
    S = field(floats, integers, At.S)
    turn = field(floats, integers, At.turn)
    now = field(floats, integers, At.s)
    point = load_vector(P, tree)
    for i in range(tree_body[tree], tree_body[tree + 1]):
        above = parent[i]
        if above < 0:
            R0, r0 = IDENTITY, sub(ZERO, point)
        else:
            R0, r0 = load_rotation(R, above), load_vector(r, above)
        r0 = add(r0, rotate(R0, load_vector(place_p, i)))
        R0 = compose(R0, load_rotation(place_R, i))
        at, dof, beyond = first_s[i], first_v[i], first_v[i + 1]
        axes = load_rotation(R, i)
        lin, ang = load_spatial(subspace, dof)
        if kind[i] == REVOLUTE:
            if ahead:
                sine, cosine = turned_further(turn[2 * i], turn[2 * i + 1], s[at] - now[at])
            else:
                sine, cosine = sine_cosine(s[at])
                turn[2 * i], turn[2 * i + 1] = sine, cosine
            R0 = compose(R0, turn_about(ang, sine, cosine))
        elif kind[i] == PRISMATIC:
            r0 = add(r0, rotate(R0, scale(s[at], lin)))
        elif kind[i] == PLANAR:
            r0 = add(r0, rotate(R0, (s[at], s[at + 1], 0.0)))
            R0 = compose(R0, turn_about((0.0, 0.0, 1.0), *sine_cosine(s[at + 2])))
            dof += 2 if ahead else 0
        else:
            r0 = add(r0, rotate(R0, (s[at], s[at + 1], s[at + 2])))
            R0 = compose(R0, turn_of(s[at + 3], s[at + 4], s[at + 5], s[at + 6]))
            dof += 3 if ahead else 0
        store_rotation(R, i, R0)
        store_vector(r, i, r0)
        if kind[i] != FREE or not ahead:
            axes = R0
        for d in range(dof, beyond):
            lin, ang = load_spatial(subspace, d)
            ang = rotate(axes, ang)
            store_spatial(S, d, (add(rotate(axes, lin), cross(r0, ang)), ang))


@inlined
def forward_sweep(floats: Any, integers: Any, tree: int) -> None:
    """Compute velocities, inertias and the forces that make the bodies follow at zero joint acceleration."""
    tree_body = field(integers, integers, At.tree_body)
    kind = field(integers, integers, At.kind)
    parent = field(integers, integers, At.parent)
    first_v = field(integers, integers, At.first_v)
    mass = field(floats, integers, At.mass)
    centre = field(floats, integers, At.centre)
    tensor = field(floats, integers, At.tensor)
    weightless = field(floats, integers, At.weightless)
    weightless_centre = field(floats, integers, At.weightless_centre)
    gravity = field(floats, integers, At.gravity)
    v = field(floats, integers, At.v)
    R = field(floats, integers, At.R)
    r = field(floats, integers, At.r)
    S = field(floats, integers, At.S)
    twist = field(floats, integers, At.twist)
    bias_acceleration = field(floats, integers, At.bias_acceleration)
    composite_mass = field(floats, integers, At.composite_mass)
    composite_h = field(floats, integers, At.composite_h)
    composite_T = field(floats, integers, At.composite_T)
    force = field(floats, integers, At.force)
    g = load_vector(gravity, 0)
    for i in range(tree_body[tree], tree_body[tree + 1]):
        above = parent[i]
        velocity, acceleration = (ZERO, ZERO), (ZERO, ZERO)
        if above >= 0:
            velocity, acceleration = load_spatial(twist, above), load_spatial(bias_acceleration, above)
        R0, r0 = load_rotation(R, i), load_vector(r, i)
        dof = first_v[i]
        joint = (ZERO, ZERO)
        for d in range(dof, first_v[i + 1]):
            lin, ang = load_spatial(S, d)
            joint = spatial_add(joint, (scale(v[d], lin), scale(v[d], ang)))
        velocity = spatial_add(velocity, joint)
        acceleration = spatial_add(acceleration, motion_cross(velocity, joint))
        if kind[i] >= PLANAR:
            # Without acceleration, a body moves straight, but its velocity in its own rotating axes changes.
            turning = (0.0, 0.0, v[dof + 2]) if kind[i] == PLANAR else (v[dof + 3], v[dof + 4], v[dof + 5])
            linear = (v[dof], v[dof + 1], 0.0 if kind[i] == PLANAR else v[dof + 2])
            acceleration = (sub(acceleration[0], rotate(R0, cross(turning, linear))), acceleration[1])
        store_spatial(twist, i, velocity)
        store_spatial(bias_acceleration, i, acceleration)
        m = mass[i]
        c = add(r0, rotate(R0, load_vector(centre, i)))
        h = scale(m, c)
        T = tensor_turned(R0, load_tensor(tensor, i))
        square = dot(h, c)
        T = (
            T[0] + square - h[0] * c[0],
            T[1] - h[0] * c[1],
            T[2] - h[0] * c[2],
            T[3] + square - h[1] * c[1],
            T[4] - h[1] * c[2],
            T[5] + square - h[2] * c[2],
        )
        composite_mass[i] = m
        store_vector(composite_h, i, h)
        store_tensor(composite_T, i, T)
        needed = spatial_add(momentum(m, h, T, acceleration), force_cross(velocity, momentum(m, h, T, velocity)))
        weight = scale(m, g)
        needed = (sub(needed[0], weight), sub(needed[1], cross(c, weight)))
        if weightless[i] != 0.0:
            lift = scale(weightless[i], g)
            at = add(r0, rotate(R0, load_vector(weightless_centre, i)))
            needed = spatial_add(needed, (lift, cross(at, lift)))
        store_spatial(force, i, needed)


@inlined
def backward_sweep(floats: Any, integers: Any, tree: int) -> None:
    """Gather inertias and forces from the tips to the root: the lower triangle of M, and bias."""
    tree_body = field(integers, integers, At.tree_body)
    dof_row = field(integers, integers, At.dof_row)
    parent = field(integers, integers, At.parent)
    first_v = field(integers, integers, At.first_v)
    dof_parent = field(integers, integers, At.dof_parent)
    S = field(floats, integers, At.S)
    composite_mass = field(floats, integers, At.composite_mass)
    composite_h = field(floats, integers, At.composite_h)
    composite_T = field(floats, integers, At.composite_T)
    force = field(floats, integers, At.force)
    M = field(floats, integers, At.M)
    bias = field(floats, integers, At.bias)
    for i in range(tree_body[tree + 1] - 1, tree_body[tree] - 1, -1):
        m, h, T = composite_mass[i], load_vector(composite_h, i), load_tensor(composite_T, i)
        f = load_spatial(force, i)
        for d in range(first_v[i], first_v[i + 1]):
            subspace = load_spatial(S, d)
            bias[d] = spatial_dot(subspace, f)
            F = momentum(m, h, T, subspace)
            row = dof_row[d]
            e = d
            while e >= 0:
                M[row + e] = spatial_dot(load_spatial(S, e), F)
                e = dof_parent[e]
        above = parent[i]
        if above >= 0:
            composite_mass[above] += m
            store_vector(composite_h, above, add(load_vector(composite_h, above), h))
            U = load_tensor(composite_T, above)
            store_tensor(
                composite_T,
                above,
                (U[0] + T[0], U[1] + T[1], U[2] + T[2], U[3] + T[3], U[4] + T[4], U[5] + T[5]),
            )
            store_spatial(force, above, spatial_add(load_spatial(force, above), f))


@inlined
def terms(floats: Any, integers: Any, tree: int) -> None:
    """Compute M and bias of a tree whose bodies have been placed."""
    forward_sweep(floats, integers, tree)
    backward_sweep(floats, integers, tree)


@inlined
def factor(floats: Any, integers: Any, first: int, beyond: int) -> None:
    """Factor M = LᵀL of a tree in place, lower triangle; entries between branches are never touched."""
    dof_row = field(integers, integers, At.dof_row)
    dof_parent = field(integers, integers, At.dof_parent)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    for k in range(beyond - 1, first - 1, -1):
        row = dof_row[k]
        inverse = 1.0 / L[row + k]
        i = dof_parent[k]
        while i >= 0:
            ki = L[row + i] * inverse
            above = dof_row[i]
            j = i
            while j >= 0:
                L[above + j] -= ki * L[row + j]
                j = dof_parent[j]
            i = dof_parent[i]
        # The next pivot does not wait for the root.
        inverse = math.sqrt(inverse)
        inverse_diagonal[k] = inverse
        i = dof_parent[k]
        while i >= 0:
            L[row + i] *= inverse
            i = dof_parent[i]


@inlined
def solve_transposed(floats: Any, integers: Any, first: int, beyond: int, x: Any, start: int) -> None:
    """Turn the entries of x for a tree's dofs, from `start` + the number of its first dof on, into L⁻ᵀ·x."""
    dof_row = field(integers, integers, At.dof_row)
    dof_parent = field(integers, integers, At.dof_parent)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    for i in range(beyond - 1, first - 1, -1):
        xi = x[start + i] * inverse_diagonal[i]
        x[start + i] = xi
        if xi != 0.0:
            row = dof_row[i]
            j = dof_parent[i]
            while j >= 0:
                x[start + j] -= L[row + j] * xi
                j = dof_parent[j]


@inlined
def solve_transposed_rows(floats: Any, integers: Any, first: int, beyond: int, x: Any, start: int) -> None:
    """Do what `solve_transposed` does for `LANES` rows at once: their entries for a dof stand side by side.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        first: dof of the tree.
        beyond: its last dof, and one.
        x: the rows.
        start: where in x their entries for the first dof are; those for the next follow.
    """
    dof_row = field(integers, integers, At.dof_row)
    dof_parent = field(integers, integers, At.dof_parent)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    for i in range(beyond - 1, first - 1, -1):
        at = start + (i - first) * LANES
        xi = inverse_diagonal[i] * load16(x, at)
        store(x, at, xi)
        row = dof_row[i]
        j = dof_parent[i]
        while j >= 0:
            at = start + (j - first) * LANES
            store(x, at, load16(x, at) - L[row + j] * xi)
            j = dof_parent[j]


@inlined
def solve_forward(floats: Any, integers: Any, first: int, beyond: int) -> None:
    """Turn the entries of x for a tree's dofs into L⁻¹·x."""
    dof_row = field(integers, integers, At.dof_row)
    dof_parent = field(integers, integers, At.dof_parent)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    x = field(floats, integers, At.u)
    for i in range(first, beyond):
        row = dof_row[i]
        xi = x[i]
        j = dof_parent[i]
        while j >= 0:
            xi -= L[row + j] * x[j]
            j = dof_parent[j]
        x[i] = xi * inverse_diagonal[i]
