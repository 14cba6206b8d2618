"""Mistakes with several consequences: one finding for each, and none that another description of the robot refutes."""

from __future__ import annotations

import json

import pytest

from urdfkit.cli import main
from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license>
  <exec_depend>effort_controllers</exec_depend></package>"""
TRANSMISSION = """<transmission name="NAME_transmission"><type>transmission_interface/SimpleTransmission</type>
      <joint name="NAME"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
      <actuator name="NAME_motor"/></transmission>
"""
JOINT = """  <link name="lN"/>
  <joint name="jN" type="revolute"><parent link="lM"/><child link="lN"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="5" velocity="1"/></joint>
"""
SRDF = """<robot name="arm">
  <group name="arm"><chain base_link="l0" tip_link="l1"/></group>
  <group name="all"><chain base_link="l0" tip_link="l3"/></group>
  <group_state name="home" group="arm">
    <joint name="j1" value="0"/><joint name="j2" value="0"/><joint name="j3" value="0"/>
  </group_state>
</robot>"""
YAML = "arm_controller:\n  type: effort_controllers/JointTrajectoryController\n  joints: [j1, j2, j3]\n"
LAUNCH = """<launch>
  <param name="robot_description" command="$(find xacro)/xacro $(find arm)/arm.urdf.xacro sim:=true"/>
  <node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model arm"/>
</launch>
"""


def robot(transmissions):
    joints = "".join(JOINT.replace("N", str(n)).replace("M", str(n - 1)) for n in (1, 2, 3))
    return f"""<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="sim" default="false"/>
  <link name="l0"/>
{joints}  <xacro:if value="$(arg sim)">
    {"".join(TRANSMISSION.replace("NAME", name) for name in transmissions)}
    <gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo>
  </xacro:if>
</robot>"""


def found(folder, files, code, capsys):
    folder = folder / "arm"
    folder.mkdir(exist_ok=True)
    for name, text in ({"package.xml": MANIFEST} | files).items():
        (folder / name).write_text(text)
    main(["lint", str(folder), "--format", "json", "--no-cache", "--target", "ros1"])
    findings = json.loads(capsys.readouterr().out)
    return [(one["severity"], one["line"], one["message"]) for one in findings if one["code"] == code]


@pytest.mark.parametrize(("transmissions", "count"), [(["j1", "j2"], 1), (["j1", "j2", "j3"], 0), ([], 0)])
def test_a_joint_without_transmission_is_found_in_the_variant(tmp_path, capsys, transmissions, count):
    files = {"arm.urdf.xacro": robot(transmissions), "control.yaml": YAML, "arm.launch": LAUNCH}
    findings = found(tmp_path, files, "K963", capsys)
    assert [(severity, line) for severity, line, _ in findings] == [("warning", 18)] * count
    assert all("joint `j3`, which has no transmission" in message for *_, message in findings)


def test_the_foreign_joints_of_a_state_have_one_finding(tmp_path, capsys):
    findings = found(tmp_path, {"arm.urdf.xacro": robot([]), "arm.srdf": SRDF}, "M107", capsys)
    assert [each[1:] for each in findings] == [(4, "joints `j2`, `j3` of state `home` are not in group `arm`")]


def test_an_undefined_child_link_hides_the_chain_that_it_cuts(tmp_path, capsys):
    text = robot([]).replace('<child link="l3"/>', '<child link="l3x"/>')
    assert found(tmp_path, {"arm.urdf.xacro": text, "arm.srdf": SRDF}, "M105", capsys) == []
    assert len(found(tmp_path, {"arm.urdf.xacro": text, "arm.srdf": SRDF}, "T202", capsys)) == 1


def codes(folder):
    return [f"{one.code}:{one.line} {one.message}" for one in lint(folder)]


def test_a_macro_that_inserts_another_block_than_its_own_is_one_finding(tmp_path):
    path = tmp_path / "mast.xacro"
    text = """<robot name="mast" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="base"/>
  <xacro:macro name="frame" params="name *origin">
    <link name="${name}"/>
    <joint name="${name}_joint" type="fixed"><parent link="base"/><child link="${name}"/>
      <xacro:insert_block name="origin"/></joint>
  </xacro:macro>
  <xacro:frame name="top"><origin xyz="0 0 0.4"/></xacro:frame>
</robot>"""
    path.write_text(text)
    assert codes(path) == []
    path.write_text(text.replace('block name="origin"', 'block name="mount"'))
    assert codes(path) == ["X107:6 block `mount` is not defined; did you mean `origin`?"]
    path.write_text(text.replace('<xacro:insert_block name="origin"/>', ""))
    assert codes(path) == ["X128:3 macro `frame` never inserts its block `origin`"]


@pytest.mark.parametrize("is_passed", [True, False])
def test_a_missing_file_in_an_argument_is_reported_where_the_launch_file_passes_it(tmp_path, is_passed):
    folder = tmp_path / "arm"
    written = "$(arg file)" if is_passed else "$(find arm)/config/missing.yaml"
    robot = f"""<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="file" default="$(find arm)/config/arm.yaml"/>
  <link name="base"/>
  <gazebo><plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>{written}</parameters>
  </plugin></gazebo>
</robot>"""
    launch = """from launch import LaunchDescription
from launch.substitutions import Command, FindExecutable, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    file = PathJoinSubstitution([FindPackageShare("arm"), "config", "missing.yaml"])
    robot = PathJoinSubstitution([FindPackageShare("arm"), "arm.urdf.xacro"])
    description = Command([FindExecutable(name="xacro"), " ", robot, " file:=", file])
    return LaunchDescription(
        [
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": description}],
            )
        ]
    )
"""
    (folder / "config").mkdir(parents=True)
    (folder / "config/arm.yaml").write_text("controller_manager:\n  ros__parameters:\n    update_rate: 100\n")
    (folder / "package.xml").write_text(MANIFEST.replace("effort_controllers", "gz_ros2_control"))
    (folder / "arm.urdf.xacro").write_text(robot)
    (folder / "arm.launch.py").write_text(launch)
    found = sorted({one.code for one in lint(folder) if one.code in ("K958", "Z828")})
    assert found == (["K958"] if is_passed else ["K958", "Z828"])
