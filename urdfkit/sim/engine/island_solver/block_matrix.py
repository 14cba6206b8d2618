"""The matrix M + Jᵀ·D·J of an island in blocks, one for each tree and for each pair of trees with a row between them.

It is factored in the order in which the fewest blocks fill in, the minimum degree, after D. J. Rose, Graph Theory and
Computing, 1972.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.island_solver.jacobian_products import load_six, times_six
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import load6, store
from urdfkit.sim.engine.simulation_memory import BLOCK_WORDS as WORDS
from urdfkit.sim.engine.simulation_memory import MATRIX

MOST_TREES = 32 * WORDS
"""Most trees of an island."""


@inlined
def bits(word: int) -> int:
    """Return how many of 32 bits are set, by sums of pairs, of fours and of bytes."""
    word -= (word >> 1) & 0x55555555
    word = (word & 0x33333333) + ((word >> 2) & 0x33333333)
    return (((word + (word >> 4)) & 0x0F0F0F0F) * 0x01010101 >> 24) & 0xFF


@inlined
def is_neighbour(after: Any, k: int, b: int) -> bool:
    """Return whether the bit of tree b is set for tree k."""
    return bool((after[WORDS * k + (b >> 5)] >> (b & 31)) & 1)


@inlined
def flip(after: Any, k: int, b: int) -> None:
    """Change the bit of tree b for tree k."""
    after[WORDS * k + (b >> 5)] ^= 1 << (b & 31)


@inlined
def degree(after: Any, k: int, words: int) -> int:
    """Return with how many trees tree k shares a block."""
    total = 0
    for i in range(words):
        total += bits(after[WORDS * k + i])
    return total


@inlined
def list_neighbours(w: KernelWorld, count: int) -> None:
    """List the trees after each tree that it shares a block with in ``block_near``, from its ``first_near`` on."""
    found = 0
    for k in range(count):
        w.first_near[k] = found
        for b in range(k + 1, count):
            if is_neighbour(w.block_after, k, b):
                w.block_near[found] = b
                found += 1
    w.first_near[count] = found


@inlined
def place_rows(w: KernelWorld, rows: int) -> None:
    """Write where the dofs of a row's trees start in the order of the blocks, and how many these are."""
    for k in range(rows):
        a, b = w.row_a[k], w.row_b[k]
        w.at_a[k], w.of_a[k] = w.block_first[w.tree_block[a]], w.tree_dof[a + 1] - w.tree_dof[a]
        w.at_b[k] = w.of_b[k] = 0
        if b >= 0:
            w.at_b[k], w.of_b[k] = w.block_first[w.tree_block[b]], w.tree_dof[b + 1] - w.tree_dof[b]


@compiled
def arrange(w: KernelWorld, root: int, rows: int) -> int:
    """Order the trees of an island for elimination; return how many dofs they have, 0 if there are too many.

    Afterwards ``block_tree`` lists the trees in order, ``tree_block`` their places in it, ``block_first`` where their
    dofs start, and ``block_near`` those after each that it shares a block with, see `list_neighbours`. For each
    row ``at_a`` and ``at_b`` are where the dofs of its trees start, ``of_a`` and ``of_b`` how many these are: none
    where there is but one tree.
    """
    after, degrees = w.block_after, w.block_near
    count = 0
    tree = root
    while tree >= 0:
        if count == MOST_TREES:
            return 0
        w.block_tree[count], w.tree_block[tree] = tree, count
        count += 1
        tree = w.island_next[tree]
    words = (count + 31) >> 5
    for k in range(WORDS * count):
        after[k] = 0
    for k in range(rows):
        if w.row_b[k] >= 0:
            a, b = w.tree_block[w.row_a[k]], w.tree_block[w.row_b[k]]
            if not is_neighbour(after, a, b):
                flip(after, a, b)
                flip(after, b, a)
    for k in range(count):
        degrees[k] = degree(after, k, words)
    # Of those left, the one with the fewest neighbours goes next, and its neighbours become each other's.
    first = 0
    for k in range(count):
        best = k
        for j in range(k + 1, count):
            if degrees[j] < degrees[best]:
                best = j
        if best != k:
            # They exchange places, and so do their bits.
            w.block_tree[k], w.block_tree[best] = w.block_tree[best], w.block_tree[k]
            degrees[k], degrees[best] = degrees[best], degrees[k]
            for i in range(words):
                here, there = WORDS * k + i, WORDS * best + i
                after[here], after[there] = after[there], after[here]
            for j in range(count):
                if is_neighbour(after, j, k) != is_neighbour(after, j, best):
                    flip(after, j, k)
                    flip(after, j, best)
        for j in range(k + 1, count):
            if is_neighbour(after, k, j):
                for i in range(words):
                    after[WORDS * j + i] |= after[WORDS * k + i]
                flip(after, j, j)
                flip(after, j, k)
                degrees[j] = degree(after, j, words)
        tree = w.block_tree[k]
        w.tree_block[tree] = k
        w.block_first[k] = first
        first += w.tree_dof[tree + 1] - w.tree_dof[tree]
    w.block_first[count] = first
    if first * first > w.sizes[MATRIX]:
        return 0
    place_rows(w, rows)
    list_neighbours(w, count)
    return first


