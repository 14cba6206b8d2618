"""Placeholders for shapes that cannot be shown, and their sizes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from urdfkit.description.loading import load_repaired
from urdfkit.lint import lint
from urdfkit.scene import Scene, scene_of
from urdfkit.scene.placeholders import with_placeholders

GONE = '<visual><geometry><mesh filename="gone.stl"/></geometry></visual>'


def shown(tmp_path: Path, inside: str) -> tuple[Scene, list[str]]:
    path = tmp_path / "r.urdf"
    path.write_text(f'<robot name="r">{inside}</robot>')
    robot = load_repaired(path)
    scene, repairs = with_placeholders(robot, scene_of(robot, strict=False))
    return scene, [f"{repair.code} {repair.link} {repair.message}" for repair in repairs]


def placeholder(scene: Scene, body: str = "a", role: str = "visual"):
    (found,) = [s for s in scene.shapes if s.is_placeholder and (s.body, s.role) == (body, role)]
    return found


def joint(child: str, xyz: str) -> str:
    origin = f'<origin xyz="{xyz}"/>'
    return f'<joint name="j{child}" type="fixed"><parent link="a"/><child link="{child}"/>{origin}</joint>'


def test_collision_shapes_give_the_box_of_visual_shapes_and_vice_versa(tmp_path: Path) -> None:
    box = '<origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry>'
    ball = '<origin xyz="0 0 4"/><geometry><sphere radius="0.5"/></geometry>'
    collisions = f"<collision>{box}</collision><collision>{ball}</collision>"
    scene, repairs = shown(tmp_path, f'<link name="a">{GONE}{GONE}{collisions}</link>')
    found = placeholder(scene)
    assert found.geometry.size == pytest.approx((1, 2, 5))
    assert found.placement[:3, 3] == pytest.approx([0, 0, 2])
    assert len(scene.with_role("collision")) == 2
    assert repairs[0] == "G601 a no file gone.stl; a placeholder is shown"
    scene, _ = shown(tmp_path, f'<link name="a"><visual>{box}</visual>{GONE.replace("visual", "collision")}</link>')
    assert placeholder(scene, role="collision").geometry.size == pytest.approx((1, 2, 3))


def test_a_placeholder_of_a_thin_plate_is_thick_enough_to_be_seen(tmp_path: Path) -> None:
    plate = '<collision><geometry><box size="1 2 0.001"/></geometry></collision>'
    links = f'<link name="a">{GONE}{plate}</link><link name="b"/>{joint("b", "0.5 0 0")}'
    assert placeholder(shown(tmp_path, links)[0]).geometry.size == pytest.approx((1, 2, 0.02 * 0.5))


def test_the_box_contains_the_solid_box_of_the_inertia_and_the_joints(tmp_path: Path) -> None:
    a, b, c, m = 0.3, 0.1, 0.2, 5.0  # along the principal axes
    i = [m / 12 * (b * b + c * c), m / 12 * (a * a + c * c), m / 12 * (a * a + b * b)]
    inertia = f'<inertia ixx="{i[0]}" iyy="{i[1]}" izz="{i[2]}" ixy="0" ixz="0" iyz="0"/>'
    origin = '<origin xyz="0.1 0 0" rpy="0 0 1.5707963267948966"/>'
    inertial = f'<inertial>{origin}<mass value="{m}"/>{inertia}</inertial>'
    scene, _ = shown(tmp_path, f'<link name="a">{inertial}{GONE}</link><link name="b"/>{joint("b", "0.2 0 0")}')
    found = placeholder(scene)
    assert found.geometry.size == pytest.approx((0.2, a, c))  # along x to the child joint
    assert found.placement[:3, 3] == pytest.approx([0.1, 0, 0])


def test_an_implausible_inertia_does_not_count(tmp_path: Path) -> None:
    unit = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    inertial = f'<inertial><mass value="0.01"/>{unit}</inertial>'  # as exporters write it: a box of 24 m
    links = f'<link name="a">{inertial}{GONE}</link><link name="b"/>{joint("b", "0.2 0 0")}'
    assert placeholder(shown(tmp_path, links)[0]).geometry.size == pytest.approx((0.26, 0.06, 0.06))


def test_the_placeholder_of_a_link_without_shapes_reaches_its_child_joints(tmp_path: Path) -> None:
    links = f'<link name="a">{GONE}</link><link name="b">{GONE}</link><link name="c"/>'
    scene, _ = shown(tmp_path, links + joint("b", "0 0 0.4") + joint("c", "0.2 0 0.4"))
    found = placeholder(scene)
    assert found.geometry.size == pytest.approx((0.32, 0.12, 0.52))
    assert found.placement[:3, 3] == pytest.approx([0.1, 0, 0.2])
    leaf = placeholder(scene, "b").geometry.size
    assert leaf == pytest.approx((0.3 * np.median([0.4, np.hypot(0.2, 0.4)]),) * 3)


def test_a_negative_size_is_shown_where_the_shape_is(tmp_path: Path) -> None:
    shape = '<visual><origin xyz="1 0 0"/><geometry><cylinder radius="-0.1" length="0.5"/></geometry></visual>'
    scene, repairs = shown(tmp_path, f'<link name="a">{shape}</link>')
    found = placeholder(scene)
    assert found.geometry.size == pytest.approx((0.2, 0.2, 0.5))
    assert found.placement[0, 3] == 1
    assert "the <cylinder> of a visual shape has the size -0.1 m; a placeholder is shown" in repairs[0]


@pytest.mark.parametrize(
    ("geometry", "code"),
    [("<geometry/>", "E014"), ("<geometry><torus/></geometry>", "E008"), ("<geometry><box/></geometry>", "E014")],
)
def test_an_unknown_geometry(geometry: str, code: str, tmp_path: Path) -> None:
    scene, repairs = shown(tmp_path, f'<link name="a"><visual>{geometry}</visual></link>')
    assert placeholder(scene)
    (repair,) = repairs
    assert repair.startswith(f"{code} a ")


def test_a_robot_without_defects_keeps_its_scene(tmp_path: Path) -> None:
    scene, repairs = shown(tmp_path, '<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>')
    assert (len(scene.shapes), scene.shapes[0].is_placeholder, repairs) == (1, False, [])


@pytest.mark.parametrize(
    ("content", "suffix", "code", "reason"),
    [
        (b"", "stl", "G607", "is empty"),
        (b"version https://git-lfs.github.com/spec/v1\n", "stl", "G607", "Git LFS pointer"),
        (b"<html/>", "dae", "G607", "is not a COLLADA file"),
        (b"solid", "step", "G606", "unsupported format"),
        (b"o nothing\n", "obj", "G607", "no triangles"),
        ((b"\0" * 80) + (5_100_000).to_bytes(4, "little"), "stl", "G607", "triangles; decimate it"),
        (None, "glb", "G607", "MiB; at most 256 are supported"),
    ],
    ids=["empty", "pointer", "no COLLADA", "format", "no triangles", "many triangles", "many bytes"],
)
def test_a_mesh_that_cannot_be_used_is_named_at_the_line_of_its_finding(
    content: bytes | None, suffix: str, code: str, reason: str, tmp_path: Path
) -> None:
    mesh = tmp_path / f"part.{suffix}"
    mesh.write_bytes(b"glTF" if content is None else content)
    if content is None or len(content) == 84:  # sparse files
        with mesh.open("r+b") as file:
            file.truncate(300 * 2**20 if content is None else 84 + 50 * 5_100_000)
    shape = f'<visual><geometry><mesh filename="{mesh.name}"/></geometry></visual>'
    scene, (repair,) = shown(tmp_path, f'\n<link name="a">\n{shape}</link>')
    assert placeholder(scene)
    assert repair.startswith(f"{code} a ")
    assert reason in repair
    assert any((finding.code, finding.line) == (code, 3) for finding in lint(tmp_path / "r.urdf"))
