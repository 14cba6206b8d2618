from __future__ import annotations

import importlib.metadata
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.cli import main

MODEL = """<?xml version="1.0"?>
<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="prefix" default=""/>
  <xacro:property name="size" value="${1/3}"/>
  <link name="$(arg prefix)base"><visual><geometry><box size="${size} 1 1"/></geometry></visual></link>
</robot>
"""


@pytest.fixture(autouse=True)
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = Path("robot.urdf.xacro")
    path.write_text(MODEL)
    return path


@pytest.mark.parametrize("arguments", [[], ["prefix:=left_"]])
def test_prints_what_stock_xacro_prints(model: Path, capsys: pytest.CaptureFixture[str], arguments: list[str]) -> None:
    xacro = shutil.which("xacro", path=str(Path(sys.executable).parent))
    assert xacro is not None
    wanted = subprocess.run([xacro, str(model), *arguments], capture_output=True, text=True, check=True).stdout
    assert main(["expand", str(model), *arguments]) == 0
    captured = capsys.readouterr()
    assert captured.out == wanted
    assert captured.err == ""


def test_writes_the_file(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["expand", str(model), "prefix:=x_"]) == 0
    printed = capsys.readouterr().out
    assert main(["expand", str(model), "-o", "out.urdf", "prefix:=x_"]) == 0
    assert Path("out.urdf").read_text() == printed
    assert capsys.readouterr().out == ""


def test_a_failure_leaves_the_file_as_it_was(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.urdf").write_text("precious")
    model.write_text(MODEL.replace("</robot>", '<link name="${oops}"/></robot>'))
    assert main(["expand", str(model), "-o", "robot.urdf"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err == "urdfkit: robot.urdf.xacro:6:1: property `oops` is not defined\n"
    assert Path("robot.urdf").read_text() == "precious"
    assert sorted(path.name for path in Path().iterdir()) == ["robot.urdf", "robot.urdf.xacro"]


def test_a_file_that_was_read_is_not_overwritten(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["expand", str(model), "-o", f"./{model}"]) == 2
    assert "would overwrite" in capsys.readouterr().err
    assert model.read_text() == MODEL


def test_the_folder_of_the_output_must_exist(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("build").mkdir()
    assert main(["expand", str(model), "-o", "biuld/robot.urdf"]) == 2
    message = "cannot write biuld/robot.urdf: no such folder: biuld; did you mean `build`?"
    assert capsys.readouterr().err == f"urdfkit: -o: {message}\n"
    assert not Path("biuld").exists()


def test_an_output_that_cannot_be_written(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("folder").mkdir()
    assert main(["expand", str(model), "-o", "folder"]) == 2
    assert capsys.readouterr().err == "urdfkit: -o: folder is a folder\n"
    assert main(["expand", str(model), "-o", f"{model}/x.urdf"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_notes_go_to_standard_error(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model.write_text(MODEL.replace("</robot>", "<a b=\"${xacro.warning('mind the gap')}\"/></robot>"))
    assert main(["expand", str(model), "prefx:=a"]) == 0
    assert capsys.readouterr().err == (
        "robot.urdf.xacro:6:1: warning: mind the gap\n"
        "urdfkit: warning: no file uses the argument `prefx`; did you mean `prefix`?\n"
    )
    assert main(["expand", "-q", str(model), "prefx:=a"]) == 0
    assert capsys.readouterr().err == ""


def test_robots_by_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["expand", "simpleton"]) == 0
    assert '<robot name="simpleton">' in capsys.readouterr().out


def test_the_program_prints_everything_before_it_leaves(model: Path) -> None:
    command = [sys.executable, "-m", "urdfkit", "expand", str(model)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith("</robot>\n")
    missing = subprocess.run([*command[:-1], "none.xacro"], capture_output=True, text=True, check=False)
    assert (missing.returncode, missing.stdout) == (2, "")
    assert missing.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("body", "status", "lines"),
    [
        ('<link name="${1/3}"/>', 0, ["robot.urdf.xacro: equal to the output of xacro 2.1.1 (15 lines)"]),
        (
            '<link name="${(lambda: 1)}"/>',  # the xacro package prints the address in memory
            1,
            [
                "robot.urdf.xacro: differs from the output of xacro 2.1.1 on line 14, column 42",
                '  xacro:     <link name="&lt;function &lt;lambda&gt; at 0x',
                '  urdfkit:   <link name="&lt;function &lt;lambda&gt;&gt;"/>',
            ],
        ),
        (
            '<link name="a"><xacro:attribute name="n" value="${1 + 1}"/></link>',
            1,
            [
                "robot.urdf.xacro: xacro 2.1.1 fails, but urdfkit expands the file",
                "  xacro: AttributeError: 'int' object has no attribute 'replace'",
            ],
        ),
        (
            r"""<link name="${str.format('\x7b0.real\x7d', 1)}"/>""",
            1,
            [
                "robot.urdf.xacro: urdfkit fails, but xacro 2.1.1 expands the file",
                r"  urdfkit: robot.urdf.xacro:6:1: cannot evaluate `${str.format('\x7b0.real\x7d', 1)}`: the format",
            ],
        ),
        ('<link name="${oops}"/>', 2, []),
    ],
)
def test_compares_with_the_xacro_package(
    model: Path, capsys: pytest.CaptureFixture[str], body: str, status: int, lines: list[str]
) -> None:
    model.write_text(MODEL.replace("</robot>", f"{body}</robot>"))
    version = importlib.metadata.version("xacro")
    assert main(["expand", str(model), "--compare", "prefix:=left_"]) == status
    captured = capsys.readouterr()
    printed = captured.out.splitlines()
    assert len(printed) == len(lines)
    for line, beginning in zip(printed, lines, strict=True):
        assert line.startswith(beginning.replace("2.1.1", version))
    if not lines:
        first, second = captured.err.splitlines()
        assert first.startswith(f"xacro {version} fails too: NameError: name 'oops' is not defined")
        assert second == "urdfkit: robot.urdf.xacro:6:1: property `oops` is not defined"
    assert Path("robot.urdf").exists() is False


def test_a_comparison_writes_no_file(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["expand", str(model), "--compare", "-o", "out.urdf"]) == 2
    assert "not allowed with argument" in capsys.readouterr().err
    assert not Path("out.urdf").exists()


@pytest.mark.parametrize("name", ["world.xacro", "world.urdf"])
def test_sdf_without_xacro_is_refused(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path(name).write_text('<sdf version="1.7"><world name="w"/></sdf>')
    assert main(["expand", name]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.endswith(
        f"this is an SDF file without xacro; simulate it with `urdfkit sim run --world {name}`\n"
    )
    assert len(captured.err.splitlines()) == 1


def test_mjcf_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    Path("m.xml").write_text('<mujoco model="m"><worldbody/></mujoco>')
    assert main(["expand", "m.xml"]) == 2
    assert capsys.readouterr() == ("", "urdfkit: m.xml:1:1: this is an MJCF file (MuJoCo) without xacro\n")


def test_sdf_with_xacro_is_expanded(capsys: pytest.CaptureFixture[str]) -> None:
    Path("world.sdf.xacro").write_text(
        '<sdf version="1.7" xmlns:xacro="http://www.ros.org/wiki/xacro"><world name="w${1 + 1}"/></sdf>'
    )
    assert main(["expand", "world.sdf.xacro"]) == 0
    assert '<world name="w2"/>' in capsys.readouterr().out
