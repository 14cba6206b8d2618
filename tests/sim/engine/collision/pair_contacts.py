"""The contacts of one pair of shapes, asked for from Python."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from urdfkit.sim.engine.collision.collide_pair import MOST, WORK, WORK_INDICES, collide_pair
from urdfkit.sim.engine.collision.geometry_arrays import Geometry

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A shape at its place.

    Attributes:
        kind: `support_points.SPHERE` and so on.
        size: [m], see `support_points`.
        R: its rotation, shape (3, 3).
        p: its centre [m], shape (3,).
        data: of a hull or mesh, what `Geometry` returned.
    """

    kind: int
    size: tuple[float, float, float] = (0.0, 0.0, 0.0)
    R: Array = field(default_factory=lambda: np.eye(3))
    p: Array = field(default_factory=lambda: np.zeros(3))
    data: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """What `collide_pair` found.

    Attributes:
        points: half-way between the surfaces [m], shape (n, 3).
        normals: unit vectors from the second shape to the first, shape (n, 3).
        gaps: along the normals [m], negative where the shapes overlap, shape (n,).
        features: what touches, shape (n,).
    """

    points: Array
    normals: Array
    gaps: Array
    features: NDArray[np.int64]

    def __len__(self) -> int:
        """Return how many contacts there are."""
        return len(self.gaps)


def contacts(a: Placed, b: Placed, *, margin: float = 0.0, geometry: Geometry | None = None) -> Contacts:
    """Return the contacts of two shapes whose gap is below a margin.

    Args:
        a: the first shape.
        b: the second.
        margin: [m].
        geometry: where their hulls and meshes are.
    """
    geometry = geometry or Geometry()
    points, normals, gaps = np.zeros(3 * MOST), np.zeros(3 * MOST), np.zeros(MOST)
    features = np.zeros(MOST, dtype=np.int64)
    numbers, indices = geometry.numbers, geometry.indices
    work, work_indices = np.zeros(WORK), np.zeros(WORK_INDICES, dtype=np.int64)
    shapes = [(s.kind, s.size, tuple(s.R.ravel().tolist()), tuple(s.p.tolist()), s.data) for s in (a, b)]
    count = collide_pair(
        *shapes[0],
        *shapes[1],
        numbers,
        indices,
        margin,
        work,
        work_indices,
        points,
        normals,
        gaps,
        features,
    )
    return Contacts(points.reshape(-1, 3)[:count], normals.reshape(-1, 3)[:count], gaps[:count], features[:count])
