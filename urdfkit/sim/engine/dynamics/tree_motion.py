"""Motion of a tree during a step: terms at the start, predicted poses for the contacts, integration."""

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.dynamics.free_body_terms import free_body_terms
from urdfkit.sim.engine.dynamics.integration import move
from urdfkit.sim.engine.dynamics.mass_matrix import FREE, place, terms
from urdfkit.sim.engine.kernel_world import KernelWorld


@compiled
def evaluate(w: KernelWorld, tree: int) -> None:
    """Place a tree's bodies where they are, and compute M and bias."""
    place(w, tree, w.s, False)
    body = w.tree_body[tree]
    if w.tree_body[tree + 1] - body == 1 and w.kind[body] == FREE and w.weightless[body] == 0.0:
        free_body_terms(w, body)
    else:
        terms(w, tree)


@compiled
def begin_step(w: KernelWorld, tree: int) -> None:
    """Start a step of a tree from its coordinates and velocities."""
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        w.v_start[d] = w.v[d]
        w.saturated[d] = w.pressed[d] = 0
    # All of a tree is reckoned from one point, its floating base: far from the origin nothing is lost.
    for k in range(3):
        w.P[3 * tree + k] = w.s[w.tree_s[tree] + k] if w.tree_floats[tree] != 0 else w.base[3 * tree + k]
    evaluate(w, tree)


@compiled
def integrate_tree(w: KernelWorld, tree: int, dt: float) -> None:
    """Integrate a tree's coordinates for `dt` with its velocities."""
    s, v = w.s, w.v
    move(w, w.tree_body[tree], w.tree_body[tree + 1], s, v, dt)


@compiled
def predict_poses(w: KernelWorld, tree: int, dt: float) -> None:
    """Compute the poses of a tree's bodies after `dt` at the present velocities."""
    s, v = w.s, w.v
    s_ahead, v_ahead = w.s_ahead, w.v_ahead
    for k in range(w.tree_s[tree], w.tree_s[tree + 1]):
        s_ahead[k] = s[k]
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        v_ahead[d] = v[d]
    move(w, w.tree_body[tree], w.tree_body[tree + 1], s_ahead, v_ahead, dt)
    place(w, tree, s_ahead, True)
