from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh

from urdfkit.errors import MissingDependencyError, ResourceError
from urdfkit.meshes import loader as mesh_module
from urdfkit.scene import MeshLoader, TriMesh

SIZE = (1.0, 2.0, 3.0)


@pytest.fixture
def loader() -> MeshLoader:
    return MeshLoader()


def write_box(folder: Path, suffix: str) -> Path:
    path = folder / f"box{suffix}"
    trimesh.creation.box(SIZE).export(path)
    return path


def solid(mesh: TriMesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)


@pytest.mark.parametrize("suffix", [".stl", ".obj", ".dae", ".glb", ".ply", ".STL"])
def test_formats(loader: MeshLoader, tmp_path: Path, suffix: str) -> None:
    mesh = loader.load(write_box(tmp_path, suffix.lower()).rename(tmp_path / f"mesh{suffix}"))
    assert mesh.vertices.dtype == np.float32
    assert mesh.faces.dtype == np.int32
    assert mesh.faces.shape == (12, 3)
    assert not mesh.vertices.flags.writeable
    np.testing.assert_allclose(mesh.bounds, [[-0.5, -1, -1.5], [0.5, 1, 1.5]])
    assert solid(mesh).volume == pytest.approx(6.0)


def test_vertices_of_an_stl_are_shared_again(loader: MeshLoader, tmp_path: Path) -> None:
    mesh = loader.load(write_box(tmp_path, ".stl"))
    assert mesh.vertices.shape == (8, 3)
    assert solid(mesh).is_watertight
    assert mesh.normals is None


@pytest.mark.parametrize("scale", [(2.0, 1.0, 0.5), (-1.0, 1.0, 1.0), (-1.0, -2.0, -3.0), (0.001, 0.001, 0.001)])
def test_scale_keeps_the_outside_outside(loader: MeshLoader, tmp_path: Path, scale: tuple[float, float, float]) -> None:
    mesh = loader.load(write_box(tmp_path, ".stl"), scale)
    np.testing.assert_allclose(mesh.bounds[1] - mesh.bounds[0], np.abs(np.array(SIZE) * scale), rtol=1e-6)
    assert solid(mesh).volume == pytest.approx(6.0 * abs(np.prod(scale)), rel=1e-5)


DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><created>2024-01-01</created><modified>2024-01-01</modified>UNIT<up_axis>Y_UP</up_axis></asset>
  <library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert>
    <diffuse><color>1 0 0.5 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
      <accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <source id="n"><float_array id="na" count="3">0 0 1</float_array><technique_common>
      <accessor source="#na" count="1" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1" material="s"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="NORMAL" source="#n" offset="1"/><p>0 0 1 0 2 0</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node id="a"><translate>0 0 5</translate><instance_geometry url="#g"><bind_material><technique_common>
      <instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry></node>
    <node id="b"><scale>1 1 -1</scale><instance_geometry url="#g"><bind_material><technique_common>
      <instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


def test_collada_nodes_units_normals_and_colours(loader: MeshLoader, tmp_path: Path) -> None:
    path = tmp_path / "part.dae"
    path.write_text(DAE.replace("UNIT", '<unit name="millimeter" meter="0.001"/>'), encoding="utf-8")
    mesh = loader.load(path, (2.0, 2.0, 2.0))
    assert len(mesh.faces) == 2
    np.testing.assert_allclose(mesh.bounds, [[0, 0, 0], [0.002, 0.002, 0.010]], atol=1e-9)
    assert mesh.normals is not None
    assert mesh.colors is not None
    assert {tuple(color) for color in mesh.colors.tolist()} == {(255, 0, 128, 255)} or {
        tuple(color) for color in mesh.colors.tolist()
    } == {(255, 0, 127, 255)}
    # One instance is mirrored: its normal and the side its triangle shows both point down.
    for triangle in mesh.faces:
        a, b, c = mesh.vertices[triangle]
        facing = np.cross(b - a, c - a)
        expected = 1.0 if a[2] > 0.001 else -1.0
        assert np.sign(facing[2]) == expected
        np.testing.assert_allclose(mesh.normals[triangle[0]], [0, 0, expected], atol=1e-6)


@pytest.mark.parametrize("top", ["n30", "n0"])
def test_a_collada_that_unfolds_is_refused(loader: MeshLoader, tmp_path: Path, top: str) -> None:
    """Thirty nodes, each with two instances of the one before, are a thousand million; n0 contains itself."""
    nodes = "".join(
        f'<node id="n{k}"><instance_node url="#n{k - 1}"/><instance_node url="#n{k - 1}"/></node>' for k in range(1, 31)
    )
    library = f'<library_nodes><node id="n0"><instance_node url="#{top}"/></node>{nodes}</library_nodes>'
    scene = f'<node id="all"><instance_node url="#{top}"/></node></visual_scene>'
    path = tmp_path / "bomb.dae"
    text = DAE.replace("UNIT", "").replace("<library_visual_scenes>", f"{library}<library_visual_scenes>")
    path.write_text(text.replace("</visual_scene>", scene), encoding="utf-8")
    with pytest.raises(ResourceError, match=r"mesh bomb\.dae is rejected: its nodes unfold into more than 20000"):
        loader.load(path)


