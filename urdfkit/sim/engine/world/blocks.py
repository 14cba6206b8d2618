"""The matrix M + Jᵀ·D·J of an island in blocks, one for each tree and for each pair of trees with a row between them.

It is factored in the order in which the fewest blocks fill in, the minimum degree, after D. J. Rose, Graph Theory and
Computing, 1972.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.guess import HOLDS, SLIDES

MOST_TREES = 62
"""Most trees of an island: as many as a number has bits."""


@inlined
def bits(mask: int) -> int:
    """Return how many bits are set."""
    count = 0
    while mask != 0:
        mask &= mask - 1
        count += 1
    return count


@compiled
def arrange(floats: Any, integers: Any, root: int, rows: int) -> int:
    """Order the trees of an island for elimination; return how many dofs they have, 0 if there are too many trees.

    Afterwards ``block_tree`` lists the trees in order, ``tree_block`` their places in it, ``block_first`` where their
    dofs start, and ``block_after`` those after each that it shares a block with, as bits.
    """
    tree_dof = field(integers, integers, At.tree_dof)
    island_next = field(integers, integers, At.island_next)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    block_tree = field(integers, integers, At.block_tree)
    tree_block = field(integers, integers, At.tree_block)
    block_first = field(integers, integers, At.block_first)
    block_after = field(integers, integers, At.block_after)
    count = 0
    tree = root
    while tree >= 0:
        if count == MOST_TREES:
            return 0
        block_tree[count], tree_block[tree], block_after[count] = tree, count, 0
        count += 1
        tree = island_next[tree]
    one = 1
    for k in range(rows):
        if row_b[k] >= 0:
            a, b = tree_block[row_a[k]], tree_block[row_b[k]]
            block_after[a] |= one << b
            block_after[b] |= one << a
    # Of those left, the one with the fewest neighbours goes next, and its neighbours become each other's.
    first = 0
    for k in range(count):
        best, fewest = k, MOST_TREES + 1
        for j in range(k, count):
            degree = bits(block_after[j])
            if degree < fewest:
                best, fewest = j, degree
        if best != k:
            # They exchange places, and so do their bits.
            block_tree[k], block_tree[best] = block_tree[best], block_tree[k]
            block_after[k], block_after[best] = block_after[best], block_after[k]
            for j in range(count):
                mask = block_after[j]
                differ = ((mask >> k) ^ (mask >> best)) & one
                block_after[j] = mask ^ ((differ << k) | (differ << best))
        mask = block_after[k]
        for j in range(k + 1, count):
            if (mask >> j) & one:
                block_after[j] = (block_after[j] | mask) & ~((one << j) | (one << k))
        tree = block_tree[k]
        tree_block[tree] = k
        block_first[k] = first
        first += tree_dof[tree + 1] - tree_dof[tree]
    block_first[count] = first
    return first


@inlined
def add_six(into: Any, at: int, c: float, b: Any) -> None:
    """Add c·b to six numbers."""
    r0, r1, r2 = into[at] + c * b[0], into[at + 1] + c * b[1], into[at + 2] + c * b[2]
    r3, r4, r5 = into[at + 3] + c * b[3], into[at + 4] + c * b[4], into[at + 5] + c * b[5]
    into[at], into[at + 1], into[at + 2] = r0, r1, r2
    into[at + 3], into[at + 4], into[at + 5] = r3, r4, r5


@inlined
def add_block(K: Any, n: int, i: int, j: int, ni: int, nj: int, Y: Any, at: int, to: int, d: float) -> None:
    """Add d·aᵀ·b to a block of K, a and b parts of a row."""
    if nj == 6:
        b = (Y[to], Y[to + 1], Y[to + 2], Y[to + 3], Y[to + 4], Y[to + 5])
        for k in range(ni):
            add_six(K, (i + k) * n + j, d * Y[at + k], b)
        return
    for k in range(ni):
        c = d * Y[at + k]
        if c != 0.0:
            for m in range(nj):
                K[(i + k) * n + j + m] += c * Y[to + m]


@inlined
def add_row(floats: Any, integers: Any, k: int, n: int, Y: Any, at: int, d: float) -> None:
    """Add d·aᵀ·a to K, a written at a place of Y, of the trees of row k."""
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    block_first = field(integers, integers, At.block_first)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    K = field(floats, integers, At.B)
    a, b = row_a[k], row_b[k]
    i, ni = block_first[tree_block[a]], tree_dof[a + 1] - tree_dof[a]
    add_block(K, n, i, i, ni, ni, Y, at, at, d)
    if b >= 0:
        j, nj = block_first[tree_block[b]], tree_dof[b + 1] - tree_dof[b]
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
            # Two rows that its slip makes of three: see `slip` and `cones`.
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
        if state[k] == HOLDS:
            add_row(floats, integers, k, n, Y, k * width, stiffness[k])
        k += 1


@inlined
def take_six(K: Any, n: int, i: int, first: int, beyond: int, start: int) -> None:
    """Take off six numbers of row i what the eliminated rows have there."""
    at = i * n + start
    r0, r1, r2, r3, r4, r5 = K[at], K[at + 1], K[at + 2], K[at + 3], K[at + 4], K[at + 5]
    for d in range(first, beyond):
        c, to = K[d * n + i], d * n + start
        r0, r1, r2 = r0 - c * K[to], r1 - c * K[to + 1], r2 - c * K[to + 2]
        r3, r4, r5 = r3 - c * K[to + 3], r4 - c * K[to + 4], r5 - c * K[to + 5]
    K[at], K[at + 1], K[at + 2], K[at + 3], K[at + 4], K[at + 5] = r0, r1, r2, r3, r4, r5


@compiled
def eliminate(floats: Any, integers: Any, n: int) -> bool:
    """Factor K = UᵀU in B block by block, its diagonal inverted; return whether it was positive."""
    block_first = field(integers, integers, At.block_first)
    block_after = field(integers, integers, At.block_after)
    K = field(floats, integers, At.B)
    one = 1
    k = 0
    while block_first[k] < n:
        first, beyond, mask = block_first[k], block_first[k + 1], block_after[k]
        for d in range(first, beyond):
            pivot = K[d * n + d]
            if not pivot > 0.0:
                return False
            inverse = 1.0 / math.sqrt(pivot)
            K[d * n + d] = inverse
            for j in range(d + 1, beyond):
                K[d * n + j] *= inverse
            for i in range(d + 1, beyond):
                c = K[d * n + i]
                for j in range(i, beyond):
                    K[i * n + j] -= c * K[d * n + j]
            left, b = mask, k
            while left != 0:
                b += 1
                while not (mask >> b) & one:
                    b += 1
                left &= left - 1
                start, size = block_first[b], block_first[b + 1] - block_first[b]
                if size == 6:
                    at = d * n + start
                    own = (
                        K[at] * inverse,
                        K[at + 1] * inverse,
                        K[at + 2] * inverse,
                        K[at + 3] * inverse,
                        K[at + 4] * inverse,
                        K[at + 5] * inverse,
                    )
                    K[at], K[at + 1], K[at + 2], K[at + 3], K[at + 4], K[at + 5] = own
                    for i in range(d + 1, beyond):
                        add_six(K, i * n + start, -K[d * n + i], own)
                    continue
                for j in range(start, start + size):
                    K[d * n + j] *= inverse
                for i in range(d + 1, beyond):
                    c = K[d * n + i]
                    for j in range(start, start + size):
                        K[i * n + j] -= c * K[d * n + j]
        left, b = mask, k
        while left != 0:
            b += 1
            while not (mask >> b) & one:
                b += 1
            rest = left
            left &= left - 1
            e = b - 1
            while rest != 0:
                e += 1
                while not (mask >> e) & one:
                    e += 1
                rest &= rest - 1
                start, size = block_first[e], block_first[e + 1] - block_first[e]
                for i in range(block_first[b], block_first[b + 1]):
                    if size == 6:
                        take_six(K, n, i, first, beyond, start)
                        continue
                    for d in range(first, beyond):
                        c = K[d * n + i]
                        for j in range(start, start + size):
                            K[i * n + j] -= c * K[d * n + j]
        k += 1
    return True


@compiled
def substitute(floats: Any, integers: Any, n: int, x: Any) -> None:
    """Turn x into K⁻¹·x."""
    block_first = field(integers, integers, At.block_first)
    block_after = field(integers, integers, At.block_after)
    K = field(floats, integers, At.B)
    one = 1
    k = 0
    while block_first[k] < n:
        first, beyond, mask = block_first[k], block_first[k + 1], block_after[k]
        for d in range(first, beyond):
            c = x[d] * K[d * n + d]
            x[d] = c
            for j in range(d + 1, beyond):
                x[j] -= c * K[d * n + j]
            left, b = mask, k
            while left != 0:
                b += 1
                while not (mask >> b) & one:
                    b += 1
                left &= left - 1
                for j in range(block_first[b], block_first[b + 1]):
                    x[j] -= c * K[d * n + j]
        k += 1
    while k > 0:
        k -= 1
        first, beyond, mask = block_first[k], block_first[k + 1], block_after[k]
        for d in range(beyond - 1, first - 1, -1):
            c = x[d]
            for j in range(d + 1, beyond):
                c -= K[d * n + j] * x[j]
            left, b = mask, k
            while left != 0:
                b += 1
                while not (mask >> b) & one:
                    b += 1
                left &= left - 1
                for j in range(block_first[b], block_first[b + 1]):
                    c -= K[d * n + j] * x[j]
            x[d] = c * K[d * n + d]
