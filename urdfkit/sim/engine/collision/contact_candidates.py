"""Contact candidates, and the reduction to the few that support the bodies."""

import math
from typing import Any

from urdfkit.sim.engine.collision.gjk import store_vector_at
from urdfkit.sim.engine.collision.support_points import vertex_at
from urdfkit.sim.engine.collision.workspace import FEATURE, GAP, MOST_CANDIDATES, NONE, NORMAL, POINT
from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.spatial_algebra import Vector, cross, dot, scale, store_vector, sub

MISSING = 0.2
"""Share of their area that a fifth contact must add to that of the four that are kept, or it is left out."""
COMMON = 1e-4
"""One minus the cosine of the angle between normals below which they count as one."""
SAME = 1e-3
"""How near two contacts must be, over the size of the shape, for one to repeat the other."""


@inlined
def add_candidate(
    count: int, point: Vector, normal: Vector, gap: float, feature: int, work: Any, work_indices: Any
) -> int:
    """Note a contact where there is room; return how many there are."""
    if count >= MOST_CANDIDATES:
        return count
    store_vector_at(work, POINT, count, point)
    store_vector_at(work, NORMAL, count, normal)
    work[GAP + count] = gap
    work_indices[FEATURE + count] = feature
    return count + 1


@inlined
def swap_candidates(k: int, to: int, work: Any, work_indices: Any) -> None:
    """Exchange two candidates."""
    point, normal, gap = vertex_at(work, POINT, k), vertex_at(work, NORMAL, k), work[GAP + k]
    store_vector_at(work, POINT, k, vertex_at(work, POINT, to))
    store_vector_at(work, NORMAL, k, vertex_at(work, NORMAL, to))
    store_vector_at(work, POINT, to, point)
    store_vector_at(work, NORMAL, to, normal)
    work[GAP + k], work[GAP + to] = work[GAP + to], gap
    at, other = FEATURE + k, FEATURE + to
    work_indices[at], work_indices[other] = work_indices[other], work_indices[at]


@compiled
def keep_widest(first: int, count: int, work: Any, work_indices: Any) -> int:
    """Keep, of the candidates from `first` on, four that span a wide area, one of them the deepest.

    All have nearly the same normal. Returns how many candidates there are then.
    """
    if count - first <= 4:
        return count
    normal = vertex_at(work, NORMAL, first)
    deepest = first
    for k in range(first + 1, count):
        if work[GAP + k] < work[GAP + deepest]:
            deepest = k
    if deepest != first:
        swap_candidates(deepest, first, work, work_indices)
    # The deepest is first now, and the three after it are chosen so that they span, with it, the widest area.
    p = vertex_at(work, POINT, first)
    best, most = first + 1, -1.0
    for k in range(first + 1, count):
        offset = sub(vertex_at(work, POINT, k), p)
        if dot(offset, offset) > most + 1e-12:
            best, most = k, dot(offset, offset)
    swap_candidates(best, first + 1, work, work_indices)
    along = sub(vertex_at(work, POINT, first + 1), p)
    side = cross(normal, along)
    area = 0.0
    for j in range(2, 4):
        sign = 1.0 if j == 2 else -1.0
        best, most = first + j, -math.inf
        for k in range(first + j, count):
            reach = sign * dot(side, sub(vertex_at(work, POINT, k), p))
            if reach > most + 1e-12:
                best, most = k, reach
        swap_candidates(best, first + j, work, work_indices)
        area += max(0.0, most)
    # The deepest may lie inside the widest area: then the corner it stands for comes back.
    left = first + 4
    best, most = -1, max(1e-12, MISSING * area)
    for k in range(left, count):
        q = vertex_at(work, POINT, k)
        gained = uncovered(first, q, normal, work)
        if gained > most:
            best, most = k, gained
    if best >= 0:
        swap_candidates(best, left, work, work_indices)
        left += 1
    return left


@inlined
def uncovered(first: int, q: Vector, normal: Vector, work: Any) -> float:
    """Return how much area a point adds to the quadrilateral of the first four candidates."""
    a, b = vertex_at(work, POINT, first), vertex_at(work, POINT, first + 1)
    c, d = vertex_at(work, POINT, first + 2), vertex_at(work, POINT, first + 3)
    # In order round: a, d, b, c (c is left of a to b, d right of it).
    gained = 0.0
    gained = max(gained, -dot(normal, cross(sub(d, a), sub(q, a))))
    gained = max(gained, -dot(normal, cross(sub(b, d), sub(q, d))))
    gained = max(gained, -dot(normal, cross(sub(c, b), sub(q, b))))
    return max(gained, -dot(normal, cross(sub(a, c), sub(q, c))))


@compiled
def keep_spread(count: int, most: int, reach: float, work: Any, work_indices: Any) -> int:
    """Keep the deepest candidate and those furthest from all kept, by place and by normal.

    Args:
        count: how many candidates there are.
        most: how many are kept at most.
        reach: distance [m] that counts as much as a difference of one between normals.
        work: working memory.
        work_indices: working memory.

    Returns:
        How many are kept; they come first.
    """
    if count == 0:
        return 0
    deepest = 0
    for k in range(1, count):
        if work[GAP + k] < work[GAP + deepest]:
            deepest = k
    swap_candidates(deepest, 0, work, work_indices)
    kept = 1
    while kept < min(count, most):
        best, furthest = kept, -1.0
        for k in range(kept, count):
            nearest = math.inf
            for j in range(kept):
                offset = sub(vertex_at(work, POINT, k), vertex_at(work, POINT, j))
                turn = scale(reach, sub(vertex_at(work, NORMAL, k), vertex_at(work, NORMAL, j)))
                nearest = min(nearest, dot(offset, offset) + dot(turn, turn))
            if nearest > furthest + 1e-12:
                best, furthest = k, nearest
        if furthest < SAME * SAME * reach * reach:
            # All other candidates repeat selected ones.
            break
        swap_candidates(best, kept, work, work_indices)
        kept += 1
    return kept


@compiled
def keep_few(count: int, most: int, reach: float, work: Any, work_indices: Any) -> int:
    """Keep the contacts with a mesh that hold a body: few where all have one normal; return how many."""
    count = keep_spread(count, count, reach, work, work_indices)
    for k in range(1, count):
        if dot(vertex_at(work, NORMAL, 0), vertex_at(work, NORMAL, k)) < 1.0 - COMMON:
            return keep_spread(count, most, reach, work, work_indices)
    return keep_widest(NONE, count, work, work_indices)


@inlined
def write(
    count: int,
    sign: float,
    work: Any,
    work_indices: Any,
    out_point: Any,
    out_normal: Any,
    out_gap: Any,
    out_feature: Any,
) -> None:
    """Write the first candidates to the outputs, the normals times `sign`."""
    for k in range(count):
        store_vector(out_point, k, vertex_at(work, POINT, k))
        store_vector(out_normal, k, scale(sign, vertex_at(work, NORMAL, k)))
        out_gap[k] = work[GAP + k]
        out_feature[k] = work_indices[FEATURE + k]
