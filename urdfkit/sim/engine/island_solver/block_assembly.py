"""Writing the matrix M + Jᵀ·D·J of an island, see `block_matrix`."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.math.simd import load6, store
from urdfkit.sim.engine.solver.row_states import HOLDS, SLIDES


@inlined
def add_three(K: Any, n: int, i: int, j: int, Y: Any, at: int, to: int, width: int, d: Any) -> None:
    """Add what the three rows of a contact add, aᵀ·D·b, to a block of K of six by six."""
    first, second, third = load6(Y, to), load6(Y, to + width), load6(Y, to + 2 * width)
    for k in range(6):
        a, b, c = d[0] * Y[at + k], d[1] * Y[at + width + k], d[2] * Y[at + 2 * width + k]
        here = (i + k) * n + j
        store(K, here, load6(K, here) + a * first + b * second + c * third)


@inlined
def add_contact(floats: Any, integers: Any, k: int, n: int, d: Any) -> None:
    """Add what the three rows of a contact add to K where both its trees, or its only one, have six dofs."""
    width = integers[WIDTH]
    Y = field(floats, integers, At.Y)
    K = field(floats, integers, At.B)
    i, at = field(integers, integers, At.at_a)[k], k * width
    add_three(K, n, i, i, Y, at, at, width, d)
    if field(integers, integers, At.of_b)[k] == 6:
        j = field(integers, integers, At.at_b)[k]
        add_three(K, n, j, j, Y, at + 6, at + 6, width, d)
        if i < j:
            add_three(K, n, i, j, Y, at, at + 6, width, d)
        else:
            add_three(K, n, j, i, Y, at + 6, at, width, d)


@inlined
def add_block(K: Any, n: int, i: int, j: int, ni: int, nj: int, Y: Any, at: int, to: int, d: float) -> None:
    """Add d·aᵀ·b to a block of K, a and b parts of a row."""
    if nj == 6:
        b = load6(Y, to)
        for k in range(ni):
            here = (i + k) * n + j
            store(K, here, load6(K, here) + d * Y[at + k] * b)
        return
    for k in range(ni):
        c = d * Y[at + k]
        if c != 0.0:
            for m in range(nj):
                K[(i + k) * n + j + m] += c * Y[to + m]


@inlined
def add_row(floats: Any, integers: Any, k: int, n: int, Y: Any, at: int, d: float) -> None:
    """Add d·aᵀ·a to K, a written at a place of Y, of the trees of row k."""
    K = field(floats, integers, At.B)
    i, ni = field(integers, integers, At.at_a)[k], field(integers, integers, At.of_a)[k]
    add_block(K, n, i, i, ni, ni, Y, at, at, d)
    j, nj = field(integers, integers, At.at_b)[k], field(integers, integers, At.of_b)[k]
    if nj > 0:
        add_block(K, n, j, j, nj, nj, Y, at + ni, at + ni, d)
        if i < j:
            add_block(K, n, i, j, ni, nj, Y, at, at + ni, d)
        else:
            add_block(K, n, j, i, nj, ni, Y, at + ni, at, d)


@compiled
def assemble(floats: Any, integers: Any, root: int, rows: int, n: int, coned: bool) -> None:
    """Write M, of each tree from its factor, and add what rows do to it: the upper triangle of K in B.

    Where a contact slides, the row along its cone, if `coned`, or else that of its normal, and the one across its slip.
    """
    width = integers[WIDTH]
    tree_dof = field(integers, integers, At.tree_dof)
    island_next = field(integers, integers, At.island_next)
    dof_row = field(integers, integers, At.dof_row)
    tree_block = field(integers, integers, At.tree_block)
    block_first = field(integers, integers, At.block_first)
    of_a = field(integers, integers, At.of_a)
    of_b = field(integers, integers, At.of_b)
    state = field(integers, integers, At.state)
    mu = field(floats, integers, At.mu)
    near = field(floats, integers, At.near_x)
    made = field(floats, integers, At.A)
    Y = field(floats, integers, At.Y)
    K = field(floats, integers, At.B)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    stiffness = field(floats, integers, At.g)
    for k in range(n * n):
        K[k] = 0.0
    tree = root
    while tree >= 0:
        first, size = tree_dof[tree], tree_dof[tree + 1] - tree_dof[tree]
        at = block_first[tree_block[tree]]
        for k in range(size):
            row = dof_row[first + k] + first
            diagonal = L[row + k] * inverse_diagonal[first + k]
            for i in range(k):
                c = L[row + i]
                for j in range(i, k):
                    K[(at + i) * n + at + j] += c * L[row + j]
                K[(at + i) * n + at + k] += c * diagonal
            K[(at + k) * n + at + k] += L[row + k]
        tree = island_next[tree]
    k = 0
    while k < rows:
        if state[k] == SLIDES:
            # Two rows that its slip makes of three: see `coulomb_direction` and `convex_newton`.
            a, b = near[k + 1], near[k + 2]
            c, share = (mu[k], 1.0 / math.sqrt(1.0 + mu[k] * mu[k])) if coned else (0.0, 1.0)
            at = k * width
            for d in range(width):
                first, second = Y[at + width + d], Y[at + 2 * width + d]
                made[d] = share * (Y[at + d] - c * (a * first + b * second))
                made[width + d] = a * second - b * first
            add_row(floats, integers, k, n, made, 0, stiffness[k])
            if near[k] > 0.0:
                add_row(floats, integers, k, n, made, width, near[k])
            k += 3
            continue
        if mu[k] > 0.0 and of_a[k] == 6 and (of_b[k] == 6 or of_b[k] == 0):
            if state[k] == HOLDS:
                add_contact(floats, integers, k, n, (stiffness[k], stiffness[k + 1], stiffness[k + 2]))
            k += 3
            continue
        if state[k] == HOLDS:
            add_row(floats, integers, k, n, Y, k * width, stiffness[k])
        k += 1
