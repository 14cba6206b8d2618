"""Conjugate gradients for sweeps: after each pair of sweeps, impulses change further along the directions so far.

The change of the impulses in a pair of sweeps serves as the negative gradient of the energy that the law minimises.
The share of the last direction in the next is the ratio of the squares of two gradients (Fletcher and Reeves); where
that is no less than 1, as where contacts begin or cease to slide, directions begin again with the gradient. Impulses
that this takes out of their cones are put right by the next sweep.

Source: M. Silcowitz-Hansen, S. Niebe, K. Erleben, The Visual Computer 26 (2010) 893-901.
"""

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.kernel_world import KernelWorld

KEPT = 15
"""Room in A for a contact: its effective mass matrix, the effective masses of single rows, whether there is such a
matrix, the change of the velocities across the normal by an impulse along it, and the inverses of these masses."""


@compiled
def note(w: KernelWorld, root: int, rows: int) -> None:
    """Keep the impulses and what they do to the trees as they are before a pair of sweeps."""
    u_before = w.sum_s
    for k in range(rows):
        w.near_x[k] = w.x[k]
    tree = root
    while tree >= 0:
        for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
            u_before[d] = w.u[d]
        tree = w.island_next[tree]


@compiled
def size_of_change(w: KernelWorld, rows: int) -> float:
    """Return the squared change of the impulses in a pair of sweeps, weighted with the inverse masses of the rows."""
    total = 0.0
    k = 0
    while k < rows:
        change = w.x[k] - w.near_x[k]
        at = KEPT * k // 3
        if w.mu[k] > 0.0:
            total += change * change / w.A[at + 6]
            if w.A[at + 7] > 0.0:
                first, second = w.x[k + 1] - w.near_x[k + 1], w.x[k + 2] - w.near_x[k + 2]
                total += (first * first + second * second) / w.A[at + 7]
            k += 3
            continue
        if w.A[at] > 0.0:
            total += change * change / w.A[at]
        k += 1
    return total


@compiled
def go_further(w: KernelWorld, root: int, rows: int, last: float) -> float:
    """Change the impulses, and with them u, along the last direction, and find the next one.

    Args:
        w: the world's arrays.
        root: first tree of the island.
        rows: how many there are.
        last: what this returned after the pair of sweeps before; 0 begins with the gradient.

    Returns:
        The square of the gradient.
    """
    u_before, x_direction, u_direction = w.sum_s, w.velocity, w.sum_v
    size = size_of_change(w, rows)
    share = size / last if size < last else 0.0
    for k in range(rows):
        further = share * x_direction[k] if share > 0.0 else 0.0
        x_direction[k] = further + w.x[k] - w.near_x[k]
        w.x[k] += further
    tree = root
    while tree >= 0:
        for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
            further = share * u_direction[d] if share > 0.0 else 0.0
            u_direction[d] = further + w.u[d] - u_before[d]
            w.u[d] += further
        tree = w.island_next[tree]
    return size
