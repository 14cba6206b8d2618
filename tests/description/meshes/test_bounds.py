"""Bounding boxes of mesh files by the quick readers are those of all vertices that trimesh reads."""

import io
import json
import math
import random
import re
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh

from urdfkit.description.meshes.bounds import bounds
from urdfkit.description.meshes.collada import contents
from urdfkit.description.meshes.format_faults import NOT_FINITE
from urdfkit.meshes.loader import MeshLoader

FLOAT32 = 1e-6
"""Relative rounding of coordinates in the loader's 32-bit numbers."""
HALF = math.sqrt(0.5)


def mesh(seed: int, subdivisions: int = 1) -> trimesh.Trimesh:
    """Return an ellipsoid at a random place."""
    generator = np.random.default_rng(seed)
    shape = trimesh.creation.icosphere(subdivisions=subdivisions)
    shape.apply_scale(generator.uniform(0.01, 2.0, 3))
    shape.apply_translation(generator.uniform(-1.0, 1.0, 3))
    return shape


def turned(shape: trimesh.Trimesh, angle: float, seed: int) -> trimesh.Scene:
    """Return a scene with a mesh below two nodes, the inner one turned and the outer one moved."""
    generator = np.random.default_rng(seed)
    scene = trimesh.Scene()
    outer = trimesh.transformations.translation_matrix(generator.uniform(-1.0, 1.0, 3))
    inner = trimesh.transformations.rotation_matrix(angle, generator.permutation([1.0, 0.0, 0.0]))
    scene.add_geometry(shape, node_name="inner", transform=outer @ inner)
    return scene


def written(folder: Path, kind: str, shape: trimesh.Trimesh, angle: float, seed: int) -> Path:
    path = folder / f"part.{kind.split()[0]}"
    if kind == "stl text":
        path.write_text(shape.export(file_type="stl_ascii"))
    elif kind == "glb turned":
        path.write_bytes(turned(shape, angle, seed).export(file_type="glb"))
    elif kind == "obj":
        path.write_text(shape.export(file_type="obj"))
    else:
        path.write_bytes(shape.export(file_type=kind))
    return path


@pytest.mark.parametrize("subdivisions", [1, pytest.param(5, marks=pytest.mark.slow)])
@pytest.mark.parametrize("kind", ["stl", "stl text", "obj", "dae", "glb", "glb turned"])
def test_exact_bounds_are_those_of_the_loader(kind: str, subdivisions: int, tmp_path: Path) -> None:
    for seed in range(3):
        path = written(tmp_path, kind, mesh(seed, subdivisions), np.pi / 2, seed)
        expected = MeshLoader().load(path).bounds
        found = bounds(path)
        assert found is not None
        assert np.allclose(found, expected, rtol=FLOAT32, atol=FLOAT32)
        path.unlink()


@pytest.mark.parametrize(
    "rotation", [(0.5, -0.5, 0.5, 0.5), (HALF, 0, 0, HALF), (0, HALF, 0, HALF), (0, 0, HALF, HALF)]
)
def test_nodes_of_gltf_are_scaled_turned_and_moved(rotation: tuple[float, ...], tmp_path: Path) -> None:
    glb = mesh(0).export(file_type="glb")
    (length,) = struct.unpack_from("<I", glb, 12)
    document = json.loads(glb[20 : 20 + length])
    (node,) = (node for node in document["nodes"] if "mesh" in node)
    node.pop("matrix", None)
    node |= {"scale": (1, 2, 3), "rotation": rotation, "translation": (4, 5, 6)}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    size = len(glb) - length + len(text)
    path = tmp_path / "part.glb"
    path.write_bytes(glb[:8] + struct.pack("<II", size, len(text)) + glb[16:20] + text + glb[20 + length :])
    assert np.allclose(bounds(path), MeshLoader().load(path).bounds, rtol=FLOAT32, atol=FLOAT32)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["stl", "stl text", "obj", "dae"])
def test_estimates_lie_inside_and_near_the_bounds(kind: str, tmp_path: Path) -> None:
    for seed in range(3):
        path = written(tmp_path, kind, mesh(seed, 6), 0.0, seed)  # 81,920 triangles
        low, high = np.array(bounds(path))
        inner_low, inner_high = np.array(bounds(path, estimated=True))
        assert (inner_low >= low).all()
        assert (inner_high <= high).all()
        size = high - low
        assert (inner_high - inner_low >= 0.95 * size).all()
        assert (inner_high - inner_low < size).any()
        path.unlink()


DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="inch" meter="0.0254"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="{count}">{text}</float_array><technique_common>
<accessor source="#a" count="{vertices}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles count="{triangles}">
<input semantic="VERTEX" source="#v" offset="0"/><p>{index}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node>{before}<node><matrix>0 -2 0 1 1 0 0 2 0 0 3 3 0 0 0 1</matrix>
<instance_geometry url="#g"/></node></node><node><translate>0.5 0 0</translate><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""


def collada(points: np.ndarray, before: str, space: str = " ") -> str:
    text = space.join(f"{value:.7g}" for value in points.ravel())
    index = " ".join(map(str, range(len(points))))
    return DAE.format(
        count=points.size, text=text, vertices=len(points), triangles=len(points) // 3, index=index, before=before
    )


