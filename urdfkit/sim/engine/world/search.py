"""The search for contacts: which trees and shapes may touch, then what does."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import (
    CONTACTS,
    DT,
    FLOOR,
    HAS_FLOOR,
    HAS_PAIRS,
    LAST_PAIRS,
    OVERFULL,
    PAIRS,
    SHAPES,
    SLOTS,
    TREES,
    At,
)
from urdfkit.sim.engine.collide import collide_with_plane, near_plane
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.world.meet import bound, collide_pairs, find_again, find_pairs


@inlined
def candidates(floats: Any, integers: Any) -> int:
    """List the pairs of shapes that may meet within a step, and mark the trees that may touch something.

    Returns:
        How many pairs; -1 if there are more than there is room for.
    """
    shapes, trees, most_pairs = integers[SHAPES], integers[TREES], integers[PAIRS]
    shape_p = field(floats, integers, At.shape_p)
    shape_radius = field(floats, integers, At.shape_radius)
    numbers = field(floats, integers, At.numbers)
    R = field(floats, integers, At.R)
    r = field(floats, integers, At.r)
    P = field(floats, integers, At.P)
    twist = field(floats, integers, At.twist)
    shape_at = field(floats, integers, At.shape_at)
    shape_reach = field(floats, integers, At.shape_reach)
    tree_low = field(floats, integers, At.tree_low)
    tree_high = field(floats, integers, At.tree_high)
    tree_shape = field(integers, integers, At.tree_shape)
    tree_meets = field(integers, integers, At.tree_meets)
    near = field(integers, integers, At.near)
    asleep = field(integers, integers, At.asleep)
    pair_a = field(integers, integers, At.pair_a)
    pair_b = field(integers, integers, At.pair_b)
    parent = field(integers, integers, At.parent)
    shape_body = field(integers, integers, At.shape_body)
    shape_owner = field(integers, integers, At.shape_owner)
    counts = field(integers, integers, At.counts)
    floor, has_floor, has_pairs = numbers[FLOOR], numbers[HAS_FLOOR] != 0.0, numbers[HAS_PAIRS] != 0.0
    dt = numbers[DT]
    pairs = 0
    for tree in range(trees):
        near[tree] = 0
        if has_floor and near_plane(
            tree_shape[tree],
            tree_shape[tree + 1],
            shape_body,
            shape_p,
            shape_radius,
            floor - P[3 * tree + 2],
            dt,
            R,
            r,
            twist,
        ):
            near[tree] = 1
        if has_pairs:
            bound(
                tree,
                tree_shape,
                shape_body,
                shape_p,
                shape_radius,
                P,
                R,
                r,
                twist,
                dt,
                shape_at,
                shape_reach,
                tree_low,
                tree_high,
            )
    if has_pairs:
        pairs = find_pairs(
            trees,
            shapes,
            most_pairs,
            tree_shape,
            tree_meets,
            asleep,
            shape_body,
            shape_owner,
            parent,
            shape_at,
            shape_reach,
            tree_low,
            tree_high,
            near,
            pair_a,
            pair_b,
        )
        if pairs < 0:
            counts[OVERFULL] = 1
            return -1
    return pairs


@inlined
def touching(floats: Any, integers: Any, pairs: int) -> int:
    """Find the contacts of the trees that have been marked and placed where the step will take them.

    What is remembered of pairs moves, in ``last``, to where their contacts are now.

    Returns:
        How many contacts; -1 if there are more than there is room for.
    """
    trees, most_contacts, slots = integers[TREES], integers[CONTACTS], integers[SLOTS]
    shape_R = field(floats, integers, At.shape_R)
    shape_p = field(floats, integers, At.shape_p)
    shape_size = field(floats, integers, At.shape_size)
    shape_radius = field(floats, integers, At.shape_radius)
    shape_mu = field(floats, integers, At.shape_mu)
    floor_mu = field(floats, integers, At.floor_mu)
    vertices = field(floats, integers, At.vertices)
    extreme = field(floats, integers, At.extreme)
    numbers = field(floats, integers, At.numbers)
    last = field(floats, integers, At.last)
    R = field(floats, integers, At.R)
    r = field(floats, integers, At.r)
    P = field(floats, integers, At.P)
    twist = field(floats, integers, At.twist)
    contact_origin = field(floats, integers, At.contact_origin)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    pair_before = field(floats, integers, At.pair_before)
    pair_numbers = field(floats, integers, At.pair_numbers)
    pair_work = field(floats, integers, At.pair_work)
    found_point = field(floats, integers, At.found_point)
    found_normal = field(floats, integers, At.found_normal)
    found_gap = field(floats, integers, At.found_gap)
    tree_shape = field(integers, integers, At.tree_shape)
    near = field(integers, integers, At.near)
    pair_a = field(integers, integers, At.pair_a)
    pair_b = field(integers, integers, At.pair_b)
    last_a = field(integers, integers, At.last_a)
    last_b = field(integers, integers, At.last_b)
    last_feature = field(integers, integers, At.last_feature)
    last_at = field(integers, integers, At.last_at)
    pair_indices = field(integers, integers, At.pair_indices)
    pair_work_indices = field(integers, integers, At.pair_work_indices)
    found_feature = field(integers, integers, At.found_feature)
    body_tree = field(integers, integers, At.body_tree)
    shape_kind = field(integers, integers, At.shape_kind)
    shape_body = field(integers, integers, At.shape_body)
    shape_feature = field(integers, integers, At.shape_feature)
    shape_vertex = field(integers, integers, At.shape_vertex)
    shape_data = field(integers, integers, At.shape_data)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    extreme_vertex = field(integers, integers, At.extreme_vertex)
    counts = field(integers, integers, At.counts)
    floor, has_floor, has_pairs = numbers[FLOOR], numbers[HAS_FLOOR] != 0.0, numbers[HAS_PAIRS] != 0.0
    dt = numbers[DT]
    first_pair_slot = slots - 3 * most_contacts
    contacts = 0
    for tree in range(trees):
        if near[tree] == 0:
            continue
        for k in range(3):
            contact_origin[3 * tree + k] = P[3 * tree + k]
        if has_floor:
            contacts = collide_with_plane(
                contacts,
                tree_shape[tree],
                tree_shape[tree + 1],
                most_contacts,
                shape_kind,
                shape_body,
                shape_feature,
                shape_vertex,
                shape_R,
                shape_p,
                shape_size,
                shape_radius,
                floor_mu,
                vertices,
                extreme,
                extreme_vertex,
                floor - P[3 * tree + 2],
                dt,
                R,
                r,
                twist,
                contact_body,
                contact_other,
                contact_shape,
                contact_against,
                contact_feature,
                contact_point,
                contact_frame,
                contact_gap,
                contact_mu,
            )
    if has_pairs:
        on_ground = contacts
        contacts = collide_pairs(
            contacts,
            most_contacts,
            pairs,
            pair_a,
            pair_b,
            body_tree,
            shape_kind,
            shape_body,
            shape_size,
            shape_R,
            shape_p,
            shape_data,
            shape_mu,
            pair_numbers,
            pair_indices,
            pair_work,
            pair_work_indices,
            found_point,
            found_normal,
            found_gap,
            found_feature,
            P,
            R,
            r,
            twist,
            dt,
            contact_body,
            contact_other,
            contact_shape,
            contact_against,
            contact_feature,
            contact_point,
            contact_frame,
            contact_gap,
            contact_mu,
        )
        if contacts < 0:
            counts[OVERFULL] = 1
            return -1
        counts[LAST_PAIRS] = find_again(
            on_ground,
            contacts,
            counts[LAST_PAIRS],
            first_pair_slot,
            last,
            last_a,
            last_b,
            last_feature,
            last_at,
            contact_shape,
            contact_against,
            contact_feature,
            pair_before,
        )
    return contacts
