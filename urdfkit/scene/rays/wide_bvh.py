"""Trees with eight children per node, made from binary trees: a packet tests all children of a node at once.

Sources: Wald, Benthin and Boulos, *Getting Rid of Packets* (2008), and Dammertz, Hanika and Keller, *Shallow Bounding
Volume Hierarchies for Fast SIMD Ray Tracing* (2008).
"""

from typing import Any

from urdfkit.scene.rays.bvh import area
from urdfkit.scene.rays.compilation import compiled, inlined
from urdfkit.scene.rays.ray_packet import CHILDREN, FAR

BOXES = 6 * CHILDREN
"""Numbers of a node's boxes: lowest x of every child, lowest y …, highest z."""

NONE = -1
"""Marks a missing child."""


@inlined
def extent(bounds: Any, node: int) -> float:
    """Return half the surface area of a node's box."""
    return area(
        bounds[node, 0], bounds[node, 1], bounds[node, 2], bounds[node, 3], bounds[node, 4], bounds[node, 5]
    )  # fmt: skip


def widen(bounds: Any, links: Any, wide: Any, origins: Any) -> int:
    """Give every node up to eight children by replacing its largest descendants with their children.

    Args:
        bounds: boxes of the nodes with two children; shape (nodes, 6).
        links: as `bvh.build` leaves them; shape (nodes, 2).
        wide: output, per child: of a leaf, its first index in the order and the number of boxes; of other nodes, its
            node and zero; and its node in the binary tree, `NONE` for a missing child; shape (≥ nodes / 2, 8, 3).
        origins: scratch; shape (≥ nodes / 2,).

    Returns:
        The number of nodes.
    """
    origins[0], nodes, node = 0, 1, 0
    while node < nodes:
        for c in range(CHILDREN):
            wide[node, c, 0], wide[node, c, 1], wide[node, c, 2] = 0, 0, NONE
        wide[node, 0, 2] = origins[node]
        count = 1
        while count < CHILDREN:
            largest, most = NONE, -1.0
            for c in range(count):
                inner = wide[node, c, 2]
                if links[inner, 1] == 0 and extent(bounds, inner) > most:
                    largest, most = c, extent(bounds, inner)
            if largest == NONE:
                break
            first = links[wide[node, largest, 2], 0]
            wide[node, largest, 2], wide[node, count, 2] = first, first + 1
            count += 1
        for c in range(count):
            inner = wide[node, c, 2]
            wide[node, c, 0], wide[node, c, 1] = links[inner, 0], links[inner, 1]
            if links[inner, 1] == 0:
                wide[node, c, 0], origins[nodes] = nodes, inner
                nodes += 1
        node += 1
    return nodes


def fill(bounds: Any, wide: Any, nodes: int, boxes: Any) -> None:
    """Fill the boxes of all children; the boxes of missing children are empty.

    Args:
        bounds: boxes of the nodes with two children; shape (nodes, 6).
        wide: the tree.
        nodes: its number of nodes.
        boxes: output, the boxes of all children; shape (≥ nodes, `BOXES`).
    """
    for node in range(nodes):
        for c in range(CHILDREN):
            inner = wide[node, c, 2]
            for axis in range(3):
                boxes[node, CHILDREN * axis + c] = bounds[inner, axis] if inner != NONE else FAR
                boxes[node, CHILDREN * (axis + 3) + c] = bounds[inner, axis + 3] if inner != NONE else -FAR


widen_compiled = compiled(widen)
fill_compiled = compiled(fill)
