"""Exports to yourdfpy, trimesh and Pinocchio: the transforms of every link, shapes and colours are ours."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest

from tests.kinematics.arms import FR3, PANDA, random_configurations, robot_or_skip
from urdfkit import load
from urdfkit.description.sdf import Cone, Ellipsoid, Plane
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Robot, Sphere
from urdfkit.errors import KinematicsError, MissingDependencyError, ResourceError
from urdfkit.kinematics import Chain, Kinematics
from urdfkit.meshes.textures import Texture
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene import Scene, Shape, scene_of
from urdfkit.scene.extent import shape_bounds
from urdfkit.scene.pose_matrices import pose_matrix

pytest.importorskip("yourdfpy")
trimesh: Any = pytest.importorskip("trimesh")

ROBOTS = ["arm", "seven_dof_arm", "simpleton", "artoo", FR3[0], PANDA[0]]

CHAINED = """<robot name="chained">
<material name="blue"><color rgba="0 0 1 1"/></material>
<link name="base">
  <inertial><origin xyz="0 0 0.1"/><mass value="2"/>
    <inertia ixx="1" ixy="0.1" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial>
  <visual><origin xyz="1 2 3"/><geometry><capsule radius="0.1" length="0.4"/></geometry><material name="blue"/></visual>
</link>
<link name="a"/><link name="b"/><link name="c"/>
<joint name="first" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 3 4"/></joint>
<joint name="second" type="prismatic"><parent link="a"/><child link="b"/><origin xyz="0.1 0 0" rpy="0.3 0.2 0.1"/>
  <axis xyz="0 3 4"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  <mimic joint="first" multiplier="2" offset="0.1"/></joint>
<joint name="third" type="revolute"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>
  <limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="second" multiplier="-3" offset="0.2"/></joint>
