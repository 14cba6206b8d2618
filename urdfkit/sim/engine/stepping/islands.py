"""Islands: trees that are connected by contacts and must be solved together."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import compiled, field, inlined


@inlined
def root_of(floats: Any, integers: Any, tree: int) -> int:
    """Return the first tree of an island, by one of its trees."""
    island = field(integers, integers, At.island)
    while island[tree] != tree:
        tree = island[tree]
    return tree


@compiled
def build_islands(floats: Any, integers: Any, trees: int, contacts: int) -> None:
    """Sort trees and contacts into islands.

    Afterwards ``island[t] == t`` for the first tree of each island; ``island_next`` links its trees and
    ``island_contact`` with ``contact_next`` its contacts, in the order of their numbers, up to -1.
    """
    body_tree = field(integers, integers, At.body_tree)
    contact_body = field(integers, integers, At.contact_body)
    contact_other = field(integers, integers, At.contact_other)
    contact_next = field(integers, integers, At.contact_next)
    island = field(integers, integers, At.island)
    island_next = field(integers, integers, At.island_next)
    island_contact = field(integers, integers, At.island_contact)
    for tree in range(trees):
        island[tree] = tree
        island_next[tree] = island_contact[tree] = -1
    for k in range(contacts):
        if contact_other[k] >= 0:
            a = root_of(floats, integers, body_tree[contact_body[k]])
            b = root_of(floats, integers, body_tree[contact_other[k]])
            island[max(a, b)] = min(a, b)
    for tree in range(trees - 1, -1, -1):
        root = root_of(floats, integers, tree)
        if root != tree:
            island_next[tree] = island_next[root]
            island_next[root] = tree
    for k in range(contacts - 1, -1, -1):
        root = root_of(floats, integers, body_tree[contact_body[k]])
        contact_next[k] = island_contact[root]
        island_contact[root] = k


@inlined
def contact_count(floats: Any, integers: Any, first: int) -> int:
    """Return how many contacts follow each other from the first on."""
    contact_next = field(integers, integers, At.contact_next)
    count = 0
    while first >= 0:
        count += 1
        first = contact_next[first]
    return count
