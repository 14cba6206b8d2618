"""Delassus matrix A = J·M⁻¹·Jᵀ from rows whitened by the mass matrices, and the effect of impulses."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_transposed, solve_transposed_rows
from urdfkit.sim.engine.math.simd import LANES, load16, store


@inlined
def row_product(floats: Any, integers: Any, i: int, j: int, width: int) -> float:
    """Return the product of two whitened rows; those of different trees meet nowhere."""
    tree_dof = field(integers, integers, At.tree_dof)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    total = 0.0
    a, b = row_a[i], row_b[i]
    n = tree_dof[a + 1] - tree_dof[a]
    at, to = i * width, j * width
    if row_a[j] == a:
        for d in range(n):
            total += Y[at + d] * Y[to + d]
    elif row_b[j] == a:
        to += tree_dof[row_a[j] + 1] - tree_dof[row_a[j]]
        for d in range(n):
            total += Y[at + d] * Y[to + d]
    if b >= 0:
        at += n
        to = j * width
        m = tree_dof[b + 1] - tree_dof[b]
        if row_a[j] == b:
            for d in range(m):
                total += Y[at + d] * Y[to + d]
        elif row_b[j] == b:
            to += tree_dof[row_a[j] + 1] - tree_dof[row_a[j]]
            for d in range(m):
                total += Y[at + d] * Y[to + d]
    return total


@inlined
def column_of(k: int, dofs: int) -> int:
    """Return where in ``columns`` the first entry of row k is, each of so many dofs; its next is `LANES` further."""
    return (k & -LANES) * dofs + (k & (LANES - 1))


@inlined
def whiten_columns(floats: Any, integers: Any, rows: int, first: int, beyond: int, width: int) -> None:
    """Do what `build_delassus` does for the rows of a single tree, `LANES` rows at once, see `column_of`.

    Entries of ``columns`` after the last row are not used.
    """
    v = field(floats, integers, At.v_start)
    u = field(floats, integers, At.u)
    Y = field(floats, integers, At.Y)
    columns = field(floats, integers, At.columns)
    bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.g)
    A = field(floats, integers, At.A)
    n = beyond - first
    for k in range(rows):
        at = column_of(k, n)
        for d in range(n):
            columns[at + d * LANES] = Y[k * width + d]
    for start in range(0, rows, LANES):
        at = column_of(start, n)
        free = load16(bias, start)
        for d in range(n):
            free = free + v[first + d] * load16(columns, at + d * LANES)
        solve_transposed_rows(floats, integers, first, beyond, columns, at)
        for d in range(n):
            free = free + u[first + d] * load16(columns, at + d * LANES)
        store(g, start, free)
    for k in range(rows):
        one = column_of(k, n)
        for start in range(0, rows, LANES):
            at = column_of(start, n)
            products = columns[one] * load16(columns, at)
            for d in range(1, n):
                products = products + columns[one + d * LANES] * load16(columns, at + d * LANES)
            # What this writes beyond the row is the next one's, which comes later.
            store(A, k * rows + start, products)


@inlined
def build_delassus(floats: Any, integers: Any, rows: int, single: int, width: int, alone: bool) -> None:
    """Turn rows J into Y = J·L⁻¹, their biases into velocities g with no impulse, and get A = J·M⁻¹·Jᵀ.

    The velocity with no impulse is v + L⁻¹·u. Most islands are a `single` tree, whose number this is; otherwise it is
    -1.
    """
    tree_dof = field(integers, integers, At.tree_dof)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    v = field(floats, integers, At.v_start)
    u = field(floats, integers, At.u)
    Y = field(floats, integers, At.Y)
    bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.g)
    A = field(floats, integers, At.A)
    if single >= 0:
        first, beyond = tree_dof[single], tree_dof[single + 1]
        if alone:
            first, beyond = 0, width
        whiten_columns(floats, integers, rows, first, beyond, width)
        return
    for k in range(rows):
        free = bias[k]
        at = k * width
        for side in range(2):
            tree = row_a[k] if side == 0 else row_b[k]
            if tree < 0:
                continue
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            start = at - first
            for d in range(first, beyond):
                free += Y[start + d] * v[d]
            solve_transposed(floats, integers, first, beyond, Y, start)
            for d in range(first, beyond):
                free += Y[start + d] * u[d]
            at += beyond - first
        g[k] = free
        for j in range(k + 1):
            total = row_product(floats, integers, k, j, width)
            A[k * rows + j] = total
            A[j * rows + k] = total


@inlined
def apply_impulses(floats: Any, integers: Any, rows: int, single: int, width: int, alone: bool) -> None:
    """Add the effect of the impulses x to u."""
    tree_dof = field(integers, integers, At.tree_dof)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    x = field(floats, integers, At.x)
    u = field(floats, integers, At.u)
    if single >= 0:
        first, beyond = tree_dof[single], tree_dof[single + 1]
        if alone:
            first, beyond = 0, width
        columns, n = field(floats, integers, At.columns), beyond - first
        for start in range(0, rows, LANES):
            many = min(LANES, rows - start)
            for d in range(n):
                at = column_of(start, n) + d * LANES
                total = u[first + d]
                for k in range(many):
                    total += columns[at + k] * x[start + k]
                u[first + d] = total
        return
    for k in range(rows):
        xk = x[k]
        at = k * width
        for side in range(2):
            tree = row_a[k] if side == 0 else row_b[k]
            if tree < 0:
                continue
            first, beyond = tree_dof[tree], tree_dof[tree + 1]
            for d in range(first, beyond):
                u[d] += Y[at - first + d] * xk
            at += beyond - first
