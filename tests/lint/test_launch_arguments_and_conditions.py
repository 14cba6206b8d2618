"""Arguments that included launch files do not have, and inverted conditions, each with the one finding that names it."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

SIMULATION = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("{package}"), "launch", "client.launch.py"])
    client = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(path), condition=IfCondition(LaunchConfiguration("gui"))
    )
    return LaunchDescription([DeclareLaunchArgument("gui", default_value="true"), client])
"""
YAML = """launch:
  - include:
      file: $(find-pkg-share cart)/launch/sim.launch.py
      arg:
        - name: {name}
          value: "false"
"""


@pytest.mark.parametrize(("name", "is_reported"), [("use_gui", True), ("gui", False), ("robot_gui", False)])
def test_an_argument_with_an_optional_word_too_many_is_misspelt(tmp_path, name, is_reported):
    """Without the files that the included file includes, other arguments may be theirs."""
    cart = package(tmp_path / "cart", "ament_cmake", "far_away")
    write(cart / "launch/sim.launch.py", SIMULATION.replace("{package}", "far_away"))
    write(cart / "launch/all.launch.yaml", YAML.replace("{name}", name))
    message = f"sim.launch.py has no argument `{name}`; did you mean `gui`?"
    assert found(cart, "L102") == ([("all.launch.yaml", 5, message)] if is_reported else [])
