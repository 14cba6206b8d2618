"""Substitutions that a Python launch file uses as strings before the launch evaluates them."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

LAUNCH = """import os
import xacro
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def setup(context):
    mode, share = LaunchConfiguration("mode"), FindPackageShare("cart")
    file = share.perform(context) + "/cart.xacro"
    text = mode.perform(context)
    mappings = {"mode": text}
    {code}
    content = {"robot_description": model.toxml()}
    return [Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[content])]


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument("mode", default_value="a"), OpaqueFunction(function=setup)])
"""
XACRO = """<robot name="cart" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="mode" default="a"/>
  <link name="base"/>
</robot>
"""
AFTER = "write `.perform(context)` after it"
USES = [
    ("model = xacro.process_file(file, mappings=mappings)", None),
    ('mappings["mode"] = str(int(text))\n    model = xacro.process_file(file, mappings=mappings)', None),
    ('model = xacro.process_file(os.path.join(os.getcwd(), file), mappings=dict(mode="1"))', None),
    (
        "model = xacro.process_file(file, mappings=dict(mode=mode))",
        f"xacro needs a string, not a `LaunchConfiguration`; {AFTER}",
    ),
    (
        'mappings["mode"] = mode; model = xacro.process_file(file, mappings=mappings)',
        f"xacro needs a string, not a `LaunchConfiguration`; {AFTER}",
    ),
    (
        'model = xacro.process_file(file, mappings={"mode": True})',
        "xacro needs a string, not `True`; write it in quotes",
    ),
    (
        'model = xacro.process_file(file, mappings={"mode": str(mode)})',
        f"`str` has no access to the value of a `LaunchConfiguration`; {AFTER}",
    ),
    (
        'model = xacro.process_file(PathJoinSubstitution([share, "cart.xacro"]))',
        f"`process_file` needs a string, not a `PathJoinSubstitution`; {AFTER}",
    ),
    (
        'model = xacro.process_file(os.path.join(share, "cart.xacro"))',
        "`join` needs a string, not a `FindPackageShare`; join the parts with `PathJoinSubstitution`",
    ),
    (
        "model = xacro.parse(open(mode))",
        f"`open` needs a string, not a `LaunchConfiguration`; {AFTER}",
    ),
]


@pytest.mark.parametrize(("code", "message"), USES)
def test_a_substitution_is_no_string(tmp_path, code, message):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "robot_state_publisher", "xacro")
    write(cart / "cart.xacro", XACRO)
    write(cart / "launch/cart.launch.py", LAUNCH.replace("{code}", code))
    assert found(cart, "L105", "L106") == ([("cart.launch.py", 15, message)] if message is not None else [])
