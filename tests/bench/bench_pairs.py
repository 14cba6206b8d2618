"""Time of one pair of shapes: ours within a compiled loop and called from Python, next to coal's called from Python.

    python tests/bench/bench_pairs.py

Shapes of 0.1 to 0.4 m that touch, or nearly do; the mesh has 1280 triangles. coal is asked for one contact, the most it
computes for these shapes; we find all that hold a body. Times are the least of five passes, taken in turn.
"""

from __future__ import annotations

import itertools
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import coal
import numpy as np
import trimesh

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.sim.engine.collision.pair_contacts import Placed, contacts
from urdfkit.sim.engine.collision.collide_pair import MOST, WORK, WORK_INDICES, collide_pair
from urdfkit.sim.engine.collision.convex_hull import convex_hull
from urdfkit.sim.engine.collision.geometry_arrays import Geometry
from urdfkit.sim.engine.collision.support_points import BOX, CAPSULE, CYLINDER, HULL, MESH, SPHERE
from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.math.spatial_algebra import load_rotation, load_vector

PLACES, PASSES, MARGIN = 1000, 5, 0.002
NAMES = {SPHERE: "sphere", BOX: "box", CYLINDER: "cylinder", CAPSULE: "capsule", HULL: "hull", MESH: "mesh"}


@compiled
def collide_all(
    kinds: Any,
    sizes: Any,
    Rs: Any,
    ps: Any,
    data: Any,
    numbers: Any,
    indices: Any,
    margin: float,
    out: Any,
    counts: Any,
) -> int:
    """Collide the pairs one after the other; return how many contacts there are."""
    work, work_indices, points, normals, gaps, features = out
    total = 0
    for k in range(len(ps) // 6):
        count = collide_pair(
            kinds[0],
            load_vector(sizes, 2 * k),
            load_rotation(Rs, 2 * k),
            load_vector(ps, 2 * k),
            data[0],
            kinds[1],
            load_vector(sizes, 2 * k + 1),
            load_rotation(Rs, 2 * k + 1),
            load_vector(ps, 2 * k + 1),
            data[1],
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
        counts[k] = count
        total += count
    return total


def turns(rng: np.random.Generator, count: int) -> np.ndarray:
    """Return random rotations."""
    Q, _ = np.linalg.qr(rng.normal(size=(count, 3, 3)))
    Q[:, :, 0] *= np.linalg.det(Q)[:, None]
    return Q


def seconds(run: Callable[[], Any]) -> float:
    """Return the CPU seconds of a call."""
    start = time.process_time()
    run()
    return time.process_time() - start


def main() -> None:
    """Print a line for each pair of kinds."""
    rng = np.random.default_rng(0)
    geometry = Geometry()
    cloud = convex_hull(rng.normal(size=(60, 3)) * 0.12)
    ball = trimesh.creation.icosphere(3, 0.3)
    data = {HULL: geometry.add_hull(cloud), MESH: geometry.add_mesh(ball.triangles)}
    numbers, indices = geometry.numbers, geometry.indices
    points = coal.StdVec_Vec3s()
    for vertex in cloud.vertices:
        points.append(vertex)
    hull = coal.Convex.convexHull(points, False, None)
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(ball.faces), 3 * len(ball.faces))
    for corners in ball.triangles:
        mesh.addTriangle(*corners)
    mesh.endModel()
    make: dict[int, Callable[[np.ndarray], Any]] = {
        SPHERE: lambda s: coal.Sphere(s[0]),
        BOX: lambda s: coal.Box(*(2.0 * s)),
        CYLINDER: lambda s: coal.Cylinder(s[0], 2.0 * s[1]),
        CAPSULE: lambda s: coal.Capsule(s[0], 2.0 * s[1]),
        HULL: lambda _: hull,
        MESH: lambda _: mesh,
    }
    out = (
        np.zeros(WORK),
        np.zeros(WORK_INDICES, dtype=np.int64),
        np.zeros(3 * MOST),
        np.zeros(3 * MOST),
        np.zeros(MOST),
        np.zeros(MOST, dtype=np.int64),
    )
    counts = np.zeros(PLACES, dtype=np.int64)
    print("µs per pair          touching  contacts  in a loop  from Python  coal from Python  coal / in a loop")
    for kinds in itertools.combinations_with_replacement(NAMES, 2):
        if kinds[0] == MESH:
            continue
        sizes, Rs = rng.uniform(0.1, 0.4, (PLACES, 2, 3)), turns(rng, 2 * PLACES).reshape(PLACES, 2, 3, 3)
        ps = np.zeros((PLACES, 2, 3))
        away = rng.normal(size=(PLACES, 3))
        ps[:, 0] = 1.5 * away / np.linalg.norm(away, axis=1)[:, None]
        for k in range(PLACES):
            # Brought together until they overlap by up to 5 mm, or are up to as far apart.
            a, b = (Placed(kinds[j], tuple(sizes[k, j]), Rs[k, j], ps[k, j], data.get(kinds[j], 0)) for j in (0, 1))
            found = contacts(a, b, margin=10.0, geometry=geometry)
            nearest = np.argmin(found.gaps)
            ps[k, 0] -= (found.gaps[nearest] + rng.uniform(-0.005, 0.005)) * found.normals[nearest]
        places = (np.array(kinds), sizes.ravel(), Rs.ravel(), ps.ravel(), np.array([data.get(k, 0) for k in kinds]))
        shapes = [(make[kinds[0]](s[0]), make[kinds[1]](s[1])) for s in sizes]
        frames = [(coal.Transform3s(R[0], p[0]), coal.Transform3s(R[1], p[1])) for R, p in zip(Rs, ps, strict=True)]
        rows = [
            [(k, tuple(s.tolist()), tuple(R.ravel().tolist()), tuple(p.tolist()), data.get(k, 0)) for k, s, R, p in one]
            for one in (zip(kinds, *parts, strict=True) for parts in zip(sizes, Rs, ps, strict=True))
        ]
        request = coal.CollisionRequest(coal.CollisionRequestFlag.CONTACT, 1)
        request.security_margin = MARGIN

        def loop(places: Any = places) -> None:
            collide_all(*places, numbers, indices, MARGIN, out, counts)

        def singly(rows: Any = rows) -> None:
            for a, b in rows:
                collide_pair(*a, *b, numbers, indices, MARGIN, *out)

        def peer(shapes: Any = shapes, frames: Any = frames, request: Any = request) -> None:
            for (a, b), (at_a, at_b) in zip(shapes, frames, strict=True):
                coal.collide(a, at_a, b, at_b, request, coal.CollisionResult())

        loop()
        singly()
        times = np.array([[seconds(run) for run in (loop, singly, peer)] for _ in range(PASSES)]).min(axis=0)
        times *= 1e6 / PLACES
        name = f"{NAMES[kinds[0]]}-{NAMES[kinds[1]]}"
        touching = np.count_nonzero(counts) / PLACES
        each = counts.sum() / max(1, np.count_nonzero(counts))
        print(
            f"{name:20s} {touching:8.0%} {each:9.1f} {times[0]:10.2f} {times[1]:12.2f} {times[2]:17.2f}"
            f" {times[2] / times[0]:17.1f}"
        )


if __name__ == "__main__":
    main()
