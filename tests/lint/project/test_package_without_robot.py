"""A package without a robot, such as bringup: its launch, YAML and build files are linted."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from urdfkit.cli import main

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>A package for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <exec_depend>joint_trajectory_controller</exec_depend>
  <exec_depend>{needed}</exec_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(arm_bringup)
find_package(ament_cmake REQUIRED)
install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME})
ament_package()
"""
LAUNCH = """<launch>
  <arg name="world" default="empty"/>
  <node pkg="controller_manager" exec="ros2_control_node">
    <param from="$(find-pkg-share arm_bringup)/config/controllers.yaml"/>
  </node>
  <node pkg="joy" exec="joy_node" namespace="$(var world)"/>
</launch>
"""
CONTROLLERS = """controller_manager:
  ros__parameters:
    update_rate: 100
    arm_controller:
      type: joint_trajectory_controller/JointTrajectoryController

arm_controller:
  ros__parameters:
    joints: [shoulder, elbow]
    command_interfaces: [position]
    state_interfaces: [position]
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "arm_bringup"
    manifest = MANIFEST.format(name="arm_bringup", needed="controller_manager</exec_depend><exec_depend>joy")
    files = {"launch/arm.launch.xml": LAUNCH, "config/controllers.yaml": CONTROLLERS, "package.xml": manifest}
    for name, text in {**files, "CMakeLists.txt": CMAKE}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def lint_json(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, list[tuple[str, str]], str]:
    status = main(["lint", "--format", "json", *words])
    out, err = capsys.readouterr()
    return status, [(one["code"], Path(one["file"]).name) for one in json.loads(out)], err


@pytest.mark.parametrize("place", ["arm_bringup", "arm_bringup/launch", "."])
def test_its_own_files_are_clean(package, capsys, place):
    status, found, err = lint_json(capsys, place)
    assert (status, found) == (0, [])
    assert "arm_bringup has no robot: only its other files are linted" in err


@pytest.mark.parametrize(
    ("file", "old", "new", "code"),
    [
        ("launch/arm.launch.xml", "$(var world)", "$(var wrld)", "L101"),
        ("config/controllers.yaml", "update_rate", "update_raet", "K962"),
        ("package.xml", "<exec_depend>joy<", "<exec_depend>joyy<", "K972"),
        ("CMakeLists.txt", "launch config", "config", "K973"),
    ],
)
def test_mistakes_are_found_again_from_the_cache_and_at_each_path(package, capsys, file, old, new, code):
    path = package / file
    path.write_text(path.read_text().replace(old, new))
    for _ in range(2):
        status, found, _err = lint_json(capsys, "arm_bringup")
        assert (status, code) == (1, found[0][0])
    assert lint_json(capsys, f"arm_bringup/{file}")[1] == [one for one in found if one[1] == path.name]
    path.write_text(path.read_text().replace(new, old))
    assert lint_json(capsys, "arm_bringup")[:2] == (0, [])


def test_the_robot_of_a_package_beside_it_is_used(package, capsys):
    (package.parent / "arm_description").mkdir()
    (package.parent / "arm_description/package.xml").write_text(MANIFEST.format(name="arm_description", needed="joy"))
    joint = '<joint name="shoulder" type="fixed"><parent link="base"/><child link="arm"/></joint>'
    robot = f'<robot name="arm" kind="x">\n<link name="base"/>\n<link name="arm"/>\n{joint}\n</robot>\n'
    manifest = (package / "package.xml").read_text()
    (package / "package.xml").write_text(manifest.replace(">joy<", ">joy</exec_depend><exec_depend>arm_description<"))
    (package.parent / "arm_description/arm.urdf").write_text(robot)
    status, found, err = lint_json(capsys, "arm_bringup")
    assert status == 1
    assert ("K959", "controllers.yaml") in found
    assert {file for _, file in found} == {"controllers.yaml"}
    assert "has no robot" not in err


def test_an_empty_folder_of_a_package_has_nothing_to_lint(package, capsys):
    (package / "src").mkdir()
    assert main(["lint", "arm_bringup/src"]) == 2
    assert "no robot description" in capsys.readouterr().err


def test_a_package_with_parts_of_robots_is_not_said_to_have_none(package, capsys):
    part = package / "urdf/arm.xacro"
    part.parent.mkdir()
    part.write_text('<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="arm" params=""/></robot>\n')
    robot = package.parent / "cell_description/cell.urdf.xacro"
    robot.parent.mkdir()
    (robot.parent / "package.xml").write_text(MANIFEST.format(name="cell_description", needed="arm_bringup"))
    include = '<xacro:include filename="$(find arm_bringup)/urdf/arm.xacro"/><link name="base"/>'
    robot.write_text(f'<robot name="cell" xmlns:xacro="http://www.ros.org/wiki/xacro">{include}</robot>\n')
    assert "has no robot" not in lint_json(capsys, ".")[2]


def test_packages_of_no_robot_in_a_workspace_with_a_robot_are_linted_too(package, capsys):
    for name in ("cart_description", "deep/joy_bringup"):
        (package.parent / name).mkdir(parents=True)
        (package.parent / name / "package.xml").write_text(MANIFEST.format(name=Path(name).name, needed="joy"))
    (package.parent / "cart_description/cart.urdf").write_text('<robot name="cart"><link name="base"/></robot>\n')
    joy = package.parent / "deep/joy_bringup/joy.launch.xml"
    joy.write_text(LAUNCH.replace("$(var world)", "$(var wrld)").replace("arm_bringup", "joy_bringup"))
    path = package / "launch/arm.launch.xml"
    path.write_text(path.read_text().replace("$(var world)", "$(var wrld)"))
    for _ in range(2):
        status, found, err = lint_json(capsys, ".")
        assert (status, sorted(each for each in found if each[0] == "L101")) == (
            1,
            [("L101", "arm.launch.xml"), ("L101", "joy.launch.xml")],
        )
        assert "2 packages have no robot: only their other files are linted (arm_bringup, joy_bringup)" in err
    path.write_text(path.read_text().replace("$(var wrld)", "$(var world)"))
    joy.unlink()
    (package / "package.xml").write_text(MANIFEST.format(name="arm_bringup", needed="cart_description"))
    assert "joy_bringup has no robot" in (err := lint_json(capsys, ".")[2])
    assert "arm_bringup has no robot" not in err
