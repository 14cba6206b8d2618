"""Contacts that slide, in velocity space: friction that follows the normal impulse, and turns with the slip.

A contact that slides along d, a unit vector in its tangents' coordinates, exerts x along its normal and -mu·x·d across
it. With the normal a stiff damper, as a row that holds, the matrix K of the blocks has besides a damper across d, as
friction turns with the slip, and it has -mu·D·dᵀ·n, which is not symmetric: a product of two vectors for each contact
that slides, of few. It is left out of the blocks and put right in each solution (the formula of Sherman, Morrison and
Woodbury).

In ``near_x`` stand the stiffness of the damper across d, at the normal's row, and d, at the tangents'.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.island_solver.block_matrix import substitute
from urdfkit.sim.engine.island_solver.jacobian_products import push_contact, row_speed
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.linear_systems import eliminate_and_solve
from urdfkit.sim.engine.math.simd import LANES, load16, padded, store
from urdfkit.sim.engine.simulation_memory import WIDTH
from urdfkit.sim.engine.solver.row_states import HOLDS, SLIDES

STIFFNESS = 1e6
"""Stiffness of a held row, over its effective mass."""


@compiled
def compute_row_stiffness(w: KernelWorld, root: int, rows: int) -> None:
    """Compute the stiffness of a row that holds from its effective mass, in ``row_stiffness``."""
    width = w.sizes[WIDTH]
    lightness = w.block_f
    tree = root
    while tree >= 0:
        first, at = w.tree_dof[tree], w.block_first[w.tree_block[tree]]
        for d in range(first, w.tree_dof[tree + 1]):
            lightness[at + d - first] = 1.0 / w.M[w.dof_row[d] + d]
        tree = w.island_next[tree]
    for k in range(rows):
        total, at, first = 0.0, k * width, w.at_a[k]
        for d in range(w.of_a[k]):
            total += w.Y[at + d] * w.Y[at + d] * lightness[first + d]
        at, first = at + w.of_a[k], w.at_b[k]
        for d in range(w.of_b[k]):
            total += w.Y[at + d] * w.Y[at + d] * lightness[first + d]
        w.row_stiffness[k] = STIFFNESS / total if total > 0.0 else 0.0


@inlined
def stiffen(w: KernelWorld, rows: int) -> None:
    """Give every row the stiffness of a held row."""
    stiffness = w.g
    for k in range(rows):
        stiffness[k] = w.row_stiffness[k]


@inlined
def slide(w: KernelWorld, k: int, first: float, second: float, speed: float, impulse: float) -> None:
    """Take a contact for sliding along a unit vector at a speed [m/s], with an impulse along its normal [N·s]."""
    stiffness = w.g
    w.state[k] = w.state[k + 1] = w.state[k + 2] = SLIDES
    most, friction = min(stiffness[k + 1], stiffness[k + 2]), w.mu[k] * max(0.0, impulse)
    w.near_x[k] = friction / speed if friction < most * speed else most
    w.near_x[k + 1], w.near_x[k + 2] = first, second


@inlined
def strike(w: KernelWorld, k: int, normal: float, first: float, second: float, inverse_mass: float) -> None:
    """Guess, from the velocities with which an open contact closes, whether it slides then.

    The inverse of the effective mass of its rows is about `inverse_mass` [1/kg].
    """
    speed = math.sqrt(first * first + second * second)
    left = speed + w.mu[k] * normal
    w.state[k] = w.state[k + 1] = w.state[k + 2] = HOLDS
    if left > 0.0:
        slide(w, k, first / speed, second / speed, left, -normal / inverse_mass if inverse_mass > 0.0 else 0.0)


@compiled
def follow(w: KernelWorld, rows: int, n: int) -> int:
    """Solve for what friction along the slips does; return how many contacts slide.

    Afterwards A has room for a matrix of the contacts that slide, that matrix, and the solutions.
    """
    stiffness, column = w.g, w.block_f
    sliding = 0
    for k in range(rows):
        if w.state[k] == SLIDES and w.mu[k] > 0.0:
            w.index[sliding] = k
            sliding += 1
    # As `eliminate_and_solve` has it.
    width = padded(sliding + 1)
    at = 2 * sliding * width
    for j in range(sliding):
        k = w.index[j]
        for d in range(n):
            column[d] = 0.0
        c = -w.mu[k] * stiffness[k]
        push_contact(w, k, 0.0, c * w.near_x[k + 1], c * w.near_x[k + 2], column)
        substitute(w, n, column)
        for d in range(n):
            w.A[at + d] = column[d]
        at += n
        for i in range(sliding):
            w.A[(sliding + i) * width + j] = row_speed(w, w.index[i], column)
        w.A[(sliding + j) * width + j] += 1.0
    return sliding


@compiled
def substitute_all(w: KernelWorld, n: int, sliding: int, x: Any) -> bool:
    """Turn x into K⁻¹·x, K with what friction along the slips does; return whether there is such a solution."""
    substitute(w, n, x)
    if sliding == 0:
        return True
    share = w.velocity
    for i in range(sliding):
        share[i] = row_speed(w, w.index[i], x)
    size = sliding * padded(sliding + 1)
    for i in range(0, size, LANES):
        store(w.A, i, load16(w.A, size + i))
    if not eliminate_and_solve(sliding, w.A, share):
        return False
    at = 2 * size
    for j in range(sliding):
        for d in range(n):
            x[d] -= w.A[at + d] * share[j]
        at += n
    return True
