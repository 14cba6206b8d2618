"""What surfaces look like: textures, smooth normals, transparency, and edges of several samples."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from tests.scene.test_ray_renderer import DOWN, FLOOR, lit, rendering, visual
from urdfkit.description.sdf import Light
from urdfkit.description.urdf.robot import Box, Mesh, Pose, Sphere
from urdfkit.meshes.textures import Texture
from urdfkit.scene import MeshLoader, Shape, TriMesh
from urdfkit.scene.camera_model import Lens, spread
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.ray_renderer import Picture

AIR = lit(ambient=(1.0, 1.0, 1.0))
ABOVE = pose_matrix(DOWN)
SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
FACES = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
UV = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float32)
QUARTERS = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], dtype=np.uint8)
"""Red and green above, blue and white below."""


def mesh_of(mesh: TriMesh, **more) -> Shape:
    return Shape("m", "m", "visual", Mesh("m.obj"), np.eye(4), mesh=mesh, **more)


def opaque(rgb: np.ndarray) -> Texture:
    return Texture(np.dstack([rgb, np.full(rgb.shape[:2], 255, dtype=np.uint8)]))


def wrapped(texture: Texture, uv: np.ndarray = UV) -> TriMesh:
    return TriMesh(SQUARE, FACES, uv=uv, textures=(texture,), face_textures=np.zeros(2, dtype=np.int32))


def seen(*shapes: Shape, lens: Lens | None = None, lighting=AIR, samples: int = 1) -> Picture:
    return rendering(*shapes, lighting=lighting).take(lens or Lens(101, 101, 0.5), ABOVE, samples=samples)


def places(lens: Lens) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y in the world of every pixel of a picture of the ground from `DOWN`."""
    row, column = np.mgrid[: lens.height, : lens.width]
    step = 5 / lens.focal_length
    return ((lens.height - 1) / 2 - row) * step, ((lens.width - 1) / 2 - column) * step


@pytest.mark.parametrize("repeats", [1, 3])
def test_a_texture_lies_between_its_texels(repeats: int) -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (7, 5, 3), dtype=np.uint8)
    lens = Lens(101, 101, 0.35)
    picture = seen(mesh_of(wrapped(opaque(pixels), repeats * UV)), lens=lens)
    x, y = places(lens)
    s, t = repeats * (x + 1) / 2, repeats * (y + 1) / 2
    u, v = (s % 1) * 5 - 0.5, (1 - t % 1) * 7 - 0.5
    left, top = np.floor(u).astype(int), np.floor(v).astype(int)
    fu, fv = (u - left)[..., None], (v - top)[..., None]

    def texel(row, column) -> np.ndarray:
        return pixels[row % 7, column % 5].astype(float)

    above = (1 - fu) * texel(top, left) + fu * texel(top, left + 1)
    below = (1 - fu) * texel(top + 1, left) + fu * texel(top + 1, left + 1)
    inside = (np.abs(x) < 0.999) & (np.abs(y) < 0.999)
    assert inside.mean() > 0.9
    # One step of 0..255 for the single precision of places on the texture.
    assert np.abs(picture.rgb - ((1 - fv) * above + fv * below))[inside].max() <= 1.0


def files(folder: Path, suffix: str) -> Path:
    """Write a square with a picture next to it, or in it, and return its file."""
    image = Image.fromarray(np.kron(QUARTERS, np.ones((8, 8, 1), dtype=np.uint8)))
    mesh = trimesh.Trimesh(SQUARE, FACES, process=False)
    if suffix == ".glb":
        material = trimesh.visual.material.PBRMaterial(baseColorTexture=image)
        mesh.visual = trimesh.visual.TextureVisuals(uv=UV, material=material)
        (folder / "square.glb").write_bytes(mesh.export(file_type="glb"))
        return folder / "square.glb"
    textures = folder / "materials" / "textures"
    textures.mkdir(parents=True)
    image.save(textures / "quarters.png")
    (folder / "meshes").mkdir()
    file = folder / "meshes" / f"square{suffix}"
    if suffix == ".obj":
        corners = "".join(f"v {x} {y} {z}\n" for x, y, z in SQUARE) + "".join(f"vt {s} {t}\n" for s, t in UV)
        file.write_text(f"mtllib square.mtl\n{corners}usemtl m\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n")
        (folder / "meshes" / "square.mtl").write_text("newmtl m\nKd 1 1 1\nmap_Kd ../materials/textures/quarters.png\n")
        return file
    file.write_text(DAE)
    return file


DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>
<unit meter="1"/></asset><library_images><image id="i"><init_from>quarters.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><newparam sid="f"><surface type="2D"><init_from>i</init_from>
</surface></newparam><newparam sid="s"><sampler2D><source>f</source></sampler2D></newparam><technique sid="c">
<lambert><diffuse><texture texture="s" texcoord="T"/></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects><library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="12">
-1 -1 0 1 -1 0 1 1 0 -1 1 0</float_array><technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><source id="t"><float_array id="ta" count="8"> 0 0 1 0 1 1 0 1</float_array>
<technique_common><accessor source="#ta" count="4" stride="2"><param name="S" type="float"/>
<param name="T" type="float"/></accessor></technique_common></source><vertices id="v">
<input semantic="POSITION" source="#p"/></vertices><triangles count="2" material="mm">
<input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#t" offset="1" set="0"/><p>
0 0 1 1 2 2 0 0 2 2 3 3</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>
<visual_scene id="s"><node><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="mm" target="#m"><bind_vertex_input semantic="T" input_semantic="TEXCOORD" input_set="0"/>
</instance_material></technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


@pytest.mark.parametrize("suffix", [".obj", ".dae", ".glb"])
def test_textures_of_files_lie_the_right_way_up(tmp_path: Path, suffix: str) -> None:
    mesh = MeshLoader().load(files(tmp_path, suffix))
    assert len(mesh.textures) == 1
    assert mesh.missing == ()
    picture = seen(mesh_of(mesh))
    x, y = places(Lens(101, 101, 0.5))
    for (right, up), color in zip(((-1, 1), (1, 1), (-1, -1), (1, -1)), QUARTERS.reshape(-1, 3), strict=True):
        at = np.argmin(np.abs(x - right / 2) + np.abs(y - up / 2))
        assert picture.rgb.reshape(-1, 3)[at].tolist() == color.tolist()


def test_a_picture_that_changed_is_read_again(tmp_path: Path) -> None:
    loader, file = MeshLoader(), files(tmp_path, ".obj")
    before = loader.load(file)
    assert loader.load(file) is before
    Image.fromarray(QUARTERS[::-1]).save(tmp_path / "materials" / "textures" / "quarters.png")
    assert loader.load(file).textures[0].hash != before.textures[0].hash


@pytest.mark.parametrize("broken", [False, True])
@pytest.mark.parametrize("suffix", [".obj", ".dae"])
def test_a_picture_that_is_not_there_is_named(tmp_path: Path, suffix: str, broken: bool) -> None:
    file = files(tmp_path, suffix)
    picture = tmp_path / "materials" / "textures" / "quarters.png"
    picture.write_bytes(b"no picture") if broken else picture.unlink()
    mesh = MeshLoader().load(file)
    (name,) = mesh.missing
    assert name.endswith("quarters.png")
    assert mesh.broken == (((name, "is not a readable picture"),) if broken else ())
    assert mesh.textures == ()
    assert (seen(mesh_of(mesh)).shapes == 0).any()


def test_pictures_outside_of_the_model_are_not_read(tmp_path: Path) -> None:
    (tmp_path / "a" / "model").mkdir(parents=True)
    file = files(tmp_path / "a" / "model", ".obj")
    Image.fromarray(QUARTERS).save(tmp_path / "a" / "secret.png")
    file.with_suffix(".mtl").write_text("newmtl m\nmap_Kd ../../secret.png\n")
    assert MeshLoader().load(file).missing == ("../../secret.png",)


def test_normals_of_vertices_make_a_ball_round() -> None:
    ball = trimesh.creation.icosphere(subdivisions=3)
    vertices, faces = ball.vertices.astype(np.float32), ball.faces.astype(np.int32)
    smooth = TriMesh(vertices, faces, normals=ball.vertices.astype(np.float32))
    sun = lit(Light("sun", "directional", direction=(0.5, 0.0, -1.0), diffuse=(0.9, 0.9, 0.9, 1.0)))
    true = seen(visual(Sphere(1.0), "ball"), lighting=sun).rgb.astype(int)
    round_, flat = (
        seen(mesh_of(mesh, has_color=True, rgba=(1, 1, 1, 1)), lighting=sun).rgb.astype(int)
        for mesh in (smooth, TriMesh(vertices, faces))
    )
    # Beyond, the light is so flat that facets lie in their own shadow.
    bright = (true > 80).all(axis=2)
    assert bright.mean() > 0.25
    assert np.abs(round_ - true)[bright].mean() <= 2
    assert np.abs(flat - true)[bright].mean() > 2 * np.abs(round_ - true)[bright].mean()
    assert np.percentile(np.abs(round_ - true)[bright], 99) <= 8


