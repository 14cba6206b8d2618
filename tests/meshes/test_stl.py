"""Our reader of binary STL agrees with trimesh's, bit for bit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from urdfkit.meshes import loader as mesh_module
from urdfkit.meshes.stl import corners_of
from urdfkit.scene import MeshLoader


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (0.001, -0.002, 0.0005)])
def test_a_binary_file_is_read_as_trimesh_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, scale: tuple[float, float, float]
) -> None:
    path = tmp_path / "annulus.stl"
    trimesh.creation.annulus(0.3, 0.5, 0.2, sections=40).export(path)
    own = MeshLoader().load(path, scale)
    monkeypatch.setattr(mesh_module, "corners_of", lambda content: None)
    assert MeshLoader().load(path, scale).hash == own.hash


def test_what_is_no_binary_stl_is_left_to_others() -> None:
    box = trimesh.creation.box()
    binary, text = box.export(file_type="stl"), box.export(file_type="stl_ascii").encode()
    corners = corners_of(binary)
    assert corners is not None
    assert corners.shape == (12, 3, 3)
    np.testing.assert_allclose(corners.reshape(-1, 3).max(axis=0), 0.5)
    for content in (b"", text, binary[:-1], binary[:80] + b"\0\0\0\0"):
        assert corners_of(content) is None
    np.testing.assert_array_equal(corners_of(binary + b"more"), corners)  # Assimp reads such a file, too
    assert corners_of(b"solid named so by some exporters".ljust(80) + binary[80:]) is not None
