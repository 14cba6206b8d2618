"""Vertex clustering, compared with the full mesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from urdfkit.meshes import loader as mesh_module
from urdfkit.meshes import simplification
from urdfkit.meshes.loader import MeshLoader
from urdfkit.meshes.simplification import simplified
from urdfkit.meshes.triangle_mesh import TriMesh


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Meshes of more than 10,000 triangles get about 4,000, in chunks."""
    for name, value in (("MOST_TRIANGLES", 10_000), ("WANTED_TRIANGLES", 4_000), ("CHUNK", 3_000)):
        monkeypatch.setattr(simplification, name, value)
    monkeypatch.setattr(mesh_module, "MOST_TRIANGLES", 10_000)
    monkeypatch.setattr(mesh_module, "CHUNK", 3_000)


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (-0.001, 0.002, 0.001)])
def test_a_large_stl_keeps_its_form(tmp_path: Path, scale: tuple[float, float, float]) -> None:
    full = trimesh.creation.torus(2.0, 0.5, 160, 160)
    full.export(tmp_path / "torus.stl")
    exact = MeshLoader().load(tmp_path / "torus.stl", scale)
    mesh = MeshLoader(is_for_screen=True).load(tmp_path / "torus.stl", scale)
    assert (exact.simplified_from, len(exact.faces)) == (0, 51_200)
    assert mesh.simplified_from == 51_200
    assert 2_000 < len(mesh.faces) < 8_000
    size = np.ptp(exact.bounds, axis=0)
    np.testing.assert_allclose(mesh.bounds, exact.bounds, atol=0.02 * size.max())
    found, wanted = (trimesh.Trimesh(each.vertices, each.faces, process=False) for each in (mesh, exact))
    assert found.volume == pytest.approx(wanted.volume, rel=0.05)  # and so the triangles face outwards
    assert found.area == pytest.approx(wanted.area, rel=0.05)


def test_other_formats_keep_their_colours() -> None:
    ball = trimesh.creation.icosphere(5)
    colors = np.where(ball.vertices[:, 2:] > 0, [[200, 0, 0, 255]], [[0, 0, 200, 255]]).astype(np.uint8)
    of_faces = (ball.triangles_center[:, 2] > 0).astype(np.int32)
    mesh = TriMesh(
        ball.vertices.astype(np.float32), ball.faces.astype(np.int32), colors=colors, face_textures=of_faces, uv=None
    )
    few = simplified(mesh)
    assert few.simplified_from == len(mesh.faces) == 20_480
    assert few.colors is not None
    assert few.face_textures is not None
    away = np.abs(few.vertices[:, 2]) > 0.1
    np.testing.assert_array_equal(few.colors[away, 0] == 200, few.vertices[away, 2] > 0)
    middle = few.vertices[few.faces].mean(axis=1)[:, 2]
    np.testing.assert_array_equal(few.face_textures[np.abs(middle) > 0.1] == 1, middle[np.abs(middle) > 0.1] > 0)
    assert np.linalg.norm(few.vertices, axis=1) == pytest.approx(1.0, abs=0.02)


def test_small_meshes_stay_as_they_are() -> None:
    ball = trimesh.creation.icosphere(3)
    mesh = TriMesh(ball.vertices.astype(np.float32), ball.faces.astype(np.int32))
    assert simplified(mesh) is mesh


def test_all_corners_at_one_point_are_no_fault() -> None:
    mesh = TriMesh(np.zeros((3, 3), np.float32), np.tile(np.arange(3, dtype=np.int32), (10_001, 1)))
    assert len(simplified(mesh).faces) == 0
