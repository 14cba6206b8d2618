"""Warm start: impulses of contacts and rows, stored for the next step, and for sleeping trees until they wake."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import CONTACTS, DOFS, LAST_PAIRS, MIMICS, SHAPES, SLOTS, At
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.math.spatial_algebra import load_rotation, load_vector, store_rotation, store_vector


@inlined
def store_impulses(floats: Any, integers: Any, tree: int) -> None:
    """Move the impulses of a tree's rows of the last step from ``memory`` to ``last``."""
    dofs, mimics, shapes = integers[DOFS], integers[MIMICS], integers[SHAPES]
    memory = field(floats, integers, At.memory)
    last = field(floats, integers, At.last)
    tree_dof = field(integers, integers, At.tree_dof)
    tree_mimic = field(integers, integers, At.tree_mimic)
    tree_shape = field(integers, integers, At.tree_shape)
    shape_feature = field(integers, integers, At.shape_feature)
    for d in range(tree_dof[tree], tree_dof[tree + 1]):
        last[d], last[dofs + d] = memory[d], memory[dofs + d]
        memory[d] = memory[dofs + d] = 0.0
    for k in range(2 * dofs + tree_mimic[tree], 2 * dofs + tree_mimic[tree + 1]):
        last[k], memory[k] = memory[k], 0.0
    first, beyond = tree_shape[tree], tree_shape[tree + 1]
    if first == beyond:
        return
    features = 2 * dofs + mimics
    end = 3 * shape_feature[beyond] if beyond < shapes else integers[SLOTS] - 3 * integers[CONTACTS] - features
    for k in range(features + 3 * shape_feature[first], features + end):
        last[k], memory[k] = memory[k], 0.0


@inlined
def store_pair_impulses(floats: Any, integers: Any) -> None:
    """Move the impulses of contacts between pairs from ``memory`` to ``last``."""
    memory = field(floats, integers, At.memory)
    last = field(floats, integers, At.last)
    last_at = field(integers, integers, At.last_at)
    counts = field(integers, integers, At.counts)
    first = integers[SLOTS] - 3 * integers[CONTACTS]
    for j in range(counts[LAST_PAIRS]):
        slot = first + 3 * last_at[j]
        for k in range(slot, slot + 3):
            last[k], memory[k] = memory[k], 0.0


@inlined
def insert_pair(floats: Any, integers: Any, k: int) -> None:
    """Insert a stored contact of a pair into the sorted contacts of the last step."""
    last = field(floats, integers, At.last)
    last_a = field(integers, integers, At.last_a)
    last_b = field(integers, integers, At.last_b)
    last_feature = field(integers, integers, At.last_feature)
    last_at = field(integers, integers, At.last_at)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_impulse = field(floats, integers, At.contact_impulse)
    contact_point = field(floats, integers, At.contact_point)
    last_point = field(floats, integers, At.last_point)
    counts = field(integers, integers, At.counts)
    a, b = contact_shape[k], contact_against[k]
    j = counts[LAST_PAIRS]
    while j > 0 and (last_a[j - 1] > a or (last_a[j - 1] == a and last_b[j - 1] > b)):
        last_a[j], last_b[j] = last_a[j - 1], last_b[j - 1]
        last_feature[j], last_at[j] = last_feature[j - 1], last_at[j - 1]
        store_vector(last_point, j, load_vector(last_point, j - 1))
        j -= 1
    last_a[j], last_b[j], last_feature[j], last_at[j] = a, b, contact_feature[k], k
    store_vector(last_point, j, load_vector(contact_point, k))
    counts[LAST_PAIRS] += 1
    slot = integers[SLOTS] - 3 * integers[CONTACTS] + 3 * k
    last[slot] = contact_impulse[3 * k + 2]
    last[slot + 1], last[slot + 2] = contact_impulse[3 * k], contact_impulse[3 * k + 1]


@inlined
def copy_contact(floats: Any, integers: Any, k: int, to: int) -> None:
    """Copy a contact to another number."""
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_shape = field(integers, integers, At.contact_shape)
    contact_against = field(integers, integers, At.contact_against)
    contact_feature = field(integers, integers, At.contact_feature)
    contact_row = field(integers, integers, At.contact_row)
    contact_point = field(floats, integers, At.contact_point)
    contact_frame = field(floats, integers, At.contact_frame)
    contact_gap = field(floats, integers, At.contact_gap)
    contact_mu = field(floats, integers, At.contact_mu)
    contact_impulse = field(floats, integers, At.contact_impulse)
    contact_body[to], contact_other[to] = contact_body[k], contact_other[k]
    contact_shape[to], contact_against[to] = contact_shape[k], contact_against[k]
    contact_feature[to], contact_row[to] = contact_feature[k], contact_row[k]
    contact_gap[to], contact_mu[to] = contact_gap[k], contact_mu[k]
    store_vector(contact_point, to, load_vector(contact_point, k))
    store_rotation(contact_frame, to, load_rotation(contact_frame, k))
    store_vector(contact_impulse, to, load_vector(contact_impulse, k))
