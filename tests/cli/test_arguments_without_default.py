"""Xacro arguments without a default whose value nobody passes: the linter and the commands report the same defect."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("pinocchio")

from urdfkit.cli import main
from urdfkit.lint import lint

ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  {}
  <link name="$(arg side)_arm"/>
</robot>
"""
LAUNCH = """import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node
def generate_launch_description():
    path = os.path.join(get_package_share_directory('p'), 'urdf', 'r.urdf.xacro')
    text = Command(['xacro ', path, ' side:=left'])
    return LaunchDescription([Node(package='robot_state_publisher', executable='robot_state_publisher',
                                   parameters=[{'robot_description': text}])])
"""


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for folder in ("urdf", "launch"):
        (tmp_path / "p" / folder).mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "p")
    Path("package.xml").write_text('<package format="3"><name>p</name><version>0.0.0</version></package>')
    Path("launch/view.launch.py").write_text(LAUNCH)
    return Path("urdf/r.urdf.xacro")


@pytest.mark.parametrize("argument", [[], ["side:=left"]])
def test_a_declaration_without_default_is_the_only_defect(
    robot: Path, argument: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    robot.write_text(ROBOT.format('<xacro:arg name="side"/>'))
    words = "<xacro:arg> has no attribute `default`"
    arguments = dict(word.split(":=") for word in argument)
    found = [(one.code, one.line, one.message) for one in lint(robot, arguments=arguments) if one.code[0] in "XL"]
    assert found == [("X125", 2, words)]
    assert main(["tf", str(robot), *argument]) == 2
    assert capsys.readouterr().err == f"urdfkit: {robot}:2:3: {words}\n"


def test_an_argument_that_is_only_used_is_one_that_launch_files_pass(
    robot: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    robot.write_text(ROBOT.format(""))
    found = [(one.code, one.severity, one.line) for one in lint(robot) if one.code[0] in "XL"]
    assert found == [("X106", "note", 3)]
    assert main(["tf", str(robot)]) == 2
    required, error = capsys.readouterr().err.splitlines()
    assert required.endswith(
        f"required argument `side`; launch files pass side:=left ({Path('launch/view.launch.py')})"
    )
    assert "argument `side` has no value; pass side:=value" in error
    assert main(["tf", str(robot), "side:=left"]) == 0
    Path("launch/view.launch.py").write_text(LAUNCH.replace("side", "sde"))
    assert {"L102", "X106"} <= {one.code for one in lint(robot)}
