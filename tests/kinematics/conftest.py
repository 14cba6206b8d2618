from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot

ARM = """<robot name="arm">
  <link name="world"/>
  <link name="turntable">
    <inertial>
      <origin xyz="0.01 -0.02 0.3" rpy="0.1 -0.7 1.3"/><mass value="3"/>
      <inertia ixx="0.05" ixy="0.002" ixz="-0.001" iyy="0.04" iyz="0.003" izz="0.03"/>
    </inertial>
  </link>
  <link name="mast"/>
  <link name="lift">
    <inertial>
      <origin xyz="0.1 0 0"/><mass value="1.5"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>
    </inertial>
  </link>
  <link name="plate">
    <inertial>
      <origin xyz="0 0.2 0" rpy="0 1 0"/><mass value="0.7"/>
      <inertia ixx="0.003" ixy="0.0001" ixz="0" iyy="0.002" iyz="0" izz="0.004"/>
    </inertial>
  </link>
  <link name="elbow">
    <inertial>
      <origin xyz="0 0 0.1"/><mass value="0.5"/>
      <inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
    </inertial>
  </link>
  <link name="finger_a">
    <inertial><mass value="0.05"/><inertia ixx="1e-5" ixy="0" ixz="0" iyy="1e-5" iyz="0" izz="1e-5"/></inertial>
  </link>
  <link name="finger_b">
    <inertial><mass value="0.05"/><inertia ixx="1e-5" ixy="0" ixz="0" iyy="1e-5" iyz="0" izz="1e-5"/></inertial>
  </link>
  <link name="dial">
    <inertial><mass value="0.02"/><inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/></inertial>
  </link>
  <link name="camera"/>
  <link name="camera_optical"/>
  <joint name="turn" type="continuous">
    <parent link="world"/><child link="turntable"/><origin xyz="0 0 0.1"/><axis xyz="0 0 3"/>
    <limit effort="20" velocity="3"/><dynamics damping="0.3" friction="0.1"/>
  </joint>
  <joint name="post" type="fixed">
    <parent link="turntable"/><child link="mast"/><origin xyz="0 0.1 0.5" rpy="0.3 0.2 -0.4"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="mast"/><child link="lift"/><origin rpy="0 0 0.5"/><axis xyz="0 2 1"/>
    <limit lower="-0.1" upper="0.4" effort="100" velocity="0.5"/>
  </joint>
  <joint name="bolted" type="fixed">
    <parent link="lift"/><child link="plate"/><origin xyz="0.05 0 0.02" rpy="1.1 0 0.2"/>
  </joint>
  <joint name="bend" type="revolute">
    <parent link="plate"/><child link="elbow"/><origin xyz="0.3 0 0" rpy="0 0.4 0"/><axis xyz="1 -1 0.5"/>
    <limit lower="-1.5" upper="2" effort="30" velocity="2"/>
  </joint>
  <joint name="grip" type="prismatic">
    <parent link="elbow"/><child link="finger_a"/><origin xyz="0 0.02 0.2"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="10" velocity="0.2"/>
  </joint>
  <joint name="grip_mirror" type="prismatic">
    <parent link="elbow"/><child link="finger_b"/><origin xyz="0 -0.02 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-0.05" upper="0.05" effort="10" velocity="0.2"/><mimic joint="grip" multiplier="-1" offset="0.001"/>
  </joint>
  <joint name="dial_joint" type="revolute">
    <parent link="lift"/><child link="dial"/><origin xyz="0 0 0.3"/><axis xyz="-1 0 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="9"/><mimic joint="bend" multiplier="1.5" offset="-0.2"/>
  </joint>
  <joint name="camera_mount" type="fixed">
    <parent link="dial"/><child link="camera"/><origin xyz="0.1 0 0" rpy="0 0.2 0"/>
  </joint>
  <joint name="camera_optical_joint" type="fixed">
    <parent link="camera"/><child link="camera_optical"/>
    <origin rpy="-1.5707963267948966 0 -1.5707963267948966"/>
  </joint>
</robot>
"""
"""All joint types of one degree of freedom, axes that are no unit vectors, fixed chains, rotated inertias, mimics."""


@pytest.fixture
def robot_of(tmp_path: Path) -> Callable[[str], Robot]:
    """Write a URDF and load it."""

    def build(xml: str) -> Robot:
        path = tmp_path / "robot.urdf"
        path.write_text(xml, encoding="utf-8")
        return load(path)

    return build


@pytest.fixture
def arm(robot_of: Callable[[str], Robot]) -> Robot:
    return robot_of(ARM)


@pytest.fixture
def arm_xml() -> str:
    return ARM


@pytest.fixture
def pair(robot_of: Callable[[str], Robot]) -> Callable[..., Robot]:
    """Build a robot of two links and one joint."""

    def build(type: str, body: str = "", *, mass: float = 1.0) -> Robot:
        inertial = (
            f'<inertial><origin xyz="0.1 0.2 -0.1"/><mass value="{mass}"/>'
            '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/></inertial>'
        )
        return robot_of(
            f'<robot name="pair"><link name="a"/><link name="b">{inertial}</link><joint name="j" type="{type}">'
            f'<parent link="a"/><child link="b"/><origin xyz="0.1 0 0.2" rpy="0.1 0.2 0.3"/>{body}</joint></robot>'
        )

    return build
