"""The contacts of a pair of shapes, whatever they are."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.pairs.shapes import SPHERE
from urdfkit.sim.engine.spatial import Vector, add, dot, scale, store_vector, sub

MOST = 8
"""Most contacts of one pair; the outputs have room for so many."""
WORK, WORK_INDICES = 4096, 1024
"""Floats and integers of working memory, which the caller allocates once."""


@compiled
def collide_pair(
    kind_a: int,
    size_a: Vector,
    R_a: Any,
    p_a: Vector,
    data_a: int,
    kind_b: int,
    size_b: Vector,
    R_b: Any,
    p_b: Vector,
    data_b: int,
    numbers: Any,
    indices: Any,
    margin: float,
    work: Any,
    work_indices: Any,
    out_point: Any,
    out_normal: Any,
    out_gap: Any,
    out_feature: Any,
) -> int:
    """Find the contacts of two shapes whose gap is below `margin`; return how many.

    Args:
        kind_a: kind of the first shape (`shapes.SPHERE` and so on).
        size_a: its sizes [m].
        R_a: its rotation, nine numbers row by row.
        p_a: its centre [m].
        data_a: where the head of its hull or mesh is among `indices`; any number for other shapes.
        kind_b: the same of the second shape.
        size_b: the same.
        R_b: the same.
        p_b: the same.
        data_b: the same.
        numbers: vertices and so on of all hulls and meshes (`geometry.Geometry`).
        indices: their heads and so on.
        margin: gap below which a contact is found [m].
        work: working memory, `WORK` floats.
        work_indices: working memory, `WORK_INDICES` integers.
        out_point: flat, three each: half-way between the two surfaces [m].
        out_normal: flat, three each: unit vectors from b to a.
        out_gap: distance along the normal [m], negative where the shapes overlap.
        out_feature: number of what touches; it stays as long as the same parts touch, and is below 2⁴⁰.

    Returns:
        How many contacts, at most `MOST`.
    """
    if kind_a == SPHERE and kind_b == SPHERE:
        return sphere_sphere(p_a, size_a[0], p_b, size_b[0], margin, out_point, out_normal, out_gap, out_feature)
    return 0


@inlined
def unit_or(a: Vector, otherwise: Vector) -> Vector:
    """Return the direction of a vector, or another one when it has none."""
    square = dot(a, a)
    return scale(square**-0.5, a) if square > 1e-300 else otherwise


@inlined
def sphere_sphere(
    p_a: Vector,
    radius_a: float,
    p_b: Vector,
    radius_b: float,
    margin: float,
    out_point: Any,
    out_normal: Any,
    out_gap: Any,
    out_feature: Any,
) -> int:
    """Find the contact of two spheres; of concentric ones the normal is up."""
    normal = unit_or(sub(p_a, p_b), (0.0, 0.0, 1.0))
    gap = dot(normal, sub(p_a, p_b)) - radius_a - radius_b
    if gap >= margin:
        return 0
    store_vector(out_normal, 0, normal)
    store_vector(out_point, 0, add(p_b, scale(radius_b + 0.5 * gap, normal)))
    out_gap[0], out_feature[0] = gap, 0
    return 1
