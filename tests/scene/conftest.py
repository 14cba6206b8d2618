from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import trimesh

from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot


@pytest.fixture
def robot_of(tmp_path: Path) -> Callable[[str], Robot]:
    """Write the inside of a ``<robot>`` into a package and load it."""

    def build(inside: str) -> Robot:
        folder = tmp_path / "thing_description" / "urdf"
        folder.mkdir(parents=True, exist_ok=True)
        (folder.parent / "package.xml").write_text("<package><name>thing_description</name></package>")
        (folder / "thing.urdf").write_text(f'<robot name="thing">\n{inside}\n</robot>\n', encoding="utf-8")
        return load(folder / "thing.urdf")

    return build


@pytest.fixture
def meshes(tmp_path: Path) -> Path:
    """Return the mesh folder of that package, with a box of 1 × 2 × 3 m as STL."""
    folder = tmp_path / "thing_description" / "meshes"
    folder.mkdir(parents=True)
    trimesh.creation.box((1, 2, 3)).export(folder / "Wheel.stl")
    return folder
