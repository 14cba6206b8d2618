"""Random rotations, solids and rays."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.description.sdf import Cone, Ellipsoid, Plane
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Sphere
from urdfkit.scene import Scene, Shape
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.scene.rays import warmup


@pytest.fixture(scope="session", autouse=True)
def compiled_kernels() -> None:
    warmup()


def shape(geometry, name="s", *, placement=None, mesh=None, role="collision", **more) -> Shape:
    placed = np.eye(4) if placement is None else placement
    return Shape(name, name, role, geometry, placed, mesh=mesh, **more)


def scene_of_shapes(shapes) -> Scene:
    return Scene(tuple(each.body for each in shapes), tuple(shapes))


def random_poses(random, count, spread=5.0):
    turns = random.normal(size=(count, 4))
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    return np.hstack([random.uniform(-spread, spread, (count, 3)), turns])


def random_geometry(random, kind):
    a, b, c = random.uniform(0.05, 2.0, 3).tolist()
    return {
        "box": Box((a, b, c)),
        "sphere": Sphere(a),
        "cylinder": Cylinder(a, b),
        "capsule": Capsule(a, b),
        "cone": Cone(a, b),
        "ellipsoid": Ellipsoid((a, b, c)),
        "plane": Plane((0.6, 0.0, 0.8)),
    }[kind]


def units(random, count):
    found = random.normal(size=(count, 3))
    return found / np.linalg.norm(found, axis=1, keepdims=True)


def rotations(poses):
    return pose_matrices(poses)[:, :3, :3]
