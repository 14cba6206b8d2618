"""Contact search: broad phase, then narrow phase for the trees that may touch."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import (
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
    At,
)
from urdfkit.sim.engine.compilation import compiled, field
from urdfkit.sim.engine.contacts.broadphase import find_pairs, update_bounds
from urdfkit.sim.engine.contacts.friction_directions import orient_friction
from urdfkit.sim.engine.contacts.ground_contacts import collide_with_plane, near_plane
from urdfkit.sim.engine.contacts.narrowphase import collide_pairs, match_contacts


@compiled
def find_candidate_pairs(floats: Any, integers: Any) -> int:
    """List the pairs of shapes that may meet within a step, and mark the trees that may touch something.

    Returns:
        How many pairs; -1 if there are more than there is room for.
    """
    shapes, trees, most_pairs = integers[SHAPES], integers[TREES], integers[PAIRS]
    numbers = field(floats, integers, At.numbers)
    P = field(floats, integers, At.P)
    tree_shape = field(integers, integers, At.tree_shape)
    near = field(integers, integers, At.near)
    asleep = field(integers, integers, At.asleep)
    counts = field(integers, integers, At.counts)
    floor, has_floor, has_pairs = numbers[FLOOR], numbers[HAS_FLOOR] != 0.0, numbers[HAS_PAIRS] != 0.0
    dt = numbers[DT]
    pairs = 0
    for tree in range(trees):
        near[tree] = 0
        if asleep[tree] != 0:
            continue
        if has_floor and near_plane(
            floats, integers, tree_shape[tree], tree_shape[tree + 1], floor - P[3 * tree + 2], dt
        ):
            near[tree] = 1
        if has_pairs:
            update_bounds(floats, integers, tree, dt)
    if has_pairs:
        pairs = find_pairs(floats, integers, trees, shapes, most_pairs)
        if pairs < 0:
            counts[OVERFULL] = 1
            return -1
    return pairs


@compiled
def find_contacts(floats: Any, integers: Any, pairs: int) -> int:
    """Find the contacts of the trees that have been marked and placed where the step will take them.

    The stored impulses of pairs are moved, in ``last``, to the indices of their present contacts.

    Returns:
        How many contacts; -1 if there are more than there is room for.
    """
    trees, most_contacts, slots = integers[TREES], integers[CONTACTS], integers[SLOTS]
    numbers = field(floats, integers, At.numbers)
    P = field(floats, integers, At.P)
    contact_origin = field(floats, integers, At.contact_origin)
    tree_shape = field(integers, integers, At.tree_shape)
    near = field(integers, integers, At.near)
    asleep = field(integers, integers, At.asleep)
    counts = field(integers, integers, At.counts)
    floor, has_floor, has_pairs = numbers[FLOOR], numbers[HAS_FLOOR] != 0.0, numbers[HAS_PAIRS] != 0.0
    dt = numbers[DT]
    first_pair_slot = slots - 3 * most_contacts
    # Contacts of sleeping trees are stored at the end of the arrays.
    room = most_contacts - counts[SLEEPING]
    contacts = 0
    for tree in range(trees):
        if near[tree] == 0 or asleep[tree] != 0:
            continue
        for k in range(3):
            contact_origin[3 * tree + k] = P[3 * tree + k]
        if has_floor:
            contacts = collide_with_plane(
                floats,
                integers,
                contacts,
                tree_shape[tree],
                tree_shape[tree + 1],
                room,
                floor - P[3 * tree + 2],
                dt,
            )
    if has_pairs:
        on_ground = contacts
        contacts = collide_pairs(floats, integers, contacts, room, pairs, dt)
        if contacts < 0:
            counts[OVERFULL] = 1
            return -1
        counts[LAST_PAIRS] = match_contacts(floats, integers, on_ground, contacts, counts[LAST_PAIRS], first_pair_slot)
    last = field(floats, integers, At.last)
    orient_friction(floats, integers, contacts, 2 * integers[DOFS] + integers[MIMICS], first_pair_slot, last, dt)
    return contacts