@pytest.mark.parametrize(
    "before", ["", "<rotate>0 0 1 90</rotate>", "<scale>1 2 3</scale><rotate>0.6 0 0.8 40</rotate>"]
)
@pytest.mark.parametrize("space", [" ", "\n", "  "])
def test_units_and_nodes_of_collada_apply(before: str, space: str, tmp_path: Path) -> None:
    path = tmp_path / "part.dae"
    points = np.random.default_rng(0).normal(size=(6000, 3)) * (1.0, 4.0, 16.0)  # no axis passes for another
    path.write_text(collada(points, before, space))
    expected = MeshLoader().load(path).bounds
    found, estimate = bounds(path), bounds(path, estimated=True)
    assert found is not None
    assert estimate is not None
    assert np.allclose(found, expected, rtol=10 * FLOAT32, atol=FLOAT32)
    if space == "  ":
        assert estimate == found, "where two spaces stand between numbers, all are read"
    else:
        shares = np.subtract(*estimate) / np.subtract(*found)
        assert np.all((shares > 0.5) & (shares <= 1.0))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('<input semantic="VERTEX" source="#v" offset="0"/>', ""),
        (r'(count="18000">)[^<]*', r"\g<1>@7"),
        (r'(count="18000">)[^<]*', r"\g<1>@0"),
        (r'<\?xml version="1.0"', r'\g<0> encoding="foo"'),
        (r'(count="18000">)[^<]*', r"\g<1>" + 40_000 * "1"),
    ],
    ids=["no vertices", "unknown placeholder", "placeholder of another text", "encoding", "one number"],
)
def test_damaged_collada_files_are_left_to_a_full_reader(old: str, new: str, tmp_path: Path) -> None:
    path = tmp_path / "part.dae"
    points = np.random.default_rng(0).normal(size=(6000, 3))
    whole = collada(points, "")
    path.write_text(re.sub(old, new, whole))
    assert path.read_text() != whole
    assert bounds(path) is None
    assert bounds(path, estimated=True) is None


@pytest.mark.parametrize("word", ["nan", "-INF", "1.5"])
@pytest.mark.parametrize("count", [9, 6000], ids=["short", "long"])
def test_vertices_that_are_no_numbers_are_found_in_collada_files(word: str, count: int, tmp_path: Path) -> None:
    path = tmp_path / "part.dae"
    points = np.random.default_rng(0).normal(size=(count, 3))
    normals = '<source id="n"><float_array id="na" count="3">nan nan nan</float_array></source><vertices id="v">'
    text = collada(points, "").replace('<vertices id="v">', normals)
    path.write_text(text.replace(f" {points[7, 1]:.7g} ", f" {word} "))
    assert (contents(path).fault == NOT_FINITE) == (word != "1.5")


@pytest.mark.parametrize("name", ["wood.png", "w" * 600 + ".png"], ids=["short", "long"])
def test_pictures_are_named_in_the_contents_of_a_collada_file(name: str, tmp_path: Path) -> None:
    path = tmp_path / "part.dae"
    image = f"<library_images><image><init_from> {name} </init_from></image></library_images><library_geometries>"
    path.write_text(collada(np.zeros((600, 3)), "").replace("<library_geometries>", image))
    assert contents(path).pictures == (name,)


def test_a_changed_file_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "part.stl"
    path.write_bytes(mesh(0).export(file_type="stl"))
    before = bounds(path)
    path.write_bytes(mesh(1).export(file_type="stl"))
    assert bounds(path) != before


def damaged(content: bytes, generator: random.Random) -> bytes:
    at = generator.randrange(len(content))
    match generator.randrange(4):
        case 0:
            return content[:at]
        case 1:
            return content[:at] + generator.randbytes(8) + content[at + 8 :]
        case 2:
            return content[:at] + content[at // 2 :]
        case _:
            return content.replace(content[at : at + 5], b"nan 1")


@pytest.mark.parametrize("kind", ["stl", "stl text", "obj", "dae", "glb"])
def test_damaged_files_never_raise_and_never_give_wrong_sizes(kind: str, tmp_path: Path) -> None:
    generator = random.Random(0)
    path = written(tmp_path, kind, mesh(0, 3), 0.0, 0)
    content = path.read_bytes()
    found = 0
    for _ in range(150):
        path.write_bytes(damaged(content, generator))
        for estimated in (False, True):
            box = bounds(path, estimated=estimated)
            assert box is None or np.isfinite(box).all()
        found += box is not None
    assert 0 < found < 150, "some of the damage is harmless, some is not"


def test_a_text_whose_last_triangle_is_cut_off_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path, "stl text", mesh(0), 0.0, 0)
    lines = path.read_text().splitlines()
    corner = max(number for number, line in enumerate(lines) if "vertex" in line)
    assert bounds(path) is not None
    path.write_text("\n".join(lines[:corner] + lines[corner + 1 :]))
    assert bounds(path) is None


def test_numbers_that_are_not_finite_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "part.stl"
    content = io.BytesIO(mesh(0, 5).export(file_type="stl")).getbuffer()
    struct.pack_into("<f", content, 84 + 12, float("nan"))
    path.write_bytes(content)
    assert bounds(path) is None
    assert bounds(path, estimated=True) is None
