"""Products of an island's rows and mass matrices with vectors, in the order of the blocks.

Most rows are of contacts, three of each, between bodies of six dofs: these are written out, which takes a fraction of
the time that loops take.
"""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.math.simd import load6, store


@inlined
def load_six(x: Any, at: int) -> Any:
    """Return six numbers."""
    return x[at], x[at + 1], x[at + 2], x[at + 3], x[at + 4], x[at + 5]


@inlined
def times_six(Y: Any, at: int, x: Any) -> float:
    """Return the product of six entries of a row with six numbers."""
    half = Y[at] * x[0] + Y[at + 1] * x[1] + Y[at + 2] * x[2]
    return float(half + (Y[at + 3] * x[3] + Y[at + 4] * x[4] + Y[at + 5] * x[5]))


@inlined
def row_speed(floats: Any, integers: Any, k: int, x: Any) -> float:
    """Return J·x of a row, x in the order of the blocks."""
    Y = field(floats, integers, At.Y)
    at = k * integers[WIDTH]
    first, size = field(integers, integers, At.at_a)[k], field(integers, integers, At.of_a)[k]
    total = 0.0
    for d in range(size):
        total += Y[at + d] * x[first + d]
    at += size
    first, size = field(integers, integers, At.at_b)[k], field(integers, integers, At.of_b)[k]
    for d in range(size):
        total += Y[at + d] * x[first + d]
    return total


@compiled
def row_speeds(floats: Any, integers: Any, rows: int, x: Any, into: Any, start: int) -> None:
    """Write J·x of all rows, x in the order of the blocks, from `start` on."""
    width = integers[WIDTH]
    at_a = field(integers, integers, At.at_a)
    at_b = field(integers, integers, At.at_b)
    of_a = field(integers, integers, At.of_a)
    of_b = field(integers, integers, At.of_b)
    mu = field(floats, integers, At.mu)
    Y = field(floats, integers, At.Y)
    k = 0
    while k < rows:
        if mu[k] > 0.0 and of_a[k] == 6 and (of_b[k] == 6 or of_b[k] == 0):
            at, own = k * width, load_six(x, at_a[k])
            first, second = times_six(Y, at, own), times_six(Y, at + width, own)
            third = times_six(Y, at + 2 * width, own)
            if of_b[k] == 6:
                at, own = at + 6, load_six(x, at_b[k])
                first, second = first + times_six(Y, at, own), second + times_six(Y, at + width, own)
                third += times_six(Y, at + 2 * width, own)
            into[start + k], into[start + k + 1], into[start + k + 2] = first, second, third
            k += 3
            continue
        into[start + k] = row_speed(floats, integers, k, x)
        k += 1


@inlined
def push_row(floats: Any, integers: Any, k: int, c: float, x: Any) -> None:
    """Add c·Jᵀ of a row to x, in the order of the blocks."""
    Y = field(floats, integers, At.Y)
    at = k * integers[WIDTH]
    first, size = field(integers, integers, At.at_a)[k], field(integers, integers, At.of_a)[k]
    for d in range(size):
        x[first + d] += c * Y[at + d]
    at += size
    first, size = field(integers, integers, At.at_b)[k], field(integers, integers, At.of_b)[k]
    for d in range(size):
        x[first + d] += c * Y[at + d]


@inlined
def push_six(Y: Any, at: int, width: int, a: float, b: float, c: float, x: Any, first: int) -> None:
    """Add what three rows exert to six numbers."""
    store(x, first, load6(x, first) + (a * load6(Y, at) + b * load6(Y, at + width) + c * load6(Y, at + 2 * width)))


@compiled
def push_contact(floats: Any, integers: Any, k: int, a: float, b: float, c: float, x: Any) -> None:
    """Add what the three rows of a contact exert to x, in the order of the blocks."""
    width = integers[WIDTH]
    of_a, of_b = field(integers, integers, At.of_a)[k], field(integers, integers, At.of_b)[k]
    Y = field(floats, integers, At.Y)
    if of_a == 6 and (of_b == 6 or of_b == 0):
        push_six(Y, k * width, width, a, b, c, x, field(integers, integers, At.at_a)[k])
        if of_b == 6:
            push_six(Y, k * width + 6, width, a, b, c, x, field(integers, integers, At.at_b)[k])
        return
    push_row(floats, integers, k, a, x)
    push_row(floats, integers, k + 1, b, x)
    push_row(floats, integers, k + 2, c, x)


@inlined
def take_momentum(floats: Any, integers: Any, root: int, x: Any, into: Any) -> None:
    """Take M·x off `into`, both in the order of the blocks."""
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    island_next = field(integers, integers, At.island_next)
    block_first = field(integers, integers, At.block_first)
    dof_row = field(integers, integers, At.dof_row)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    tree = root
    while tree >= 0:
        first, size = tree_dof[tree], tree_dof[tree + 1] - tree_dof[tree]
        at = block_first[tree_block[tree]]
        for k in range(size):
            row = dof_row[first + k] + first
            diagonal = L[row + k] * inverse_diagonal[first + k]
            total = diagonal * x[at + k]
            for j in range(k):
                total += L[row + j] * x[at + j]
            for j in range(k):
                into[at + j] -= L[row + j] * total
            into[at + k] -= diagonal * total
        tree = island_next[tree]
