"""The contacts of one pair of shapes, asked for from Python."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.sim.engine.collision.collide_pair import MOST, WORK, WORK_INDICES, collide_pair
from urdfkit.sim.engine.collision.geometry_arrays import Geometry
from urdfkit.sim.engine.kernel_cache import Kernel, load_compiled, world_digest

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


def pair(
    a: Any, b: Any, kinds: Any, geometry: Any, head: Any, work: Any, integers: Any, out: Any, features: Any
) -> int:
    """Call `collide_pair`; each of `a` and `b` is size, rotation and place of a shape, and the margin follows `b`."""
    return collide_pair(
        kinds[0],
        (a[0], a[1], a[2]),
        (a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]),
        (a[12], a[13], a[14]),
        kinds[1],
        kinds[2],
        (b[0], b[1], b[2]),
        (b[3], b[4], b[5], b[6], b[7], b[8], b[9], b[10], b[11]),
        (b[12], b[13], b[14]),
        kinds[3],
        geometry,
        head,
        b[15],
        work,
        integers,
        out[: 3 * MOST],
        out[3 * MOST : 6 * MOST],
        out[6 * MOST :],
        features,
    )


@cache
def compiled_pair() -> Kernel:
    """Return `pair`, compiled once per machine: compiling takes 25 s of CPU time."""
    floats, integers = "floats", "integers"
    arguments = (floats, floats, integers, floats, integers, floats, integers, floats, integers)
    return load_compiled(pair, arguments, digest=world_digest())


def contacts(a: Placed, b: Placed, *, margin: float = 0.0, geometry: Geometry | None = None) -> Contacts:
    """Return the contacts of two shapes whose gap is below a margin.

    Args:
        a: the first shape.
        b: the second.
        margin: [m].
        geometry: where their hulls and meshes are.
    """
    geometry = geometry or Geometry()
    out, features = np.zeros(7 * MOST), np.zeros(MOST, dtype=np.int64)
    places = [np.array([*s.size, *s.R.ravel(), *s.p, margin]) for s in (a, b)]
    kinds = np.array([a.kind, a.data, b.kind, b.data])
    work, work_indices = np.zeros(WORK), np.zeros(WORK_INDICES, dtype=np.int64)
    count = compiled_pair()(*places, kinds, geometry.numbers, geometry.indices, work, work_indices, out, features)
    points, normals, gaps = np.split(out, [3 * MOST, 6 * MOST])
    return Contacts(points.reshape(-1, 3)[:count], normals.reshape(-1, 3)[:count], gaps[:count], features[:count])
