"""Products of an island's rows and mass matrices with vectors, in the order of the blocks.

Most rows are of contacts, three of each, between bodies of six dofs: these are written out, which takes a fraction of
the time that loops take.
"""

from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import load6, store
from urdfkit.sim.engine.simulation_memory import WIDTH


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
def row_speed(w: KernelWorld, k: int, x: Any) -> float:
    """Return J·x of a row, x in the order of the blocks."""
    at = k * w.sizes[WIDTH]
    first, size = w.at_a[k], w.of_a[k]
    total = 0.0
    for d in range(size):
        total += w.Y[at + d] * x[first + d]
    at += size
    first, size = w.at_b[k], w.of_b[k]
    for d in range(size):
        total += w.Y[at + d] * x[first + d]
    return total


@inlined
def contact_speeds(w: KernelWorld, k: int, x: Any) -> Any:
    """Return J·x of the three rows of a contact, x in the order of the blocks."""
    width = w.sizes[WIDTH]
    if w.of_a[k] == 6 and (w.of_b[k] == 6 or w.of_b[k] == 0):
        at, own = k * width, load_six(x, w.at_a[k])
        first, second = times_six(w.Y, at, own), times_six(w.Y, at + width, own)
        third = times_six(w.Y, at + 2 * width, own)
        if w.of_b[k] == 6:
            at, own = at + 6, load_six(x, w.at_b[k])
            first, second = first + times_six(w.Y, at, own), second + times_six(w.Y, at + width, own)
            third += times_six(w.Y, at + 2 * width, own)
        return first, second, third
    return row_speed(w, k, x), row_speed(w, k + 1, x), row_speed(w, k + 2, x)


@compiled
def row_speeds(w: KernelWorld, rows: int, x: Any, into: Any, start: int) -> None:
    """Write J·x of all rows, x in the order of the blocks, from `start` on."""
    k = 0
    while k < rows:
        if w.mu[k] > 0.0:
            into[start + k], into[start + k + 1], into[start + k + 2] = contact_speeds(w, k, x)
            k += 3
            continue
        into[start + k] = row_speed(w, k, x)
        k += 1


@inlined
def push_row(w: KernelWorld, k: int, c: float, x: Any) -> None:
    """Add c·Jᵀ of a row to x, in the order of the blocks."""
    at = k * w.sizes[WIDTH]
    first, size = w.at_a[k], w.of_a[k]
    for d in range(size):
        x[first + d] += c * w.Y[at + d]
    at += size
    first, size = w.at_b[k], w.of_b[k]
    for d in range(size):
        x[first + d] += c * w.Y[at + d]


@inlined
def push_six(Y: Any, at: int, width: int, a: float, b: float, c: float, x: Any, first: int) -> None:
    """Add what three rows exert to six numbers."""
    store(x, first, load6(x, first) + (a * load6(Y, at) + b * load6(Y, at + width) + c * load6(Y, at + 2 * width)))


@inlined
def add_impulse(w: KernelWorld, k: int, a: float, b: float, c: float, x: Any) -> None:
    """Do what `push_contact` does, as part of the caller."""
    width = w.sizes[WIDTH]
    of_a, of_b = w.of_a[k], w.of_b[k]
    if of_a == 6 and (of_b == 6 or of_b == 0):
        push_six(w.Y, k * width, width, a, b, c, x, w.at_a[k])
        if of_b == 6:
            push_six(w.Y, k * width + 6, width, a, b, c, x, w.at_b[k])
        return
    push_row(w, k, a, x)
    push_row(w, k + 1, b, x)
    push_row(w, k + 2, c, x)


@compiled
def push_contact(w: KernelWorld, k: int, a: float, b: float, c: float, x: Any) -> None:
    """Add the impulses of a contact's three rows to x, in the order of the blocks."""
    add_impulse(w, k, a, b, c, x)


@inlined
def take_momentum(w: KernelWorld, root: int, x: Any, into: Any) -> None:
    """Take M·x off `into`, both in the order of the blocks."""
    tree = root
    while tree >= 0:
        first, size = w.tree_dof[tree], w.tree_dof[tree + 1] - w.tree_dof[tree]
        at = w.block_first[w.tree_block[tree]]
        for k in range(size):
            row = w.dof_row[first + k] + first
            diagonal = w.L[row + k] * w.inverse_diagonal[first + k]
            total = diagonal * x[at + k]
            for j in range(k):
                total += w.L[row + j] * x[at + j]
            for j in range(k):
                into[at + j] -= w.L[row + j] * total
            into[at + k] -= diagonal * total
        tree = w.island_next[tree]
