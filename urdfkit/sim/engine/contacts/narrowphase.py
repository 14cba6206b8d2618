"""Narrow phase: contacts of candidate pairs, and their impulses of the last step for the warm start."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.collision.collide_pair import collide_pair
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.contacts.ground_contacts import REACH
from urdfkit.sim.engine.math.spatial_algebra import (
    IDENTITY,
    ZERO,
    add,
    compose,
    cross,
    dot,
    load_rotation,
    load_spatial,
    load_vector,
    rotate,
    scale,
    store_rotation,
    store_vector,
    sub,
)

UNKNOWN = -1.0
"""Stands for an impulse that has not been found; no contact pulls."""


@inlined
def tangents(normal: Any) -> Any:
    """Return two unit vectors across a unit vector, the first level wherever it can be."""
    first = cross((0.0, 1.0, 0.0), normal) if abs(normal[2]) > 0.9 else cross(normal, (0.0, 0.0, 1.0))
    first = scale(1.0 / dot(first, first) ** 0.5, first)
    return first, cross(normal, first)


@compiled
def collide_pairs(floats: Any, integers: Any, count: int, room: int, pairs: int, dt: float) -> int:
    """Find the contacts of pairs of shapes that can close within a step; return how many there are, -1 if no room."""
    pair_a = field(integers, integers, At.pair_a)
    pair_b = field(integers, integers, At.pair_b)
    body_tree = field(integers, integers, At.body_tree)
    shape_kind = field(integers, integers, At.shape_kind)
    shape_body = field(integers, integers, At.shape_body)
    shape_size = field(floats, integers, At.shape_size)
    shape_R = field(floats, integers, At.shape_R)
    shape_p = field(floats, integers, At.shape_p)
    shape_data = field(integers, integers, At.shape_data)
    shape_mu = field(floats, integers, At.shape_mu)
    pair_numbers = field(floats, integers, At.pair_numbers)
    pair_indices = field(integers, integers, At.pair_indices)
    pair_work = field(floats, integers, At.pair_work)
    pair_work_indices = field(integers, integers, At.pair_work_indices)
    found_point = field(floats, integers, At.found_point)
    found_normal = field(floats, integers, At.found_normal)
    found_gap = field(floats, integers, At.found_gap)
    found_feature = field(integers, integers, At.found_feature)
    P = field(floats, integers, At.P)
    R = field(floats, integers, At.R)
    r = field(floats, integers, At.r)
    twist = field(floats, integers, At.twist)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    for pair in range(pairs):
        a, b = pair_a[pair], pair_b[pair]
        body, other = shape_body[a], shape_body[b]
        origin = load_vector(P, body_tree[body])
        R_a = load_rotation(R, body)
        p_a = add(load_vector(r, body), rotate(R_a, load_vector(shape_p, a)))
        R_b, p_b, shift = IDENTITY, ZERO, scale(-1.0, origin)
        still = (ZERO, ZERO)
        moving = still
        if other >= 0:
            R_b, p_b = load_rotation(R, other), load_vector(r, other)
            shift = sub(load_vector(P, body_tree[other]), origin)
            moving = load_spatial(twist, other)
        p_b = add(add(p_b, rotate(R_b, load_vector(shape_p, b))), shift)
        velocity = load_spatial(twist, body)
        # No two points of them close in faster than this.
        relative = sub(add(velocity[0], cross(velocity[1], p_a)), add(moving[0], cross(moving[1], sub(p_b, shift))))
        fastest = abs(relative[0]) + abs(relative[1]) + abs(relative[2])
        for k in range(3):
            fastest += 2.0 * shape_size[3 * a + k] * dot(velocity[1], velocity[1]) ** 0.5
            fastest += 2.0 * shape_size[3 * b + k] * dot(moving[1], moving[1]) ** 0.5
        found = collide_pair(
            shape_kind[a],
            load_vector(shape_size, a),
            compose(R_a, load_rotation(shape_R, a)),
            p_a,
            shape_data[a],
            shape_kind[b],
            load_vector(shape_size, b),
            compose(R_b, load_rotation(shape_R, b)),
            p_b,
            shape_data[b],
            pair_numbers,
            pair_indices,
            2.0 * dt * fastest + dt * dt * REACH,
            pair_work,
            pair_work_indices,
            found_point,
            found_normal,
            found_gap,
            found_feature,
        )
        for k in range(found):
            point, normal = load_vector(found_point, k), load_vector(found_normal, k)
            closing = add(velocity[0], cross(velocity[1], point))
            closing = sub(closing, add(moving[0], cross(moving[1], sub(point, shift))))
            if found_gap[k] > 2.0 * dt * abs(dot(closing, normal)) + dt * dt * REACH:
                continue
            if count >= room:
                return -1
            first, second = tangents(normal)
            contact_body[count], contact_other[count] = body, other
            contact_shape[count], contact_against[count] = a, b
            contact_feature[count] = found_feature[k]
            contact_gap[count] = found_gap[k]
            # Surfaces meet with the smaller friction, as in Gazebo.
            contact_mu[count] = min(shape_mu[a], shape_mu[b])
            store_vector(contact_point, count, point)
            store_rotation(
                contact_frame,
                count,
                (
                    first[0],
                    first[1],
                    first[2],
                    second[0],
                    second[1],
                    second[2],
                    normal[0],
                    normal[1],
                    normal[2],
                ),
            )
            count += 1
    return count


@inlined
def transfer_impulse(floats: Any, integers: Any, k: int, j: int, first_slot: int) -> None:
    """Move the impulse of the j-th contact of the last step to a contact, so that no other contact gets it."""
    memory = field(floats, integers, At.last)
    slot = first_slot + 3 * field(integers, integers, At.last_at)[j]
    store_vector(field(floats, integers, At.pair_before), k, (memory[slot], memory[slot + 1], memory[slot + 2]))
    field(integers, integers, At.last_feature)[j] = -1


@inlined
def match_contacts(floats: Any, integers: Any, first: int, count: int, last: int, first_slot: int) -> int:
    """Match the contacts of pairs with those of the last step and move their impulses; return the number to store.

    Both lists are sorted by pair, so one pass is sufficient. A contact with a new feature, such as a corner that moved
    from an edge to a face, gets the impulse of the nearest unmatched contact of its pair.
    """
    memory = field(floats, integers, At.last)
    last_a = field(integers, integers, At.last_a)
    last_b = field(integers, integers, At.last_b)
    last_feature = field(integers, integers, At.last_feature)
    last_at = field(integers, integers, At.last_at)
    last_point = field(floats, integers, At.last_point)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_point = field(floats, integers, At.contact_point)
    pair_before = field(floats, integers, At.pair_before)
    at, k = 0, first
    while k < count:
        a, b = contact_shape[k], contact_against[k]
        while at < last and (last_a[at] < a or (last_a[at] == a and last_b[at] < b)):
            at += 1
        left, end = 0, at
        while end < last and last_a[end] == a and last_b[end] == b:
            left += last_feature[end] >= 0
            end += 1
        start, unknown = k, 0
        while k < count and contact_shape[k] == a and contact_against[k] == b:
            store_vector(pair_before, k, (UNKNOWN, 0.0, 0.0))
            unknown += 1
            for j in range(at, end):
                if last_feature[j] == contact_feature[k]:
                    transfer_impulse(floats, integers, k, j, first_slot)
                    left, unknown = left - 1, unknown - 1
                    break
            k += 1
        for new in range(start, k):
            if unknown == 0 or pair_before[3 * new] != UNKNOWN:
                continue
            nearest, way = -1, math.inf
            for j in range(at, end):
                if left > 0 and last_feature[j] >= 0:
                    offset = sub(load_vector(contact_point, new), load_vector(last_point, j))
                    if dot(offset, offset) < way:
                        nearest, way = j, dot(offset, offset)
            if nearest >= 0:
                transfer_impulse(floats, integers, new, nearest, first_slot)
                left -= 1
            else:
                store_vector(pair_before, new, ZERO)
    for j in range(last):
        slot = first_slot + 3 * last_at[j]
        memory[slot] = memory[slot + 1] = memory[slot + 2] = 0.0
    for k in range(first, count):
        j = k - first
        last_a[j], last_b[j], last_feature[j] = contact_shape[k], contact_against[k], contact_feature[k]
        last_at[j] = k
        store_vector(last_point, j, load_vector(contact_point, k))
        slot = first_slot + 3 * k
        memory[slot], memory[slot + 1], memory[slot + 2] = load_vector(pair_before, k)
    return count - first
