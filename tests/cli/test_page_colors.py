"""Colours of mesh files on the page without light, per part, compared with those that trimesh reads from the files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from PIL import Image

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
  const gl = renderer.getContext(), { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  viewer.render();
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
    assert {link: materials for link, _, materials, _ in rows if materials > 5.0} == {}
