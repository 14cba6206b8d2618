"""Hulls of ellipsoids and cones stay as near to the true shapes as is reported."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.description.sdf import Cone, Ellipsoid
from urdfkit.scene import TriMesh
from urdfkit.sim.construction.primitive_hulls import TOLERANCE, hull_of


def planes(mesh: TriMesh, scale: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> tuple[np.ndarray, np.ndarray]:
    """Return the outward unit normals of a hull's faces, and their distances from the origin."""
    points = mesh.vertices.astype(float) / scale
    a, b, c = (points[mesh.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return normals, (normals * a).sum(1)


@pytest.mark.parametrize("radii", [(1.0, 1.0, 1.0), (0.3, 0.2, 0.1)])
def test_an_ellipsoid_is_within_its_tolerance(radii: tuple[float, float, float]) -> None:
    mesh = hull_of(Ellipsoid(radii))
    # Stretched back to a sphere: faces no nearer, corners no farther than the tolerance.
    assert planes(mesh, radii)[1].min() > 1 - TOLERANCE
    assert np.linalg.norm(mesh.vertices / radii, axis=1).max() < 1 + TOLERANCE


def test_a_cone_stands_on_its_base_with_its_origin_half_way_up() -> None:
    mesh = hull_of(Cone(0.5, 2.0))
    assert mesh.bounds[:, 2] == pytest.approx((-1.0, 1.0))
    _, distances = planes(mesh)
    assert (distances > 0).all()  # all faces look outward
    around = np.linalg.norm(mesh.vertices[:48, :2], axis=1)
    assert around == pytest.approx(0.5, rel=0.0022)
