"""Which shapes are near each other: boxes along the axes of the world, swept along one of them.

The order in which the boxes begin is kept from step to step, so that sorting it again costs little, and boxes that
begin at the same place are in the order of their numbers: what is found depends on the boxes alone.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.pairs.faces import column
from urdfkit.sim.engine.pairs.mesh import bounds_in
from urdfkit.sim.engine.pairs.shapes import FIRST_BOUND, MESH, PLANE, vertex_at
from urdfkit.sim.engine.spatial import IDENTITY, ZERO, Vector, add, rotate, scale, store_vector, sub


@compiled
def shape_bounds(
    k: int,
    kind: int,
    size: Vector,
    R: Any,
    p: Vector,
    data: int,
    numbers: Any,
    indices: Any,
    margin: float,
    low: Any,
    high: Any,
) -> None:
    """Write the k-th box: the least and the largest coordinates of a shape, with a margin.

    Args:
        k: number of the shape.
        kind: of the shape, and so on, as for `collide_pair`.
        size: the same.
        R: the same.
        p: the same.
        data: the same.
        numbers: of hulls and meshes.
        indices: of hulls and meshes.
        margin: by which the box is wider on all sides [m].
        low: the least coordinates of all boxes, flat, three each.
        high: the largest.
    """
    if kind == PLANE:
        # A half-space ends somewhere only along the axis of the world it looks along.
        normal = column(R, 2)
        most = (math.inf, math.inf, math.inf)
        store_vector(low, k, scale(-1.0, most))
        store_vector(high, k, most)
        for axis in range(3):
            if normal[axis] == 1.0:
                high[3 * k + axis] = p[axis] + margin
            elif normal[axis] == -1.0:
                low[3 * k + axis] = p[axis] - margin
    elif kind == MESH:
        at = indices[data + FIRST_BOUND]
        first, last = vertex_at(numbers, at, 0), vertex_at(numbers, at, 1)
        half = scale(0.5, sub(last, first))
        centre = add(p, rotate(R, scale(0.5, add(first, last))))
        reach = (
            abs(R[0]) * half[0] + abs(R[1]) * half[1] + abs(R[2]) * half[2] + margin,
            abs(R[3]) * half[0] + abs(R[4]) * half[1] + abs(R[5]) * half[2] + margin,
            abs(R[6]) * half[0] + abs(R[7]) * half[1] + abs(R[8]) * half[2] + margin,
        )
        store_vector(low, k, sub(centre, reach))
        store_vector(high, k, add(centre, reach))
    else:
        box = bounds_in((kind, size, R, p, data), IDENTITY, ZERO, numbers, indices, margin)
        store_vector(low, k, (box[0], box[1], box[2]))
        store_vector(high, k, (box[3], box[4], box[5]))


@inlined
def begins_before(i: int, j: int, axis: int, low: Any) -> bool:
    """Return whether box i begins before box j."""
    a, b = low[3 * i + axis], low[3 * j + axis]
    return bool(a < b or (a == b and i < j))


@inlined
def overlap(i: int, j: int, low: Any, high: Any) -> bool:
    """Return whether two boxes meet."""
    return bool(
        low[3 * i] <= high[3 * j]
        and low[3 * j] <= high[3 * i]
        and low[3 * i + 1] <= high[3 * j + 1]
        and low[3 * j + 1] <= high[3 * i + 1]
        and low[3 * i + 2] <= high[3 * j + 2]
        and low[3 * j + 2] <= high[3 * i + 2]
    )


@inlined
def is_among(key: int, keys: Any) -> bool:
    """Return whether a sorted array holds a number."""
    first, beyond = 0, len(keys)
    while first < beyond:
        middle = (first + beyond) // 2
        if keys[middle] < key:
            first = middle + 1
        else:
            beyond = middle
    return bool(first < len(keys) and keys[first] == key)


@compiled
def find_pairs(
    count: int,
    axis: int,
    low: Any,
    high: Any,
    body: Any,
    is_static: Any,
    bodies: int,
    excluded: Any,
    order: Any,
    active: Any,
    pair_a: Any,
    pair_b: Any,
) -> int:
    """Find the pairs of shapes whose boxes meet; return how many there are, which may be more than there is room for.

    Args:
        count: how many shapes there are.
        axis: 0 to 2, along which the boxes are swept: best where they are most spread out.
        low: the least coordinates of their boxes, flat, three each.
        high: the largest.
        body: the body of each shape; shapes of one body are no pair.
        is_static: of each shape, not zero where its body never moves; two of these are no pair.
        bodies: how many bodies there are.
        excluded: pairs of bodies that may not collide, sorted: less · `bodies` + larger.
        order: working memory kept from call to call, at first 0, 1, 2, …
        active: working memory, one for each shape.
        pair_a: the smaller shape of each pair.
        pair_b: the larger.

    Returns:
        How many pairs there are; those that have no room are left out.
    """
    for k in range(1, count):
        shape = order[k]
        j = k - 1
        while j >= 0 and begins_before(shape, order[j], axis, low):
            order[j + 1] = order[j]
            j -= 1
        order[j + 1] = shape
    found = 0
    waiting = 0
    for k in range(count):
        shape = order[k]
        start = low[3 * shape + axis]
        left = 0
        for j in range(waiting):
            other = active[j]
            if high[3 * other + axis] < start:
                continue
            active[left] = other
            left += 1
            if (is_static[shape] and is_static[other]) or not overlap(shape, other, low, high):
                continue
            a, b = min(body[shape], body[other]), max(body[shape], body[other])
            if a == b or is_among(a * bodies + b, excluded):
                continue
            if found < len(pair_a):
                pair_a[found], pair_b[found] = min(shape, other), max(shape, other)
            found += 1
        active[left] = shape
        waiting = left + 1
    return found
