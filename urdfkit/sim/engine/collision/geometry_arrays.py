"""Hulls and meshes in the two flat arrays that the compiled functions read."""

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.sim.engine.collision.convex_hull import Hull
from urdfkit.sim.engine.collision.convex_mesh import LEAF, ONE_SIDED

Indices = NDArray[np.int64]

CONCAVE = 1e-6
"""Height over length above which a neighbouring triangle is above, or below, another's plane."""


class Geometry:
    """Hulls and meshes, added one by one.

    `add_hull` and `add_mesh` return the `data` of the shape, by which compiled functions find it.
    """

    def __init__(self) -> None:
        """Start empty."""
        self._numbers: list[Array] = [np.zeros(1)]
        self._indices: list[Indices] = [np.zeros(1, dtype=np.int64)]

    @property
    def numbers(self) -> Array:
        """All floats, one after the other; never empty."""
        return np.concatenate(self._numbers)

    @property
    def indices(self) -> Indices:
        """All integers, one after the other; never empty."""
        return np.concatenate(self._indices)

    def _next_number(self) -> int:
        return sum(len(part) for part in self._numbers)

    def _next_index(self) -> int:
        return sum(len(part) for part in self._indices)

    def add_hull(self, hull: Hull) -> int:
        """Add a hull (see `convex_hull.convex_hull`); return its `data`."""
        at, first = self._next_index(), self._next_number()
        loops = np.cumsum([0, *(len(face) for face in hull.faces)])
        head = [len(hull.vertices), first, len(hull.faces), first + hull.vertices.size, at + 6, at + 6 + len(loops)]
        corners = [vertex for face in hull.faces for vertex in face]
        self._numbers += [hull.vertices.ravel(), hull.normals.ravel()]
        self._indices.append(np.array([*head, *loops, *corners], dtype=np.int64))
        return at

    def add_mesh(self, triangles: Array) -> int:
        """Add a mesh; return its `data`.

        Args:
            triangles: corners [m], shape (n, 3, 3), counter-clockwise seen from outside.
        """
        triangles = np.asarray(triangles, dtype=float).reshape(-1, 3, 3)
        triangles = triangles[along_a_curve(triangles.mean(axis=1))]
        bounds = tree(triangles)
        at, first = self._next_index(), self._next_number()
        head = [len(triangles), first, (len(bounds) + 1) // 2, first + triangles.size, at + 5]
        self._numbers += [triangles.ravel(), bounds.ravel()]
        self._indices.append(np.concatenate([np.array(head, dtype=np.int64), flags(triangles)]))
        return at


def along_a_curve(points: Array) -> Indices:
    """Return the order of points along a space-filling curve, in which neighbours lie close (Morton's)."""
    low = points.min(axis=0)
    size = float(np.max(np.ptp(points, axis=0))) or 1.0
    cells = ((points - low) / size * 1023.0).astype(np.int64)
    codes = np.zeros(len(points), dtype=np.int64)
    for bit in range(10):
        for axis in range(3):
            codes |= ((cells[:, axis] >> bit) & 1) << (3 * bit + axis)
    return np.argsort(codes, kind="stable").astype(np.int64)


def tree(triangles: Array) -> Array:
    """Return the boxes of a binary tree whose leaves are so many triangles each, in their order.

    Node k has the children 2k + 1 and 2k + 2; the leaves, a power of two, come last. An empty box is inside out.
    """
    leaves = 1
    while leaves * LEAF < len(triangles):
        leaves *= 2
    bounds = np.empty((2 * leaves - 1, 6))
    bounds[:, :3], bounds[:, 3:] = np.inf, -np.inf
    for k in range(LEAF):
        part = triangles[k::LEAF]
        own = bounds[leaves - 1 : leaves - 1 + len(part)]
        own[:, :3] = np.minimum(own[:, :3], part.min(axis=1))
        own[:, 3:] = np.maximum(own[:, 3:], part.max(axis=1))
    level = leaves
    while level > 1:
        children = bounds[level - 1 : 2 * level - 1]
        parents = bounds[level // 2 - 1 : level - 1]
        parents[:, :3] = np.minimum(children[::2, :3], children[1::2, :3])
        parents[:, 3:] = np.maximum(children[::2, 3:], children[1::2, 3:])
        level //= 2
    return bounds


def flags(triangles: Array) -> Indices:
    """Return of each triangle which of its edges can be hit, and whether only its outer side can be.

    An edge that joins two triangles into one plane cannot be hit, nor can one in a hollow of a closed mesh.
    """
    count = len(triangles)
    _, names = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    corners = names.reshape(count, 3)
    starts, ends = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    order = np.lexsort((high, low))
    changes = np.flatnonzero((np.diff(low[order]) != 0) | (np.diff(high[order]) != 0)) + 1
    groups = np.split(order, changes)
    is_closed = all(len(group) == 2 and starts[group[0]] == ends[group[1]] for group in groups)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals = normals / np.where(lengths > 0.0, lengths, 1.0)[:, None]
    if is_closed:
        # Seen from inside, a mesh whose faces look in is as closed as one whose faces look out.
        volume = float(np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])))
        is_closed = volume > 0.0
    found = np.full(count, 7 | (ONE_SIDED if is_closed else 0), dtype=np.int64)
    for group in groups:
        if len(group) != 2:
            continue
        for edge, other in ((group[0], group[1]), (group[1], group[0])):
            triangle, neighbour = edge // 3, other // 3
            apex = triangles[neighbour][(other % 3 + 2) % 3]
            away = apex - triangles[triangle][edge % 3]
            height = matmul(normals[triangle], away) / (vector_norm(away) or 1.0)
            if abs(height) <= CONCAVE or (is_closed and height > 0.0):
                found[triangle] &= ~(1 << int(edge % 3))
    return found
