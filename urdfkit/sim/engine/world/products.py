"""Products of an island's rows and mass matrices with vectors, in the order of the blocks."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import field, inlined


@inlined
def row_speed(floats: Any, integers: Any, k: int, x: Any) -> float:
    """Return J·x of a row, x in the order of the blocks."""
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    block_first = field(integers, integers, At.block_first)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    at = k * integers[WIDTH]
    tree = row_a[k]
    first, size = block_first[tree_block[tree]], tree_dof[tree + 1] - tree_dof[tree]
    total = 0.0
    for d in range(size):
        total += Y[at + d] * x[first + d]
    tree = row_b[k]
    if tree >= 0:
        at += size
        first = block_first[tree_block[tree]]
        for d in range(tree_dof[tree + 1] - tree_dof[tree]):
            total += Y[at + d] * x[first + d]
    return total


@inlined
def push_row(floats: Any, integers: Any, k: int, c: float, x: Any) -> None:
    """Add c·Jᵀ of a row to x, in the order of the blocks."""
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    block_first = field(integers, integers, At.block_first)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    at = k * integers[WIDTH]
    tree = row_a[k]
    first, size = block_first[tree_block[tree]], tree_dof[tree + 1] - tree_dof[tree]
    for d in range(size):
        x[first + d] += c * Y[at + d]
    tree = row_b[k]
    if tree >= 0:
        at += size
        first = block_first[tree_block[tree]]
        for d in range(tree_dof[tree + 1] - tree_dof[tree]):
            x[first + d] += c * Y[at + d]


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
