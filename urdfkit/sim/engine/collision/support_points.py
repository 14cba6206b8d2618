"""The convex shapes and their support points, for the compiled kernel.

A shape is a core and a radius round it: a sphere is a point, a capsule a segment, each with its radius; box, cylinder,
hull and triangle are their own cores with radius zero. Results for the cores are valid for the shapes after the radii
are subtracted from the gap.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.math.spatial_algebra import Vector, add, rotate

SPHERE, BOX, CYLINDER, WHEEL, CAPSULE, HULL, PLANE, MESH, TRIANGLE = range(9)
"""Kinds of shape. Sizes: radius; half edges; radius and half length (three times); none for the rest.

A wheel is a cylinder that touches in the middle of its rim. A capsule's half length is that of the segment between the
centres of its caps. A plane is the half-space below the z axis of its placement. A hull or mesh is found by its `data`
(see `geometry`); a triangle is one of a mesh, and its `data` is where its three vertices start among the numbers.
"""

VERTICES, FIRST_VERTEX, FACES, FIRST_NORMAL, FIRST_LOOP, FIRST_CORNER = range(6)
"""Entries of the head of a hull among the indices."""
TRIANGLES, FIRST_TRIANGLE, LEAVES, FIRST_BOUND, FIRST_FLAG = range(5)
"""Entries of the head of a mesh among the indices."""


@inlined
def unrotate(R: Any, a: Vector) -> Vector:
    """Return Rᵀ·a."""
    return (
        R[0] * a[0] + R[3] * a[1] + R[6] * a[2],
        R[1] * a[0] + R[4] * a[1] + R[7] * a[2],
        R[2] * a[0] + R[5] * a[1] + R[8] * a[2],
    )


@inlined
def radius_of(kind: int, size: Vector) -> float:
    """Return the radius of a shape round its core."""
    return size[0] if kind in (SPHERE, CAPSULE) else 0.0


@inlined
def vertex_at(numbers: Any, first: int, k: int) -> Vector:
    """Return the k-th of the vectors that start at `first`."""
    return (numbers[first + 3 * k], numbers[first + 3 * k + 1], numbers[first + 3 * k + 2])


@compiled
def support(
    kind: int, size: Vector, R: Any, p: Vector, data: int, numbers: Any, indices: Any, direction: Vector
) -> Vector:
    """Return the point of a convex shape's core that lies furthest in a direction (any length)."""
    d = unrotate(R, direction)
    if kind == BOX:
        local = (
            size[0] if d[0] >= 0.0 else -size[0],
            size[1] if d[1] >= 0.0 else -size[1],
            size[2] if d[2] >= 0.0 else -size[2],
        )
    elif kind in (CYLINDER, WHEEL):
        level = math.sqrt(d[0] * d[0] + d[1] * d[1])
        reach = size[0] / level if level > 0.0 else 0.0
        local = (reach * d[0], reach * d[1], size[1] if d[2] >= 0.0 else -size[1])
    elif kind == CAPSULE:
        local = (0.0, 0.0, size[1] if d[2] >= 0.0 else -size[1])
    elif kind in (HULL, TRIANGLE):
        first, count = data, 3
        if kind == HULL:
            first, count = indices[data + FIRST_VERTEX], indices[data + VERTICES]
        local = vertex_at(numbers, first, 0)
        most = d[0] * local[0] + d[1] * local[1] + d[2] * local[2]
        for k in range(1, count):
            vertex = vertex_at(numbers, first, k)
            reach = d[0] * vertex[0] + d[1] * vertex[1] + d[2] * vertex[2]
            if reach > most:
                most, local = reach, vertex
    else:
        local = (0.0, 0.0, 0.0)
    return add(p, rotate(R, local))
