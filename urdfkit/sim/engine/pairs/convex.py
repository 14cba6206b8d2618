"""Contacts of two convex shapes of any kind."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.pairs.epa import depth
from urdfkit.sim.engine.pairs.gjk import APART, FAR, distance
from urdfkit.sim.engine.pairs.manifold import spread
from urdfkit.sim.engine.pairs.shapes import radius_of
from urdfkit.sim.engine.spatial import Vector, dot, scale, sub


@compiled
def nearest(
    a: Any, b: Any, numbers: Any, indices: Any, limit: float, work: Any, work_indices: Any
) -> tuple[bool, Vector, float, Vector]:
    """Find the normal and the gap of two cores.

    Args:
        a: the first shape: kind, size, rotation, centre, data.
        b: the second.
        numbers: of hulls and meshes.
        indices: of hulls and meshes.
        limit: gap beyond which nothing is found [m].
        work: working memory.
        work_indices: working memory.

    Returns:
        Whether they are nearer than the limit, the unit normal from b to a, the gap [m], and the point half-way [m].
    """
    state, count, apart, on_a = distance(a, b, numbers, indices, limit, work)
    if state == FAR:
        return False, apart, limit, on_a
    if state == APART:
        gap = math.sqrt(dot(apart, apart))
        normal = scale(1.0 / gap, apart)
    else:
        normal, apart, on_a = depth(count, a, b, numbers, indices, work, work_indices)
        gap = dot(normal, apart)
    return gap < limit, normal, gap, sub(on_a, scale(0.5, apart))


@compiled
def collide_convex(
    count: int, a: Any, b: Any, numbers: Any, indices: Any, margin: float, feature: int, work: Any, work_indices: Any
) -> int:
    """Note the contacts of two convex shapes; return how many candidates there are then."""
    limit = margin + radius_of(a[0], a[1]) + radius_of(b[0], b[1])
    near, normal, gap, between = nearest(a, b, numbers, indices, limit, work, work_indices)
    if not near:
        return count
    return spread(count, a, b, numbers, indices, normal, gap, between, near, margin, feature, work, work_indices)
