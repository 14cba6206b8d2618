"""Islands: trees that are connected by contacts and must be solved together."""

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld


@inlined
def root_of(w: KernelWorld, tree: int) -> int:
    """Return the first tree of an island, by one of its trees."""
    while w.island[tree] != tree:
        tree = w.island[tree]
    return tree


@compiled
def build_islands(w: KernelWorld, trees: int, contacts: int) -> None:
    """Sort trees and contacts into islands.

    Afterwards ``island[t] == t`` for the first tree of each island; ``island_next`` links its trees and
    ``island_contact`` with ``contact_next`` its contacts, in the order of their numbers, up to -1.
    """
    for tree in range(trees):
        w.island[tree] = tree
        w.island_next[tree] = w.island_contact[tree] = -1
    for k in range(contacts):
        if w.contact_other[k] >= 0:
            a = root_of(w, w.body_tree[w.contact_body[k]])
            b = root_of(w, w.body_tree[w.contact_other[k]])
            w.island[max(a, b)] = min(a, b)
    for tree in range(trees - 1, -1, -1):
        root = root_of(w, tree)
        if root != tree:
            w.island_next[tree] = w.island_next[root]
            w.island_next[root] = tree
    for k in range(contacts - 1, -1, -1):
        root = root_of(w, w.body_tree[w.contact_body[k]])
        w.contact_next[k] = w.island_contact[root]
        w.island_contact[root] = k


@inlined
def contact_count(w: KernelWorld, first: int) -> int:
    """Return how many contacts follow each other from the first on."""
    count = 0
    while first >= 0:
        count += 1
        first = w.contact_next[first]
    return count
