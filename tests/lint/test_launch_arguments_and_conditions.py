"""Arguments that included launch files do not have, and inverted conditions of launch files."""

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


CONDITION = """<launch>
  <arg name="{argument}" default="true"/>
  <include {inverted}="$(arg {argument})" file="$(find cart_moveit_config)/launch/move_group.launch"/>
{more}</launch>
"""
ALTERNATIVE = '  <include if="$(arg moveit)" file="$(find cart_moveit_config)/launch/demo.launch"/>\n'
DRIVER = '  <group if="$(arg moveit)">\n    <node pkg="joy" type="joy_node" name="joy"/>\n  </group>\n'


@pytest.mark.parametrize(
    ("inverted", "argument", "more", "is_reported"),
    [
        ("unless", "moveit", "", True),
        ("unless", "moveit", DRIVER, True),
        ("unless", "use_moveit", "", True),
        ("if", "without_moveit", "", True),
        ("if", "moveit", "", False),
        ("unless", "moveit", ALTERNATIVE, False),
        ("unless", "fake_moveit", "", False),
        ("unless", "no_moveit", "", False),
        ("unless", "simulation", "", False),
    ],
)
def test_what_an_argument_names_starts_with_it(tmp_path, inverted, argument, more, is_reported):
    cart = package(tmp_path / "cart", "catkin", "cart_moveit_config", "joy")
    text = CONDITION.replace("{inverted}", inverted).replace("{argument}", argument).replace("{more}", more)
    write(cart / "launch/all.launch", text)
    value = "true" if inverted == "if" else "false"
    message = f"this starts `move_group.launch` if `{argument}` is {value}; the condition is inverted"
    assert found(cart, "L127") == ([("all.launch", 3, message)] if is_reported else [])


def test_a_group_with_a_window_does_not_start_if_the_launch_is_headless(tmp_path):
    cart = package(tmp_path / "cart", "ament_cmake", "rviz2")
    xml = '<launch>\n  <arg name="headless" default="false"/>\n  <group {}="$(var headless)">\n'
    xml += '    <node pkg="rviz2" exec="rviz2"/>\n  </group>\n</launch>\n'
    write(cart / "launch/wrong.launch.xml", xml.format("if"))
    write(cart / "launch/right.launch.xml", xml.format("unless"))
    message = "this starts `rviz2` if `headless` is true; the condition is inverted"
    assert found(cart, "L127") == [("wrong.launch.xml", 3, message)]


ALL = """<launch>
  <arg name="speed" default="1.0"/>
  <arg name="gui" default="true"/>{more}
  <include file="$(find cart)/launch/drive.launch"{option}>{passed}
    <arg name="mode" value="slow"/>
  </include>
</launch>
"""
DRIVE = """<launch>
  <arg name="speed" default="0.5"/>
  <arg name="mode"/>
  <param name="speed" value="$(arg speed)"/>
  <param name="mode" value="$(arg mode)"/>
</launch>
"""


@pytest.mark.parametrize(
    ("more", "option", "passed", "is_reported"),
    [
        ("", "", "", True),
        ("", "", '<arg name="speed" value="$(arg speed)"/>', False),
        ("", "", '<arg name="speed" value="2.0"/>', False),
        ("", ' pass_all_args="true"', "", False),
        ('<param name="v" value="$(eval 2 * arg(\'speed\'))"/>', "", "", False),
        ('<param name="v" value="$(eval speed > 2)"/>', "", "", False),
        ("", ' unless="$(arg speed)"', "", False),
    ],
)
def test_an_unused_argument_that_the_included_file_declares_is_not_passed_on(
    tmp_path, more, option, passed, is_reported
):
    cart = package(tmp_path / "cart", "catkin")
    write(cart / "launch/all.launch", ALL.format(more=more, option=option, passed=passed))
    write(cart / "launch/drive.launch", DRIVE)
    message = "the include does not pass the argument `speed` on to drive.launch, which uses its default"
    assert found(cart, "L102") == ([("all.launch", 4, message)] if is_reported else [])


def test_files_of_ros_2_share_arguments_with_the_files_that_they_include(tmp_path):
    cart = package(tmp_path / "cart", "ament_cmake")
    ros2 = ALL.format(more="", option="", passed="").replace("$(find ", "$(find-pkg-share ")
    write(cart / "launch/all.launch.xml", ros2.replace("drive.launch", "drive.launch.xml"))
    write(cart / "launch/drive.launch.xml", DRIVE.replace("(arg", "(var"))
    assert found(cart, "L102") == []


def test_an_unused_argument_of_gazebo_is_not_passed_on(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "gazebo_ros")
    lines = '<arg name="gui" default="true"/><include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
    write(cart / "launch/world.launch", f"<launch>{lines}</launch>")
    message = "the include does not pass the argument `gui` on to empty_world.launch, which uses its default"
    assert found(cart, "L102") == [("world.launch", 1, message)]
