"""Distances, depths and normals of thousands of random places, next to coal's and in closed form."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import coal
import numpy as np
import pytest
import trimesh

from tests.sim.engine.collision.pair_contacts import Contacts, Placed, contacts
from urdfkit.sim.engine.collision.convex_hull import convex_hull
from urdfkit.sim.engine.collision.geometry_arrays import Geometry
from urdfkit.sim.engine.collision.support_points import BOX, CAPSULE, CYLINDER, HULL, MESH, PLANE, SPHERE

CONVEX = [SPHERE, BOX, CYLINDER, CAPSULE, HULL]
PLACES = 1000
EXACT = 1e-6
"""The distance both agree to [m]; coal's search for a cylinder's ends some 1e-7 short of it."""
HULLS = Geometry()
_rng = np.random.default_rng(11)
_clouds = [convex_hull(_rng.normal(size=(30, 3)) * _rng.uniform(0.05, 0.2, 3)) for _ in range(8)]
HULL_DATA = [(HULLS.add_hull(hull), hull.vertices) for hull in _clouds]
TORUS = trimesh.creation.torus(0.5, 0.15, major_sections=24, minor_sections=12).triangles
TORUS_DATA = HULLS.add_mesh(TORUS)


def turn(rng: np.random.Generator) -> np.ndarray:
    Q, R = np.linalg.qr(rng.normal(size=(3, 3)))
    Q = Q * np.sign(np.diag(R))
    return np.asarray(Q if np.linalg.det(Q) > 0.0 else -Q)


def any_shape(kind: int, rng: np.random.Generator, reach: float) -> tuple[Placed, object]:
    """A shape of a kind, anywhere, and coal's."""
    x, y, z = (float(s) for s in rng.uniform(0.05, 0.4, 3))
    R, p = turn(rng), rng.uniform(-reach, reach, 3)
    if kind == HULL:
        data, vertices = HULL_DATA[rng.integers(len(HULL_DATA))]
        points = coal.StdVec_Vec3s()
        for vertex in vertices:
            points.append(vertex)
        return Placed(kind, (0.0, 0.0, 0.0), R, p, data), coal.Convex.convexHull(points, False, None)
    make: dict[int, Callable[[], object]] = {
        SPHERE: lambda: coal.Sphere(x),
        BOX: lambda: coal.Box(2.0 * x, 2.0 * y, 2.0 * z),
        CYLINDER: lambda: coal.Cylinder(x, 2.0 * y),
        CAPSULE: lambda: coal.Capsule(x, 2.0 * y),
    }
    return Placed(kind, (x, y, z), R, p), make[kind]()


def coal_distance(a: Placed, shape_a: object, b: Placed, shape_b: object) -> tuple[float, np.ndarray]:
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.gjk_tolerance = request.epa_tolerance = 1e-8
    request.gjk_max_iterations, request.epa_max_iterations = 200, 300
    distance = coal.distance(shape_a, coal.Transform3s(a.R, a.p), shape_b, coal.Transform3s(b.R, b.p), request, result)
    return float(distance), -np.array(result.normal)


def reach(placed: Placed, direction: np.ndarray) -> float:
    """How far a shape reaches in a direction: its support function, written down anew."""
    d = placed.R.T @ direction
    x, y, z = placed.size
    level = math.hypot(d[0], d[1])
    local = {
        SPHERE: lambda: x * float(np.linalg.norm(d)),
        BOX: lambda: float(np.abs(d) @ [x, y, z]),
        CYLINDER: lambda: x * level + y * abs(d[2]),
        CAPSULE: lambda: x * float(np.linalg.norm(d)) + y * abs(d[2]),
        HULL: lambda: float(max(dict(HULL_DATA)[placed.data] @ d)),
    }[placed.kind]()
    return float(direction @ placed.p) + local


def separation(a: Placed, b: Placed, normal: np.ndarray) -> float:
    """The gap of two shapes along a normal from b to a: no true gap is less, and the least depth is the true one."""
    return -reach(a, -normal) - reach(b, normal)


def check(found: Contacts, a: Placed, b: Placed) -> None:
    deepest = int(np.argmin(found.gaps))
    normal = found.normals[deepest]
    assert np.linalg.norm(found.normals, axis=1) == pytest.approx(np.ones(len(found)), abs=1e-12)
    # The gap is that of the two shapes along the normal, by their support functions.
    assert found.gaps[deepest] == pytest.approx(separation(a, b, normal), abs=EXACT)
    for point, gap in zip(found.points, found.gaps, strict=True):
        # A point half-way is within half the gap of either shape's reach.
        for shape, sign in ((a, -1.0), (b, 1.0)):
            assert (
                sign * float(point @ normal) + 0.5 * min(gap, 0.0)
                <= reach(shape, sign * normal) + max(gap, 0.0) + EXACT
            )


