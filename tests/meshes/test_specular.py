"""Gloss: what asks for it, and how bright it makes a surface."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.scene.test_ray_renderer import DOWN, FLOOR, lit, rendering, visual
from urdfkit.description import load
from urdfkit.description.sdf import Light, load_world
from urdfkit.description.urdf.robot import Pose, Sphere
from urdfkit.meshes.specular import GLOSSY, MATT, MOST, gloss_from
from urdfkit.scene import MeshLoader, scene_of
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.sim.scene_view import world_scene

BLACK = (0.0, 0.0, 0.0, 1.0)
SUN = Light("sun", "directional", direction=(0.0, 0.3, -1.0), diffuse=(1, 1, 1, 1), specular=(0.8, 0.6, 0.4, 1.0))
LAMP = Light(
    "lamp", "point", Pose((0.5, 0.4, 2.0)), diffuse=(1, 1, 1, 1), specular=(0.9, 0.9, 0.9, 1.0),
    attenuation=(20.0, 0.5, 0.1, 0.02),
)  # fmt: skip


def robot_with(tmp_path: Path, block: str):
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual>'
        f'<collision><geometry><box size="1 1 1"/></geometry></collision></link>'
        f'<gazebo reference="a">{block}</gazebo></robot>'
    )
    return scene_of(load(path))


@pytest.mark.parametrize(
    ("block", "gloss"),
    [
        ("<material>Gazebo/Gold</material>", GLOSSY["Gold"]),
        ("<visual><material><script><name>Gazebo/Orange</name></script></material></visual>", GLOSSY["Orange"]),
        ("<material>Gazebo/Red</material>", MATT),
        ("<visual><material><specular>0.5 0.4 0.3 1</specular><shininess>20</shininess></material></visual>",
         (0.5, 0.4, 0.3, 20.0)),
        ("<visual><material><specular>0.5 0.4 0.3 1</specular></material></visual>", MATT),
        ("<visual><material><specular>0.5 0.4</specular><shininess>20</shininess></material></visual>", MATT),
        ("<visual><material><specular>0 0 0 1</specular><shininess>20</shininess></material></visual>", MATT),
    ],
)  # fmt: skip
def test_only_what_asks_for_it_is_glossy(tmp_path: Path, block: str, gloss) -> None:
    scene = robot_with(tmp_path, block)
    assert [shape.gloss for shape in scene.shapes] == [gloss, MATT]


def test_numbers_stay_within_what_they_can_be() -> None:
    assert gloss_from((2.0, -1.0, 0.5, 1.0), "1e9") == (1.0, 0.0, 0.5, MOST)
    for color, exponent in (((1, 1, 1), 0), ((1, 1, 1), "nan"), ((1, 1, "x"), 5), ((1, 1), 5), (None, None)):
        assert gloss_from(color, exponent) is None


def test_visuals_of_a_world_are_glossy_where_they_ask_for_it(tmp_path: Path) -> None:
    def box(name: str, material: str) -> str:
        return (
            f'<visual name="{name}"><geometry><box><size>1 1 1</size></box></geometry>'
            f"<material>{material}</material></visual>"
        )

    path = tmp_path / "w.sdf"
    path.write_text(
        '<sdf version="1.7"><world name="w"><model name="m"><static>1</static><link name="l">'
        + box("a", "<diffuse>1 0 0 1</diffuse><specular>0.6 0.6 0.6 1</specular><shininess>30</shininess>")
        + box("b", "<diffuse>1 0 0 1</diffuse><specular>0.6 0.6 0.6 1</specular>")
        + box("c", "<script><name>Gazebo/Gold</name></script>")
        + "</link></model></world></sdf>"
    )
    scene, _ = world_scene(load_world(path))
    assert [shape.gloss for shape in scene.shapes] == [(0.6, 0.6, 0.6, 30.0), MATT, GLOSSY["Gold"]]


def test_an_obj_files_materials_are_as_glossy_as_they_say(tmp_path: Path) -> None:
    (tmp_path / "m.mtl").write_text(
        "newmtl shiny\nKd 1 0 0\nKs 0.5 0.25 0.125\nNs 40\nnewmtl dull\nKd 0 1 0\nKs 0.5 0.5 0.5\n"
    )
    (tmp_path / "m.obj").write_text(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl shiny\nf 1 2 3\nusemtl dull\nf 2 4 3\n"
    )
    mesh = MeshLoader().load(tmp_path / "m.obj")
    assert mesh.face_gloss is not None
    rows = sorted(mesh.face_gloss.tolist())
    assert rows == [list(MATT), [0.5, 0.25, 0.125, 40.0]]


@pytest.mark.parametrize("exponent", [1.0, 12.5, 128.0])
@pytest.mark.parametrize("light", [SUN, LAMP], ids=["sun", "lamp"])
def test_a_black_ball_shines_back_as_blinns_formula_says(light: Light, exponent: float) -> None:
    gloss = (0.9, 0.8, 0.7, exponent)
    lens, lighting = Lens(64, 64, 0.5), lit(light)
    picture = rendering(visual(Sphere(1.0), "ball", rgba=BLACK, gloss=gloss), lighting=lighting).take(
        lens, pose_matrix(DOWN)
    )
    eye = np.array(DOWN.xyz)
    frame = pose_matrix(DOWN)
    seen = picture.shapes.ravel() == 0
    row, column = np.divmod(np.arange(64 * 64), 64)
    rays = (lens.towards(column.astype(float), row.astype(float)) @ frame[:3, :3].T)[seen]
    points = eye + rays * (picture.depth.ravel()[seen] / (rays @ frame[:3, 0]))[:, None]
    n = points / np.linalg.norm(points, axis=1, keepdims=True)
    if light.type == "directional":
        to = np.tile(-np.array(light.direction) / np.linalg.norm(light.direction), (len(n), 1))
        fall = 1.0
    else:
        to = np.array(light.pose.xyz) - points
        r = np.linalg.norm(to, axis=1, keepdims=True)
        to, (_, constant, linear, quadratic) = to / r, light.attenuation
        fall = 1.0 / (constant + r * (linear + quadratic * r))
    half = to - rays
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    lit_up = ((n * to).sum(1) > 0)[:, None]
    back = lit_up * fall * np.maximum((n * half).sum(1), 0.0)[:, None] ** exponent
    truth = np.minimum(back * np.array(light.specular[:3]) * np.array(gloss[:3]), 1.0) * 255
    found = picture.rgb.reshape(-1, 3)[seen]
    sharp = (n * to).sum(1) > 0.02  # where the light begins to be seen, a pixel is a jump
    assert sharp.sum() > 500
    assert np.abs(found - truth)[sharp].max() <= 1.0
    assert truth.max() > 60


def test_in_a_shadow_nothing_shines_back() -> None:
    sun = Light("sun", "directional", direction=(0, 0, -1.0), specular=(1, 1, 1, 1), cast_shadows=True)
    floor = visual(FLOOR.geometry, "floor", rgba=BLACK, gloss=(1.0, 1.0, 1.0, 5.0))
    lid = visual(Sphere(0.5), "lid", (0, 0, 8.0), rgba=BLACK)  # above the camera
    lens = Lens(33, 33, 0.6)
    shaded = rendering(floor, lid, lighting=lit(sun)).take(lens, pose_matrix(DOWN)).rgb
    bare = rendering(floor, lighting=lit(sun)).take(lens, pose_matrix(DOWN)).rgb
    assert bare[16, 16, 0] > 250
    assert shaded[16, 16].max() == 0
    assert np.array_equal(shaded[0, 0], bare[0, 0])
