"""Mistakes in macros and in their calls: the finding is where somebody has to edit."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="rover" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="stroke" value="0.4"/>
  <xacro:property name="front" value="0.1"/>
  <!-- a cylinder along the y axis -->
  <xacro:macro name="inertia_of_wheel" params="m r w">
    <inertial>
      <origin xyz="0 0 0" rpy="0 0 0"/>
      <mass value="${m}"/>
      <inertia ixx="${(3*r*r + w*w) * m / 12}" ixy="0" ixz="0"
               iyy="${m * r * r / 2}" iyz="0"
               izz="${(3*r*r + w*w) * m / 12}"/>
    </inertial>
  </xacro:macro>
  <xacro:macro name="wheel" params="name parent x side">
    <link name="${name}_wheel">
      <collision><origin rpy="${pi/2} 0 0"/><geometry><cylinder radius="0.1" length="0.05"/></geometry></collision>
      <xacro:inertia_of_wheel m="1" r="0.1" w="0.05"/>
    </link>
    <joint name="${name}_wheel_joint" type="continuous">
      <parent link="${parent}"/><child link="${name}_wheel"/>
      <origin xyz="${x} ${side * 0.25} 0"/>
      <axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
  <link name="base"><collision><geometry><box size="0.6 0.4 0.2"/></geometry></collision></link>
  <link name="nose">
    <collision><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.4 0.1"/></geometry></collision>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="nose"/><origin xyz="0.3 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-0.3" upper="0.3" effort="9" velocity="1"/>
  </joint>
  <xacro:wheel name="front_left" parent="nose" x="${front}" side="1"/>
  <xacro:wheel name="front_right" parent="nose" x="${front}" side="-1"/>
  <xacro:wheel name="rear_left" parent="base" x="-0.2" side="1"/>
  <xacro:wheel name="rear_right" parent="base" x="-0.2" side="-1"/>
  <xacro:macro name="mast" params="length">
    <link name="mast"><collision>
      <origin xyz="0 0 -0.3"/><geometry><box size="0.05 0.05 0.6"/></geometry>
    </collision></link>
    <joint name="arm_mount_joint" type="fixed"><parent link="base"/><child link="arm"/></joint>
    <link name="arm"><collision><geometry><box size="0.1 0.1 0.9"/></geometry></collision></link>
    <!-- positive lift = the mast goes down -->
    <joint name="lift_joint" type="prismatic">
      <parent link="arm"/><child link="mast"/><origin xyz="0.05 0 0.4"/><axis xyz="0 0 -1"/>
      <limit lower="0" upper="${length}" effort="9" velocity="1"/>
    </joint>
    <link name="hook"/>
    <joint name="arm_hook_joint" type="prismatic">
      <parent link="mast"/><child link="hook"/><axis xyz="1 0 0"/>
      <limit lower="0" upper="0.1" effort="9" velocity="1"/>
      <mimic joint="lift_joint"/>
    </joint>
  </xacro:macro>
  <xacro:mast length="${stroke}"/>
</robot>
"""
CODES = ("I519", "J416", "J421", "J422", "S917")


@pytest.mark.parametrize(
    ("old", "new", "code", "marked"),
    [
        ('upper="${length}"', 'upper="${length * 1000}"', "J422", 'upper="${length * 1000}"'),
        ('name="stroke" value="0.4"', 'name="stroke" value="400"', "J422", 'value="400"'),
        ('name="front" value="0.1"', 'name="front" value="${2 * 0.3}"', "J421", 'name="front"'),
        ('rear_left" parent="base" x="-0.2"', 'rear_left" parent="base" x="-0.9"', "J421", 'x="-0.9"'),
        (
            'iyy="${m * r * r / 2}" iyz="0"\n               izz="${(3*r*r + w*w) * m / 12}"',
            'iyy="${(3*r*r + w*w) * m / 12}" iyz="0"\n               izz="${m * r * r / 2}"',
            "I519",
            "iyy=",
        ),
        ('mimic joint="lift_joint"', 'mimic joint="arm_joint"', "J416", '"arm_joint"'),
        ("the mast goes down", "the mast goes up", "S917", 'axis xyz="0 0 -1"'),
        ('<origin xyz="0 0 -0.3"/>', '<origin xyz="0 0 0.3"/>', "S917", 'axis xyz="0 0 -1"'),
    ],
    ids=["factor", "value", "property", "call", "moments", "mimic", "comment", "standing"],
)
def test_a_mistake_is_reported_where_it_is(old, new, code, marked, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert ROBOT.count(old) == 1
    text = ROBOT.replace(old, new)
    (tmp_path / "rover.urdf.xacro").write_text(text)
    (found,) = lint("rover.urdf.xacro", select=CODES)
    assert (found.code, marked in text.splitlines()[found.line - 1]) == (code, True), found


def test_the_robot_without_mistakes_has_no_findings(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rover.urdf.xacro").write_text(ROBOT)
    assert lint("rover.urdf.xacro", select=CODES) == []


WHEELS = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="wheel_radius" value="0.1"/>
  <xacro:property name="wheel_width" value="0.04"/>
  <xacro:property name="hub_width" value="0.03"/>
  <xacro:property name="wheel" value="${dict(radius=0.1, width=0.04)}"/>
  <xacro:macro name="tensor" params="m r h">
    <inertia ixx="${m*(3*r*r + h*h)/12}" ixy="0" ixz="0" iyy="${m*(3*r*r + h*h)/12}" iyz="0" izz="${m*r*r/2}"/>
  </xacro:macro>
  <xacro:macro name="caster" params="name y">
    <link name="${name}">
      <inertial>
        <mass value="1"/>
        <xacro:tensor m="1" r="${wheel_radius}" h="${wheel_width}"/>
      </inertial>
      <collision><geometry><sphere radius="0.1"/></geometry></collision>
    </link>
    <joint name="${name}_joint" type="continuous">
      <parent link="base"/><child link="${name}"/><origin xyz="0 ${y} 0"/><axis xyz="0 0 1"/>
    </joint>
  </xacro:macro>
  <link name="base"/>
  <xacro:caster name="left" y="0.2"/>
  <xacro:caster name="right" y="-0.2"/>
</robot>
"""


@pytest.mark.parametrize(
    ("radius", "length", "is_wrong"),
    [
        ("${wheel_radius}", "${wheel_width}", False),
        ("${wheel_width}", "${wheel_radius}", True),
        ("${wheel['width']}", "${wheel['radius']}", True),
        ("${hub_width}", "${wheel_radius}", False),  # sizes of two parts
        ("${wheel_width/2}", "${wheel_radius}", False),
        ("${wheel_radius}", "${wheel_radius}", False),
    ],
)
def test_swapped_arguments_of_a_tensor(radius, length, is_wrong, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call = 'r="${wheel_radius}" h="${wheel_width}"'
    assert WHEELS.count(call) == 1
    (tmp_path / "cart.urdf.xacro").write_text(WHEELS.replace(call, f'r="{radius}" h="{length}"'))
    rows = [(each.line, each.message, each.help) for each in lint("cart.urdf.xacro", select=("I519",))]
    message, help = "the call of macro `tensor` swaps radius and length", "swap the values of `r` and `h`"
    assert rows == ([(13, message, help)] if is_wrong else [])