@inlined
def take_six(K: Any, n: int, i: int, first: int, start: int) -> None:
    """Take off six numbers of row i what six eliminated rows have there."""
    here, at, to = i * n + start, first * n + i, first * n + start
    rest = load6(K, here) - K[at] * load6(K, to) - K[at + n] * load6(K, to + n) - K[at + 2 * n] * load6(K, to + 2 * n)
    at, to = at + 3 * n, to + 3 * n
    store(K, here, rest - K[at] * load6(K, to) - K[at + n] * load6(K, to + n) - K[at + 2 * n] * load6(K, to + 2 * n))


@compiled
def eliminate(w: KernelWorld, n: int) -> bool:
    """Factor K = UᵀU in B block by block, its diagonal inverted; return whether it was positive."""
    block_first, K = w.block_first, w.B
    k = 0
    while block_first[k] < n:
        first, beyond = block_first[k], block_first[k + 1]
        near, beyond_near = w.first_near[k], w.first_near[k + 1]
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
            for at in range(near, beyond_near):
                b = w.block_near[at]
                start, size = block_first[b], block_first[b + 1] - block_first[b]
                if size == 6:
                    own = inverse * load6(K, d * n + start)
                    store(K, d * n + start, own)
                    for i in range(d + 1, beyond):
                        here = i * n + start
                        store(K, here, load6(K, here) - K[d * n + i] * own)
                    continue
                for j in range(start, start + size):
                    K[d * n + j] *= inverse
                for i in range(d + 1, beyond):
                    c = K[d * n + i]
                    for j in range(start, start + size):
                        K[i * n + j] -= c * K[d * n + j]
        for at in range(near, beyond_near):
            b = w.block_near[at]
            for to in range(at, beyond_near):
                e = w.block_near[to]
                start, size = block_first[e], block_first[e + 1] - block_first[e]
                for i in range(block_first[b], block_first[b + 1]):
                    if size == 6 and beyond - first == 6:
                        take_six(K, n, i, first, start)
                        continue
                    for d in range(first, beyond):
                        c = K[d * n + i]
                        for j in range(start, start + size):
                            K[i * n + j] -= c * K[d * n + j]
        k += 1
    return True


@inlined
def forward_six(K: Any, n: int, d: int, x: Any) -> Any:
    """Return x, from d on, after forward substitution with a block of six."""
    at = d * n + d
    a = x[d] * K[at]
    b = (x[d + 1] - a * K[at + 1]) * K[at + n + 1]
    c = (x[d + 2] - a * K[at + 2] - b * K[at + n + 2]) * K[at + 2 * n + 2]
    at, to = at + 3, at + 2 * n + 3
    e = (x[d + 3] - a * K[at] - b * K[at + n] - c * K[to]) * K[to + n]
    f = (x[d + 4] - a * K[at + 1] - b * K[at + n + 1] - c * K[to + 1] - e * K[to + n + 1]) * K[to + 2 * n + 1]
    g = x[d + 5] - a * K[at + 2] - b * K[at + n + 2] - c * K[to + 2] - e * K[to + n + 2] - f * K[to + 2 * n + 2]
    return a, b, c, e, f, g * K[to + 3 * n + 2]


