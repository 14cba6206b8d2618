"""Mistakes in launch files of one or two packages, with the findings that name them."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="{format}">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>A package for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <buildtool_depend>{tool}</buildtool_depend>
{needed}</package>
"""


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def package(folder: Path, tool: str, *needed: str) -> Path:
    """Write a package with the robot `cart` into a folder."""
    lines = "".join(f"  <exec_depend>{each}</exec_depend>\n" for each in needed)
    write(folder / "package.xml", MANIFEST.format(format=2, name=folder.name, tool=tool, needed=lines))
    write(folder / "cart.urdf", '<robot name="cart">\n  <link name="base"/>\n</robot>\n')
    return folder


def found(folder: Path, *codes: str) -> list[tuple[str, int, str]]:
    """Return the file name, line and message of the findings with these codes."""
    findings = [finding for finding in lint(folder) if finding.code in codes]
    return [(Path(finding.file).name, finding.line, finding.message) for finding in findings]


USES = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("{declared}", default_value="false"),
        Node(package="rviz2", executable="rviz2", parameters=[{"use_sim_time": LaunchConfiguration("use_sim_time")}]),
    ])
"""
INCLUDES = """<launch>
  <include file="$(find-pkg-share cart)/launch/view.launch.py">
    <arg name="use_sim_time" value="true"/>
  </include>
</launch>
"""


@pytest.mark.parametrize("declared", ["log", "use_sim_time"])
def test_an_argument_that_only_an_including_file_has_is_a_warning(tmp_path, declared):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "rviz2")
    write(cart / "launch/view.launch.py", USES.replace("{declared}", declared))
    write(cart / "launch/all.launch.xml", INCLUDES)
    message = "launch argument `use_sim_time` is not declared; the file fails unless an including file has it"
    assert found(cart, "L101") == ([("view.launch.py", 11, message)] if declared == "log" else [])


@pytest.mark.parametrize(("needed", "is_reported"), [("nav2_behaviors", True), ("nav2_recoveries", False)])
def test_packages_of_navigation_date_the_release_that_has_no_spawner_py(tmp_path, needed, is_reported):
    cart = package(tmp_path / "cart", "ament_cmake", "controller_manager", needed)
    write(
        cart / "launch/spawn.launch.xml",
        '<launch>\n  <node pkg="controller_manager" exec="spawner.py" args="drive"/>\n</launch>\n',
    )
    message = "package `controller_manager` has no executable `spawner.py` in this release of ROS 2; did you mean"
    reported = found(cart, "L103")
    assert len(reported) == is_reported
    assert all(text.startswith(message) for _, _, text in reported)
