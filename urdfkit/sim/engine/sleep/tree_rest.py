"""Rest of one tree: stop it, and detect what disturbs it."""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.dynamics.mass_matrix import place
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import ZERO, store_spatial, store_vector
from urdfkit.sim.engine.sleep.sleep_criteria import TARGETS, target_of


@inlined
def stop(w: KernelWorld, tree: int) -> None:
    """Set a tree's velocity to zero and store its positions and targets."""
    first = w.tree_s[tree]
    for k in range(first, w.tree_s[tree + 1]):
        w.s_ahead[k] = w.s[k]
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        w.v[d] = 0.0
        for k in range(TARGETS):
            w.targets_at_sleep[TARGETS * d + k] = target_of(w, d, k)
    if w.tree_floats[tree] != 0:
        store_vector(w.P, tree, (w.s[first], w.s[first + 1], w.s[first + 2]))
    place(w, tree, w.s, False)
    for b in range(w.tree_body[tree], w.tree_body[tree + 1]):
        store_spatial(w.twist, b, (ZERO, ZERO))


@inlined
def is_disturbed(w: KernelWorld, tree: int) -> bool:
    """Return whether a sleeping tree was moved from outside or has new targets."""
    for k in range(w.tree_s[tree], w.tree_s[tree + 1]):
        if w.s[k] != w.s_ahead[k]:
            return True
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        if w.v[d] != 0.0:
            return True
        for k in range(TARGETS):
            if w.targets_at_sleep[TARGETS * d + k] != target_of(w, d, k):
                return True
    return False


@inlined
def gravity_changed(w: KernelWorld) -> bool:
    """Return whether gravity differs from that of the last call."""
    changed = False
    for k in range(3):
        changed = changed or w.gravity[k] != w.gravity_last_step[k]
        w.gravity_last_step[k] = w.gravity[k]
    return changed
