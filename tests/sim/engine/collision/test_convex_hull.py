"""Convex hulls hold their points and are closed, convex and small."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine.collision.convex_hull import Hull, convex_hull

RNG = np.random.default_rng(3)


def highest(hull: Hull, points: np.ndarray) -> float:
    """How far the furthest point is outside the hull [m]."""
    offsets = [normal @ hull.vertices[face[0]] for face, normal in zip(hull.faces, hull.normals, strict=True)]
    return float(np.max(points @ hull.normals.T - np.array(offsets)))


@pytest.mark.parametrize("count", [4, 7, 30, 500])
def test_hull_of_random_points_is_closed_and_holds_them(count: int) -> None:
    points = RNG.normal(size=(count, 3)) * RNG.uniform(0.01, 2.0, 3)
    hull = convex_hull(points)
    assert highest(hull, points) < 1e-12
    edges = [(f[k], f[(k + 1) % len(f)]) for f in hull.faces for k in range(len(f))]
    assert len(edges) == len(set(edges))
    assert all((j, i) in set(edges) for i, j in edges)
    assert len(hull.vertices) - len(edges) // 2 + len(hull.faces) == 2
    assert {tuple(v) for v in hull.vertices} <= {tuple(v) for v in points}


def test_faces_on_one_plane_are_one() -> None:
    cube = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    hull = convex_hull(np.vstack([cube, cube + 0.0, [[0.5, 0.5, 1.0], [0.2, 0.3, 0.4]]]))
    assert len(hull.vertices) == 8
    assert sorted(len(face) for face in hull.faces) == [4] * 6


def test_too_many_vertices_are_left_out_and_the_error_is_known() -> None:
    points = RNG.normal(size=(5000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    hull = convex_hull(points)
    assert len(hull.vertices) <= 64
    assert 0.0 < hull.error < 0.1
    assert highest(hull, points) <= hull.error + 1e-6


@pytest.mark.parametrize(
    ("points", "vertices", "faces"),
    [
        ([[1.0, 2.0, 3.0]], 1, 1),
        ([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.5, 0.5, 0.5]], 2, 1),
        ([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 0.0]], 4, 2),
    ],
)
def test_flat_points_have_a_flat_hull(points: list[list[float]], vertices: int, faces: int) -> None:
    hull = convex_hull(np.array(points))
    assert (len(hull.vertices), len(hull.faces)) == (vertices, faces)
    assert np.linalg.norm(hull.normals, axis=1) == pytest.approx(np.ones(faces))
