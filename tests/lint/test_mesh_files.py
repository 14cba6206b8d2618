"""The smallest content that a mesh file must have, byte by byte."""

from __future__ import annotations

import os
import struct
from pathlib import Path

import numpy as np
import pytest

from urdfkit.description.meshes.bounds import bounds
from urdfkit.lint import lint
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

TRIANGLE = struct.pack("<12f2x", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0)
ASCII = b"""solid a
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid a
"""


def binary(count: int, *triangles: bytes, header: bytes = b"") -> bytes:
    return header.ljust(80, b" ") + struct.pack("<I", count) + b"".join(triangles)


@pytest.mark.parametrize(
    ("name", "content", "fault"),
    [
        ("a.stl", b"", "is empty"),
        ("a.stl", b"version https://git-lfs.github.com/spec/v1\n", "is a Git LFS pointer: run `git lfs pull`"),
        ("a.stl", b"solid a\nendsolid a\n", "contains no triangles"),
        ("a.stl", binary(0)[:-1], "is truncated: 83 bytes, but 0 triangles need 84"),
        ("a.stl", binary(0), "contains no triangles"),
        ("a.stl", binary(1, TRIANGLE[:-1]), "is truncated: 133 bytes, but 1 triangles need 134"),
        ("a.stl", binary(2, TRIANGLE, TRIANGLE[:-1]), "is truncated: 183 bytes, but 2 triangles need 184"),
        ("a.stl", binary(1, TRIANGLE), None),
        ("a.stl", binary(1, TRIANGLE, b"more"), None),
        ("a.stl", binary(1, TRIANGLE, header=b"solid by a program"), None),
        ("a.STL", binary(0), "contains no triangles"),
        ("a.stl", ASCII, None),
        ("a.stl", b" \n" + ASCII, None),
        ("a.dae", b"<html/>", "is not a COLLADA file but a web page (HTML): download the file again"),
        ("a.dae", b"glTF", "is not a COLLADA file but a binary glTF file: rename it to end with .glb"),
        ("a.gltf", b"\x89PNG\r\n", "is not a glTF file but a PNG image"),
        ("a.ply", b"\0\1\2", "is not a PLY file"),
        ("a.glb", b"gltf", "is not a binary glTF file"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "contains no triangles"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", None),
        ("a.obj", b"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "has all vertices at one point"),
    ],
)
def test_the_fault_of_a_mesh_file(name: str, content: bytes, fault: str | None, write) -> None:
    write(name, content)
    mesh = f'<link name="a"><visual><geometry><mesh filename="{name}"/></geometry></visual></link>'
    messages = [finding.message for finding in lint(write("r.urdf", mesh), select=("G607",))]
    assert messages == ([] if fault is None else [f"mesh `{name}` {fault}"])


def test_messages_give_the_size_of_all_vertices_though_large_meshes_are_estimated_first(tmp_path: Path) -> None:
    corners = np.zeros((60_000, 3, 3))
    corners[:, 1, 0] = corners[:, 2, 1] = 0.05
    corners[31_234, 2, 2] = 0.31  # no sample has this triangle
    records = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    records["corners"] = corners
    (tmp_path / "part.stl").write_bytes(bytes(80) + len(corners).to_bytes(4, "little") + records.tobytes())
    path = tmp_path / "part.urdf"
    for height, wanted in ((0.3, []), (0.5, ["centre of mass of link `part` is 0.19 m outside its shapes"])):
        path.write_text(
            f"""<robot name="part"><link name="part">
            <inertial><origin xyz="0 0 {height}"/><mass value="1"/>
            <inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial>
            <visual><geometry><mesh filename="part.stl"/></geometry></visual></link></robot>"""
        )
        assert [found.message for found in lint(path, select=["I513"])] == wanted


@pytest.mark.parametrize("name", ["pipe.stl", "pipe.dae", "zero.obj"])
def test_pipes_and_devices_are_not_read(name: str, tmp_path: Path) -> None:
    """Reading a pipe that nobody writes to, or /dev/zero, never ends."""
    if name.startswith("pipe"):
        os.mkfifo(tmp_path / name)
    else:
        (tmp_path / name).symlink_to("/dev/zero")
    path = tmp_path / "part.urdf"
    shape = f'<visual><geometry><mesh filename="{name}"/></geometry></visual>'
    path.write_text(f'<robot name="part"><link name="part">{shape}</link></robot>')
    assert bounds(tmp_path / name) is None
    expected = [f"mesh `{name}` is not a regular file"]
    assert [one.message for one in lint(path, select=["G607", "G608"])] == expected
    cached = [run([Entry(path)], Options(), cached=True) for _ in range(2)]
    assert [[one.code for one in outcome.findings] for outcome in cached] == [["G607"]] * 2


def test_meshes_that_have_not_changed_are_searched_for_faults_once(tmp_path: Path, monkeypatch) -> None:
    import trimesh

    from urdfkit.description.meshes import unchanged_files
    from urdfkit.lint.rules.geometry import mesh_corrupt

    read: list[int] = []
    search = mesh_corrupt._stl_fault
    monkeypatch.setattr(mesh_corrupt, "_stl_fault", lambda *words: read.append(1) or search(*words))
    mesh, path = tmp_path / "part.stl", tmp_path / "part.urdf"
    trimesh.creation.box((1.0, 1.0, 1.0)).export(mesh)
    path.write_text(
        '<robot name="part"><link name="part"><visual><geometry><mesh filename="part.stl"/></geometry></visual></link>'
        "</robot>"
    )
    old = mesh.stat().st_mtime_ns
    assert [lint(path, select=["G607"]) for _ in range(2)] == [[], []]
    assert len(read) == 2, "a file that has just changed is read again"
    monkeypatch.setattr(unchanged_files, "_JUST_CHANGED", -(10**12))
    assert [lint(path, select=["G607"]) for _ in range(3)] == [[], [], []]
    assert len(read) == 3
    content = bytearray(mesh.read_bytes())
    content[96:100] = b"\x00\x00\x80\x7f"  # infinite
    mesh.write_bytes(content)
    os.utime(mesh, ns=(old, old))
    assert [one.code for one in lint(path, select=["G607"])] == ["G607"]
