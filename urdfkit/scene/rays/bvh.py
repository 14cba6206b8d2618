"""Bounding volume hierarchies: built with the binned surface area heuristic, refitted when boxes move.

Sources: Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies* (2007); MacDonald and Booth, *Heuristics
for ray tracing using space subdivision* (1990).
"""

from typing import Any

from urdfkit.scene.rays.compilation import compiled, inlined

BINS = 16
MAX_SAH_DEPTH = 40
"""Deeper nodes are split in half, so that no tree is deeper than `DEPTH`."""
DEPTH = 80
SCRATCH = BINS * 14 + 6 + 3 * DEPTH
"""Size of the scratch array of `build`."""


@inlined
def area(low_x: float, low_y: float, low_z: float, high_x: float, high_y: float, high_z: float) -> float:
    """Return half the surface area of a box; zero for an empty box."""
    x, y, z = max(high_x - low_x, 0.0), max(high_y - low_y, 0.0), max(high_z - low_z, 0.0)
    return x * y + y * z + z * x


def build(boxes: Any, order: Any, bounds: Any, links: Any, leaf: int, scratch: Any) -> int:
    """Build the tree over boxes; return its number of nodes.

    Args:
        boxes: lowest and highest corners; shape (n, 6), n > 0.
        order: output, the permutation of the boxes in the leaves; shape (n,).
        bounds: output, the boxes of the nodes; shape (≥ 2n - 1, 6).
        links: output; of a leaf, its first index in `order` and the number of boxes; of other nodes, the first of two
            consecutive children, and zero; shape (≥ 2n - 1, 2).
        leaf: maximum number of boxes per leaf, if their centres differ.
        scratch: shape (≥ `SCRATCH`,).
    """
    count = len(order)
    for k in range(count):
        order[k] = k
    links[0, 0], links[0, 1] = 0, count
    nodes, depth = 1, 0
    todo = BINS * 14 + 6  # stack of (node, depth) in the scratch
    scratch[todo], scratch[todo + 1] = 0.0, 0.0
    waiting = 1
    while waiting > 0:
        waiting -= 1
        node, depth = int(scratch[todo + 2 * waiting]), int(scratch[todo + 2 * waiting + 1])
        first, size = links[node, 0], links[node, 1]
        fit(boxes, order, first, size, bounds, node)
        if size <= leaf:
            continue
        middle = split(boxes, order, first, size, scratch) if depth < MAX_SAH_DEPTH else first
        if middle <= first or middle >= first + size:
            middle = first + size // 2  # too deep, or all centres are equal
        left = nodes
        nodes += 2
        links[left, 0], links[left, 1] = first, middle - first
        links[left + 1, 0], links[left + 1, 1] = middle, first + size - middle
        links[node, 0], links[node, 1] = left, 0
        for side in range(2):
            scratch[todo + 2 * waiting], scratch[todo + 2 * waiting + 1] = left + side, depth + 1
            waiting += 1
    return nodes


build_compiled = compiled(build)


@inlined
def fit(boxes: Any, order: Any, first: int, size: int, bounds: Any, node: int) -> None:
    """Fit the box of a node to its boxes."""
    for axis in range(3):
        low, high = boxes[order[first], axis], boxes[order[first], axis + 3]
        for k in range(first + 1, first + size):
            low = min(low, boxes[order[k], axis])
            high = max(high, boxes[order[k], axis + 3])
        bounds[node, axis], bounds[node, axis + 3] = low, high


@inlined
def split(boxes: Any, order: Any, first: int, size: int, scratch: Any) -> int:
    """Partition ``order[first:first + size]`` at the lowest expected cost; return the start of the second part."""
    best, best_axis, best_bin = 1e300, -1, 0
    spans = BINS * 14  # minimum and range of the centres per axis
    for axis in range(3):
        low, high = 1e300, -1e300
        for k in range(first, first + size):
            centre = boxes[order[k], axis] + boxes[order[k], axis + 3]
            low, high = min(low, centre), max(high, centre)
        scratch[spans + axis], scratch[spans + 3 + axis] = low, high - low
        if high - low <= 0.0:
            continue
        for b in range(BINS):
            at = b * 14
            scratch[at] = 0.0
            for c in range(3):
                scratch[at + 1 + c], scratch[at + 4 + c] = 1e300, -1e300
        for k in range(first, first + size):
            at = bin_of(boxes, order[k], axis, low, high - low) * 14
            scratch[at] += 1.0
            for c in range(3):
                scratch[at + 1 + c] = min(scratch[at + 1 + c], boxes[order[k], c])
                scratch[at + 4 + c] = max(scratch[at + 4 + c], boxes[order[k], c + 3])
        sweep(scratch)
        for b in range(1, BINS):
            left, right = (b - 1) * 14, b * 14
            if scratch[left + 7] > 0.0 and size - scratch[left + 7] > 0.0:
                cost = scratch[left + 8] * scratch[left + 7] + scratch[right + 9] * (size - scratch[left + 7])
                if cost < best:
                    best, best_axis, best_bin = cost, axis, b
    if best_axis < 0:
        return first
    low, spread = scratch[spans + best_axis], scratch[spans + 3 + best_axis]
    i, j = first, first + size - 1
    while i <= j:
        if bin_of(boxes, order[i], best_axis, low, spread) < best_bin:
            i += 1
        else:
            order[i], order[j] = order[j], order[i]
            j -= 1
    return i


@inlined
def bin_of(boxes: Any, item: int, axis: int, low: float, spread: float) -> int:
    """Return the bin that the centre of a box falls into."""
    centre = boxes[item, axis] + boxes[item, axis + 3]
    return min(BINS - 1, int(BINS * ((centre - low) / spread)))


@inlined
def sweep(scratch: Any) -> None:
    """Accumulate per bin: count up to it (7), area of the union up to it (8) and from it on (9)."""
    for way in range(2):
        x0 = y0 = z0 = 1e300
        x1 = y1 = z1 = -1e300
        total = 0.0
        for step in range(BINS):
            at = (step if way == 0 else BINS - 1 - step) * 14
            total += scratch[at]
            x0, y0, z0 = min(x0, scratch[at + 1]), min(y0, scratch[at + 2]), min(z0, scratch[at + 3])
            x1, y1, z1 = max(x1, scratch[at + 4]), max(y1, scratch[at + 5]), max(z1, scratch[at + 6])
            if way == 0:
                scratch[at + 7] = total
                scratch[at + 8] = area(x0, y0, z0, x1, y1, z1)
            else:
                scratch[at + 9] = area(x0, y0, z0, x1, y1, z1)


@compiled
def refit(boxes: Any, order: Any, bounds: Any, links: Any, nodes: int) -> float:
    """Refit the boxes of the nodes to moved boxes; return the sum of their areas, a measure of the casting cost."""
    total = 0.0
    for node in range(nodes - 1, -1, -1):
        first, size = links[node, 0], links[node, 1]
        if size > 0:
            fit(boxes, order, first, size, bounds, node)
        else:
            for axis in range(3):
                bounds[node, axis] = min(bounds[first, axis], bounds[first + 1, axis])
                bounds[node, axis + 3] = max(bounds[first, axis + 3], bounds[first + 1, axis + 3])
        total += area(
            bounds[node, 0], bounds[node, 1], bounds[node, 2], bounds[node, 3], bounds[node, 4], bounds[node, 5]
        )
    return total
