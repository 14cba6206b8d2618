"""Warm start: impulses of contacts and rows, stored for the next step, and for sleeping trees until they wake."""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import load_rotation, load_vector, store_rotation, store_vector
from urdfkit.sim.engine.simulation_memory import CONTACTS, DOFS, LAST_PAIRS, MIMICS, SHAPES, SLOTS


@inlined
def store_impulses(w: KernelWorld, tree: int) -> None:
    """Move the impulses of a tree's rows of the last step from ``memory`` to ``last``."""
    dofs, mimics, shapes = w.sizes[DOFS], w.sizes[MIMICS], w.sizes[SHAPES]
    memory = w.memory
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        w.last[d], w.last[dofs + d] = memory[d], memory[dofs + d]
        memory[d] = memory[dofs + d] = 0.0
    for k in range(2 * dofs + w.tree_mimic[tree], 2 * dofs + w.tree_mimic[tree + 1]):
        w.last[k], memory[k] = memory[k], 0.0
    first, beyond = w.tree_shape[tree], w.tree_shape[tree + 1]
    if first == beyond:
        return
    features = 2 * dofs + mimics
    end = 3 * w.shape_feature[beyond] if beyond < shapes else w.sizes[SLOTS] - 3 * w.sizes[CONTACTS] - features
    for k in range(features + 3 * w.shape_feature[first], features + end):
        w.last[k], memory[k] = memory[k], 0.0


@inlined
def store_pair_impulses(w: KernelWorld) -> None:
    """Move the impulses of contacts between pairs from ``memory`` to ``last``."""
    first = w.sizes[SLOTS] - 3 * w.sizes[CONTACTS]
    for j in range(w.counts[LAST_PAIRS]):
        slot = first + 3 * w.last_at[j]
        for k in range(slot, slot + 3):
            w.last[k], w.memory[k] = w.memory[k], 0.0


@inlined
def insert_pair(w: KernelWorld, k: int) -> None:
    """Insert a stored contact of a pair into the sorted contacts of the last step."""
    a, b = w.contact_shape[k], w.contact_against[k]
    j = w.counts[LAST_PAIRS]
    while j > 0 and (w.last_a[j - 1] > a or (w.last_a[j - 1] == a and w.last_b[j - 1] > b)):
        w.last_a[j], w.last_b[j] = w.last_a[j - 1], w.last_b[j - 1]
        w.last_feature[j], w.last_at[j] = w.last_feature[j - 1], w.last_at[j - 1]
        store_vector(w.last_point, j, load_vector(w.last_point, j - 1))
        j -= 1
    w.last_a[j], w.last_b[j], w.last_feature[j], w.last_at[j] = a, b, w.contact_feature[k], k
    store_vector(w.last_point, j, load_vector(w.contact_point, k))
    w.counts[LAST_PAIRS] += 1
    slot = w.sizes[SLOTS] - 3 * w.sizes[CONTACTS] + 3 * k
    w.last[slot] = w.contact_impulse[3 * k + 2]
    w.last[slot + 1], w.last[slot + 2] = w.contact_impulse[3 * k], w.contact_impulse[3 * k + 1]


@inlined
def copy_contact(w: KernelWorld, k: int, to: int) -> None:
    """Copy a contact to another number."""
    w.contact_body[to], w.contact_other[to] = w.contact_body[k], w.contact_other[k]
    w.contact_shape[to], w.contact_against[to] = w.contact_shape[k], w.contact_against[k]
    w.contact_feature[to], w.contact_row[to] = w.contact_feature[k], w.contact_row[k]
    w.contact_gap[to], w.contact_mu[to] = w.contact_gap[k], w.contact_mu[k]
    store_vector(w.contact_point, to, load_vector(w.contact_point, k))
    store_rotation(w.contact_frame, to, load_rotation(w.contact_frame, k))
    store_vector(w.contact_impulse, to, load_vector(w.contact_impulse, k))
