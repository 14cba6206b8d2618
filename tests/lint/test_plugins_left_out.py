"""Launch arguments that leave the plugin with the controller manager out of a spawned robot."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

ROBOT = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="sim" default="true"/>
  <link name="base"/>
  <xacro:if value="$(arg sim)">
    <gazebo><plugin filename="{plugin}" name="control"/></gazebo>
  </xacro:if>
</robot>
"""
DESCRIPTION = """<launch>
  <arg name="simulated" default="true"/>
  <param name="robot_description"
         command="$(find xacro)/xacro $(find cart)/cart.xacro sim:=$(arg simulated)"/>
</launch>
"""
SIMULATION = """<launch>
  <include file="$(find cart)/launch/description.launch">
    <arg name="{argument}" value="{value}"/>
  </include>
{spawn}  <node name="spawner" pkg="controller_manager" type="spawner" args="wheels"/>
</launch>
"""
SPAWN = '  <node name="robot" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model cart"/>\n'


@pytest.mark.parametrize(
    ("value", "plugin", "spawn", "is_reported"),
    [
        ("false", "libgazebo_ros_control.so", SPAWN, True),
        ("true", "libgazebo_ros_control.so", SPAWN, False),
        ("false", "libgazebo_ros_imu_sensor.so", SPAWN, False),
        ("false", "libgazebo_ros_control.so", "", False),
    ],
)
def test_an_argument_that_leaves_the_controller_manager_out(tmp_path, value, plugin, spawn, is_reported):
    cart = package(tmp_path / "cart", "catkin", "xacro", "gazebo_ros", "controller_manager")
    (cart / "cart.urdf").unlink()
    write(cart / "cart.xacro", ROBOT.format(plugin=plugin))
    write(cart / "launch/description.launch", DESCRIPTION.replace("simulated", "sim"))
    write(cart / "launch/sim.launch", SIMULATION.format(argument="sim", value=value, spawn=spawn))
    message = "`sim:=false` excludes the plugin that runs the controller manager, so `spawner` waits forever"
    assert found(cart, "K968") == ([("sim.launch", 3, message)] if is_reported else [])
