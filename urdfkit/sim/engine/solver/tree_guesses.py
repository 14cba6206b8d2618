"""Impulses of a single tree by the matrix of all its rows, where the rounds of `augmented_newton` have failed."""

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.dynamics.mass_matrix import solve_forward
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.solver.active_set_newton import fastest_row, iterate, regularise_tangents
from urdfkit.sim.engine.solver.delassus import apply_impulses, build_delassus

MOST_GUESSED = 100
"""Rows up to which `GUESSED` follows where all rounds failed: of these, the motors of a humanoid are some forty."""


@compiled
def solve_without_rounds(w: KernelWorld, tree: int, stride: int, rows: int, guesses: bool) -> int:
    """Do what `solve_single_tree` does by the matrix of all rows, with guesses of the active set or only by sweeps.

    Returns:
        How many guesses it took; 0 if velocities only come near the law.
    """
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    # What `smooth_motion` left in u is L times the change of velocity without impulses.
    for d in range(first, beyond):
        w.u[d] = w.u_free[d] / w.inverse_diagonal[d]
        e = w.dof_parent[d]
        while e >= 0:
            w.u[d] += w.L[w.dof_row[d] + e] * w.u_free[e]
            e = w.dof_parent[e]
    build_delassus(w, rows, tree, stride, False)
    regularise_tangents(w, rows)
    tried = iterate(w, rows, fastest_row(w, rows), MOST_GUESSED if guesses else 0)
    apply_impulses(w, rows, tree, stride, False)
    solve_forward(w, first, beyond)
    return abs(tried)
