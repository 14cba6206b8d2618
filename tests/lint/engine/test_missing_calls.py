"""Findings on names that one missing macro call would define."""

import pytest

from urdfkit.lint import lint

HEAD = '<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">'
WHEEL = """  <xacro:macro name="wheel" params="name y">
    <link name="${name}_wheel"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="${name}_wheel_joint" type="continuous">
      <parent link="base"/><child link="${name}_wheel"/><origin xyz="0 ${y} 0"/><axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
  <xacro:macro name="side" params="name y"><xacro:wheel name="${name}" y="${y}"/></xacro:macro>
"""
ROBOT = f"""{HEAD}
{WHEEL}
  <link name="base"/>
  <xacro:side name="left" y="0.2"/>
  <xacro:side name="right" y="-0.2"/>
  <gazebo reference="left_wheel"><mu1>1</mu1></gazebo>
  <gazebo reference="right_wheel"><mu1>1</mu1></gazebo>
  <ros2_control name="cart" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name="left_wheel_joint"><command_interface name="velocity"/></joint>
    <joint name="right_wheel_joint"><command_interface name="velocity"/></joint>
  </ros2_control>
</robot>
"""


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (None, []),
        (('  <xacro:side name="right" y="-0.2"/>\n', ""), [11]),
        (('name="right" y', 'name="rihgt" y'), [12]),
        (('reference="right_wheel"', 'reference="rear_wheel"'), [14]),
    ],
    ids=["correct", "deleted", "misspelt", "one reference"],
)
def test_names_of_a_missing_call_are_one_finding_at_the_call_beside_it(change, expected, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cart.urdf.xacro").write_text(ROBOT.replace(*change) if change else ROBOT)
    assert [each.line for each in lint("cart.urdf.xacro", select=("C7", "Z8", "T"))] == expected
