"""Distances to solids equal an independent solution in extended precision; normals stand on the surface."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scene.rays.conftest import random_geometry, random_poses, rotations, scene_of_shapes, shape, units
from tests.scene.rays.truth import nearest
from urdfkit.description.sdf import Plane
from urdfkit.scene.rays import RayTable

POSES = 10_000
KINDS = ("box", "sphere", "cylinder", "capsule", "ellipsoid", "cone", "plane")


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_distances_are_true_at_ten_thousand_random_poses(kind: str) -> None:
    random = np.random.default_rng(KINDS.index(kind))
    poses = random_poses(random, POSES)
    R = rotations(poses)
    # Towards a point in or near the solid, from anywhere around, some from within.
    targets = poses[:, :3] + random.normal(0.0, 0.5, (POSES, 3))
    origins = poses[:, :3] + units(random, POSES) * 10 ** random.uniform(-1.5, 1.5, (POSES, 1))
    directions = targets - origins
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    worst, hits = 0.0, 0
    for first in range(0, POSES, 100):
        geometry = random_geometry(random, kind)
        solid = shape(geometry)
        table = RayTable(scene_of_shapes([solid]), [solid])
        for k in range(first, first + 100):
            table.place(poses[k])
            found = table.cast(origins[k], directions[k]).distances[0]
            true = nearest(geometry, R[k], poses[k, :3], origins[k], directions[k])
            assert np.isfinite(found) == np.isfinite(true), k
            if np.isfinite(true):
                worst, hits = max(worst, abs(found - true)), hits + 1
    assert worst <= 1e-9
    assert hits > POSES // 5


def test_a_visual_plane_ends_at_its_sides() -> None:
    solid = shape(Plane((0.0, 0.0, 1.0), (4.0, 2.0)), role="visual")
    table = RayTable(scene_of_shapes([solid]), [solid])
    table.place(np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))
    places = np.array([(1.99, 0.99), (-1.99, -0.99), (2.01, 0.0), (-2.01, 0.0), (0.0, 1.01), (0.0, -1.01)])
    origins = np.column_stack([places, np.full(6, 3.0)])
    found = table.cast(origins, np.tile([0.0, 0.0, -1.0], (6, 1))).distances
    assert found.tolist() == [3.0, 3.0, *[np.inf] * 4]


@pytest.mark.parametrize("kind", KINDS)
def test_normals_stand_on_the_surface_towards_the_ray(kind: str) -> None:
    random = np.random.default_rng(7)
    geometry = random_geometry(random, kind)
    solid = shape(geometry)
    table = RayTable(scene_of_shapes([solid]), [solid])
    pose = random_poses(random, 1)
    table.place(pose)
    origins = pose[0, :3] + 4.0 * units(random, 400)
    directions = pose[0, :3] + random.normal(0.0, 0.2, (400, 3)) - origins
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    hits = table.cast(origins, directions, normals=True)
    met = hits.shapes >= 0
    assert met.sum() > 100
    n = hits.normals[met]
    assert np.allclose(np.linalg.norm(n, axis=1), 1.0)
    assert (np.einsum("ij,ij->i", n, directions[met]) < 0).all()
    # A step along two tangents stays on the surface to second order.
    points = origins[met] + hits.distances[met, None] * directions[met]
    R = rotations(pose)[0]
    step, off = 1e-5, []
    for point, normal in zip(points, n, strict=True):
        tangent = np.cross(normal, np.roll(normal, 1) + 0.1)
        tangent /= np.linalg.norm(tangent)
        start = point + 0.01 * normal + step * tangent
        off.append(nearest(geometry, R, pose[0, :3], start, -normal) - 0.01)
    assert np.median(np.abs(off)) < 1e-8
    assert (np.abs(off) < 1e-6).mean() > 0.95  # the rest step over an edge


def test_of_two_shapes_at_one_place_the_first_counts() -> None:
    random = np.random.default_rng(3)
    geometry = random_geometry(random, "box")
    pair = [shape(geometry, "a"), shape(geometry, "b")]
    for order in (pair, pair[::-1]):
        table = RayTable(scene_of_shapes(order), order)
        table.place(np.array([[0, 0, 0, 0, 0, 0, 1.0]] * 2))
        hits = table.cast((5, 0.01, 0.02), [[-1.0, 0, 0]] * 40)
        assert set(hits.shapes.tolist()) == {0}


def test_rays_see_nothing_before_near_nor_beyond_far() -> None:
    random = np.random.default_rng(4)
    solids = [shape(random_geometry(random, "sphere"), "near"), shape(random_geometry(random, "sphere"), "far")]
    table = RayTable(scene_of_shapes(solids), solids)
    table.place([[3, 0, 0, 0, 0, 0, 1.0], [9, 0, 0, 0, 0, 0, 1.0]])

    def met(**limits):
        hits = table.cast((0, 0, 0), [[1.0, 0, 0]], **limits)
        return None if hits.shapes[0] < 0 else table.shapes[hits.shapes[0]].name

    assert met() == "near"
    assert met(near=5.5) == "far"
    assert met(near=5.5, far=6.0) is None
    assert met(far=0.5) is None


def test_a_ray_that_begins_inside_sees_where_it_leaves() -> None:
    solid = shape(random_geometry(np.random.default_rng(5), "box"))
    table = RayTable(scene_of_shapes([solid]), [solid])
    table.place([[0, 0, 0, 0, 0, 0, 1.0]])
    hits = table.cast((0, 0, 0), [[0, 0, -1.0]])
    assert hits.distances[0] == solid.geometry.size[2] / 2


def test_rays_along_an_axis_hit_faces_they_are_parallel_to_nothing() -> None:
    solid = shape(random_geometry(np.random.default_rng(6), "box"))
    x, y, _ = (edge / 2 for edge in solid.geometry.size)
    table = RayTable(scene_of_shapes([solid]), [solid])
    table.place([[0, 0, 0, 0, 0, 0, 1.0]])
    hits = table.cast([[5, 0, 0], [5, y * 1.001, 0], [0, 0, 9]], [[-1.0, 0, 0], [-1.0, 0, 0], [0, 1.0, 0]])
    assert hits.distances[0] == pytest.approx(5 - x, abs=1e-12)
    assert np.isinf(hits.distances[1:]).all()
