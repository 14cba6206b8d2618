"""Findings on values that macros hand on: at the call where the value is written."""

import pytest

from urdfkit import Simulator
from urdfkit.lint import lint

PARTS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="ball" params="name parent mass">
    <link name="${name}">
      <inertial><mass value="${mass}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    </link>
    <joint name="${name}_joint" type="fixed"><parent link="${parent}"/><child link="${name}"/></joint>
  </xacro:macro>
  <xacro:macro name="part" params="name parent m:=2"><xacro:ball name="${name}" parent="${parent}" mass="${m}"/>
  </xacro:macro>
</robot>
"""
ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="parts.xacro"/>
  <link name="base"/>
  <xacro:part name="a" parent="base" m="1"/>
  <xacro:part name="b" parent="base" m="1"/>
</robot>
"""
HELP = "set a mass greater than 0 kg; macro `ball` uses the value at parts.xacro:4:17"


@pytest.mark.parametrize(
    ("parts", "robot", "code", "place"),
    [
        ("", ('b" parent="base" m="1"', 'b" parent="base" m="-2.0"'), "I501", ("r.urdf.xacro", 5, 38)),
        ("", ('b" parent="base"', 'b" parent="bse"'), "T201", ("r.urdf.xacro", 5, 24)),
        ("", (' m="1"', ' m="-2.0"'), "I501", ("parts.xacro", 4, 17)),
        ("default", (' m="1"', ""), "I501", ("parts.xacro", 8, 48)),
        ("comment", ('b" parent="base" m="1"', 'b" parent="base" m="-2.0"'), "I501", ("parts.xacro", 4, 17)),
    ],
    ids=["value", "name", "several-calls", "default", "suppressions"],
)
def test_a_value_that_a_macro_hands_on_is_found_at_its_call(parts, robot, code, place, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = {"": PARTS, "default": PARTS.replace("m:=2", "m:=-2"), "comment": f"{PARTS}<!-- urdfkit: ignore I514 -->"}
    (tmp_path / "parts.xacro").write_text(text[parts])
    (tmp_path / "r.urdf.xacro").write_text(ROBOT.replace(*robot))
    (found,) = lint("r.urdf.xacro", select=(code,))
    assert (found.file, found.line, found.column) == place
    assert found.chains
    assert (found.help == HELP) is (code == "I501" and place[1:] != (4, 17))


def test_with_urdfkit_as_the_target_findings_stay_where_repairs_are_reported(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "parts.xacro").write_text(PARTS)
    (tmp_path / "r.urdf.xacro").write_text(ROBOT.replace('b" parent="base"', 'b" parent="bse"'))
    (found,) = lint("r.urdf.xacro", select=("T201",), target="urdfkit")
    position = Simulator("r.urdf.xacro", note=lambda text: None).repairs[0].position
    assert (found.file, found.line, found.column) == (position.file, position.line, position.column)
    assert found.file == "parts.xacro"


TWINS = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="ball_mass" value="{}"/>
  <xacro:macro name="wheel" params="side y mass">
    <link name="${{side}}">
      <collision><origin rpy="${{pi / 2}} 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
      <inertial><mass value="${{mass}}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    </link>
    <joint name="${{side}}_joint" type="continuous">
      <parent link="base"/><child link="${{side}}"/><origin xyz="0 ${{y}} 0"/><axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
  <link name="base"/>
  <xacro:wheel side="left" y="0.2" mass="1"/>
  <xacro:wheel side="right" y="{}" mass="${{ball_mass}}"/>
  <gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so"><left_joint>left_joint</left_joint>
    <right_joint>right_joint</right_joint><wheel_separation>0.4</wheel_separation></plugin></gazebo>
</robot>
"""


@pytest.mark.parametrize(
    ("mass", "y", "code", "line"),
    [("-2", "-0.2", "I501", 2), ("1", "0.2", "S907", 14), ("1", "0.2 * 1", "S907", 8)],
    ids=["property", "equal-calls", "calls-that-differ"],
)
def test_a_value_is_found_where_it_is_written_once(mass, y, code, line, tmp_path):
    (tmp_path / "r.urdf.xacro").write_text(TWINS.format(mass, f"${{{y}}}" if "*" in y else y))
    (found,) = lint(tmp_path / "r.urdf.xacro", select=(code,), target="ros2")
    assert found.line == line


HINGES = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="far" value="40"/>
  <xacro:macro name="hinge" params="name axis:='0 0 1' yaw:=0 start:=0">
    <link name="${name}"/>
    <joint name="${name}_joint" type="revolute">
      <parent link="base"/><child link="${name}"/><origin xyz="0 0 0.2" rpy="0 0 ${yaw}"/><axis xyz="${axis}"/>
      <limit lower="-1" upper="1" effort="1" velocity="1"/>
    </joint>
    <ros2_control name="${name}" type="system">
      <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
      <joint name="${name}_joint">
        <command_interface name="position"/>
        <state_interface name="position"><param name="initial_value">${start}</param></state_interface>
      </joint>
    </ros2_control>
  </xacro:macro>
  <link name="base"/>
  CALL
</robot>
"""


@pytest.mark.parametrize(
    ("call", "code", "attribute"),
    [
        ('<xacro:hinge name="head_pan" axis="0 ${far} 0"/>', "S917", 'axis="0 ${far} 0"'),
        ('<xacro:hinge name="head" start="1.5"/>', "C719", 'start="1.5"'),
        ('<xacro:hinge name="head" yaw="${far + 50}"/>', "J408", 'yaw="${far + 50}"'),
    ],
    ids=["expression", "text of a tag with attributes", "between zeros"],
)
def test_expressions_and_values_between_zeros_are_found_at_the_call(call, code, attribute, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "r.urdf.xacro").write_text(HINGES.replace("CALL", call))
    (found,) = lint("r.urdf.xacro", select=(code,))
    line = (tmp_path / "r.urdf.xacro").read_text().splitlines()[found.line - 1]
    assert line[found.column - 1 :].startswith(attribute)
