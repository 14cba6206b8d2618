from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from urdfkit.description import load
from urdfkit.description.urdf.robot import Box, Cylinder, Robot, Sphere
from urdfkit.errors import ResourceError
from urdfkit.resources import find_model
from urdfkit.scene import MeshLoader, scene_of

Build = Callable[[str], Robot]
MESH = '<{role}><geometry><mesh filename="{uri}"/></geometry></{role}>'


def mesh_link(uri: str, role: str = "visual", name: str = "a") -> str:
    return f'<link name="{name}">{MESH.format(uri=uri, role=role)}</link>'


def test_bodies_and_shapes_come_in_the_order_of_the_description() -> None:
    robot = load(find_model(["simpleton"]).path)
    scene = scene_of(robot)
    assert scene.bodies == tuple(link.name for link in robot.links)
    assert [shape.body for shape in scene.shapes] == sorted(
        (shape.body for shape in scene.shapes), key=scene.bodies.index
    )
    assert {shape.role for shape in scene.shapes} == {"visual", "collision"}
    assert len({shape.name for shape in scene.shapes}) == len(scene.shapes)
    assert len(scene.with_role("visual")) + len(scene.with_role("collision")) == len(scene.shapes)
    assert not scene.problems
    assert scene.body_index[scene.bodies[2]] == 2


def test_a_shape_says_what_where_and_which_colour(robot_of: Build) -> None:
    scene = scene_of(
        robot_of(
            '<link name="a"><visual name="top"><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>'
            '<geometry><box size="1 2 3"/></geometry>'
            '<material name="m"><color rgba="0.1 0.2 0.3 0.4"/></material></visual>'
            '<collision><geometry><cylinder radius="0.5" length="2"/></geometry></collision>'
            '<collision><geometry><sphere radius="0.5"/></geometry></collision></link>'
        )
    )
    visual, cylinder, sphere = scene.shapes
    assert (visual.name, visual.body, visual.role) == ("a/visual/top", "a", "visual")
    assert visual.geometry == Box((1.0, 2.0, 3.0))
    assert (visual.rgba, visual.has_color) == ((0.1, 0.2, 0.3, 0.4), True)
    assert visual.mesh is None
    np.testing.assert_allclose(visual.placement[:3, 3], [1, 2, 3])
    assert not visual.placement.flags.writeable
    assert (cylinder.geometry, cylinder.name) == (Cylinder(0.5, 2.0), "a/collision/0")
    assert (sphere.geometry, sphere.name) == (Sphere(0.5), "a/collision/1")
    assert not sphere.has_color


def test_names_that_are_given_twice_stay_apart(robot_of: Build) -> None:
    sphere = '<visual name="s"><geometry><sphere radius="1"/></geometry></visual>'
    scene = scene_of(robot_of(f'<link name="a">{sphere}{sphere}{sphere}</link>'))
    assert len({shape.name for shape in scene.shapes}) == 3


@pytest.mark.parametrize("uri", ["package://thing_description/meshes/Wheel.stl", "../meshes/Wheel.stl", "file://{}"])
def test_a_mesh_is_found_by_any_uri(robot_of: Build, meshes: Path, uri: str) -> None:
    scene = scene_of(robot_of(mesh_link(uri.format(meshes / "Wheel.stl"))))
    (shape,) = scene.shapes
    assert shape.mesh is not None
    np.testing.assert_allclose(shape.mesh.bounds, [[-0.5, -1, -1.5], [0.5, 1, 1.5]])


def test_one_file_used_often_is_read_once(robot_of: Build, meshes: Path) -> None:
    uri = "package://thing_description/meshes/Wheel.stl"
    links = mesh_link(uri, "collision", "a") + mesh_link(uri, "visual", "b")
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    robot = robot_of(links + joint)
    loader = MeshLoader()
    first, second = scene_of(robot, meshes=loader).shapes
    assert first.mesh is second.mesh
    assert scene_of(robot, meshes=loader).shapes[0].mesh is first.mesh
    assert scene_of(robot).shapes[0].mesh is not first.mesh


def test_a_mesh_whose_name_differs_in_capital_letters_is_used_and_noted(robot_of: Build, meshes: Path) -> None:
    robot = robot_of(f'<link name="root"/>\n{mesh_link("package://thing_description/meshes/wheel.STL")}\n{JOINT}')
    (shape,) = scene_of(robot).shapes
    assert shape.mesh is not None
    assert robot.packages is not None
    (note,) = robot.packages.notes.values()
    place = r"\S+urdf:\d+:\d+: package://thing_description/meshes/wheel.STL"
    assert re.match(place + ": the name of the file is Wheel.stl in ", note)


@pytest.mark.parametrize(
    ("uri", "message"),
    [
        ("package://thing_description/meshes/whel.stl", r"did you mean `Wheel\.stl`\?"),
        ("package://thing_description/meshes/Wheel.dae", r"did you mean `Wheel\.stl`\?"),
        ("package://thing_description/mesh/Wheel.stl", r"did you mean `meshes`\?"),
        ("package://thing_descripton/meshes/Wheel.stl", r"no package `thing_descripton` .*`thing_description`\?"),
        ("http://example.org/Wheel.stl", r"this machine only"),
        ("../meshes/Wheel.step", r"Wheel"),
    ],
)
def test_a_missing_mesh_is_one_line_at_its_place(robot_of: Build, meshes: Path, uri: str, message: str) -> None:
    robot = robot_of(f'<link name="root"/>\n{mesh_link(uri)}\n{JOINT}')
    with pytest.raises(ResourceError, match=message) as caught:
        scene_of(robot)
    assert str(caught.value).startswith(f"{robot.files[0]}:3:")
    assert "\n" not in str(caught.value)
    assert caught.value.position is not None
    line = robot.files[0].read_text().splitlines()[2]
    assert line[caught.value.position.column - 1 :].startswith("<mesh")


JOINT = '<joint name="j" type="fixed"><parent link="root"/><child link="a"/></joint>'


def test_a_lenient_scene_leaves_out_what_cannot_be_had(robot_of: Build, meshes: Path) -> None:
    (meshes / "broken.stl").write_bytes(b"not a mesh at all")
    scene = scene_of(
        robot_of(
            '<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual>'
            + MESH.format(uri="../meshes/gone.stl", role="visual")
            + MESH.format(uri="../meshes/broken.stl", role="collision")
            + MESH.format(uri="../meshes/Wheel.stl", role="collision")
            + "</link>"
        ),
        strict=False,
    )
    assert [shape.role for shape in scene.shapes] == ["visual", "collision"]
    gone, broken = scene.problems
    assert (gone.name, gone.body, gone.role) == ("a/visual/1", "a", "visual")
    assert (broken.name, broken.role) == ("a/collision/0", "collision")
    assert "gone.stl" in gone.error.message
    assert "broken.stl" in broken.error.message
    assert gone.error.position is not None


def test_an_empty_link_has_a_body_and_no_shape(robot_of: Build) -> None:
    scene = scene_of(robot_of('<link name="a"/>'))
    assert scene.bodies == ("a",)
    assert scene.shapes == ()
