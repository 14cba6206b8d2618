"""Closed forms against many points on the surface."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfkit.description import load
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Mesh, Pose, Sphere
from urdfkit.kinematics import Kinematics
from urdfkit.resources import find_model
from urdfkit.scene import Scene, Shape, TriMesh, bounds, lowest_point, scene_of
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix

IDENTITY = [0.0, 0, 0, 0, 0, 0, 1]


def scene_with(geometry: Geometry, origin: Pose, *, role: str = "collision", mesh: TriMesh | None = None) -> Scene:
    shape = Shape("a/s", "a", role, geometry, pose_matrix(origin), mesh=mesh)  # type: ignore[arg-type]
    return Scene(("a",), (shape,))


def surface(geometry: Geometry) -> np.ndarray:
    """Return points of the surface, rims and poles among them, dense enough for 3e-4 m."""
    turn = np.linspace(0, 2 * np.pi, 361)
    ring = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    match geometry:
        case Box(size=size):
            return np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * np.array(size) / 2
        case Cylinder(radius=radius, length=length):
            return np.concatenate([ring * radius + [0, 0, sign * length / 2] for sign in (-1, 1)])
    ball = np.concatenate([ring * np.cos(a) + [0, 0, np.sin(a)] for a in np.linspace(-np.pi / 2, np.pi / 2, 181)])
    if isinstance(geometry, Sphere):
        return ball * geometry.radius
    assert isinstance(geometry, Capsule)
    return np.concatenate([ball * geometry.radius + [0, 0, sign * geometry.length / 2] for sign in (-1, 1)])


angle = st.floats(-np.pi, np.pi)


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@pytest.mark.parametrize("geometry", [Box((0.3, 0.2, 0.7)), Cylinder(0.4, 0.1), Sphere(0.3), Capsule(0.1, 0.5)])
@given(rpy=st.tuples(angle, angle, angle), body=st.tuples(angle, angle, angle))
def test_bounds_of_primitives(
    geometry: Geometry, rpy: tuple[float, float, float], body: tuple[float, float, float]
) -> None:
    scene = scene_with(geometry, Pose((0.1, -0.2, 0.3), rpy))
    placed = pose_matrix(Pose((1.0, 2.0, 3.0), body))
    pose = _pose(placed)
    matrix = pose_matrices([pose])[0] @ scene.shapes[0].placement
    points = surface(geometry) @ matrix[:3, :3].T + matrix[:3, 3]
    found = bounds(scene, [pose])
    assert found is not None
    np.testing.assert_allclose(found, [points.min(axis=0), points.max(axis=0)], rtol=0, atol=3e-4)
    # Exact, so never inside of a point of the surface.
    assert (found[0] <= points.min(axis=0) + 1e-12).all()
    assert (found[1] >= points.max(axis=0) - 1e-12).all()
    assert lowest_point(scene, [pose]) == found[0, 2]


def _pose(matrix: np.ndarray) -> np.ndarray:
    import pinocchio as pin

    return np.asarray(pin.SE3ToXYZQUAT(pin.SE3(matrix)))


def test_a_lying_cylinder_touches_with_its_mantle_exactly() -> None:
    scene = scene_with(Cylinder(0.1, 0.05), Pose((0, 0, 0.25), (np.pi / 2, 0, 0)))
    assert lowest_point(scene, [IDENTITY]) == pytest.approx(0.15, abs=1e-15)


def test_bounds_of_a_mesh_are_those_of_its_vertices() -> None:
    box = trimesh.creation.box((1, 2, 3))
    mesh = TriMesh(np.asarray(box.vertices, np.float32), np.asarray(box.faces, np.int32))
    scene = scene_with(Mesh("x.stl"), Pose((0, 0, 1), (0, 0, np.pi / 2)), mesh=mesh)
    found = bounds(scene, [IDENTITY])
    np.testing.assert_allclose(found, [[-1, -0.5, -0.5], [1, 0.5, 2.5]], rtol=0, atol=1e-12)


def test_only_collisions_count_for_the_lowest_point() -> None:
    visual = scene_with(Sphere(1.0), Pose(), role="visual")
    assert lowest_point(visual, [IDENTITY]) is None
    assert bounds(visual, [IDENTITY]) is not None
    assert bounds(visual, [IDENTITY], role="collision") is None


def test_simpleton_stands_on_its_wheels_and_caster() -> None:
    robot = load(find_model(["simpleton"]).path)
    kinematics, scene = Kinematics(robot), scene_of(robot)
    assert scene.bodies == kinematics.link_names
    low = lowest_point(scene, kinematics.link_poses(kinematics.neutral()))
    assert low == pytest.approx(0.0, abs=1e-12)
    turned = kinematics.configuration({"left_wheel_joint": 1.0})
    assert lowest_point(scene, kinematics.link_poses(turned)) == pytest.approx(0.0, abs=1e-12)
