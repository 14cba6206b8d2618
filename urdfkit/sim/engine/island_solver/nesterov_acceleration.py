"""Nesterov's acceleration of sweeps: after each pair of sweeps, impulses change further in the direction of the last.

A pair of sweeps serves as the step of a gradient method. The momentum grows with each pair, and begins again when the
change in a pair is directed against the change since the one before. Impulses that this takes out of their cones are
corrected by the next sweep.

Sources: Y. Nesterov, Soviet Math. Dokl. 27 (1983) 372-376. B. O'Donoghue, E. Candès, Found. Comput. Math. 15 (2015)
715-732 (restarts). H. Mazhar et al., ACM Trans. Graph. 34 (2015) 32 (for contacts).
"""

import math

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld

KEPT = 15
"""Room in A for a contact: its effective mass matrix, the effective masses of single rows, whether there is such a
matrix, the change of the velocities across the normal by an impulse along it, and the inverses of these masses."""


@compiled
def begin_acceleration(w: KernelWorld, root: int, rows: int) -> None:
    """Store the impulses, in ``velocity``, and what they do to the trees, in ``sum_v``."""
    for k in range(rows):
        w.velocity[k] = w.x[k]
    tree = root
    while tree >= 0:
        for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
            w.sum_v[d] = w.u[d]
        tree = w.island_next[tree]


@inlined
def note(w: KernelWorld, rows: int) -> None:
    """Store the impulses before a pair of sweeps."""
    for k in range(rows):
        w.near_x[k] = w.x[k]


@inlined
def turns_back(w: KernelWorld, rows: int) -> bool:
    """Return whether the change in a pair of sweeps is against that since the last, in the metric of inverse masses."""
    x, before, last = w.x, w.near_x, w.velocity
    total = 0.0
    k = 0
    while k < rows:
        at = KEPT * k // 3
        if w.mu[k] > 0.0:
            total += w.A[at + 11] * (x[k] - before[k]) * (x[k] - last[k])
            along = (x[k + 1] - before[k + 1]) * (x[k + 1] - last[k + 1])
            total += w.A[at + 12] * (along + (x[k + 2] - before[k + 2]) * (x[k + 2] - last[k + 2]))
            k += 3
            continue
        if w.A[at] > 0.0:
            total += (x[k] - before[k]) * (x[k] - last[k]) / w.A[at]
        k += 1
    return total < 0.0


@compiled
def go_further(w: KernelWorld, root: int, rows: int, momentum: float) -> float:
    """Change the impulses, and with them u, further in the direction of their change since the last pair of sweeps.

    Args:
        w: the world's arrays.
        root: first tree of the island.
        rows: how many there are.
        momentum: what this returned after the last pair of sweeps; 1 at the beginning.
    """
    if turns_back(w, rows):
        momentum = 1.0
    following = 0.5 * (1.0 + math.sqrt(1.0 + 4.0 * momentum * momentum))
    share = (momentum - 1.0) / following
    for k in range(rows):
        now = w.x[k]
        w.x[k] += share * (now - w.velocity[k])
        w.velocity[k] = now
    tree = root
    while tree >= 0:
        for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
            u = w.u[d]
            w.u[d] += share * (u - w.sum_v[d])
            w.sum_v[d] = u
        tree = w.island_next[tree]
    return following
