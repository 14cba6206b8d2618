"""Remappings of nodes that do not have the old name: of the workspace's own nodes and of well-known ones."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

PYTHON = """import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import Float64


class Odometer(Node):
    def __init__(self):
        super().__init__("odometer")
        self.distance = self.create_publisher(Float64, "distance", 1)
        self.create_subscription(Odometry, {topic}, self.read, 1)

    def read(self, message):
        self.distance.publish(Float64(data=0.0))
"""
CPP = """#include "rclcpp/rclcpp.hpp"
class Odometer : public {base} {
  Odometer() : Node("odometer") {
    distance_ = create_publisher<std_msgs::msg::Float64>("distance", 1);
    odometry_ = this->create_subscription<nav_msgs::msg::Odometry>({topic}, 1, read_);
  }
};
"""
LAUNCH = """<launch>
  <node pkg="cart" exec="odometer">
    <remap from="{old}" to="{new}"/>
  </node>
</launch>
"""
NOT_NAMED = "the code of `cart` does not name `odometry`; did you mean `odom`?"
SWAPPED = "the code of `cart` names the topic `odom`, not `drive/odom`; swap the names"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("odometry", "drive/odom", NOT_NAMED),
        ("drive/odom", "odom", SWAPPED),
        ("odom", "drive/odom", None),
        ("/odom", "/drive/odom", None),
        ("~/odom", "drive/odom", None),
        ("/tf", "/cart/tf", None),
        ("$(var topic)", "drive/odom", None),
    ],
)
@pytest.mark.parametrize("code", ["py", "cpp"])
def test_a_remapping_needs_a_name_in_the_code_of_an_own_node(tmp_path, code, old, new, message):
    cart = package(tmp_path / "cart", "ament_cmake", "rclpy", "nav_msgs", "std_msgs")
    text = (PYTHON if code == "py" else CPP).replace("{topic}", '"odom"').replace("{base}", "rclcpp::Node")
    write(cart / f"src/odometer.{code}", text)
    write(cart / "launch/cart.launch.xml", LAUNCH.replace("{old}", old).replace("{new}", new))
    assert found(cart, "K980") == ([("cart.launch.xml", 3, message)] if message else [])


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("odometer.py", PYTHON.replace("{topic}", 'self.get_parameter("topic").value')),
        ("odometer.py", PYTHON.replace("{topic}", '"odom"').replace("class Odometer(Node)", "class Odometer(Base)")),
        ("odometer.py", "import image_transport\n" + PYTHON.replace("{topic}", '"odom"')),
        ("odometer.py", "if\n" + PYTHON),
        ("odometer.cpp", CPP.replace("{topic}", 'ns_ + "odom"').replace("{base}", "rclcpp::Node")),
        ("odometer.cpp", CPP.replace("{topic}", '"odom"').replace("{base}", "other::Base")),
        ("readme.md", "odom"),
    ],
)
def test_code_with_other_names_accepts_every_remapping(tmp_path, file, text):
    cart = package(tmp_path / "cart", "ament_cmake", "rclpy", "nav_msgs", "std_msgs")
    write(cart / f"src/{file}", text)
    write(cart / "launch/cart.launch.xml", LAUNCH.replace("{old}", "odometry").replace("{new}", "drive/odom"))
    assert found(cart, "K980") == []


SERVERS = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    every = [("nav_vel", "cmd_vel")]
    return LaunchDescription([
        Node(package="nav2_controller", executable="controller_server", name="controller_server", remappings={first}),
        Node(package="{other}", executable="{other}", remappings={second}),
    ])
"""


@pytest.mark.parametrize(
    ("first", "second", "other", "is_reported"),
    [
        ('[("nav_vel", "cmd_vel")]', "[]", "rviz2", True),
        ('[("nav_vel", "/cmd_vel")]', "[]", "rviz2", True),
        ('[("cmd_vel", "nav_vel")]', "[]", "rviz2", False),
        ("every", "[]", "rviz2", True),
    ],
)
def test_swapped_names_of_the_velocity_commands_of_navigation(tmp_path, first, second, other, is_reported):
    cart = package(tmp_path / "cart", "ament_cmake", "nav2_controller", "rviz2", "cart_driver")
    text = SERVERS
    for name, value in {"first": first, "second": second, "other": other}.items():
        text = text.replace(f"{{{name}}}", value)
    write(cart / "launch/nav.launch.py", text)
    found_here = found(cart, "K980")
    assert [(file, "; swap the names" in text) for file, _, text in found_here] == [
        ("nav.launch.py", True)
    ] * is_reported
