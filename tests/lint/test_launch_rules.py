"""Launch files of several packages: which files a finding takes into account."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="2">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>A package for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend>{needed}</exec_depend>
</package>
"""
SPAWN = '<launch>\n  <node name="s" pkg="controller_manager" type="spawner" args="drive_controller"/>\n</launch>\n'
LOAD = '<launch>\n  <rosparam command="load" file="$(find cart_description)/config/control.yaml"/>\n</launch>\n'
GAZEBO = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"/>
  <node name="s" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model cart"/>
</launch>
"""


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A package with a robot and its controllers."""
    package = tmp_path / "cart_description"
    write(package / "package.xml", MANIFEST.format(name=package.name, needed="controller_manager"))
    write(package / "cart.urdf", '<robot name="cart">\n  <link name="base"/>\n</robot>\n')
    write(package / "config/control.yaml", "drive_controller:\n  type: diff_drive_controller/DiffDriveController\n")
    return tmp_path


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def codes(folder: Path) -> set[str]:
    here = Path.cwd()
    os.chdir(folder)
    try:
        return {finding.code for finding in lint("cart_description/cart.urdf")}
    finally:
        os.chdir(here)


def test_parameters_are_missing_unless_an_unrelated_launch_file_loads_them(source):
    write(source / "cart_description/launch/spawn.launch", SPAWN)
    assert "L112" in codes(source)
    write(source / "bringup/package.xml", MANIFEST.format(name="bringup", needed="rviz"))
    write(source / "bringup/launch/all.launch", LOAD)
    assert "L112" not in codes(source)


def test_a_description_is_missing_unless_an_including_launch_file_sets_it(source):
    write(source / "cart_description/launch/gazebo.launch", GAZEBO)
    assert "L113" in codes(source)
    including = '<launch>\n  <param name="robot_description" textfile="$(find cart_description)/cart.urdf"/>\n'
    including += '  <include file="$(find cart_description)/launch/gazebo.launch"/>\n</launch>\n'
    write(source / "cart_description/launch/all.launch", including)
    assert "L113" not in codes(source)


@pytest.mark.parametrize("tools", ["catkin", "ament_cmake", "catkin ament_cmake"])
def test_the_build_tool_decides_which_ros_reads_a_launch_file(source, tools):
    tags = "".join(f"  <buildtool_depend>{tool}</buildtool_depend>\n" for tool in tools.split())
    manifest = MANIFEST.replace("  <buildtool_depend>catkin</buildtool_depend>\n", tags)
    write(source / "cart_description/package.xml", manifest.format(name="cart_description", needed="rviz"))
    text = (
        '<launch>\n  <arg name="a" default="1"/>\n  <node name="r" pkg="rviz" {}="rviz" args="$({} a)"/>\n</launch>\n'
    )
    write(source / "cart_description/launch/one.launch", text.format("type", "arg"))
    assert ("L109" in codes(source)) is (tools == "ament_cmake")
    write(source / "cart_description/launch/one.launch", text.format("exec", "var"))
    assert ("L109" in codes(source)) is (tools == "catkin")
