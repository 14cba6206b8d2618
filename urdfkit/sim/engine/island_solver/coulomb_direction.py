"""Contacts that slide, in velocity space: friction that follows the normal impulse, and turns with the slip.

A contact that slides along d, a unit vector in its tangents' coordinates, exerts x along its normal and -mu·x·d across
it. With the normal a stiff damper, as a row that holds, the matrix K of the blocks has besides a damper across d, as
friction turns with the slip, and it has -mu·D·dᵀ·n, which is not symmetric: a product of two vectors for each contact
that slides, of few. It is left out of the blocks and put right in each solution (the formula of Sherman, Morrison and
Woodbury).

In ``near_x`` stand the stiffness of the damper across d, at the normal's row, and d, at the tangents'.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.island_solver.block_matrix import substitute
from urdfkit.sim.engine.island_solver.block_products import push_contact, row_speed
from urdfkit.sim.engine.math.linear_systems import eliminate_and_solve
from urdfkit.sim.engine.solver.row_states import HOLDS, SLIDES

STIFFNESS = 1e6
"""Stiffness of a row that holds, over the inverse of what it feels of the masses."""


@compiled
def feel(floats: Any, integers: Any, root: int, rows: int) -> None:
    """Find, from what every row feels of the masses, the stiffness of one that holds, in ``felt``."""
    width = integers[WIDTH]
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    island_next = field(integers, integers, At.island_next)
    block_first = field(integers, integers, At.block_first)
    dof_row = field(integers, integers, At.dof_row)
    at_a = field(integers, integers, At.at_a)
    at_b = field(integers, integers, At.at_b)
    of_a = field(integers, integers, At.of_a)
    of_b = field(integers, integers, At.of_b)
    Y = field(floats, integers, At.Y)
    M = field(floats, integers, At.M)
    lightness = field(floats, integers, At.block_f)
    felt = field(floats, integers, At.felt)
    tree = root
    while tree >= 0:
        first, at = tree_dof[tree], block_first[tree_block[tree]]
        for d in range(first, tree_dof[tree + 1]):
            lightness[at + d - first] = 1.0 / M[dof_row[d] + d]
        tree = island_next[tree]
    for k in range(rows):
        total, at, first = 0.0, k * width, at_a[k]
        for d in range(of_a[k]):
            total += Y[at + d] * Y[at + d] * lightness[first + d]
        at, first = at + of_a[k], at_b[k]
        for d in range(of_b[k]):
            total += Y[at + d] * Y[at + d] * lightness[first + d]
        felt[k] = STIFFNESS / total if total > 0.0 else 0.0


@inlined
def stiffen(floats: Any, integers: Any, rows: int) -> None:
    """Give every row the stiffness of one that holds."""
    felt = field(floats, integers, At.felt)
    stiffness = field(floats, integers, At.g)
    for k in range(rows):
        stiffness[k] = felt[k]


@inlined
def slide(floats: Any, integers: Any, k: int, first: float, second: float, speed: float, impulse: float) -> None:
    """Take a contact for sliding along a unit vector at a speed [m/s], with an impulse along its normal [N·s]."""
    mu = field(floats, integers, At.mu)
    stiffness = field(floats, integers, At.g)
    near = field(floats, integers, At.near_x)
    state = field(integers, integers, At.state)
    state[k] = state[k + 1] = state[k + 2] = SLIDES
    most, friction = min(stiffness[k + 1], stiffness[k + 2]), mu[k] * max(0.0, impulse)
    near[k] = friction / speed if friction < most * speed else most
    near[k + 1], near[k + 2] = first, second


@inlined
def strike(floats: Any, integers: Any, k: int, normal: float, first: float, second: float, felt: float) -> None:
    """Guess, from the velocities with which an open contact closes, whether it slides then.

    What a row of it feels of the masses is about `felt` [1/kg].
    """
    mu = field(floats, integers, At.mu)
    state = field(integers, integers, At.state)
    speed = math.sqrt(first * first + second * second)
    left = speed + mu[k] * normal
    state[k] = state[k + 1] = state[k + 2] = HOLDS
    if left > 0.0:
        slide(floats, integers, k, first / speed, second / speed, left, -normal / felt if felt > 0.0 else 0.0)


@compiled
def follow(floats: Any, integers: Any, rows: int, n: int) -> int:
    """Solve for what friction along the slips does; return how many contacts slide.

    Afterwards A has room for a matrix of the contacts that slide, that matrix, and the solutions.
    """
    index = field(integers, integers, At.index)
    state = field(integers, integers, At.state)
    mu = field(floats, integers, At.mu)
    near = field(floats, integers, At.near_x)
    stiffness = field(floats, integers, At.g)
    A = field(floats, integers, At.A)
    column = field(floats, integers, At.block_f)
    sliding = 0
    for k in range(rows):
        if state[k] == SLIDES and mu[k] > 0.0:
            index[sliding] = k
            sliding += 1
    at = 2 * sliding * sliding
    for j in range(sliding):
        k = index[j]
        for d in range(n):
            column[d] = 0.0
        c = -mu[k] * stiffness[k]
        push_contact(floats, integers, k, 0.0, c * near[k + 1], c * near[k + 2], column)
        substitute(floats, integers, n, column)
        for d in range(n):
            A[at + d] = column[d]
        at += n
        for i in range(sliding):
            A[(sliding + i) * sliding + j] = row_speed(floats, integers, index[i], column)
        A[(sliding + j) * sliding + j] += 1.0
    return sliding


@compiled
def substitute_all(floats: Any, integers: Any, n: int, sliding: int, x: Any) -> bool:
    """Turn x into K⁻¹·x, K with what friction along the slips does; return whether there is such a solution."""
    substitute(floats, integers, n, x)
    if sliding == 0:
        return True
    index = field(integers, integers, At.index)
    A = field(floats, integers, At.A)
    share = field(floats, integers, At.velocity)
    for i in range(sliding):
        share[i] = row_speed(floats, integers, index[i], x)
    for i in range(sliding * sliding):
        A[i] = A[sliding * sliding + i]
    if not eliminate_and_solve(sliding, A, share):
        return False
    at = 2 * sliding * sliding
    for j in range(sliding):
        for d in range(n):
            x[d] -= A[at + d] * share[j]
        at += n
    return True
