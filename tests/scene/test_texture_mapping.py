"""Pictures on visuals by the <texture> of a URDF material."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.scene.gl.test_same_picture import DEVICE, agree
from tests.scene.test_paint import QUARTERS
from tests.scene.test_ray_renderer import lit
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere
from urdfkit.meshes.texture_mapping import solid
from urdfkit.scene import scene_of
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays import RayTable

AIR = lit(ambient=(1.0, 1.0, 1.0))
LENS = Lens(101, 101, 0.6)
MATERIAL = '<material name="m"><color rgba="0 1 0 1"/><texture filename="{}"/></material>'
PICTURE = "package://thing_description/meshes/quarters.png"
SIDES = {"+x": (0, np.pi), "-x": (0, 0.0), "+y": (0, -np.pi / 2), "-y": (0, np.pi / 2)}
RED, GREEN, BLUE, WHITE = QUARTERS.reshape(-1, 3)


@pytest.fixture
def quarters(meshes: Path) -> Path:
    Image.fromarray(np.kron(QUARTERS, np.ones((16, 16, 1), np.uint8))).save(meshes / "quarters.png")
    return meshes


def table_of(robot) -> RayTable:
    scene = scene_of(robot)
    table = RayTable(scene, scene.with_role("visual"))
    table.place(np.tile([0, 0, 0, 0, 0, 0, 1.0], (len(scene.bodies), 1)))
    return table


def look(table: RayTable, pitch: float, yaw: float, away: float = 5.0) -> np.ndarray:
    """Return a picture of the origin, as seen along a direction."""
    turn = pose_matrix(Pose((0, 0, 0), (0.0, pitch, yaw)))
    frame = turn.copy()
    frame[:3, 3] = -away * turn[:3, 0]
    return RayRenderer(table, AIR).take(LENS, frame).rgb


def visual(geometry: str, material: str = MATERIAL.format(PICTURE)) -> str:
    return f'<link name="a"><visual><geometry>{geometry}</geometry>{material}</visual></link>'


def corners(picture: np.ndarray, off: int) -> list[list[int]]:
    """Return the colours above left and right, below left and right of the middle."""
    return [picture[50 + row, 50 + column].tolist() for row in (-off, off) for column in (-off, off)]


@pytest.mark.parametrize("side", SIDES)
def test_a_picture_is_upright_on_each_side_of_a_box(robot_of, quarters: Path, side: str) -> None:
    table = table_of(robot_of(visual('<box size="1 1 1"/>')))
    assert corners(look(table, *SIDES[side]), 6) == QUARTERS.reshape(-1, 3).tolist()


def test_on_top_x_is_to_the_right(robot_of, quarters: Path) -> None:
    table = table_of(robot_of(visual('<box size="1 1 1"/>')))
    seen = look(table, np.pi / 2, np.pi / 2)  # from above, with y upwards in the picture
    assert corners(seen, 6) == QUARTERS.reshape(-1, 3).tolist()


def test_once_round_a_cylinder_and_a_ball(robot_of, quarters: Path) -> None:
    for shape in ('<cylinder radius="0.5" length="1"/>', '<sphere radius="0.5"/>'):
        table = table_of(robot_of(visual(shape)))
        front = look(table, 0, np.pi)  # the picture's middle looks along x
        assert corners(front, 4) == QUARTERS.reshape(-1, 3).tolist()
        behind = look(table, 0, 0.0)  # where its two ends meet
        assert corners(behind, 4) == [GREEN.tolist(), RED.tolist(), WHITE.tolist(), BLUE.tolist()]


def test_a_mesh_has_it_where_its_file_says(robot_of, quarters: Path) -> None:
    (quarters / "flag.obj").write_text(
        "v 0 -.5 -.5\nv 0 .5 -.5\nv 0 .5 .5\nv 0 -.5 .5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"
    )
    table = table_of(robot_of(visual('<mesh filename="package://thing_description/meshes/flag.obj"/>')))
    assert corners(look(table, 0, np.pi), 6) == QUARTERS.reshape(-1, 3).tolist()


def test_a_mesh_that_does_not_say_has_its_colour(robot_of, quarters: Path) -> None:
    table = table_of(robot_of(visual('<mesh filename="package://thing_description/meshes/Wheel.stl"/>')))
    assert look(table, 0, 0.0)[50, 50].tolist() == [0, 255, 0]


def test_a_material_may_be_named_elsewhere(robot_of, quarters: Path) -> None:
    inside = MATERIAL.format(PICTURE) + visual('<box size="1 1 1"/>', '<material name="m"/>')
    assert corners(look(table_of(robot_of(inside)), 0, np.pi), 6) == QUARTERS.reshape(-1, 3).tolist()


@pytest.mark.parametrize("name", ["package://thing_description/meshes/gone.png", "../meshes/broken.png"])
def test_a_picture_that_is_not_there_is_missed_by_name(robot_of, quarters: Path, name: str) -> None:
    (quarters / "broken.png").write_bytes(b"no picture")
    table = table_of(robot_of(visual('<box size="1 1 1"/>', MATERIAL.format(name))))
    (shape,) = table.shapes
    assert shape.mesh is not None
    assert shape.mesh.missing == (name,)
    assert shape.mesh.broken == (((name, "is not a readable picture"),) if "broken" in name else ())
    assert look(table, 0, 0.0)[50, 50].tolist() == [0, 255, 0]


@pytest.mark.parametrize("geometry", [Box((1, 2, 3)), Cylinder(0.4, 1.5), Sphere(0.7), Capsule(0.2, 0.6)])
def test_solids_are_closed_and_face_outwards(geometry) -> None:
    mesh = solid(geometry)
    assert mesh is not None
    a, b, c = (mesh.vertices[mesh.faces[:, k]].astype(float) for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    match geometry:
        case Box():
            wanted = 6.0
        case Cylinder(radius=r, length=length):
            wanted = np.pi * r * r * length
        case Sphere(radius=r):
            wanted = 4 / 3 * np.pi * r**3
        case _:
            wanted = np.pi * 0.04 * 0.6 + 4 / 3 * np.pi * 0.008
    assert volume == pytest.approx(wanted, rel=0.005)
    assert mesh.normals is not None
    assert mesh.uv is not None
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), mesh.normals[mesh.faces].mean(axis=1)) > 0).all()
    assert mesh.uv.min() >= -1e-6
    assert mesh.uv.max() <= 1 + 1e-6


@pytest.mark.opengl
def test_opengl_sees_the_same(robot_of, quarters: Path) -> None:
    from urdfkit.scene.gl.gl_renderer import GlRenderer

    frame = pose_matrix(Pose((-3.0, 0.5, 2.0), (0.0, 0.5, -0.1)))
    for shape in ('<box size="1 1 1"/>', '<cylinder radius="0.5" length="1"/>', '<sphere radius="0.5"/>'):
        table = table_of(robot_of(visual(shape)))
        gl, rays = GlRenderer(table, AIR, DEVICE.backend), RayRenderer(table, AIR)
        agree(gl.take(LENS, frame), rays.take(LENS, frame))
