"""Materials of OBJ, COLLADA and glTF files, and what a URDF material adds where a file names none."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from urdfkit.description import load
from urdfkit.meshes.loader import MeshLoader
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene import Shape, scene_of

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
FACE = "f 1/1 2/2 3/3\n"


def obj(folder: Path, materials: str, faces: str) -> TriMesh:
    (folder / "a.mtl").write_text(materials)
    (folder / "a.obj").write_text(f"mtllib a.mtl\n{SQUARE}{faces}")
    return MeshLoader().load(folder / "a.obj")


def corner_colors(mesh: TriMesh) -> list[list[int]]:
    assert mesh.colors is not None
    return sorted({tuple(row) for row in mesh.colors[mesh.faces[:, 0]].tolist()})


@pytest.mark.parametrize(
    ("opacity", "alpha"), [("d 0.5", 128), ("Tr 0.25", 191), ("", 255), ("d 0", 255), ("Tr 1", 255)]
)
def test_the_opacity_of_an_obj_material(tmp_path: Path, opacity: str, alpha: int) -> None:
    assert corner_colors(obj(tmp_path, f"newmtl a\nKd 1 0.2 0\n{opacity}\n", f"usemtl a\n{FACE}")) == [
        (255, 51, 0, alpha)
    ]


def test_the_colour_of_an_obj_material_multiplies_its_texture(tmp_path: Path) -> None:
    Image.new("RGB", (2, 2), (200, 100, 50)).save(tmp_path / "t.png")
    mesh = obj(tmp_path, "newmtl a\nKd 0.5 0.5 1\nd 0.5\nmap_Kd t.png\n", f"usemtl a\n{FACE}")
    assert mesh.textures[0].pixels[0, 0].tolist() == [100, 50, 50, 128]


def glb(material: dict, image: Image.Image | None = None) -> bytes:
    """Return a triangle with a material, written by hand after the specification of glTF 2.0."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes() + np.zeros((3, 2), "<f4").tobytes()
    file = io.BytesIO()
    if image is not None:
        image.save(file, "PNG")
    picture = file.getvalue()
    header = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "scene": 0,
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
        ],
        "materials": [material],
        "buffers": [{"byteLength": 60 + len(picture)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 24},
        ],
    }
    if image is not None:
        header["bufferViews"].append({"buffer": 0, "byteOffset": 60, "byteLength": len(picture)})
        header |= {"images": [{"bufferView": 2, "mimeType": "image/png"}], "textures": [{"source": 0}]}
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    content = points + picture
    content += b"\0" * (-len(content) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(content), 0x004E4942) + content
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def test_the_colours_of_gltf_are_linear(tmp_path: Path) -> None:
    (tmp_path / "a.glb").write_bytes(glb({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.0, 1.0, 0.25]}}))
    # 0.5 linear is 188 of 255 in sRGB; a material is opaque unless it has the mode BLEND or MASK.
    assert corner_colors(MeshLoader().load(tmp_path / "a.glb")) == [(188, 0, 255, 255)]
    blend = {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.0, 1.0, 0.25]}, "alphaMode": "BLEND"}
    (tmp_path / "b.glb").write_bytes(glb(blend))
    assert corner_colors(MeshLoader().load(tmp_path / "b.glb")) == [(188, 0, 255, 64)]


def test_the_colour_of_gltf_multiplies_linear_texels(tmp_path: Path) -> None:
    material = {"pbrMetallicRoughness": {"baseColorFactor": [0.25, 1, 1, 1], "baseColorTexture": {"index": 0}}}
    (tmp_path / "a.glb").write_bytes(glb(material, Image.new("RGBA", (2, 2), (188, 188, 0, 10))))
    pixel = MeshLoader().load(tmp_path / "a.glb").textures[0].pixels[0, 0].tolist()
    assert pixel[1:] == [188, 0, 255]
    assert pixel[0] == pytest.approx(99, abs=1)  # linear 0.503 / 4 = 0.126 is 99 in sRGB


def shape_of(folder: Path, urdf: str) -> Shape:
    (folder / "robot.urdf").write_text(f'<robot name="r"><link name="a"><visual>{urdf}</visual></link></robot>')
    return scene_of(load(folder / "robot.urdf")).shapes[0]


MESH = '<geometry><mesh filename="a.obj"/></geometry>'
BLUE = '<material name="m"><color rgba="0 0 1 0.5"/></material>'


def test_a_urdf_colour_fills_what_the_file_leaves_open(tmp_path: Path) -> None:
    obj(tmp_path, "newmtl red\nKd 1 0 0\n", f"usemtl red\n{FACE}usemtl unknown\nf 1/1 3/3 4/4\n")
    shape = shape_of(tmp_path, MESH + BLUE)
    assert not shape.has_color
    assert corner_colors(shape.mesh) == [(0, 0, 255, 255), (255, 0, 0, 255)]
    assert shape.rgba[3] == 0.5  # the opacity applies to all, as in RViz
    grey = shape_of(tmp_path, MESH)
    assert corner_colors(grey.mesh) == [(178, 178, 178, 255), (255, 0, 0, 255)]
    assert grey.rgba[3] == 1.0


