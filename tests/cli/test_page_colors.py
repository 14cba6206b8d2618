"""Colours of mesh files on the page without light, per part, compared with those that trimesh reads from the files."""

from __future__ import annotations

import base64
import io
from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from PIL import Image

from tests.cli.conftest import READY

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")
pytest.importorskip("collada")

pytestmark = [pytest.mark.browser, pytest.mark.slow]

COLORS = [[204, 51, 26, 255], [26, 128, 51, 255], [51, 77, 179, 255]]
UNLIT = """([points, link]) => {
  const { viewport, scene } = urdfkit, { viewer } = viewport, { renderer } = viewer;
  const shapes = scene.shapes(link, "visual");
  viewport.ground.visible = false;
  for (const shape of shapes) shape.traverse((mesh) => {
    const { material: was } = mesh;
    if (!was) return;
    const { color, map, vertexColors } = was;
    mesh.material = new MeshCat.THREE.MeshBasicMaterial({ color, map, vertexColors });
  });
  renderer.render(viewer.scene, viewer.camera);
  const gl = renderer.getContext(), { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  const node = scene.byLink.get(link), pixel = new Uint8Array(4);
  return points.map((point) => {
    const at = node.localToWorld(new MeshCat.THREE.Vector3(...point)).project(viewer.camera);
    gl.readPixels((at.x / 2 + 0.5) * width, (at.y / 2 + 0.5) * height, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return [...pixel].slice(0, 3);
  });
}"""


def parts(suffix: str) -> list[trimesh.Trimesh]:
    """Return three boxes in a row, of one colour each, and one with a texture of four colours where the format can."""
    made = []
    for k, color in enumerate(COLORS):
        box = trimesh.creation.box((0.4, 0.4, 0.4), trimesh.transformations.translation_matrix((0, 0.8 * k, 0.2)))
        if suffix != ".obj":
            material = trimesh.visual.material.PBRMaterial(baseColorFactor=color, metallicFactor=0.0)
        else:
            material = trimesh.visual.material.SimpleMaterial(diffuse=color)
        box.visual = trimesh.visual.TextureVisuals(uv=np.zeros((len(box.vertices), 2)), material=material)
        made.append(box)
    if suffix != ".dae":  # trimesh writes no textures there
        image = np.zeros((64, 64, 3), np.uint8)
        image[:32, :32], image[:32, 32:], image[32:, :32], image[32:, 32:] = (
            (230, 30, 30), (30, 200, 60), (40, 60, 220), (240, 220, 40)
        )  # fmt: skip
        plate = trimesh.creation.box((0.4, 0.4, 0.4), trimesh.transformations.translation_matrix((0, 2.4, 0.2)))
        plate.unmerge_vertices()
        # The two triangles on top use different corners of the image, so that all four colours are seen.
        uv = np.tile([[0.1, 0.1], [0.9, 0.1], [0.4, 0.9]], (len(plate.faces), 1, 1))
        uv[np.flatnonzero(plate.face_normals[:, 2] > 0.9)[0]] = [[0.9, 0.9], [0.1, 0.9], [0.6, 0.1]]
        uv = uv.reshape(-1, 2)
        kind = trimesh.visual.material
        picture = Image.fromarray(image)
        material = (
            kind.PBRMaterial(baseColorTexture=picture)
            if suffix == ".glb"
            else kind.SimpleMaterial(picture, diffuse=[255] * 3)
        )
        plate.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
        made.append(plate)
    return made


def displayed(mesh: trimesh.Trimesh, face: int, where: NDArray[np.float64], *, linear: bool) -> NDArray[np.float64]:
    """Return the colour of a point of a face, given by barycentric coordinates, as trimesh reads it; 0..255, sRGB."""
    material = mesh.visual.material
    image = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
    if image is not None:
        place = where @ mesh.visual.uv[mesh.faces[face]]
        return np.asarray(trimesh.visual.color.uv_to_color(place[None], image)[0][:3], float)
    color = np.asarray(material.main_color[:3], float)
    if linear:  # factors of glTF, section 3.9.2
        share = color / 255
        color = 255 * np.where(share <= 0.0031308, 12.92 * share, 1.055 * share ** (1 / 2.4) - 0.055)
    return color


