"""Branches of conditions that neither the default arguments nor launch files select are linted too."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from urdfkit.cli import main

ROBOT = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="camera" default="false"/>
  <xacro:arg name="drive" default="diff"/>
  <xacro:property name="with_camera" value="$(arg camera)"/>
  <link name="base"/>
  <xacro:CONDITION>
    <link name="mast"/>
    <joint name="mast_joint" type="fixed"><parent link="bse"/><child link="mast"/></joint>
  </xacro:TAG>
</robot>
"""


def found(condition: str, capsys: pytest.CaptureFixture[str], *words: str) -> list[tuple[str, int, str | None]]:
    text = ROBOT.replace("CONDITION", condition).replace("TAG", condition.partition(" ")[0])
    Path("cart.urdf.xacro").write_text(text)
    main(["lint", ".", "--select", "T", "--format", "json", "--no-cache", *words])
    return [(each["code"], each["line"], each["variant"]) for each in json.loads(capsys.readouterr().out)]


@pytest.mark.parametrize(
    ("condition", "variant"),
    [
        ('if value="$(arg camera)"', "camera:=true"),
        ('if value="${with_camera}"', "camera:=true"),
        ('unless value="${not with_camera}"', "camera:=true"),
        ("if value=\"${'$(arg drive)' == 'omni'}\"", "drive:=omni"),
        ("if value=\"$(eval drive == 'omni')\"", "drive:=omni"),
        ('unless value="$(arg camera)"', None),
    ],
)
def test_a_branch_that_is_not_selected_is_linted_with_the_argument_that_selects_it(
    condition: str,
    variant: str | None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert found(condition, capsys) == [("T201", 8, variant)]
    assert bool(found(condition, capsys, "--no-launch-arguments")) == (variant is None)
    assert bool(found(condition, capsys, "camera:=false", "drive:=diff")) == (variant is None)


@pytest.mark.parametrize("condition", ['if value="${with_camera and drive}"', 'if value="false"'])
def test_a_condition_that_no_single_argument_changes_is_not_linted(
    condition: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert found(condition, capsys) == []


def test_findings_outside_of_the_branch_are_those_of_the_default_arguments(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="camera" default="false"/>
  <link name="base"/>
  <xacro:if value="$(arg camera)"><link name="base"/></xacro:if>
  <xacro:unless value="$(arg camera)"><link name="mast"/></xacro:unless>
  <joint name="mast_joint" type="fixed"><parent link="base"/><child link="mast"/></joint>
</robot>
"""
    Path("cart.urdf.xacro").write_text(text)
    main(["lint", ".", "--select", "T", "--format", "json", "--no-cache"])
    found = [(each["code"], each["line"], each["variant"]) for each in json.loads(capsys.readouterr().out)]
    assert found == [("T206", 4, "camera:=true")]
