"""Included files and YAML files whose names differ in capital letters: used with a warning, reported by the linter."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from urdfkit.cli import main
from urdfkit.lint import lint

ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="parts/Arm.xacro"/>
  <link name="base"/>
  <xacro:property name="sizes" value="${xacro.load_yaml('sizes.yaml')}"/>
  <joint name="j" type="fixed"><parent link="base"/><child link="arm"/><origin xyz="${sizes['x']} 0 0"/></joint>
</robot>
"""
ARM = '<robot><link name="arm"/></robot>'


@pytest.fixture(autouse=True)
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("Parts").mkdir()
    Path("Parts/arm.xacro").write_text(ARM)
    Path("Sizes.YAML").write_text("x: 2")
    Path("r.urdf.xacro").write_text(ROBOT)
    if Path("parts/Arm.xacro").exists():
        pytest.skip("file names in any case are the same here")


@pytest.mark.parametrize(
    "command",
    [["tf"], ["info"], ["expand"], ["view", "--html", "p.html"], ["sim", "run", "--for", "0", "--world", "void"]],
)
def test_they_are_used_with_a_warning(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    words = [*command, "r.urdf.xacro"]
    main(words)
    text = capsys.readouterr().err.replace(f"in {Path.cwd()}/Parts", "in Parts").replace(f"in {Path.cwd()};", "in .;")
    name = "the name of the file is"
    assert [line for line in text.splitlines() if "capital" in line] == [
        f"urdfkit: warning: r.urdf.xacro:2:3: parts/Arm.xacro: {name} arm.xacro in Parts; correct the capital letters",
        f"urdfkit: warning: r.urdf.xacro:4:3: sizes.yaml: {name} Sizes.YAML in .; correct the capital letters",
    ]
    main([*words, "-q"])
    assert "capital" not in capsys.readouterr().err


def test_the_linter_reports_them_and_names_the_file() -> None:
    found = {one.line: one for one in lint("r.urdf.xacro") if one.severity == "error"}
    assert "Arm.xacro" in found[2].message
    assert "sizes.yaml" in found[4].message


def test_no_file_is_chosen_among_several(capsys: pytest.CaptureFixture[str]) -> None:
    Path("Parts/arm.xacro").rename("Parts/ARM.xacro")
    Path("Parts/aRM.xacro").write_text(ARM)
    assert main(["tf", "r.urdf.xacro"]) == 2
    assert "parts/Arm.xacro" in capsys.readouterr().err
