"""Includes and macros that do not exist: the rest of the robot is used, with a warning where lint has a finding."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")

from urdfkit.cli import main
from urdfkit.errors import XacroError
from urdfkit.lint import lint

BODY = (
    '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    '<collision><geometry><box size="0.4 0.3 0.1"/></geometry></collision>'
)
ROBOT = f"""<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find maker_resources)/materials.xacro"/>
  <xacro:include filename="tools.xacro"/>
  <link name="base">{BODY}
    <visual><geometry><box size="0.4 0.3 0.1"/></geometry><xacro:material_orange/></visual></link>
  <link name="upper">{BODY}
    <visual><geometry><box size="0.4 0.3 0.1"/></geometry>
      <material name="grey"><color
        rgba="${{grey}}"/></material></visual></link>
  <joint name="turn" type="fixed"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/></joint>
  <xacro:gripper parent="upper"/>
  <link name="camera">{BODY}</link>
  <joint name="mount" type="fixed"><parent link="palm"/><child link="camera"/></joint>
</robot>
"""
REPAIRS = [("X113", 2), ("X113", 3), ("X103", 5), ("X104", 9), ("X103", 11), ("T201", 13)]


@pytest.fixture(autouse=True)
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = Path("arm.urdf.xacro")
    path.write_text(ROBOT)
    return path


@pytest.mark.parametrize(
    "words",
    [
        ["tf", "arm.urdf.xacro", "base", "upper", "--json"],
        ["info", "arm.urdf.xacro", "--json"],
        ["sim", "run", "arm.urdf.xacro", "--for", "0.01", "--world", "void", "--json"],
    ],
    ids=lambda words: words[0],
)
def test_the_rest_is_used_with_a_finding_at_each_repair(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 0
    out, err = capsys.readouterr()
    repairs = sorted((repair["line"], repair["code"]) for repair in json.loads(out)["repairs"])
    assert repairs == sorted((line, code) for code, line in REPAIRS)
    assert "arm.urdf.xacro:11:3: macro `gripper` is not defined; the call is ignored" in err
    assert "arm.urdf.xacro:3:3: included file tools.xacro does not exist; the include is ignored" in err
    found = {(finding.code, finding.line) for finding in lint("arm.urdf.xacro", target="urdfkit")}
    assert set(REPAIRS) <= found


def test_the_viewer_shows_the_rest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["view", "arm.urdf.xacro", "--html", "page.html"]) == 0
    assert "macro `material_orange` is not defined; the call is ignored" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["info", "--strict"], ["tf", "base", "upper", "--strict"], ["expand"]])
def test_strict_commands_and_expand_refuse_it(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main([words[0], "arm.urdf.xacro", *words[1:]]) == 2
    assert "arm.urdf.xacro:2:3: no package `maker_resources`" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('<mass value="1"/>', '<mass value="${mass}"/>'),
        ('name="upper">', 'name="upper${suffix}">'),
        ("<xacro:gripper ", '<xacro:if value="${gripper}"><link name="x"/></xacro:if><xacro:gripper '),
        ("<xacro:gripper ", '<link name="$(arg prefix)x"/><xacro:gripper '),
        ("<link ", "<xacro:link "),
    ],
    ids=["mass", "name", "condition", "argument", "no link"],
)
def test_a_robot_whose_links_depend_on_what_is_missing_is_refused(old: str, new: str, robot: Path) -> None:
    from urdfkit.description.loading import load_repaired

    robot.write_text(ROBOT.replace(old, new).replace("</link>", "</xacro:link>" if "<xacro:link" in new else "</link>"))
    with pytest.raises(XacroError, match="no package `maker_resources`"):
        load_repaired(robot)