@inlined
def backward_six(K: Any, n: int, d: int, x: Any) -> None:
    """Apply back substitution with a block of six, from d on."""
    at = d * n + d
    to = at + 3 * n + 3
    g = x[d + 5] * K[to + 2 * n + 2]
    f = (x[d + 4] - K[to + n + 2] * g) * K[to + n + 1]
    e = (x[d + 3] - K[to + 1] * f - K[to + 2] * g) * K[to]
    to = at + 2 * n + 2
    c = (x[d + 2] - K[to + 1] * e - K[to + 2] * f - K[to + 3] * g) * K[to]
    to = at + n + 1
    b = (x[d + 1] - K[to + 1] * c - K[to + 2] * e - K[to + 3] * f - K[to + 4] * g) * K[to]
    a = x[d] - K[at + 1] * b - K[at + 2] * c - K[at + 3] * e - K[at + 4] * f - K[at + 5] * g
    x[d], x[d + 1], x[d + 2], x[d + 3], x[d + 4], x[d + 5] = a * K[at], b, c, e, f, g


@inlined
def take_product(K: Any, at: int, start: int, n: int, x: Any, d: int) -> None:
    """Subtract the product of a 6 x 6 block at a place of K and x from `start` on, from x from d on."""
    own = load_six(x, start)
    for k in range(6):
        x[d + k] -= times_six(K, at + k * n, own)


@compiled
def substitute(w: KernelWorld, n: int, x: Any) -> None:
    """Turn x into K⁻¹·x."""
    block_first, K = w.block_first, w.B
    k = 0
    while block_first[k] < n:
        first, beyond = block_first[k], block_first[k + 1]
        sixes = beyond - first == 6
        moves = False
        for d in range(first, beyond):
            moves = moves or x[d] != 0.0
        if not moves:
            k += 1
            continue
        if sixes:
            a, c, e, f, g, h = forward_six(K, n, first, x)
            x[first], x[first + 1], x[first + 2] = a, c, e
            x[first + 3], x[first + 4], x[first + 5] = f, g, h
        else:
            for d in range(first, beyond):
                c = x[d] * K[d * n + d]
                x[d] = c
                for j in range(d + 1, beyond):
                    x[j] -= c * K[d * n + j]
        for i in range(w.first_near[k], w.first_near[k + 1]):
            b = w.block_near[i]
            start, size = block_first[b], block_first[b + 1] - block_first[b]
            if sixes and size == 6:
                at = first * n + start
                rest = load6(x, start) - x[first] * load6(K, at) - x[first + 1] * load6(K, at + n)
                rest = rest - x[first + 2] * load6(K, at + 2 * n) - x[first + 3] * load6(K, at + 3 * n)
                store(x, start, rest - x[first + 4] * load6(K, at + 4 * n) - x[first + 5] * load6(K, at + 5 * n))
                continue
            for d in range(first, beyond):
                for j in range(start, start + size):
                    x[j] -= x[d] * K[d * n + j]
        k += 1
    while k > 0:
        k -= 1
        first, beyond = block_first[k], block_first[k + 1]
        sixes = beyond - first == 6
        for i in range(w.first_near[k], w.first_near[k + 1]):
            b = w.block_near[i]
            start, size = block_first[b], block_first[b + 1] - block_first[b]
            if sixes and size == 6:
                take_product(K, first * n + start, start, n, x, first)
                continue
            for d in range(first, beyond):
                for j in range(start, start + size):
                    x[d] -= K[d * n + j] * x[j]
        if sixes:
            backward_six(K, n, first, x)
            continue
        for d in range(beyond - 1, first - 1, -1):
            c = x[d]
            for j in range(d + 1, beyond):
                c -= K[d * n + j] * x[j]
            x[d] = c * K[d * n + d]