def test_a_urdf_colour_paints_a_file_without_materials(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(SQUARE + FACE)
    shape = shape_of(tmp_path, MESH + BLUE)
    assert (shape.has_color, shape.rgba, shape.mesh.colors) == (True, (0.0, 0.0, 1.0, 0.5), None)


@pytest.mark.parametrize("suffix", [".dae", ".glb"])
def test_a_file_with_one_material_keeps_it(tmp_path: Path, suffix: str) -> None:
    box = trimesh.creation.box()
    color = np.array([0.5, 0.25, 1.0, 1.0])
    box.visual = trimesh.visual.TextureVisuals(
        uv=np.zeros((8, 2)), material=trimesh.visual.material.PBRMaterial(baseColorFactor=color)
    )
    box.export(tmp_path / f"a{suffix}")
    shape = shape_of(tmp_path, f'<geometry><mesh filename="a{suffix}"/></geometry>{BLUE}')
    (found,) = corner_colors(shape.mesh)
    expected = {".dae": (128, 64, 255), ".glb": (188, 137, 255)}[suffix]
    assert np.abs(np.array(found[:3]) - expected).max() <= 1
    assert not shape.has_color


def test_a_urdf_texture_fills_what_the_file_leaves_open(tmp_path: Path) -> None:
    Image.new("RGB", (2, 2), (9, 8, 7)).save(tmp_path / "t.png")
    texture = '<material name="m"><texture filename="t.png"/></material>'
    obj(tmp_path, "newmtl red\nKd 1 0 0\n", f"usemtl red\n{FACE}usemtl unknown\nf 1/1 3/3 4/4\n")
    mesh = shape_of(tmp_path, MESH + texture).mesh
    colors = mesh.colors[mesh.faces[:, 0]].tolist()
    assert [colors[k] for k in range(2) if mesh.face_textures[k] < 0] == [[255, 0, 0, 255]]
    assert sorted(mesh.face_textures.tolist()) == [-1, 0]
    obj(tmp_path, "newmtl red\nKd 1 0 0\n", f"usemtl red\n{FACE}")
    assert shape_of(tmp_path, MESH + texture).mesh.textures == ()


DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="c">{effect}</technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="s"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>
"""


def dae_color(folder: Path, effect: str) -> tuple[int, ...]:
    (folder / "a.dae").write_text(DAE.format(effect=effect))
    (color,) = corner_colors(MeshLoader().load(folder / "a.dae"))
    return tuple(color)


@pytest.mark.parametrize(
    ("mode", "color", "factor", "alpha"),
    [
        ("", "1 1 1 1", "0.3", 76),
        (' opaque="A_ONE"', "1 1 1 0.5", "0.5", 64),
        (' opaque="A_ZERO"', "1 1 1 1", "0.7", 77),
        (' opaque="RGB_ZERO"', "1 1 1 1", "0.7", 76),
        (' opaque="RGB_ZERO"', "0 0 0 1", "1", 255),
        (' opaque="RGB_ZERO"', "1 1 1 1", "0", 255),
        (' opaque="RGB_ONE"', "0 1 0 1", "1", 182),
        ("", "0 0 0 1", "1", 255),
        ("", "1 1 1 1", "0", 255),  # written by exporters for opaque parts
    ],
)
def test_the_opacity_of_a_collada_effect_by_its_mode(
    tmp_path: Path, mode: str, color: str, factor: str, alpha: int
) -> None:
    written = (
        f"<transparent{mode}><color>{color}</color></transparent><transparency><float>{factor}</float></transparency>"
    )
    found = dae_color(tmp_path, f"<lambert><diffuse><color>1 0.2 0 1</color></diffuse>{written}</lambert>")
    assert found[:3] == (255, 51, 0)
    assert found[3] == pytest.approx(alpha, abs=1)


PLACES = """<source id="t"><float_array id="u" count="6">0 0 1 0 0 1</float_array>
<technique_common><accessor source="#u" count="3" stride="2"><param name="S" type="float"/>
<param name="T" type="float"/></accessor></technique_common></source><vertices id="v">"""
PICTURE = """<newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="p"><sampler2D><source>s</source></sampler2D></newparam>"""


@pytest.mark.parametrize(("more", "alpha"), [("", 255), ('<transparent><texture texture="p"/></transparent>', 102)])
def test_the_alpha_of_a_collada_texture_is_used_where_the_opacity_is_a_texture(
    tmp_path: Path, more: str, alpha: int
) -> None:
    Image.fromarray(np.full((2, 2, 4), (10, 20, 30, 102), dtype=np.uint8)).save(tmp_path / "p.png")
    emission = '<emission><texture texture="p"/></emission>'
    written = DAE.format(effect=f'<lambert>{emission}<diffuse><texture texture="p"/></diffuse>{more}</lambert>')
    for before, after in (
        ('<vertices id="v">', PLACES),
        ('offset="0"/><p>0 1 2</p>', 'offset="0"/><input semantic="TEXCOORD" source="#t" offset="0"/><p>0 1 2</p>'),
        ('<technique sid="c">', f'{PICTURE}<technique sid="c">'),
        (
            "<library_effects>",
            '<library_images><image id="i"><init_from>p.png</init_from></image></library_images><library_effects>',
        ),
    ):
        assert before in written
        written = written.replace(before, after)
    (tmp_path / "a.dae").write_text(written)
    (texture,) = MeshLoader().load(tmp_path / "a.dae").textures
    assert texture.pixels[0, 0].tolist() == [10, 20, 30, alpha]


@pytest.mark.parametrize(
    ("effect", "color"),
    [
        ("<constant><emission><color>0 0.2 1 1</color></emission></constant>", (0, 51, 255)),
        (
            "<phong><emission><color>0.2 0 0 1</color></emission><diffuse><color>0 0.4 0 1</color></diffuse></phong>",
            (51, 102, 0),
        ),
        (
            "<phong><emission><color>0 0 0 1</color></emission><diffuse><color>1 0.4 0 1</color></diffuse></phong>",
            (255, 102, 0),
        ),
    ],
)
def test_the_emission_of_a_collada_effect_is_seen(tmp_path: Path, effect: str, color: tuple[int, ...]) -> None:
    assert dae_color(tmp_path, effect)[:3] == color
