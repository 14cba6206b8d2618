"""Meshes: the same distances as embree's, wherever the mesh stands; trees kept on disk are used, and checked."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
import trimesh.ray.ray_pyembree as embree

from tests.scene.rays.conftest import random_poses, scene_of_shapes, shape, units
from urdfkit.description.urdf.robot import Box, Mesh
from urdfkit.scene import TriMesh
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.scene.rays import RayTable, bvh_cache

RAYS = 20_000


def bumpy(seed: int = 0, subdivisions: int = 4) -> trimesh.Trimesh:
    """Return a potato of 20 · 4^subdivisions triangles."""
    ball = trimesh.creation.icosphere(subdivisions=subdivisions)
    x, y, z = ball.vertices.T
    ball.vertices *= (1.0 + 0.2 * np.sin(5 * x + seed) * np.cos(4 * y) * np.sin(3 * z + 1))[:, None]
    return ball


def ours(mesh: trimesh.Trimesh) -> TriMesh:
    return TriMesh(mesh.vertices.astype(np.float32), mesh.faces.astype(np.int32))


def placed(mesh: TriMesh, name: str = "m"):
    return shape(Mesh("m.stl"), name, mesh=mesh)


@pytest.mark.parametrize("solid", ["potato", "ring", "stairs"])
def test_distances_are_embrees(solid: str) -> None:
    random = np.random.default_rng(1)
    made = {
        "potato": bumpy(),
        "ring": trimesh.creation.torus(1.0, 0.3, major_sections=64, minor_sections=32),
        "stairs": trimesh.util.concatenate(
            [trimesh.creation.box((0.4, 1, 0.2 * k), trimesh.transformations.translation_matrix((0.4 * k, 0, 0.1 * k)))
             for k in range(1, 8)]
        ),
    }[solid]  # fmt: skip
    one = placed(ours(made))
    table = RayTable(scene_of_shapes([one]), [one])
    pose = random_poses(random, 1)
    table.place(pose)
    origins = pose[0, :3] + 4.0 * units(random, RAYS)
    directions = pose[0, :3] + random.normal(0.0, 0.6, (RAYS, 3)) - origins
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    hits = table.cast(origins, directions, normals=True)
    moved = made.copy()
    moved.vertices = made.vertices.astype(np.float32)
    moved.apply_transform(pose_matrices(pose)[0])
    places, rays, faces = embree.RayMeshIntersector(moved).intersects_location(origins, directions, False)
    true = np.full(RAYS, np.inf)
    true[rays] = np.linalg.norm(places - origins[rays], axis=1)
    assert np.isfinite(true).mean() > 0.2
    assert np.isclose(hits.distances, true, rtol=0, atol=1e-3).mean() >= 0.999
    agree = hits.triangles[rays] == faces
    assert agree.mean() > 0.99  # the rest pass between two
    facing = np.abs(np.einsum("ij,ij->i", hits.normals[rays][agree], moved.face_normals[faces[agree]]))
    assert np.allclose(facing, 1.0, atol=1e-5)


def test_one_mesh_in_several_places_is_kept_once_and_seen_in_each() -> None:
    mesh = ours(bumpy(subdivisions=3))
    shapes = [placed(mesh, f"m{k}") for k in range(30)]
    table = RayTable(scene_of_shapes(shapes), shapes)
    assert len(table._corners) == 9 * len(mesh.faces)
    random = np.random.default_rng(2)
    poses = random_poses(random, 30, spread=8.0)
    table.place(poses)
    origins, directions = random.uniform(-9, 9, (2000, 3)), units(random, 2000)
    best = np.full(2000, np.inf)
    for k in range(30):
        single = RayTable(scene_of_shapes(shapes[:1]), shapes[:1])
        single.place(poses[k])
        best = np.minimum(best, single.cast(origins, directions).distances)
    assert np.array_equal(table.cast(origins, directions).distances, best)


def test_meshes_and_solids_hide_each_other() -> None:
    shapes = [placed(ours(bumpy(subdivisions=2))), shape(Box((1.0, 1.0, 1.0)), "box")]
    table = RayTable(scene_of_shapes(shapes), shapes)
    for box, first in ((5.0, "box"), (-5.0, "m")):
        table.place([[0, 0, 0, 0, 0, 0, 1.0], [box, 0, 0, 0, 0, 0, 1.0]])
        hits = table.cast((9, 0.01, 0.02), [[-1.0, 0, 0]])
        assert table.shapes[hits.shapes[0]].name == first
        assert bool(hits.triangles[0] >= 0) is (first == "m")


@pytest.fixture
def kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(bvh_cache, "KEPT_FROM", 100)
    return tmp_path / "urdfkit" / "trees"


def test_a_tree_is_built_once_and_then_read(kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = ours(bumpy(subdivisions=3))
    first = bvh_cache.mesh_tree(mesh)
    (file,) = kept.iterdir()
    monkeypatch.setattr(bvh_cache, "_build", None)
    again = bvh_cache.mesh_tree(mesh)
    for name in ("bounds", "links", "order", "corners"):
        assert np.array_equal(getattr(first, name), getattr(again, name))
    assert mesh.hash in file.name


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty", "other", "folder"])
def test_a_broken_tree_is_built_again(kept: Path, damage: str) -> None:
    mesh = ours(bumpy(subdivisions=3))
    first = bvh_cache.mesh_tree(mesh)
    (file,) = kept.iterdir()
    whole = file.read_bytes()
    middle = len(whole) // 2
    broken = {
        "cut": whole[:middle],
        "flipped": whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1 :],
        "empty": b"",
        "other": b"not a tree at all",
    }
    if damage == "folder":
        file.unlink()
        file.mkdir()
    else:
        file.write_bytes(broken[damage])
    again = bvh_cache.mesh_tree(mesh)
    assert np.array_equal(first.bounds, again.bounds)
    if damage != "folder":
        assert file.read_bytes() == whole


def test_without_a_place_to_keep_it_a_tree_is_built_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr(bvh_cache, "KEPT_FROM", 100)
    assert len(bvh_cache.mesh_tree(ours(bumpy(subdivisions=3))).links) > 100
