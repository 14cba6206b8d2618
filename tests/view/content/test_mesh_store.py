import struct

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfkit.scene import TriMesh
from urdfkit.view.content.mesh_store import GeometryStore, crease, pack


def tri_mesh(mesh: trimesh.Trimesh, **more) -> TriMesh:
    return TriMesh(np.asarray(mesh.vertices, dtype=np.float32), np.asarray(mesh.faces, dtype=np.int32), **more)


def unpack(packed: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray | None]:
    points, faces, coloured = struct.unpack_from("<III", packed)
    values = np.frombuffer(packed, "<f4", 6 * points, 12).reshape(2, points, 3)
    at = 12 + 24 * points
    triangles = np.frombuffer(packed, "<u4", 3 * faces, at).reshape(faces, 3)
    at += 12 * faces
    colours = np.frombuffer(packed, np.uint8, 4 * points, at).reshape(points, 4) if coloured else None
    assert len(packed) == at + (4 * points if coloured else 0)
    return values[0], values[1], triangles, colours


def test_a_box_keeps_its_edges() -> None:
    box = trimesh.creation.box((1, 2, 3))
    points, normals, faces, _ = unpack(pack(tri_mesh(box)))
    assert len(points) == 24  # each corner once per side
    assert np.allclose(points[faces], box.vertices[box.faces])
    sides = points[faces]
    flat = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    assert np.allclose(normals[faces], flat[:, None], atol=1e-4)


def test_a_sphere_is_smooth() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=3)
    points, normals, _, _ = unpack(pack(tri_mesh(sphere)))
    assert len(points) == len(sphere.vertices)
    assert np.all(np.einsum("ij,ij->i", points, normals) > 0.999)


def test_a_cylinder_is_smooth_around_and_sharp_at_its_ends() -> None:
    _, normals, _, _ = unpack(pack(tri_mesh(trimesh.creation.cylinder(1.0, 2.0, sections=48))))
    side = np.abs(normals[:, 2]) < 0.5
    assert np.allclose(normals[side, 2], 0, atol=1e-3)
    assert np.allclose(np.abs(normals[~side, 2]), 1, atol=1e-3)


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
    _points, normals, faces, found = unpack(pack(tri_mesh(box, normals=given_normals, colors=colours)))
    assert np.array_equal(normals, given_normals)
    assert np.array_equal(found, colours)
    assert np.array_equal(faces, box.faces)
    _, normals, faces, found = unpack(pack(tri_mesh(box, colors=colours)))
    assert np.array_equal(found[faces], colours[box.faces])
    assert np.allclose(np.linalg.norm(normals, axis=1), 1)


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