@pytest.mark.slow
@pytest.mark.parametrize(("kind_a", "kind_b"), list(itertools.combinations_with_replacement(CONVEX, 2)))
def test_gap_and_normal_are_those_of_coal(kind_a: int, kind_b: int) -> None:
    rng = np.random.default_rng(kind_a * 10 + kind_b)
    wrong = []
    for k in range(PLACES):
        a, shape_a = any_shape(kind_a, rng, 0.4)
        b, shape_b = any_shape(kind_b, rng, 0.4)
        found = contacts(a, b, margin=10.0, geometry=HULLS)
        check(found, a, b)
        gap, normal = coal_distance(a, shape_a, b, shape_b)
        if abs(found.gaps.min() - gap) > EXACT:
            wrong.append((k, gap, found.gaps.min()))
            # The larger of two separations is the true one: ours is one (checked above), and coal's is not larger.
            assert not math.isfinite(gap) or abs(gap) > 1e300 or separation(a, b, normal) < found.gaps.min() + EXACT
        elif abs(gap) > 1e-3 and kind_b not in (CYLINDER, HULL):
            assert found.normals[np.argmin(found.gaps)] == pytest.approx(normal, abs=2e-3)
    # coal fails now and then on cylinders; nowhere else do we differ.
    if CYLINDER in (kind_a, kind_b):
        assert len(wrong) < 0.1 * PLACES
    else:
        assert not wrong


@pytest.mark.slow  # in a fresh checkout: the kernel is compiled first
def test_a_ball_and_a_cylinder_are_as_far_apart_as_geometry_says() -> None:
    rng = np.random.default_rng(4)
    for _ in range(PLACES):
        a, _ = any_shape(SPHERE, rng, 0.5)
        b, _ = any_shape(CYLINDER, rng, 0.5)
        x, y, z = b.R.T @ (a.p - b.p)
        beside, above = math.hypot(x, y) - b.size[0], abs(z) - b.size[1]
        both = beside > 0.0 and above > 0.0
        expected = (math.hypot(beside, above) if both else max(beside, above)) - a.size[0]
        assert contacts(a, b, margin=10.0).gaps.min() == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("kind", CONVEX)
def test_the_gap_to_a_plane_is_the_least_height(kind: int) -> None:
    rng = np.random.default_rng(kind)
    for _ in range(PLACES):
        a, _ = any_shape(kind, rng, 0.5)
        plane = Placed(PLANE, R=turn(rng), p=rng.uniform(-0.2, 0.2, 3))
        found = contacts(a, plane, margin=10.0, geometry=HULLS)
        normal = plane.R[:, 2]
        assert found.normals == pytest.approx(np.tile(normal, (len(found), 1)))
        assert found.gaps.min() == pytest.approx(-reach(a, -normal) - float(normal @ plane.p), abs=1e-6)
        assert found.points @ normal - float(normal @ plane.p) == pytest.approx(0.5 * found.gaps, abs=1e-9)


@pytest.mark.parametrize("kind", CONVEX)
def test_shapes_outside_a_mesh_are_as_far_from_it_as_coal_says(kind: int) -> None:
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(TORUS), 3 * len(TORUS))
    for corners in TORUS:
        mesh.addTriangle(*corners)
    mesh.endModel()
    rng = np.random.default_rng(kind)
    near = 0
    for _ in range(PLACES):
        a, shape = any_shape(kind, rng, 0.9)
        # The middle is outside the tube.
        if math.hypot(math.hypot(a.p[0], a.p[1]) - 0.5, a.p[2]) < 0.15:
            continue
        b = Placed(MESH, p=np.zeros(3), data=TORUS_DATA)
        found = contacts(a, b, margin=0.05, geometry=HULLS)
        gap, _ = coal_distance(a, shape, b, mesh)
        if not math.isfinite(gap) or abs(gap) > 1e300:
            continue
        if gap > EXACT:
            assert (len(found) > 0) == (gap < 0.05) or abs(gap - 0.05) < EXACT
            if len(found):
                near += 1
                assert found.gaps.min() == pytest.approx(gap, abs=EXACT)
        else:
            assert len(found) > 0
    assert near > 10


def test_meshes_touch_where_their_hulls_do() -> None:
    rng = np.random.default_rng(8)
    geometry = Geometry()
    box = trimesh.creation.box((0.4, 0.3, 0.2))
    mesh, hull = geometry.add_mesh(box.triangles), geometry.add_hull(convex_hull(box.vertices))
    near = 0
    for _ in range(300):
        places = [(turn(rng), rng.uniform(-0.25, 0.25, 3)) for _ in range(2)]
        a, b = (Placed(MESH, R=R, p=p, data=mesh) for R, p in places)
        c, d = (Placed(HULL, R=R, p=p, data=hull) for R, p in places)
        expected = contacts(c, d, margin=0.05, geometry=geometry)
        if len(expected) and expected.gaps.min() > EXACT:
            near += 1
            assert contacts(a, b, margin=0.05, geometry=geometry).gaps.min() == pytest.approx(
                expected.gaps.min(), abs=EXACT
            )
    assert near > 10
