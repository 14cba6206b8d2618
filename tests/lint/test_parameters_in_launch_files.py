"""Parameters in launch files that the node does not have, or under the name of another node or release."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write
from urdfkit.lint import lint

NODE = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="{package}", executable="{program}", parameters=[{"{key}": "x", "use_sim_time": True}]),
    ])
"""


@pytest.mark.parametrize(
    ("needed", "program", "key", "near"),
    [
        ("nav2_map_server", "map_server", "map", "yaml_filename"),
        ("nav2_map_server", "map_server", "yaml_filename", None),
        ("nav2_map_server", "map_server", "latched", ""),
        ("nav2_amcl", "amcl", "base_frame", "base_frame_id"),
        ("robot_state_publisher", "robot_state_publisher", "rate", "publish_frequency"),
        ("robot_state_publisher", "robot_state_publisher", "frame_prefix", None),
        ("joint_state_publisher", "joint_state_publisher", "use_gui", ""),
        ("joint_state_publisher", "joint_state_publisher", "zeros.arm_joint", None),
        ("moveit_ros_move_group", "move_group", "robot_description_srdf", "robot_description_semantic"),
        ("moveit_ros_move_group", "move_group", "robot_description_planning", None),
        ("moveit_ros_move_group", "move_group", "other_description", None),
        ("slam_toolbox", "sync_slam_toolbox_node", "own_setting", None),
    ],
)
def test_parameters_that_a_node_does_not_have(tmp_path, needed, program, key, near):
    cart = package(tmp_path / "cart", "ament_cmake", needed)
    text = NODE
    for name, value in {"package": needed, "program": program, "key": key}.items():
        text = text.replace(f"{{{name}}}", value)
    write(cart / "launch/node.launch.py", text)
    message = f"unknown parameter `{key}` of a node of `{needed}`" + (f"; did you mean `{near}`?" if near else "")
    assert found(cart, "L104") == ([] if near is None else [("node.launch.py", 8, message)])


YAML = """launch:
  - node:
      pkg: nav2_map_server
      exec: map_server
      param:
        - name: map
          value: maps/hall.yaml
"""
ROS1 = """<launch>
  <node pkg="moveit_ros_move_group" type="move_group" name="move_group">
    <param name="{}" value="ompl_interface/OMPLPlanner"/>
  </node>
</launch>
"""


def test_parameters_in_yaml_launch_files(tmp_path):
    cart = package(tmp_path / "cart", "ament_cmake", "nav2_map_server")
    write(cart / "launch/node.launch.yaml", YAML)
    message = "unknown parameter `map` of a node of `nav2_map_server`; did you mean `yaml_filename`?"
    assert found(cart, "L104") == [("node.launch.yaml", 6, message)]


@pytest.mark.parametrize("name", ["planning_plugin", "planning_plugins"])
def test_the_parameter_of_the_planner_in_ros1(tmp_path, name):
    cart = package(tmp_path / "cart", "catkin", "moveit_ros_move_group")
    write(cart / "launch/move_group.launch", ROS1.format(name))
    message = "`moveit_ros_move_group` has no parameter `planning_plugins`; did you mean `planning_plugin`?"
    assert found(cart, "L110") == ([("move_group.launch", 3, message)] if name.endswith("s") else [])


def test_the_parameters_of_a_node_without_a_package_are_unknown(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "moveit_ros_move_group")
    text = ROS1.format("planning_plugins").replace('pkg="moveit_ros_move_group" ', "")
    write(cart / "launch/move_group.launch", text)
    assert [(one.code, one.line) for one in lint(cart)] == [("L109", 2)]


SRDF = '<launch>\n  <param name="{}" textfile="$(find cart)/config/cart.srdf"/>\n</launch>\n'


@pytest.mark.parametrize(
    ("name", "other", "is_reported"),
    [
        ("robot_description_srdf", "", True),
        ("$(arg robot_description)_semantics", "", True),
        ("/robot_description_semantic", "", False),
        ("srdf", "robot_description_semantic", False),
    ],
)
def test_the_parameter_with_the_semantic_description_in_ros1(tmp_path, name, other, is_reported):
    cart = package(tmp_path / "cart", "catkin")
    write(cart / "config/cart.srdf", '<robot name="cart"/>\n')
    write(cart / "launch/a.launch", SRDF.format(name))
    if other:
        write(cart / "launch/b.launch", SRDF.format(other))
    shown = name.replace("$(arg robot_description)", "robot_description")
    message = f"MoveIt reads the SRDF from `robot_description_semantic`, not from `{shown}`"
    assert found(cart, "L110") == ([("a.launch", 2, message)] if is_reported else [])


LOADED = """<launch>
  <node pkg="moveit_ros_move_group" type="move_group" name="move_group">
    <rosparam command="load"{} file="$(find cart)/config/controllers.yaml"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("space", "text", "is_reported"),
    [
        ("", "controller_list:\n  - {name: arm}\n", False),
        (' ns="controllers"', "controller_list:\n  - {name: arm}\n", True),
        (' ns="$(arg space)"', "controller_list:\n  - {name: arm}\n", False),
        (' ns="ompl"', "planner_configs: {}\n", False),
    ],
)
def test_the_list_of_controllers_that_move_group_reads_in_ros1(tmp_path, space, text, is_reported):
    cart = package(tmp_path / "cart", "catkin", "moveit_ros_move_group")
    write(cart / "config/controllers.yaml", text)
    write(cart / "launch/a.launch", LOADED.format(space))
    message = "`moveit_ros_move_group` reads its own parameters, not those in `controllers`; remove `ns`"
    rows = [row for row in found(cart, "L110") if "remove `ns`" in row[2]]
    assert rows == ([("a.launch", 3, message)] if is_reported else [])