@pytest.mark.parametrize("suffix", [".dae", ".obj", ".glb"])
def test_parts_have_the_colours_of_their_file(serve, visits, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"row{suffix}"
    if suffix == ".dae":
        path.write_bytes(trimesh.exchange.dae.export_collada(parts(suffix)))
    else:
        trimesh.Scene({f"part{k}": part for k, part in enumerate(parts(suffix))}).export(path)
    link = f'<link name="row"><visual><geometry><mesh filename="{path.name}"/></geometry></visual></link>'
    (tmp_path / "row.urdf").write_text(f'<robot name="row">{link}</robot>')
    read = trimesh.load_scene(path, process=False)
    weights = np.array([[1, 1, 1], [4, 1, 1], [1, 4, 1], [1, 1, 4]]) / np.array([[3], [6], [6], [6]])
    points, wanted, part = [], [], []
    for k, node in enumerate(sorted(read.graph.nodes_geometry)):
        transform, name = read.graph[node]
        mesh = read.geometry[name].copy()
        mesh.apply_transform(transform)
        for face in np.flatnonzero(mesh.face_normals[:, 2] > 0.9):  # seen from the camera in front and above
            for where in weights:
                points.append((where @ mesh.vertices[mesh.faces[face]]).tolist())
                wanted.append(displayed(mesh, face, where, linear=suffix == ".glb"))
                part.append(k)
    assert len(set(part)) == len(parts(suffix))
    assert len(np.unique(np.rint(wanted), axis=0)) == (3 if suffix == ".dae" else 7)
    page = visits.open(serve("view", str(tmp_path / "row.urdf")).url)
    page.evaluate("urdfkit.scene.settled()")
    found = np.array(page.evaluate(UNLIT, [points, "row"]), float)
    for k in set(part):
        these = np.array(part) == k
        difference = np.abs(found[these] - np.array(wanted)[these]).mean() / 255
        assert difference <= 0.05, (k, found[these], np.array(wanted)[these])
    assert visits.problems == []


LIT = """() => {
  const { viewport } = urdfkit, { viewer } = viewport, { renderer } = viewer, pixel = new Uint8Array(4);
  viewer.render(); // a smooth frame before it had more pixels
  const gl = renderer.getContext(), { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  const at = urdfkit.scene.byLink.get("top").localToWorld(new MeshCat.THREE.Vector3()).project(viewer.camera);
  gl.readPixels((at.x / 2 + 0.5) * width, (at.y / 2 + 0.5) * height, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return [...pixel].slice(0, 3);
}"""


@pytest.mark.parametrize("rgb", [(1.0, 1.0, 1.0), (0.95, 0.45, 0.1), (0.12, 0.12, 0.13)])
def test_lit_surfaces_keep_their_colour_and_are_not_burnt_to_white(serve, visits, tmp_path: Path, rgb) -> None:
    color = " ".join(map(str, rgb))
    shape = f'<geometry><box size="1 1 0.1"/></geometry><material name="c"><color rgba="{color} 1"/></material>'
    gazebo = '<gazebo reference="top"><visual><material><specular>1 1 1 50</specular></material></visual></gazebo>'
    (tmp_path / "p.urdf").write_text(
        f'<robot name="p"><link name="top"><visual>{shape}</visual></link>{gazebo}</robot>'
    )
    page = visits.open(serve("view", str(tmp_path / "p.urdf")).url)
    programs = (
        "(({ info, getContext }) => info.programs.filter(({ name }) => name === 'MeshStandardMaterial')"
        ".map((p) => getContext().getShaderSource(p.fragmentShader).includes('softbox')))"
        "(urdfkit.viewport.viewer.renderer)"
    )
    assert page.evaluate(programs) == [True]  # the page's light, not that of three.js
    found = np.array(page.evaluate(LIT)) / 255
    assert found.max() < 0.99
    assert np.abs(found - rgb).max() < 0.25
    assert list(np.argsort(found, kind="stable")) == list(np.argsort(rgb, kind="stable"))
    assert visits.problems == []


@pytest.mark.slow
def test_the_page_has_the_materials_of_a_camera_of_the_same_pose(serve, visits) -> None:
    from tests.bench.bench_page_camera import measure

    page = visits.open(serve("sim", "teleop", "heterogeneous").url, viewport={"width": 480, "height": 360})
    page.locator("#pause").click()
    page.wait_for_selector("#pause[aria-pressed=true]")
    rows = measure(page, "heterogeneous")
    assert len(rows) > 10
    assert {link: materials for link, _, materials, _, _ in rows if materials > 5.0} == {}
    assert {link: world for link, *_, world in rows if world > 5.0} == {}


LAMPS = """<?xml version="1.0"?>
<sdf version="1.9"><world name="lamps">
  <scene><ambient>0.15 0.2 0.3 1</ambient><background>0.2 0.4 0.6 1</background><shadows>true</shadows></scene>
  <light name="sun" type="directional"><diffuse>0.4 0.35 0.3 1</diffuse><specular>0.6 0.6 0.6 1</specular>
    <direction>-0.5 0.2 -0.9</direction><cast_shadows>true</cast_shadows></light>
  <light name="bulb" type="point"><pose>1.5 -1 1.5 0 0 0</pose><diffuse>0.9 0.2 0.1 1</diffuse>
    <specular>0.5 0.5 0.5 1</specular><cast_shadows>true</cast_shadows>
    <attenuation><range>6</range><constant>0.4</constant><linear>0.1</linear><quadratic>0.05</quadratic></attenuation></light>
  <light name="spot" type="spot"><pose>0 0 3 0 0 0</pose><diffuse>0.1 0.7 0.2 1</diffuse><direction>0 0 -1</direction>
    <attenuation><range>9</range><constant>1</constant><linear>0</linear><quadratic>0</quadratic></attenuation>
    <spot><inner_angle>0.2</inner_angle><outer_angle>0.5</outer_angle><falloff>0.8</falloff></spot>
    <cast_shadows>true</cast_shadows></light>
  <model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1</normal>
    </plane></geometry></collision></link></model>
</world></sdf>"""
TABLE = """<robot name="table">
  <link name="top"><inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><box size="1.5 1.5 0.2"/></geometry>
      <material name="c"><color rgba="0.8 0.7 0.6 1"/></material></visual>
    <collision><geometry><box size="1.5 1.5 0.2"/></geometry></collision>
    <visual><origin xyz="0.2 0.2 0.4"/><geometry><sphere radius="0.25"/></geometry>
      <material name="d"><color rgba="0.3 0.4 0.9 1"/></material></visual></link>
  <link name="ball"><visual><geometry><mesh filename="ball.obj"/></geometry></visual></link>
  <joint name="j" type="fixed"><parent link="top"/><child link="ball"/><origin xyz="0.3 -0.4 0.4"/></joint>
  <gazebo reference="top"><visual><material><specular>0.7 0.7 0.7 20</specular></material></visual></gazebo>
</robot>"""


MATERIALS = """newmtl glossy
Kd 0.5 0.2 0.2
Ks 0.9 0.9 0.9
Ns 5
newmtl matt
Kd 0.2 0.5 0.2
"""
OPEN = "urdfkit.page.panels.arrange({ open: ['camera'], pinned: [] })"


def write_table(folder: Path) -> None:
    """Write a table with a ball of two materials of which one is glossy."""
    ball = trimesh.creation.icosphere(subdivisions=3, radius=0.25)
    lines = ["mtllib ball.mtl", *(f"v {x} {y} {z}" for x, y, z in ball.vertices), "usemtl glossy"]
    for k, (a, b, c) in enumerate(ball.faces[np.argsort(ball.triangles_center[:, 0])] + 1):
        lines += ["usemtl matt"] * (k == len(ball.faces) // 4) + [f"f {a} {b} {c}"]
    (folder / "ball.obj").write_text("\n".join(lines))
    (folder / "ball.mtl").write_text(MATERIALS)
    (folder / "table.urdf").write_text(TABLE)


@pytest.fixture
def lamps(serve, visits, tmp_path: Path):
    """Return a page of a table in a world with a sun, a bulb and a spot."""
    (tmp_path / "lamps.sdf").write_text(LAMPS)
    write_table(tmp_path)
    served = serve("sim", "teleop", str(tmp_path / "table.urdf"), "--world", str(tmp_path / "lamps.sdf"))
    return visits.open(served.url, viewport={"width": 480, "height": 360})


def test_with_the_light_of_the_world_the_page_looks_like_a_camera(lamps, visits, tmp_path: Path) -> None:
    from tests.bench.bench_page_camera import measure

    lamps.locator("#pause").click()
    lamps.wait_for_selector("#pause[aria-pressed=true]")
    rows = measure(lamps, str(tmp_path / "table.urdf"), tmp_path, world=str(tmp_path / "lamps.sdf"))
    assert [link for link, *_ in rows] == ["ball", "top", "robot"]
    for *_, studio, world in rows:
        assert studio > 5.0
        assert world <= 1.0
    corner = np.asarray(Image.open(next(tmp_path.glob("*-0-world.png"))).convert("RGB"))[0, 0]
    assert np.abs(corner - np.array([51, 102, 153])).max() <= 1  # the background
    assert visits.problems == []


def test_the_light_is_chosen_by_keys_and_saved_with_the_layout(lamps, visits, until) -> None:
    lamps.evaluate(OPEN)
    assert lamps.evaluate("urdfkit.layout.state.light") == "studio"
    lamps.locator("#light-studio").focus()
    lamps.keyboard.press("ArrowRight")
    assert lamps.locator("#light-world").is_checked()
    background = "urdfkit.viewport.viewer.scene.background.toArray().map((x) => Math.round(100 * x))"
    assert lamps.evaluate(background) == [20, 40, 60]
    lamps.emulate_media(color_scheme="dark")
    assert lamps.evaluate(background) == [20, 40, 60]
    layout = lamps.evaluate("urdfkit.layout.state")
    lamps.locator("#light-world").focus()
    lamps.keyboard.press("ArrowLeft")
    assert lamps.evaluate(background) == [9, 11, 14]  # the dark theme
    lamps.evaluate("(layout) => urdfkit.layout.apply(layout)", layout)
    assert lamps.locator("#light-world").is_checked()
    assert lamps.evaluate(background) == [20, 40, 60]
    kept = "Object.values(localStorage).some((each) => JSON.parse(each).light === 'world')"
    until(lambda: lamps.evaluate(kept))
    lamps.reload()
    lamps.wait_for_selector(READY)
    until(lambda: lamps.evaluate(background) == [20, 40, 60])
    assert visits.problems == []


FLOOR = """<?xml version="1.0"?>
<sdf version="1.9"><world name="floor"><scene><ambient>1 1 1 1</ambient><background>0 0 0 1</background></scene>
  <model name="ground"><static>true</static><link name="l">
    <collision name="c"><geometry><plane/></geometry></collision>
    <visual name="v"><geometry><plane><normal>0 0 1</normal><size>8 8</size></plane></geometry>
      <material><diffuse>0.2 0.6 0.4 1</diffuse></material></visual></link></model>
</world></sdf>"""


def test_planes_of_the_world_are_drawn_in_its_material(serve, visits, until, tmp_path: Path) -> None:
    from tests.bench.bench_page_camera import SHOT

    (tmp_path / "floor.sdf").write_text(FLOOR)
    page = visits.open(serve("sim", "teleop", "simpleton", "--world", str(tmp_path / "floor.sdf")).url)
    page.locator("#pause").click()
    until(lambda: page.evaluate("urdfkit.viewport.planes.some"))

    def seen(light: str, x: float) -> list[int]:
        """Return the colour of a point of the ground, seen from above."""
        data = page.evaluate(SHOT, [[x - 0.1, 2.0, 2.0], [x, 2.0, 0.0], 20.0, 64, 64, True, light])
        picture = Image.open(io.BytesIO(base64.b64decode(data.partition(",")[2]))).convert("RGB")
        return [int(value) for value in np.asarray(picture)[32, 32]]

    assert seen("world", 1.0) == pytest.approx([51, 153, 102], abs=2)
    assert seen("world", 6.0) == [0, 0, 0]  # beyond its edge
    sky = np.array([238, 241, 245])
    near = np.array(seen("studio", 1.0))
    assert near == pytest.approx(0.6 * np.array([51, 153, 102]) + 0.4 * sky, abs=3)
    page.evaluate("urdfkit.page.panels.arrange({ open: ['show'], pinned: [] })")
    page.get_by_label("Ground", exact=True).uncheck()
    assert seen("studio", 1.0) == pytest.approx(sky, abs=2)
    assert seen("world", 1.0) == [0, 0, 0]
    assert visits.problems == []


def test_a_view_without_a_world_has_no_choice_of_light(serve, visits, tmp_path: Path) -> None:
    write_table(tmp_path)
    page = visits.open(serve("view", str(tmp_path / "table.urdf")).url)
    page.evaluate(OPEN)
    assert page.locator("#camera-orbit").is_visible()
    assert page.locator("#light-world").is_hidden()
    assert visits.problems == []
