"""Narrow phase: contacts of candidate pairs, and their impulses of the last step for the warm start."""

import math
from typing import Any

from urdfkit.sim.engine.collision.collide_pair import collide_pair
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.contacts.ground_contacts import REACH
from urdfkit.sim.engine.kernel_world import KernelWorld
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
def collide_pairs(w: KernelWorld, count: int, room: int, pairs: int, dt: float) -> int:
    """Find the contacts of pairs of shapes that can close within a step; return how many there are, -1 if no room."""
    for pair in range(pairs):
        a, b = w.pair_a[pair], w.pair_b[pair]
        body, other = w.shape_body[a], w.shape_body[b]
        origin = load_vector(w.P, w.body_tree[body])
        R_a = load_rotation(w.R, body)
        p_a = add(load_vector(w.r, body), rotate(R_a, load_vector(w.shape_p, a)))
        R_b, p_b, shift = IDENTITY, ZERO, scale(-1.0, origin)
        still = (ZERO, ZERO)
        moving = still
        if other >= 0:
            R_b, p_b = load_rotation(w.R, other), load_vector(w.r, other)
            shift = sub(load_vector(w.P, w.body_tree[other]), origin)
            moving = load_spatial(w.twist, other)
        p_b = add(add(p_b, rotate(R_b, load_vector(w.shape_p, b))), shift)
        velocity = load_spatial(w.twist, body)
        # No two points of them close in faster than this.
        relative = sub(add(velocity[0], cross(velocity[1], p_a)), add(moving[0], cross(moving[1], sub(p_b, shift))))
        fastest = abs(relative[0]) + abs(relative[1]) + abs(relative[2])
        for k in range(3):
            fastest += 2.0 * w.shape_size[3 * a + k] * dot(velocity[1], velocity[1]) ** 0.5
            fastest += 2.0 * w.shape_size[3 * b + k] * dot(moving[1], moving[1]) ** 0.5
        found = collide_pair(
            w.shape_kind[a],
            load_vector(w.shape_size, a),
            compose(R_a, load_rotation(w.shape_R, a)),
            p_a,
            w.shape_data[a],
            w.shape_kind[b],
            load_vector(w.shape_size, b),
            compose(R_b, load_rotation(w.shape_R, b)),
            p_b,
            w.shape_data[b],
            w.pair_numbers,
            w.pair_indices,
            2.0 * dt * fastest + dt * dt * REACH,
            w.pair_work,
            w.pair_work_indices,
            w.found_point,
            w.found_normal,
            w.found_gap,
            w.found_feature,
        )
        for k in range(found):
            point, normal = load_vector(w.found_point, k), load_vector(w.found_normal, k)
            closing = add(velocity[0], cross(velocity[1], point))
            closing = sub(closing, add(moving[0], cross(moving[1], sub(point, shift))))
            if w.found_gap[k] > 2.0 * dt * abs(dot(closing, normal)) + dt * dt * REACH:
                continue
            if count >= room:
                return -1
            first, second = tangents(normal)
            w.contact_body[count], w.contact_other[count] = body, other
            w.contact_shape[count], w.contact_against[count] = a, b
            w.contact_feature[count] = w.found_feature[k]
            w.contact_gap[count] = w.found_gap[k]
            # Surfaces meet with the smaller friction, as in Gazebo.
            w.contact_mu[count] = min(w.shape_mu[a], w.shape_mu[b])
            store_vector(w.contact_point, count, point)
            store_rotation(
                w.contact_frame,
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
def transfer_impulse(w: KernelWorld, k: int, j: int, first_slot: int) -> None:
    """Move the impulse of the j-th contact of the last step to a contact, so that no other contact gets it."""
    slot = first_slot + 3 * w.last_at[j]
    store_vector(w.pair_before, k, (w.last[slot], w.last[slot + 1], w.last[slot + 2]))
    w.last_feature[j] = -1


@inlined
def match_contacts(w: KernelWorld, first: int, count: int, last: int, first_slot: int) -> int:
    """Match the contacts of pairs with those of the last step and move their impulses; return the number to store.

    Both lists are sorted by pair, so one pass is sufficient. A contact with a new feature, such as a corner that moved
    from an edge to a face, gets the impulse of the nearest unmatched contact of its pair.
    """
    memory = w.last
    at, k = 0, first
    while k < count:
        a, b = w.contact_shape[k], w.contact_against[k]
        while at < last and (w.last_a[at] < a or (w.last_a[at] == a and w.last_b[at] < b)):
            at += 1
        left, end = 0, at
        while end < last and w.last_a[end] == a and w.last_b[end] == b:
            left += w.last_feature[end] >= 0
            end += 1
        start, unknown = k, 0
        while k < count and w.contact_shape[k] == a and w.contact_against[k] == b:
            store_vector(w.pair_before, k, (UNKNOWN, 0.0, 0.0))
            unknown += 1
            for j in range(at, end):
                if w.last_feature[j] == w.contact_feature[k]:
                    transfer_impulse(w, k, j, first_slot)
                    left, unknown = left - 1, unknown - 1
                    break
            k += 1
        for new in range(start, k):
            if unknown == 0 or w.pair_before[3 * new] != UNKNOWN:
                continue
            nearest, way = -1, math.inf
            for j in range(at, end):
                if left > 0 and w.last_feature[j] >= 0:
                    offset = sub(load_vector(w.contact_point, new), load_vector(w.last_point, j))
                    if dot(offset, offset) < way:
                        nearest, way = j, dot(offset, offset)
            if nearest >= 0:
                transfer_impulse(w, new, nearest, first_slot)
                left -= 1
            else:
                store_vector(w.pair_before, new, ZERO)
    for j in range(last):
        slot = first_slot + 3 * w.last_at[j]
        memory[slot] = memory[slot + 1] = memory[slot + 2] = 0.0
    for k in range(first, count):
        j = k - first
        w.last_a[j], w.last_b[j], w.last_feature[j] = w.contact_shape[k], w.contact_against[k], w.contact_feature[k]
        w.last_at[j] = k
        store_vector(w.last_point, j, load_vector(w.contact_point, k))
        slot = first_slot + 3 * k
        memory[slot], memory[slot + 1], memory[slot + 2] = load_vector(w.pair_before, k)
    return count - first