</robot>"""


def robot_named(name: Any, request: pytest.FixtureRequest) -> Robot:
    if name == "arm":
        return request.getfixturevalue("arm")  # type: ignore[no-any-return]
    return load(name) if isinstance(name, str) else robot_or_skip(name)  # type: ignore[return-value]


def configurations(robot: Robot, number: int = 20) -> list[dict[str, float]]:
    """Return positions of the independent joints of one degree of freedom, within their limits."""
    kinematics = Kinematics(robot)
    random = np.random.default_rng(0)
    limits = {name: np.clip(kinematics.limits(name), -3.0, 3.0) for name in kinematics.joint_names}
    return [{name: float(random.uniform(*ends)) for name, ends in limits.items()} for _ in range(number)]


def compare(robot: Robot, exported: Any) -> None:
    """Compare the transforms of every link at 20 configurations."""
    kinematics = Kinematics(robot)
    for positions in configurations(robot):
        placements = kinematics.placements(kinematics.configuration(positions))
        exported.update_cfg(positions)
        for link in kinematics.link_names:
            expected = placements[kinematics.frame(link)].homogeneous
            found = exported.get_transform(link, kinematics.root)
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9, err_msg=link)


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS, ids=str)
def test_yourdfpy_has_our_transforms(name: Any, request: pytest.FixtureRequest) -> None:
    robot = robot_named(name, request)
    compare(robot, robot.to_yourdfpy(load_meshes=False))


def test_yourdfpy_has_chains_of_mimic_joints_inertias_and_colours(robot_of: Callable[[str], Robot]) -> None:
    robot = robot_of(CHAINED)
    exported = robot.to_yourdfpy()
    compare(robot, exported)
    assert exported.actuated_joint_names == ["first"]
    assert exported.joint_names == ["first", "second", "third"]
    base = exported.link_map["base"]
    np.testing.assert_array_equal(base.inertial.inertia, [[1, 0.1, 0], [0.1, 2, 0], [0, 0, 2.5]])
    assert base.inertial.mass == 2.0
    assert len(base.visuals) == 3  # the capsule
    np.testing.assert_allclose(exported.scene.bounds, [[0.9, 1.9, 2.7], [1.1, 2.1, 3.3]], atol=1e-9)
    colors = {tuple(mesh.visual.face_colors[0].tolist()) for mesh in exported.scene.geometry.values()}
    assert colors == {(0, 0, 255, 255)}


def test_yourdfpy_finds_meshes_of_packages(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "package.xml").write_text("<package><name>shapes</name></package>")
    trimesh.creation.box([1, 2, 3]).export(tmp_path / "box.stl")
    visual = '<visual><geometry><mesh filename="package://shapes/{}.stl" scale="2 1 1"/></geometry></visual>'
    file = tmp_path / "robot.urdf"
    file.write_text(f'<robot name="a"><link name="b">{visual.format("box")}</link></robot>')
    with caplog.at_level(logging.WARNING):
        exported = load(file).to_yourdfpy()
    assert caplog.messages == []
    np.testing.assert_allclose(exported.scene.bounds, [[-1, -1, -1.5], [1, 1, 1.5]])
    file.write_text(f'<robot name="a"><link name="b">{visual.format("ball")}</link></robot>')
    with caplog.at_level(logging.WARNING):
        load(file).to_yourdfpy()
    assert caplog.messages == ["Can't find package://shapes/ball.stl"]


def test_yourdfpy_names_the_robot_whose_mesh_it_cannot_read(tmp_path: Path) -> None:
    (tmp_path / "a.dae").write_text("nothing")
    shape = '<visual><geometry><mesh filename="a.dae"/></geometry></visual>'
    (tmp_path / "r.urdf").write_text(f'<robot name="r"><link name="a">{shape}</link></robot>')
    robot = load(tmp_path / "r.urdf")
    with pytest.raises(ResourceError, match=r"robot `r`: yourdfpy cannot read a mesh .*load_meshes=False"):
        robot.to_yourdfpy()
    assert robot.to_yourdfpy(load_meshes=False).base_link == "a"
    with pytest.raises(TypeError, match="load_mesh"):
        robot.to_yourdfpy(load_mesh=False)


def test_without_yourdfpy(arm: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "urdfkit.description.urdf.yourdfpy_export", raising=False)
    monkeypatch.setitem(sys.modules, "yourdfpy", None)
    with pytest.raises(MissingDependencyError, match="pip install yourdfpy"):
        arm.to_yourdfpy()


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS, ids=str)
def test_trimesh_has_our_transforms_and_shapes(name: Any, request: pytest.FixtureRequest) -> None:
    robot = robot_named(name, request)
    kinematics, scene = Kinematics(robot), scene_of(robot, strict=False)
    for positions in configurations(robot):
        q = kinematics.configuration(positions)
        exported = scene.to_trimesh(kinematics.link_poses(q), role="collision")
        placements = kinematics.placements(q)
        for link in kinematics.link_names:
            found, expected = exported.graph.get(link)[0], placements[kinematics.frame(link)].homogeneous
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9, err_msg=link)
    placed = np.array([placements[kinematics.frame(link)].homogeneous for link in scene.bodies])
    for shape in scene.with_role("collision"):
        matrix, geometry = exported.graph.get(shape.name)
        corners = trimesh.transform_points(exported.geometry[geometry].vertices, matrix)
        tolerance = 1e-6 if shape.mesh is not None else 0.03 * np.ptp(corners)  # round solids have facets
        expected = shape_bounds(shape, placed[scene.body_index[shape.body]])
        np.testing.assert_allclose([corners.min(axis=0), corners.max(axis=0)], expected, rtol=0, atol=tolerance)


ROUND = np.pi * 0.01
SOLIDS = {
    Box((0.1, 0.2, 0.3)): (0.006, (0.05, 0.1, 0.15)),
    Sphere(0.1): (4 / 3 * ROUND * 0.1, (0.1, 0.1, 0.1)),
    Cylinder(0.1, 0.5): (ROUND * 0.5, (0.1, 0.1, 0.25)),
    Capsule(0.1, 0.5): (ROUND * (0.5 + 4 / 3 * 0.1), (0.1, 0.1, 0.35)),
    Ellipsoid((0.1, 0.2, 0.3)): (4 / 3 * np.pi * 0.006, (0.1, 0.2, 0.3)),
    Cone(0.1, 0.5): (ROUND * 0.5 / 3, (0.1, 0.1, 0.25)),
}
"""Volume [m³] and half of the sizes of the box around it [m]."""


def shape_of(geometry: Any, **looks: Any) -> Shape:
    placement = pose_matrix(Pose((1.0, 2.0, 3.0)))
    return Shape("world/visual/0", "world", "visual", geometry, placement, (1.0, 0.0, 0.0, 0.5), **looks)


@pytest.mark.parametrize("geometry", SOLIDS)
def test_trimesh_has_all_kinds_of_solids(geometry: Any) -> None:
    (mesh,) = Scene(("world",), (shape_of(geometry),)).to_trimesh([[0, 0, 0, 0, 0, 0, 1]]).dump()
    volume, half = SOLIDS[geometry]
    assert mesh.volume == pytest.approx(volume, rel=0.03)
    np.testing.assert_allclose(mesh.bounds, np.add([1, 2, 3], [np.negative(half), half]), rtol=0, atol=1e-3)
    assert (mesh.visual.face_colors == [255, 0, 0, 128]).all()


def test_trimesh_has_the_visible_part_of_a_plane() -> None:
    plane = Plane((0.0, 0.6, 0.8), (2.0, 3.0))
    (mesh,) = Scene(("world",), (shape_of(plane),)).to_trimesh([[0, 0, 0, 0, 0, 0, 1]]).dump()
    np.testing.assert_allclose(mesh.face_normals, [plane.normal] * 2, rtol=0, atol=1e-12)
    assert mesh.area == pytest.approx(6.0)


def test_trimesh_has_colours_and_textures() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    colors = np.array([[10, 20, 30, 255]] * 4, dtype=np.uint8)
    pixels = np.full((2, 2, 4), 77, dtype=np.uint8)
    mesh = TriMesh(
        vertices,
        faces,
        colors=colors,
        uv=vertices[:, :2].copy(),
        textures=(Texture(pixels),),
        face_textures=np.array([-1, 0], dtype=np.int32),
    )

    def parts(**looks: Any) -> list[Any]:
        shape = Shape("a/visual/0", "a", "visual", Box((1, 1, 1)), np.eye(4), (0.0, 1.0, 0.0, 1.0), mesh=mesh, **looks)
        exported = Scene(("a",), (shape,)).to_trimesh([[0, 0, 0, 0, 0, 0, 1]])
        return list(exported.geometry.values())

    plain, textured = parts()
    assert (plain.visual.vertex_colors == colors[0]).all()
    assert len(plain.faces) == len(textured.faces) == 1
    np.testing.assert_array_equal(np.asarray(textured.visual.material.baseColorTexture), pixels)
    assert textured.visual.uv.tolist() == vertices[:, :2].tolist()
    (colored,) = parts(has_color=True)
    assert (colored.visual.face_colors == [0, 255, 0, 255]).all()
    assert len(colored.faces) == 2


def test_trimesh_needs_a_pose_for_each_body() -> None:
    with pytest.raises(KinematicsError, match="1 poses for 2 bodies"):
        Scene(("a", "b"), ()).to_trimesh([[0, 0, 0, 0, 0, 0, 1]])


@pytest.mark.parametrize("name", ["arm", "seven_dof_arm", FR3[0]], ids=str)
def test_the_model_of_pinocchio_has_our_transforms(name: Any, request: pytest.FixtureRequest) -> None:
    robot = robot_named(name, request)
    kinematics = Kinematics(robot)
    model, data = kinematics.model, kinematics.model.createData()
    for link in kinematics.link_names:
        try:
            chain = Chain(robot, None, link)
        except KinematicsError:  # fixed to the root
            continue
        for q, pose in zip(found := random_configurations(chain, 20), chain.forward(found), strict=True):
            positions = dict(zip(chain.joint_names, q.tolist(), strict=True))
            pin.framesForwardKinematics(model, data, kinematics.configuration(positions))
            frame = data.oMf[model.getFrameId(link, pin.BODY)]
            np.testing.assert_allclose(frame.homogeneous, pose, rtol=0, atol=1e-9)
