from __future__ import annotations

from collections.abc import Callable

import pytest

from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.resources import find_model
from urdfkit.scene import scene_of
from urdfkit.scene.colors import DEFAULT, GAZEBO

Build = Callable[[str], Robot]
RED, BLUE = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)


def visual(material: str = "") -> str:
    return f'<visual><geometry><sphere radius="1"/></geometry>{material}</visual>'


def material(name: str, rgba: tuple[float, ...] | None = None) -> str:
    color = "" if rgba is None else f'<color rgba="{" ".join(map(str, rgba))}"/>'
    return f'<material name="{name}">{color}</material>'


def link(*visuals: str) -> str:
    return f'<link name="a">{"".join(visuals)}</link>'


def colors(robot: Robot) -> list[tuple[float, float, float, float]]:
    return [shape.rgba for shape in scene_of(robot).shapes]


@pytest.mark.parametrize("name", ["", "paint"])
def test_inline(robot_of: Build, name: str) -> None:
    assert colors(robot_of(link(visual(material(name, RED))))) == [RED]


def test_by_name_from_the_robot_wherever_it_is_defined(robot_of: Build) -> None:
    painted = link(visual(material("paint")))
    assert colors(robot_of(material("paint", RED) + painted)) == [RED]
    assert colors(robot_of(painted + material("paint", RED))) == [RED]


def test_by_name_from_another_visual(robot_of: Build) -> None:
    assert colors(robot_of(link(visual(material("paint", BLUE)), visual(material("paint"))))) == [BLUE, BLUE]


def test_the_robots_definition_wins_as_in_rviz(robot_of: Build) -> None:
    assert colors(robot_of(material("paint", RED) + link(visual(material("paint", BLUE))))) == [RED]


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        ("<material>Gazebo/Orange</material>", GAZEBO["Orange"]),
        ("<material> Gazebo/FlatBlack\n</material>", GAZEBO["FlatBlack"]),
        ("<material>Orange</material>", GAZEBO["Orange"]),
        ("<material>Gazebo/NoSuchThing</material>", DEFAULT),
        ("<visual><material><diffuse>0 0 1 1</diffuse></material></visual>", BLUE),
        ("<visual><material><ambient>1 0 0</ambient></material></visual>", RED),
        ("<visual><material><diffuse>blue</diffuse></material></visual>", DEFAULT),
        ("<material><script><name>Gazebo/Gold</name></script></material>", GAZEBO["Gold"]),
        ("<mu1>1</mu1>", DEFAULT),
    ],
)
def test_gazebos_material_serves_where_urdf_says_nothing(
    robot_of: Build, block: str, expected: tuple[float, ...]
) -> None:
    gazebo = f'<gazebo reference="a">{block}</gazebo>'
    assert colors(robot_of(link(visual()) + gazebo)) == [expected]
    # Over a URDF colour it does not win.
    assert colors(robot_of(link(visual(material("m", RED))) + gazebo)) == [RED]


def test_a_name_that_nobody_defines_is_grey(robot_of: Build) -> None:
    (shape,) = scene_of(robot_of(link(visual(material("ghost"))))).shapes
    assert (shape.rgba, shape.has_color) == (DEFAULT, False)


def test_simpleton_is_colourful() -> None:
    scene = scene_of(load(find_model(["simpleton"]).path))
    assert all(shape.has_color for shape in scene.with_role("visual"))
    assert len({shape.rgba for shape in scene.with_role("visual")}) >= 3


def test_all_of_gazebos_colours_are_colours() -> None:
    for rgba in GAZEBO.values():
        assert len(rgba) == 4
        assert all(0.0 <= component <= 1.0 for component in rgba)