def test_collada_instances_of_nodes_are_flattened(loader: MeshLoader, tmp_path: Path) -> None:
    node = '<node id="part"><translate>0 0 7</translate><instance_geometry url="#g"/></node>'
    library = f"<library_nodes>{node}</library_nodes>"
    scene = '<node id="all"><instance_node url="#part"/></node></visual_scene>'
    path = tmp_path / "part.dae"
    text = DAE.replace("UNIT", "").replace("<library_visual_scenes>", f"{library}<library_visual_scenes>")
    path.write_text(text.replace("</visual_scene>", scene), encoding="utf-8")
    mesh = loader.load(path)
    assert len(mesh.faces) == 3
    np.testing.assert_allclose(mesh.bounds[1], [1, 1, 7])


@pytest.mark.parametrize("unit", ["", '<unit meter="1"/>', '<unit meter="many"/>', '<unit meter="0"/>'])
def test_collada_is_in_metres_by_default(loader: MeshLoader, tmp_path: Path, unit: str) -> None:
    path = tmp_path / "part.dae"
    path.write_text(DAE.replace("UNIT", unit), encoding="utf-8")
    np.testing.assert_allclose(loader.load(path).bounds[1], [1, 1, 5])


def test_an_obj_takes_its_colours_from_its_material_file(loader: MeshLoader, tmp_path: Path) -> None:
    path = tmp_path / "part.obj"
    path.write_text("mtllib part.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    library = tmp_path / "part.mtl"
    library.write_text("newmtl paint\nKd 1.0 0.0 0.0\n")
    red = loader.load(path)
    assert red.colors is not None
    assert red.colors[0].tolist() == [255, 0, 0, 255]
    library.write_text("newmtl paint\nKd 0.0 0.0 1.0\n")
    blue = loader.load(path)
    assert blue.colors is not None
    assert blue.colors[0].tolist() == [0, 0, 255, 255]
    assert red.hash != blue.hash


def test_colours_that_look_alike_as_numbers_stay_apart(loader: MeshLoader, tmp_path: Path) -> None:
    """Colours are four bytes; read as a float some are NaN, and a NaN may change its bits when copied."""
    path = tmp_path / "cloud.ply"
    colors = [[0, 0, 128, 255], [0, 0, 192, 255], [1, 0, 128, 255], [1, 0, 192, 127], [0, 0, 0, 255], [0, 0, 0, 128]]
    made = trimesh.Trimesh(np.eye(3).repeat(2, axis=0), [[0, 2, 4], [1, 3, 5]], process=False, vertex_colors=colors)
    made.export(path)
    mesh = loader.load(path)
    assert mesh.colors is not None
    assert sorted(mesh.colors.tolist()) == sorted(colors)


def test_the_same_content_elsewhere_is_the_same_mesh(loader: MeshLoader, tmp_path: Path) -> None:
    first = write_box(tmp_path, ".stl")
    second = tmp_path / "copy.stl"
    second.write_bytes(first.read_bytes())
    assert loader.load(first) is loader.load(second)
    assert loader.load(first, (2.0, 1.0, 1.0)) is not loader.load(first)
    assert loader.load(first).hash == MeshLoader().load(first).hash
    assert loader.load(first, (2.0, 1.0, 1.0)).hash != loader.load(first).hash


def test_a_file_that_changed_is_read_again(loader: MeshLoader, tmp_path: Path) -> None:
    path = write_box(tmp_path, ".stl")
    before = loader.load(path)
    trimesh.creation.box((5, 5, 5)).export(path)
    after = loader.load(path)
    assert after.hash != before.hash
    np.testing.assert_allclose(after.bounds[1], 2.5)


def _binary_stl(count: int, triangles: bytes) -> bytes:
    return b"\0" * 80 + struct.pack("<I", count) + triangles


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.stl", b"", r"mesh a\.stl "),
        ("a.stl", b"\x00" * 60, r"mesh a\.stl is truncated: 60 bytes instead of 84"),
        ("a.stl", _binary_stl(0, b""), r"mesh a\.stl (has no triangles|cannot be read)"),
        ("a.stl", _binary_stl(2**31, b"\0" * 50), r"mesh a\.stl is truncated: 134 bytes instead of 107374182484"),
        ("a.stl", _binary_stl(1, struct.pack("<12f", *([float("nan")] * 12)) + b"\0\0"), r"a vertex is not finite"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 9\n", r"mesh a\.obj "),
        ("a.obj", b"hello\n", r"mesh a\.obj "),
        (
            "a.ply",
            b"ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\n",
            r"mesh a\.ply cannot be read",
        ),
        ("a.glb", b"glTF\x02\0\0\0\xff\xff\xff\xff", r"mesh a\.glb is truncated"),
        ("a.dae", b"<COLLADA", r"mesh a\.dae cannot be read"),
        ("a.dae", b"<?xml version='1.0'?><html/>", r"mesh a\.dae "),
        ("a.dae", b"solid a\nfacet normal 0 0 1", r"mesh a\.dae is not a COLLADA file but an STL file: rename it"),
        ("a.dae", b"glTF\x02\0\0\0", r"mesh a\.dae is not a COLLADA file but a binary glTF file: rename it"),
        ("a.dae", b"{}", r"mesh a\.dae is not a COLLADA file$"),
        (
            "a.dae",
            b"<!DOCTYPE x [<!ENTITY a 'aa'>]><COLLADA>&a;</COLLADA>",
            r"mesh a\.dae is rejected: it declares a document type",
        ),
        ("a.stl", b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n", r"LFS pointer.*git lfs pull"),
        ("a.step", b"ISO-10303-21;", r"unsupported format.*upported: \.stl"),
        ("a.slt", b"", r"did you mean `\.stl`\?"),
    ],
)
def test_what_is_no_mesh_is_one_line(
    loader: MeshLoader, tmp_path: Path, name: str, content: bytes, message: str
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(ResourceError, match=message) as caught:
        loader.load(path)
    assert "\n" not in str(caught.value)


def test_a_missing_file_names_the_nearest(loader: MeshLoader, tmp_path: Path) -> None:
    write_box(tmp_path, ".stl")
    with pytest.raises(ResourceError, match=r"missing mesh file .*Box\.stl; did you mean `box\.stl`\?"):
        loader.load(tmp_path / "Box.stl")
    with pytest.raises(ResourceError, match=r"missing mesh file"):
        loader.load(tmp_path / "nowhere" / "box.stl")
    (tmp_path / "folder.stl").mkdir()
    with pytest.raises(ResourceError, match=r"mesh folder\.stl is a folder"):
        loader.load(tmp_path / "folder.stl")


def test_too_large_is_refused_before_it_is_read(
    loader: MeshLoader, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_box(tmp_path, ".stl")
    monkeypatch.setattr(mesh_module, "MAX_BYTES", 100)
    with pytest.raises(ResourceError, match="decimate it"):
        loader.load(path)
    monkeypatch.undo()
    monkeypatch.setattr(mesh_module, "MAX_TRIANGLES", 11)
    with pytest.raises(ResourceError, match="more than 11 triangles"):
        loader.load(path)


def test_a_mesh_reads_only_its_own_folder(loader: MeshLoader, tmp_path: Path) -> None:
    """A glTF whose buffer is elsewhere on the disk cannot be read."""
    (tmp_path / "secret.bin").write_bytes(np.zeros(9, np.float32).tobytes())
    folder = tmp_path / "meshes"
    folder.mkdir()
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": "../secret.bin", "byteLength": 36}],
    }
    path = folder / "thing.gltf"
    path.write_text(json.dumps(document))
    with pytest.raises(ResourceError, match=r"mesh thing\.gltf cannot be read"):
        loader.load(path)
    (folder / "near.bin").write_bytes(np.eye(3, dtype=np.float32).tobytes())
    document["buffers"] = [{"uri": "near.bin", "byteLength": 36}]
    path.write_text(json.dumps(document))
    np.testing.assert_allclose(loader.load(path).bounds, [[0, 0, 0], [1, 1, 1]])


def test_a_missing_trimesh_says_what_to_run(
    loader: MeshLoader, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_box(tmp_path, ".obj")
    monkeypatch.setitem(__import__("sys").modules, "trimesh", None)
    with pytest.raises(MissingDependencyError, match=r"pip install 'urdfkit\[view\]'"):
        loader.load(path)


@pytest.mark.parametrize("kind", [b"VEC2", b"VEC4", b"MAT4"])
def test_vertices_without_three_coordinates_are_refused(tmp_path, kind):
    path = tmp_path / "a.glb"
    content = trimesh.creation.box().export(file_type="glb")
    path.write_bytes(content.replace(b"VEC3", kind))
    with pytest.raises(ResourceError, match=r"mesh a\.glb (is invalid: a vertex|cannot be read)"):
        MeshLoader().load(path)
