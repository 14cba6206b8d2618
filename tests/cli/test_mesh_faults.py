"""Whatever is wrong with a mesh file, the viewer's repair has a finding in the same line, and both name the defect."""

from __future__ import annotations

import re
import shutil
import struct
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("collada")

import trimesh

from urdfkit.cli import main
from urdfkit.lint import lint
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

CRATE = Path(__file__).parents[1] / "lint/rules/texture-missing"
BOX = trimesh.creation.box()
STL, TEXT, OBJ, DAE, GLB = (BOX.export(file_type=kind) for kind in ("stl", "stl_ascii", "obj", "dae", "glb"))
RUBBISH = bytes((37 * n * n + 11) % 251 for n in range(700))


def changed(content: bytes | str, old: str, new: str) -> bytes:
    """Return the content with the first match of a pattern replaced."""
    before = content.encode() if isinstance(content, str) else content
    after = re.sub(old.encode(), new.encode(), before, count=1)
    assert after != before
    return after


def with_vertex(content: bytes, at: int, number: float) -> bytes:
    """Return the content with a 32-bit number at a position."""
    return content[:at] + struct.pack("<f", number) + content[at + 4 :]


NOT_FINITE = "is invalid: a vertex is not finite"
FILES = {
    "nan.stl": (with_vertex(STL, 84 + 50 * 7 + 12 + 4, float("nan")), NOT_FINITE),
    "inf.stl": (with_vertex(STL, 84 + 50 * 11 + 44, float("-inf")), NOT_FINITE),
    "nan_text.stl": (changed(TEXT, r"vertex \S+", "vertex nan"), NOT_FINITE),
    "large_text.stl": (changed(TEXT, r"vertex \S+", "vertex 1e39"), NOT_FINITE),
    "word_text.stl": (changed(TEXT, r"vertex \S+", "vertex x"), "not a valid STL file"),
    "inf.obj": (changed(OBJ, r"v \S+", "v inf"), NOT_FINITE),
    "large.obj": (changed(OBJ, r"v \S+", "v 1e+039"), NOT_FINITE),
    "word.obj": (changed(OBJ, r"v \S+", "v x"), "not a valid OBJ file"),
    "corner.obj": (changed(OBJ, r"f \S+", "f x"), "the corner `x` of a face is not a number"),
    "cut.dae": (DAE[: len(DAE) // 2], "its XML is invalid on line"),
    "source.dae": (
        changed(DAE, r'<input semantic="POSITION" source="#', '<input semantic="POSITION" source="#no'),
        "DA",
    ),
    "nan.glb": (with_vertex(GLB, GLB.index(struct.pack("<3f", *BOX.vertices[3])), float("nan")), NOT_FINITE),
    "old.glb": (GLB[:4] + struct.pack("<I", 1) + GLB[8:], "not a valid binary glTF file"),
    "text.glb": (b"glTF" + struct.pack("<4I", 2, 28, 8, 0x4E4F534A) + b"no JSON!", "its JSON is invalid on line 1"),
    "text.gltf": (b"{]", "its JSON is invalid on line 1, column 2"),
    **{f"rubbish.{kind}": (RUBBISH, "") for kind in ("stl", "obj", "dae", "glb", "gltf", "ply")},
    **{f"empty.{kind}": (b"", "is empty") for kind in ("stl", "obj", "dae", "glb", "gltf", "ply")},
    "page.dae": (b"<!DOCTYPE html><html></html>", "is not a COLLADA file but a web page (HTML)"),
    "image.stl": (b"\x89PNG\r\n\x1a\n" + RUBBISH, "is not an STL file but a PNG image"),
    "other.obj": (GLB, "is not an OBJ file but a binary glTF file: rename it to end with .glb"),
}


@pytest.mark.slow
def test_each_repair_has_a_finding_in_its_line_and_names_the_defect(tmp_path: Path, capfd, monkeypatch) -> None:
    monkeypatch.setattr("urdfkit.description.urdf.repair_record.SMALLEST_GROUP", 1_000)  # a line for each
    files = {"whole.stl": (STL, ""), "whole.obj": (OBJ.encode(), ""), "whole.dae": (DAE, ""), "whole.glb": (GLB, "")}
    rows = ['<robot name="r"><link name="base">']
    for name, (content, _) in (files | FILES).items():
        (tmp_path / name).write_bytes(content)
        rows.append(f'<visual><geometry><mesh filename="{name}"/></geometry></visual>')
    robot = tmp_path / "r.urdf"
    robot.write_text("\n".join([*rows, "</link></robot>"]))
    assert main(["view", str(robot), "--html", str(tmp_path / "page.html")]) == 0
    shown = dict(re.findall(r"warning: \S+?:(\d+):\d+: (.*)", capfd.readouterr().err))
    found = {str(each.line): each.message for each in lint(robot, select=["G607"])}
    expected = {str(2 + len(files) + n): name for n, name in enumerate(FILES)}
    assert sorted(expected[line] for line in shown) == sorted(FILES)
    assert [expected[line] for line in found] == list(FILES)
    for line, name in expected.items():
        assert FILES[name][1] in shown[line]
        assert "Error" not in shown[line]


def test_each_texture_that_is_not_shown_has_a_finding_in_its_line(tmp_path: Path, capfd) -> None:
    shutil.copytree(CRATE, tmp_path / "crate")
    robot = tmp_path / "crate/bad.urdf"
    assert main(["view", str(robot), "--html", str(tmp_path / "page.html")]) == 0
    shown = re.findall(r"warning: \S+?:(\d+):\d+: texture `(.*?)`.*(exist|picture|pull`);", capfd.readouterr().err)
    assert sorted(int(line) for line, _, _ in shown) == [3, 6, 10]
    assert [each.line for each in lint(robot, select=["G618"])] == [3, 6, 10]
    assert main(["view", str(tmp_path / "crate/good.urdf"), "--html", str(tmp_path / "page.html")]) == 0
    assert "texture `" not in capfd.readouterr().err


def test_a_texture_that_returns_ends_its_finding(tmp_path: Path) -> None:
    shutil.copytree(CRATE, tmp_path / "crate")
    robot = tmp_path / "crate/bad.urdf"

    def lines() -> list[int]:
        return [each.line for each in run([Entry(robot)], Options(), cached=True).findings if each.code == "G618"]

    found = [lines(), lines()]
    for name in ("textures/gone.png", "meshes/gone.png", "meshes/pointer.png"):
        (tmp_path / "crate" / name).parent.mkdir(exist_ok=True)
        shutil.copy(CRATE / "materials/textures/wood.png", tmp_path / "crate" / name)
        found.append(lines())
    assert found == [[3, 6, 10], [3, 6, 10], [3, 6], [6], []]
