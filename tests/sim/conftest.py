"""A small rover for the simulator's tests: a box on two wheels and a frictionless ball."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

WHEEL = """
  <link name="{side}_wheel">
    <collision><origin rpy="1.5707963267948966 0 0"/>
      <geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
    <inertial><mass value="0.2"/><inertia ixx="0.0006" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.0006"/></inertial>
  </link>
  <joint name="{side}_joint" type="continuous">
    <parent link="base"/><child link="{side}_wheel"/><origin xyz="0 {y} 0.1"/><axis xyz="0 1 0"/>
  </joint>
"""

ROVER = """<robot name="rover">
  <link name="base">
    <collision><origin xyz="-0.1 0 0.12"/><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
    <inertial><origin xyz="-0.05 0 0.1"/><mass value="1"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  </link>
  <link name="ball"><collision><geometry><sphere radius="0.03"/></geometry></collision></link>
  <joint name="ball_joint" type="fixed">
    <parent link="base"/><child link="ball"/><origin xyz="-0.2 0 0.03"/>
  </joint>
  <gazebo reference="ball"><mu1>0</mu1><mu2>0</mu2></gazebo>
  {wheels}
  {extra}
</robot>
"""

DIFF_DRIVE = """
  <gazebo><plugin name="drive" filename="{filename}">
{parameters}
  </plugin></gazebo>
"""

ROS_1 = """<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>
<wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.2</wheelDiameter>"""
ROS_2 = """<left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
<wheel_separation>0.3</wheel_separation><wheel_diameter>0.2</wheel_diameter>"""
GZ = """<left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
<wheel_separation>0.3</wheel_separation><wheel_radius>0.1</wheel_radius>"""


def plugin(parameters: str, filename: str = "libgazebo_ros_diff_drive.so") -> str:
    """Return a model-level plugin."""
    return DIFF_DRIVE.format(filename=filename, parameters=parameters)


def drive(generation: str, parameters: str = "") -> str:
    """Return the rover's diff drive in one generation's spelling, with further parameters."""
    if generation == "gz":
        return plugin(GZ + parameters, "gz-sim-diff-drive-system").replace('drive"', 'gz::sim::systems::DiffDrive"', 1)
    return plugin({"ros1": ROS_1, "ros2": ROS_2}[generation] + parameters)


@pytest.fixture
def write_rover(tmp_path: Path) -> Callable[..., Path]:
    """Write the rover with some extra XML; returns the file."""

    def write(extra: str = "", **replaced: str) -> Path:
        wheels = WHEEL.format(side="left", y=0.15) + WHEEL.format(side="right", y=-0.15)
        text = ROVER.format(wheels=wheels, extra=extra)
        for old, new in replaced.items():
            text = text.replace(old, new)
        path = tmp_path / "rover.urdf"
        path.write_text(text)
        return path

    return write


@pytest.fixture
def make(write_rover: Callable[..., Path]) -> Callable[..., Any]:
    """Make a simulator of the rover with a drive of one generation."""
    from urdfkit.sim import Simulator

    def build(generation: str | None = "ros1", parameters: str = "", *, extra: str = "", **options: Any) -> Any:
        drives = drive(generation, parameters) if generation else ""
        return Simulator(write_rover(drives + extra), **options)

    return build
