import gzip
import io
import json
import struct

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from urdfkit.meshes.textures import Texture
from urdfkit.scene import TriMesh
from urdfkit.view.content.crease_normals import crease
from urdfkit.view.content.mesh_encoding import pack
from urdfkit.view.content.mesh_store import GeometryStore


def tri_mesh(mesh: trimesh.Trimesh, **more) -> TriMesh:
    return TriMesh(np.asarray(mesh.vertices, dtype=np.float32), np.asarray(mesh.faces, dtype=np.int32), **more)


def unpack(packed: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray | None]:
    """Decode a mesh as the format is documented; return points, normals, faces and colours."""
    found = decoded(packed)
    return found["position"], found["normal"], found["index"].reshape(-1, 3), found.get("color")


def decoded(packed: bytes) -> dict:
    content = gzip.decompress(packed)
    (size,) = struct.unpack_from("<I", content)
    header = json.loads(content[4 : 4 + size])
    at, of = 4 + size, None
    found: dict = {"parts": header["parts"]}
    for stream in header["streams"]:
        width, rows, depth = stream["width"], stream["rows"], stream["bytes"]
        planes = np.frombuffer(content, np.uint8, width * rows * depth, at).reshape(width, depth, rows).astype(np.int64)
        at += width * rows * depth
        table = (planes << (8 * np.arange(depth))[:, None]).sum(axis=1).T
        if stream["name"] in ("index", "of"):
            mark, numbers = 0, []
            for code in table[:, 0].tolist():
                numbers.append(mark - code)
                mark += code == 0
            if stream["name"] == "of":
                of = np.array(numbers)
            else:
                found["index"] = np.array(numbers)
            continue
        values = np.cumsum((table >> 1) ^ -(table & 1), axis=0)
        values = values if of is None else values[of]
        of = None
        if "step" in stream:
            values = values * stream["step"] + np.array(stream.get("low", 0.0))
        if stream["name"] == "normal":
            x, y = (values - 1.0).T
            z = 1.0 - abs(x) - abs(y)
            under = z < 0
            x, y = (
                np.where(under, (1 - abs(y)) * np.where(x >= 0, 1, -1), x),
                np.where(under, (1 - abs(x)) * np.where(y >= 0, 1, -1), y),
            )
            values = np.stack([x, y, z], axis=1)
            values /= np.linalg.norm(values, axis=1, keepdims=True)
        found[stream["name"]] = values
    assert at == len(content)
    return found


def test_a_box_keeps_its_edges() -> None:
    box = trimesh.creation.box((1, 2, 3))
    points, normals, faces, _ = unpack(pack(tri_mesh(box)))
    assert len(points) == 24  # each corner once per side
    assert np.allclose(points[faces], box.vertices[box.faces], atol=3 / 65535)
    sides = points[faces]
    flat = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    assert np.allclose(normals[faces], flat[:, None], atol=1e-9)


def test_a_sphere_is_smooth() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=3)
    points, normals, _, _ = unpack(pack(tri_mesh(sphere)))
    assert len(points) == len(sphere.vertices)
    assert np.all(np.einsum("ij,ij->i", points, normals) > 0.999)


def test_a_cylinder_is_smooth_around_and_sharp_at_its_ends() -> None:
    points, normals, _, _ = unpack(pack(tri_mesh(trimesh.creation.cylinder(1.0, 2.0, sections=48))))
    side = np.abs(normals[:, 2]) < 0.5
    assert np.allclose(normals[side, 2], 0, atol=2e-3)
    assert np.allclose(normals[side, :2], points[side, :2], atol=0.05)  # of the radius 1; a facet is 0.13 wide
    assert np.allclose(np.abs(normals[~side, 2]), 1, atol=2e-3)


def test_triangles_without_shared_vertices_look_the_same() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=2)
    corners = sphere.vertices[sphere.faces].reshape(-1, 3)
    soup = trimesh.Trimesh(corners, np.arange(len(corners)).reshape(-1, 3), process=False)
    assert len(unpack(pack(tri_mesh(soup)))[0]) == len(sphere.vertices)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 40), st.integers(3, 20), st.randoms(use_true_random=False))
def test_any_triangles_get_unit_normals_and_keep_their_corners(count: int, places: int, random) -> None:
    vertices = np.array([[random.uniform(-1, 1) for _ in range(3)] for _ in range(places)])
    faces = np.array([[random.randrange(places) for _ in range(3)] for _ in range(count)], dtype=np.int64).reshape(
        -1, 3
    )
    points, normals, triangles = crease(vertices, faces)
    assert np.allclose(points[triangles], vertices[faces].astype(np.float32))
    assert np.allclose(np.linalg.norm(normals, axis=1), 1)


