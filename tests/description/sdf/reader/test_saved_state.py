"""Shapes scaled by the state of a world."""

import pytest

from urdfkit.description.sdf.reader.saved_state import scaled
from urdfkit.description.sdf.shapes import Cone, Ellipsoid, Plane, WorldGeometry
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Sphere

SHAPES: list[tuple[WorldGeometry, WorldGeometry]] = [
    (Box((1.0, 2.0, 3.0)), Box((2.0, 10.0, 9.0))),
    (Ellipsoid((1.0, 2.0, 3.0)), Ellipsoid((2.0, 10.0, 9.0))),
    (Mesh("m.stl", (1.0, 2.0, 3.0)), Mesh("m.stl", (2.0, 10.0, 9.0))),
    (Sphere(2.0), Sphere(10.0)),
    (Cylinder(2.0, 4.0), Cylinder(10.0, 12.0)),
    (Capsule(2.0, 4.0), Capsule(10.0, 12.0)),
    (Cone(2.0, 4.0), Cone(10.0, 12.0)),
    (Plane((0.0, 0.0, 1.0), (2.0, 4.0)), Plane((0.0, 0.0, 1.0), (4.0, 20.0))),
]


@pytest.mark.parametrize(("shape", "expected"), SHAPES, ids=lambda shape: type(shape).__name__)
def test_a_shape_is_scaled_along_its_axes(shape: WorldGeometry, expected: WorldGeometry) -> None:
    assert scaled(shape, (2.0, 5.0, 3.0)) == expected


def test_the_height_of_a_round_shape_does_not_change_its_radius() -> None:
    assert scaled(Cylinder(2.0, 4.0), (1.5, 1.0, 7.0)) == Cylinder(3.0, 28.0)
    assert scaled(Sphere(2.0), (1.0, 1.0, 7.0)) == Sphere(14.0)
