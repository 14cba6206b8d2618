"""Contact search: broad phase, then narrow phase for the trees that may touch."""

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.contacts.anisotropic_friction import orient_friction
from urdfkit.sim.engine.contacts.broadphase import find_pairs, update_bounds
from urdfkit.sim.engine.contacts.ground_contacts import collide_with_plane, near_plane
from urdfkit.sim.engine.contacts.narrowphase import collide_pairs, match_contacts
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import (
    CONTACTS,
    DOFS,
    DT,
    FLOOR,
    HAS_FLOOR,
    HAS_PAIRS,
    LAST_PAIRS,
    MIMICS,
    OVERFULL,
    PAIRS,
    SHAPES,
    SLEEPING,
    SLOTS,
    TREES,
)


@compiled
def find_candidate_pairs(w: KernelWorld) -> int:
    """List the pairs of shapes that may meet within a step, and mark the trees that may touch something.

    Returns:
        How many pairs; -1 if there are more than there is room for.
    """
    shapes, trees, most_pairs = w.sizes[SHAPES], w.sizes[TREES], w.sizes[PAIRS]
    floor, has_floor, has_pairs = w.numbers[FLOOR], w.numbers[HAS_FLOOR] != 0.0, w.numbers[HAS_PAIRS] != 0.0
    dt = w.numbers[DT]
    pairs = 0
    for tree in range(trees):
        w.near[tree] = 0
        if w.asleep[tree] != 0:
            continue
        if has_floor and near_plane(w, w.tree_shape[tree], w.tree_shape[tree + 1], floor - w.P[3 * tree + 2], dt):
            w.near[tree] = 1
        if has_pairs:
            update_bounds(w, tree, dt)
    if has_pairs:
        pairs = find_pairs(w, trees, shapes, most_pairs)
        if pairs < 0:
            w.counts[OVERFULL] = 1
            return -1
    return pairs


@compiled
def find_contacts(w: KernelWorld, pairs: int) -> int:
    """Find the contacts of the trees that have been marked and placed where the step will take them.

    The stored impulses of pairs are moved, in ``last``, to the indices of their present contacts.

    Returns:
        How many contacts; -1 if there are more than there is room for.
    """
    trees, most_contacts, slots = w.sizes[TREES], w.sizes[CONTACTS], w.sizes[SLOTS]
    floor, has_floor, has_pairs = w.numbers[FLOOR], w.numbers[HAS_FLOOR] != 0.0, w.numbers[HAS_PAIRS] != 0.0
    dt = w.numbers[DT]
    first_pair_slot = slots - 3 * most_contacts
    # Contacts of sleeping trees are stored at the end of the arrays.
    room = most_contacts - w.counts[SLEEPING]
    contacts = 0
    for tree in range(trees):
        if w.near[tree] == 0 or w.asleep[tree] != 0:
            continue
        for k in range(3):
            w.contact_origin[3 * tree + k] = w.P[3 * tree + k]
        if has_floor:
            contacts = collide_with_plane(
                w, contacts, w.tree_shape[tree], w.tree_shape[tree + 1], room, floor - w.P[3 * tree + 2], dt
            )
    if has_pairs:
        on_ground = contacts
        contacts = collide_pairs(w, contacts, room, pairs, dt)
        if contacts < 0:
            w.counts[OVERFULL] = 1
            return -1
        w.counts[LAST_PAIRS] = match_contacts(w, on_ground, contacts, w.counts[LAST_PAIRS], first_pair_slot)
    orient_friction(w, contacts, 2 * w.sizes[DOFS] + w.sizes[MIMICS], first_pair_slot, w.last, dt)
    return contacts