def test_own_normals_and_colours_are_kept() -> None:
    box = trimesh.creation.box()
    colours = np.arange(4 * len(box.vertices), dtype=np.uint8).reshape(-1, 4)
    given_normals = np.asarray(box.vertex_normals, dtype=np.float32)
    points, normals, faces, found = unpack(pack(tri_mesh(box, normals=given_normals, colors=colours)))
    assert np.allclose(points[faces], box.vertices[box.faces], atol=1e-4)
    angles = np.arccos(np.minimum((normals[faces] * given_normals[box.faces]).sum(axis=-1), 1.0))
    assert np.rad2deg(angles).max() < 0.2
    assert np.array_equal(found[faces], colours[box.faces])
    _, normals, faces, found = unpack(pack(tri_mesh(box, colors=colours)))
    assert np.array_equal(found[faces], colours[box.faces])
    assert np.allclose(np.linalg.norm(normals, axis=1), 1)


def test_parts_have_one_gloss_each() -> None:
    box = trimesh.creation.box()
    glosses = np.array([[0, 0, 0, 0], [0.5, 0.5, 0.5, 8]], dtype=np.float32)
    which = np.arange(len(box.faces)) % 2
    mesh = tri_mesh(box, face_gloss=glosses[which])
    store = GeometryStore()
    found = decoded(store.get(store.add(mesh)))
    assert [(part["first"], part["count"], part["gloss"]) for part in found["parts"]] == [
        (0, 6, glosses[0].tolist()),
        (6, 6, glosses[1].tolist()),
    ]


@pytest.mark.parametrize("alphas", [(255, 99), (254, 255)])
def test_parts_are_sorted_by_texture_and_name_it(alphas: tuple[int, int]) -> None:
    box = trimesh.creation.box()
    uv = np.random.default_rng(0).uniform(-3.0, 3.0, (len(box.vertices), 2)).astype(np.float32)
    textures = tuple(
        Texture(np.full((2, 2, 4), [k, k, k, alpha], np.uint8)) for k, alpha in zip((9, 7), alphas, strict=True)
    )
    which = np.array([1, -1, 0, 1, -1, 0, 0, 0, 1, -1, -1, 1], dtype=np.int32)
    mesh = tri_mesh(box, uv=uv, textures=textures, face_textures=which)
    store = GeometryStore()
    found = decoded(store.get(store.add(mesh)))
    parts = found["parts"]
    assert [(part["first"], part["count"], part["clear"]) for part in parts] == [
        (0, 4, False),
        (4, 4, alphas[0] < 255),
        (8, 4, alphas[1] < 255),
    ]
    assert parts[0]["texture"] is None
    for part, k in zip(parts[1:], (0, 1), strict=True):
        corners = found["index"].reshape(-1, 3)[part["first"] : part["first"] + part["count"]]
        assert np.allclose(found["uv"][corners], uv[box.faces[which == k]], atol=1e-5)
        image = np.asarray(Image.open(io.BytesIO(store.image(part["texture"]))).convert("RGBA"))
        assert np.abs(image.astype(int) - textures[k].pixels).max() <= 3
    store.keep_only(())
    assert store.image(parts[1]["texture"]) is None


def test_textures_are_sent_in_the_size_that_is_requested() -> None:
    wide = Texture(np.zeros((100, 1500, 4), np.uint8))
    store = GeometryStore()
    store.add(tri_mesh(trimesh.creation.box(), uv=np.zeros((8, 2), np.float32), textures=(wide,)))
    ((name, image),) = store.images
    assert Image.open(io.BytesIO(image)).size == (1500, 100)
    assert Image.open(io.BytesIO(store.image(name, 512))).size == (375, 25)


def test_equal_meshes_are_one() -> None:
    store = GeometryStore()
    one, two = tri_mesh(trimesh.creation.box()), tri_mesh(trimesh.creation.box())
    other = tri_mesh(trimesh.creation.box((1, 1, 2)))
    assert store.add(one) == store.add(two)
    assert len(store) == 1
    name = store.add(other)
    assert len(name) == 64
    store.keep_only({name})
    assert store.get(store.add(other)) is not None
    assert len(store) == 1
    assert store.get(store.add(one)) is not None
    assert store.get("../../etc/passwd") is None


@pytest.mark.slow
def test_a_hundred_thousand_triangles_pack() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=6)  # 81,920
    assert len(unpack(pack(tri_mesh(sphere)))[0]) == len(sphere.vertices)
