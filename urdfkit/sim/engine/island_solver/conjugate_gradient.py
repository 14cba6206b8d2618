"""Conjugate gradients for sweeps: after each pair of sweeps, impulses change further along the directions so far.

What a pair of sweeps changes of the impulses is taken for the negative gradient of the energy that the law minimises.
The share of the last direction in the next is the ratio of the squares of two gradients (Fletcher and Reeves); where
that is no less than 1, as where contacts begin or cease to slide, directions begin again with the gradient. Impulses
that this takes out of their cones are put right by the next sweep.

Source: M. Silcowitz-Hansen, S. Niebe, K. Erleben, The Visual Computer 26 (2010) 893-901.
"""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import compiled, field

KEPT = 9
"""Numbers kept in A of a contact: the inverse of what its rows feel of the masses, and of what single rows feel."""


@compiled
def note(floats: Any, integers: Any, root: int, rows: int) -> None:
    """Keep the impulses and what they do to the trees as they are before a pair of sweeps."""
    x = field(floats, integers, At.x)
    u = field(floats, integers, At.u)
    x_before = field(floats, integers, At.near_x)
    u_before = field(floats, integers, At.sum_s)
    tree_dof = field(integers, integers, At.tree_dof)
    island_next = field(integers, integers, At.island_next)
    for k in range(rows):
        x_before[k] = x[k]
    tree = root
    while tree >= 0:
        for d in range(tree_dof[tree], tree_dof[tree + 1]):
            u_before[d] = u[d]
        tree = island_next[tree]


@compiled
def size_of_change(floats: Any, integers: Any, rows: int) -> float:
    """Return the square of what a pair of sweeps changed of the impulses, by what each row feels of the masses."""
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    x_before = field(floats, integers, At.near_x)
    A = field(floats, integers, At.A)
    total = 0.0
    k = 0
    while k < rows:
        change = x[k] - x_before[k]
        at = KEPT * k // 3
        if mu[k] > 0.0:
            total += change * change / A[at + 6]
            if A[at + 7] > 0.0:
                first, second = x[k + 1] - x_before[k + 1], x[k + 2] - x_before[k + 2]
                total += (first * first + second * second) / A[at + 7]
            k += 3
            continue
        if A[at] > 0.0:
            total += change * change / A[at]
        k += 1
    return total


@compiled
def go_further(floats: Any, integers: Any, root: int, rows: int, last: float) -> float:
    """Change the impulses, and with them u, along the last direction, and find the next one.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        root: first tree of the island.
        rows: how many there are.
        last: what this returned after the pair of sweeps before; 0 begins with the gradient.

    Returns:
        The square of the gradient.
    """
    x = field(floats, integers, At.x)
    u = field(floats, integers, At.u)
    x_before = field(floats, integers, At.near_x)
    u_before = field(floats, integers, At.sum_s)
    x_direction = field(floats, integers, At.velocity)
    u_direction = field(floats, integers, At.sum_v)
    tree_dof = field(integers, integers, At.tree_dof)
    island_next = field(integers, integers, At.island_next)
    size = size_of_change(floats, integers, rows)
    share = size / last if size < last else 0.0
    for k in range(rows):
        further = share * x_direction[k] if share > 0.0 else 0.0
        x_direction[k] = further + x[k] - x_before[k]
        x[k] += further
    tree = root
    while tree >= 0:
        for d in range(tree_dof[tree], tree_dof[tree + 1]):
            further = share * u_direction[d] if share > 0.0 else 0.0
            u_direction[d] = further + u[d] - u_before[d]
            u[d] += further
        tree = island_next[tree]
    return size
