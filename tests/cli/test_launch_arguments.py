"""Xacro arguments from the launch files of a robot's package, as `sim`, `view` and their output use them."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.cli import main

PAGE = (Path(__file__).parents[2] / "docs/loading.md").read_text("utf-8")

ROBOT = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <!-- Mass of the base [kg] -->
  <xacro:property name="mass" value="$(arg mass)"/>
  <link name="base_$(arg camera)">
    <inertial><mass value="${mass}"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <collision><geometry><box size="0.3 0.3 0.3"/></geometry></collision>
  </link>
</robot>"""
LAUNCH = """<launch>
  <arg name="camera" default="on" description="Whether to add the camera"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher"><param name="robot_description"
    value="$(command 'xacro $(find-pkg-share arm)/urdf/arm.urdf.xacro mass:={mass} camera:=$(var camera)')"/></node>
  <node pkg="{package}" exec="create"/>
</launch>"""


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Write a package whose robot needs two arguments, without launch files."""
    for folder in ("urdf", "launch"):
        (tmp_path / folder).mkdir()
    (tmp_path / "package.xml").write_text("<package><name>arm</name></package>")
    (tmp_path / "urdf" / "arm.urdf.xacro").write_text(ROBOT)
    monkeypatch.chdir(tmp_path)
    return "urdf/arm.urdf.xacro"


def loaded(words: list[str], capsys: pytest.CaptureFixture[str]) -> tuple[bool, str]:
    """Run `sim run` with a missing world; return whether the robot, which is read before, was loaded, and the notes."""
    assert main(["sim", "run", *words, "--for", "0", "--world", "missing.sdf"]) == 2
    err = capsys.readouterr().err
    return "missing.sdf" in err, err


def write(name: str, mass: str, package: str = "ros_gz_sim") -> None:
    Path("launch", name).write_text(LAUNCH.replace("{mass}", mass).replace("{package}", package))


def test_sim_uses_the_arguments_of_the_simulation_launch_file_and_prints_them(
    robot: str, capsys: pytest.CaptureFixture[str]
) -> None:
    write("sim.launch.xml", "2.5")
    write("display.launch.xml", "9", "joint_state_publisher_gui")
    done, err = loaded([robot, "camera:=off"], capsys)
    assert done
    line = "urdfkit: xacro arguments of launch/sim.launch.xml: mass:=2.5 (--no-launch-arguments ignores them)\n"
    assert line in err
    assert line in PAGE
    assert not loaded([robot, "camera:=off", "--no-launch-arguments"], capsys)[0]


def test_view_uses_the_arguments_of_the_display_launch_file(robot: str, capsys: pytest.CaptureFixture[str]) -> None:
    write("sim.launch.xml", "2.5")
    write("display.launch.xml", "9", "joint_state_publisher_gui")
    assert main(["view", robot, "--html", "arm.html"]) == 0
    assert (
        "urdfkit: xacro arguments of launch/display.launch.xml: mass:=9 camera:=on (--no-launch-arguments ignores them)"
        in capsys.readouterr().err
    )
    assert "base_on" in Path("arm.html").read_text()


def test_contradicting_launch_files_are_named_and_none_is_used(robot: str, capsys: pytest.CaptureFixture[str]) -> None:
    write("a.launch.xml", "2.5")
    write("b.launch.xml", "3")
    done, err = loaded([robot], capsys)
    assert not done
    assert (
        "urdfkit: warning: the simulation launch files pass different xacro arguments to urdf/arm.urdf.xacro, and none "
        "is used: mass:=2.5 (launch/a.launch.xml) and mass:=3 (launch/b.launch.xml); choose one, such as mass:=2.5\n"
        in err
    )
    line = "urdfkit: required argument `mass`: Mass of the base [kg]; "
    line += "launch files pass mass:=2.5 (launch/a.launch.xml), mass:=3 (launch/b.launch.xml)\n"
    assert line in err
    assert line in PAGE
    assert (
        "urdfkit: required argument `camera`: Whether to add the camera; launch files pass camera:=on "
        "(launch/a.launch.xml)\n" in err
    )
    done, err = loaded([robot, "mass:=3"], capsys)
    assert done
    assert "xacro arguments of launch/b.launch.xml: camera:=on" in err


def test_a_required_argument_that_no_launch_file_passes_is_listed(
    robot: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["info", robot, "camera:=on"]) == 2
    first, second = capsys.readouterr().err.splitlines()
    assert first == ("urdfkit: required argument `mass`: Mass of the base [kg]; no launch file passes a constant value")
    assert "argument `mass` has no value" in second


def test_a_run_simulates_the_robot_of_the_launch_file(robot: str, capsys: pytest.CaptureFixture[str]) -> None:
    write("sim.launch.xml", "2.5")
    assert main(["sim", "run", robot, "--for", "0.1"]) == 0
    out, err = capsys.readouterr()
    assert "base base_on: x 0.0000 y 0.0000 z " in out
    assert "xacro arguments of launch/sim.launch.xml: mass:=2.5 camera:=on" in err


def test_a_run_with_contradicting_launch_files_needs_one_argument(
    robot: str, capsys: pytest.CaptureFixture[str]
) -> None:
    write("a.launch.xml", "2.5")
    write("b.launch.xml", "3")
    assert main(["sim", "run", robot, "--for", "0.1"]) == 2
    assert "choose one, such as mass:=2.5" in capsys.readouterr().err
    assert main(["sim", "run", robot, "mass:=3", "--for", "0.1"]) == 0
    assert "base base_on: x 0.0000 y 0.0000 z " in capsys.readouterr().out