def test_light_comes_through_what_is_transparent() -> None:
    glass = visual(Box((1, 1, 0.1)), "glass", (0, 0, 1.0), rgba=(0.0, 0.0, 1.0, 0.25))
    picture = seen(FLOOR, glass)
    floor, blue = np.array([255, 127.5, 63.75]), np.array([0, 0, 255])
    # Rays meet the top of a box, then its inside at the bottom: two layers.
    expected = 0.25 * blue + 0.75 * (0.25 * blue + 0.75 * floor)
    assert np.abs(picture.rgb[50, 50] - expected).max() <= 1.0
    assert picture.depth[50, 50] == pytest.approx(3.95)
    assert np.abs(picture.rgb[0, 0] - floor).max() <= 1.0


def test_what_is_wholly_transparent_is_not_there() -> None:
    air = visual(Sphere(1.0), "air", (0, 0, 1.0), rgba=(1.0, 0.0, 0.0, 0.0))
    with_, without = seen(FLOOR, air), seen(FLOOR)
    assert np.array_equal(with_.rgb, without.rgb)
    assert np.array_equal(with_.shapes, without.shapes)
    assert np.allclose(with_.depth, without.depth, rtol=1e-5)


@pytest.mark.parametrize("alpha", [1.0, 0.99])
def test_only_what_is_opaque_casts_a_shadow(alpha: float) -> None:
    sun = lit(Light("sun", "directional", direction=(0.0, 1.0, -1.0), cast_shadows=True))
    plate = visual(Box((1, 1, 0.02)), "plate", (0, -1.5, 1.5), rgba=(1, 1, 1, alpha))
    assert (seen(FLOOR, plate, lighting=sun).rgb[50, 50].max() == 0) == (alpha == 1.0)


def test_many_panes_are_seen_through() -> None:
    panes = [visual(Sphere(0.5), f"p{k}", (0, 0, 0.6 + 0.01 * k), rgba=(0, 0, 0, 0.01)) for k in range(6)]
    left = 0.99**12
    assert seen(FLOOR, *panes).rgb[50, 50, 0] == pytest.approx(255 * left, abs=1.0)


def test_a_hole_in_a_texture_is_seen_through() -> None:
    pixels = np.zeros((8, 8, 4), dtype=np.uint8)
    pixels[:, :4] = (0, 255, 0, 255)
    picture = seen(visual(FLOOR.geometry, "floor", (0, 0, -0.01), rgba=FLOOR.rgba), mesh_of(wrapped(Texture(pixels))))
    x, y = places(Lens(101, 101, 0.5))
    assert (picture.rgb[(np.abs(x + 0.5) < 0.3) & (np.abs(y) < 0.9)] == (0, 255, 0)).all()
    assert (picture.rgb[(np.abs(x - 0.5) < 0.3) & (np.abs(y) < 0.9)] == (255, 128, 64)).all()
    assert (picture.shapes[(np.abs(x - 0.5) < 0.3) & (np.abs(y) < 0.9)] == 0).all()
    assert (picture.shapes[(np.abs(x + 0.5) < 0.3) & (np.abs(y) < 0.9)] == 1).all()


@pytest.mark.parametrize("samples", [4, 7, 16])
def test_edges_are_as_grey_as_what_lies_in_them(samples: int) -> None:
    # The edge runs along the world's x = y/4 + 0.005, through the picture's middle.
    lens = Lens(64, 64, 0.5)
    turn = np.arctan2(1, 4)
    plate = Shape(
        "b", "b", "visual", Box((50, 2, 1e-6)),
        pose_matrix(Pose((-np.sin(turn) + 0.005, np.cos(turn), 0.0), (0.0, 0.0, turn))), (0, 0, 0, 1), True,
    )  # fmt: skip
    air = lit(ambient=(1, 1, 1))
    one, many = seen(plate, lens=lens, lighting=air), seen(plate, lens=lens, lighting=air, samples=samples)
    assert np.array_equal(one.depth, many.depth)
    assert np.array_equal(one.shapes, many.shapes)
    fine = Lens(64 * 16, 64 * 16, 0.5)
    truth = seen(plate, lens=fine, lighting=air).rgb[..., 2].reshape(64, 16, 64, 16).mean(axis=(1, 3)) / 255
    found = many.rgb[..., 2] / 255
    # The edge crosses 64 pixels and more.
    assert ((truth > 0.02) & (truth < 0.98)).sum() > 60
    assert np.abs(found - truth).max() < 1.5 / samples**0.5 / 2
    assert np.abs(found - truth).mean() < 0.6 * np.abs(one.rgb[..., 2] / 255 - truth).mean()
    assert abs(found.sum() - truth.sum()) < 64 * 0.3 / samples


def test_samples_lie_around_the_middle() -> None:
    for samples in (1, 2, 4, 16):
        at = spread(samples)
        assert np.abs(at.mean(axis=0)).max() < 1e-12
        assert np.abs(at).max() < 0.8
