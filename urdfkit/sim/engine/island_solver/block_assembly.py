"""Writing the matrix M + Jᵀ·D·J of an island, see `block_matrix`."""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import load4, load6, store
from urdfkit.sim.engine.simulation_memory import WIDTH
from urdfkit.sim.engine.solver.row_states import HOLDS, SLIDES


@inlined
def add_three(K: Any, n: int, i: int, j: int, Y: Any, at: int, to: int, width: int, d: Any) -> None:
    """Add aᵀ·D·b, the contribution of the three rows of a contact, to a 6 x 6 block of K."""
    first, second, third = load6(Y, to), load6(Y, to + width), load6(Y, to + 2 * width)
    for k in range(6):
        a, b, c = d[0] * Y[at + k], d[1] * Y[at + width + k], d[2] * Y[at + 2 * width + k]
        here = (i + k) * n + j
        store(K, here, load6(K, here) + a * first + b * second + c * third)


@inlined
def add_diagonal(K: Any, n: int, i: int, Y: Any, at: int, width: int, d: Any) -> None:
    """Add aᵀ·D·a to a block on the diagonal of K, of which only the upper triangle is used."""
    first, second, third = load6(Y, at), load6(Y, at + width), load6(Y, at + 2 * width)
    for k in range(2):
        a, b, c = d[0] * Y[at + k], d[1] * Y[at + width + k], d[2] * Y[at + 2 * width + k]
        here = (i + k) * n + i
        store(K, here, load6(K, here) + a * first + b * second + c * third)
    one, other, last = load4(Y, at + 2), load4(Y, at + width + 2), load4(Y, at + 2 * width + 2)
    for k in range(2, 6):
        a, b, c = d[0] * Y[at + k], d[1] * Y[at + width + k], d[2] * Y[at + 2 * width + k]
        here = (i + k) * n + i + 2
        store(K, here, load4(K, here) + a * one + b * other + c * last)


@inlined
def add_contact(w: KernelWorld, k: int, n: int, d: Any) -> None:
    """Add the contribution of a contact's three rows to K where all of its trees have six dofs."""
    width = w.sizes[WIDTH]
    K = w.B
    i, at = w.at_a[k], k * width
    add_diagonal(K, n, i, w.Y, at, width, d)
    if w.of_b[k] == 6:
        j = w.at_b[k]
        add_diagonal(K, n, j, w.Y, at + 6, width, d)
        if i < j:
            add_three(K, n, i, j, w.Y, at, at + 6, width, d)
        else:
            add_three(K, n, j, i, w.Y, at + 6, at, width, d)


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
def add_row(w: KernelWorld, k: int, n: int, Y: Any, at: int, d: float) -> None:
    """Add d·aᵀ·a to K, a written at a place of Y, of the trees of row k."""
    K = w.B
    i, ni = w.at_a[k], w.of_a[k]
    add_block(K, n, i, i, ni, ni, Y, at, at, d)
    j, nj = w.at_b[k], w.of_b[k]
    if nj > 0:
        add_block(K, n, j, j, nj, nj, Y, at + ni, at + ni, d)
        if i < j:
            add_block(K, n, i, j, ni, nj, Y, at, at + ni, d)
        else:
            add_block(K, n, j, i, nj, ni, Y, at + ni, at, d)


@inlined
def clear(w: KernelWorld, n: int) -> None:
    """Set the blocks that are written or fill in to zero."""
    K, first = w.B, w.block_first
    k = 0
    while first[k] < n:
        for i in range(first[k] * n, first[k + 1] * n, n):
            for j in range(i + first[k], i + first[k + 1]):
                K[j] = 0.0
            for each in range(w.first_near[k], w.first_near[k + 1]):
                b = w.block_near[each]
                for j in range(i + first[b], i + first[b + 1]):
                    K[j] = 0.0
        k += 1


@compiled
def assemble(w: KernelWorld, root: int, rows: int, n: int, coned: bool) -> None:
    """Write M, of each tree from its factor, and add what rows do to it: the upper triangle of K in B.

    Where a contact slides, the row along its cone, if `coned`, or else that of its normal, and the one across its slip.
    """
    width = w.sizes[WIDTH]
    near, made, K, stiffness = w.near_x, w.A, w.B, w.g
    clear(w, n)
    tree = root
    while tree >= 0:
        first, size = w.tree_dof[tree], w.tree_dof[tree + 1] - w.tree_dof[tree]
        at = w.block_first[w.tree_block[tree]]
        for k in range(size):
            row = w.dof_row[first + k] + first
            diagonal = w.L[row + k] * w.inverse_diagonal[first + k]
            for i in range(k):
                c = w.L[row + i]
                for j in range(i, k):
                    K[(at + i) * n + at + j] += c * w.L[row + j]
                K[(at + i) * n + at + k] += c * diagonal
            K[(at + k) * n + at + k] += w.L[row + k]
        tree = w.island_next[tree]
    k = 0
    while k < rows:
        if w.state[k] == SLIDES:
            # Two rows that its slip makes of three: see `coulomb_direction` and `convex_newton`.
            a, b = near[k + 1], near[k + 2]
            c, share = (w.mu[k], 1.0 / math.sqrt(1.0 + w.mu[k] * w.mu[k])) if coned else (0.0, 1.0)
            at = k * width
            for d in range(width):
                first, second = w.Y[at + width + d], w.Y[at + 2 * width + d]
                made[d] = share * (w.Y[at + d] - c * (a * first + b * second))
                made[width + d] = a * second - b * first
            add_row(w, k, n, made, 0, stiffness[k])
            if near[k] > 0.0:
                add_row(w, k, n, made, width, near[k])
            k += 3
            continue
        if w.mu[k] > 0.0 and w.of_a[k] == 6 and (w.of_b[k] == 6 or w.of_b[k] == 0):
            if w.state[k] == HOLDS:
                add_contact(w, k, n, (stiffness[k], stiffness[k + 1], stiffness[k + 2]))
            k += 3
            continue
        if w.state[k] == HOLDS:
            add_row(w, k, n, w.Y, k * width, stiffness[k])
        k += 1
