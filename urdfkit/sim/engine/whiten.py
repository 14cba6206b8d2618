"""Rows whitened by the mass matrices, and what comes of their impulses: A = J·M⁻¹·Jᵀ, see `solve`."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.dynamics import solve_transposed, solve_transposed_by_four
from urdfkit.sim.engine.linear import gram_row


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
def whiten(floats: Any, integers: Any, rows: int, single: int, width: int, alone: bool) -> None:
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
        for k in range(rows):
            start = k * width - first
            free = bias[k]
            for d in range(first, beyond):
                free += Y[start + d] * v[d]
            g[k] = free
        k = 0
        while k + 4 <= rows:
            solve_transposed_by_four(floats, integers, first, beyond, Y, k * width - first, width)
            k += 4
        while k < rows:
            solve_transposed(floats, integers, first, beyond, Y, k * width - first)
            k += 1
        for k in range(rows):
            start = k * width - first
            free = g[k]
            for d in range(first, beyond):
                free += Y[start + d] * u[d]
            g[k] = free
            gram_row(rows, k, beyond - first, width, Y, A)
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
def push(floats: Any, integers: Any, rows: int, single: int, width: int, alone: bool) -> None:
    """Add what the impulses x do to u."""
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
        for k in range(rows):
            xk = x[k]
            for d in range(beyond - first):
                u[first + d] += Y[k * width + d] * xk
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
