"""Findings on values behind dictionaries, defaults and formulas: where the wrong literal is written."""

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="solids.xacro" ns="solids"/>
  <xacro:property name="dims" value="${xacro.load_yaml('dims.yaml')}"/>
  <xacro:property name="load" value="${dict(mass=3.0, reach=2.0)}"/>
  <xacro:macro name="part" params="name size at span:=0.5 *pose">
    <xacro:property name="depth" value="${size['depth']}"/>
    <link name="${name}">
      <collision><geometry><box size="0.2 ${depth} ${size.list[1]}"/></geometry></collision>
      <inertial>
        <mass value="${size['mass']}"/>
        <xacro:solids.moments m="${size['mass']}"/>
      </inertial>
    </link>
    <joint name="${name}_joint" type="revolute">
      <parent link="base"/>
      <child link="${name}"/>
      <xacro:insert_block name="pose"/>
      <axis xyz="0 0 1"/>
      <xacro:property name="turn" value="${radians(at['turn'])}"/>
      <limit lower="${-turn}" upper="${turn}" effort="${at['effort']}" velocity="${span}"/>
    </joint>
  </xacro:macro>
  <link name="base"><collision><geometry><box size="0.4 0.4 0.4"/></geometry></collision></link>
  <xacro:part name="a" size="${dims['a']['box']}" at="${dims['a']['joint']}">
    <origin xyz="0.1 ${solids.side * dims.a.y} 0"/>
  </xacro:part>
  <xacro:part name="b" size="${dims['b']['box']}" at="${dims['b']['joint']}" span="1.5">
    <origin xyz="0.1 ${-solids.side * dims.b.y} 0"/>
  </xacro:part>
</robot>
"""
SOLIDS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="side" value="1"/>
  <xacro:macro name="moments" params="m"><inertia ixx="${m/200}" ixy="0" ixz="0" iyy="${m/200}" iyz="0" izz="${m/200}"/>
  </xacro:macro>
</robot>
"""
DIMS = """a:
  box: {depth: 0.2, list: [0.1, 0.2], mass: 2.0}
  joint:
    turn: 40
    effort: 5
  y: 0.3
b:
  box: {depth: 0.21, list: [0.1, 0.22], mass: 2.1}
  joint:
    turn: 50
    effort: 6
  y: 0.31
"""


def found_in(tmp_path, monkeypatch, robot=ROBOT, dims=DIMS):
    monkeypatch.chdir(tmp_path)
    for name, text in (("r.urdf.xacro", robot), ("solids.xacro", SOLIDS), ("dims.yaml", dims)):
        (tmp_path / name).write_text(text)
    return [(each.code, each.file, each.line, each.column) for each in lint("r.urdf.xacro", select=CODES)]


CODES = ("G611", "G619", "I501", "I514", "J405", "J409", "J410", "J421")


def test_a_correct_robot_has_no_findings(tmp_path, monkeypatch):
    assert found_in(tmp_path, monkeypatch) == []


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (("depth: 0.21", "depth: 210"), ("G619", "dims.yaml", 8, 16)),
        (("[0.1, 0.22]", "[0.1, 220]"), ("G619", "dims.yaml", 8, 34)),
        (("mass: 2.1", "mass: -2.1"), ("I501", "dims.yaml", 8, 47)),
        (("mass: 2.0", "mass: 2000"), ("I514", "dims.yaml", 2, 45)),
        (("turn: 50", "turn: -50"), ("J405", "dims.yaml", 10, 11)),
        (("effort: 5", "effort: 0"), ("J409", "dims.yaml", 5, 13)),
        (("y: 0.31", "y: 31"), ("J421", "dims.yaml", 12, 6)),
        (("span:=0.5", "span:=-0.5"), ("J410", "r.urdf.xacro", 5, 49)),
        (('span="1.5"', 'span="-1.5"'), ("J410", "r.urdf.xacro", 27, 78)),
        (
            ("size=\"${dims['b']['box']}\"", 'size="${dict(depth=0.21, list=[1, 0.22], mass=0)}"'),
            ("I501", "r.urdf.xacro", 27, 24),
        ),
    ],
    ids=["dictionary", "list", "argument", "unit", "function", "nested keys", "block", "default", "literal", "display"],
)
def test_a_wrong_literal_is_reported_where_it_is_written(change, expected, tmp_path, monkeypatch):
    robot, dims = ROBOT.replace(*change), DIMS.replace(*change)
    assert (robot, dims) != (ROBOT, DIMS)
    assert found_in(tmp_path, monkeypatch, robot, dims) == [expected]


def test_a_wrong_formula_is_reported_in_the_macro(tmp_path, monkeypatch):
    robot = ROBOT.replace('lower="${-turn}"', 'lower="${turn + 1}"')
    assert {place[:3] for place in found_in(tmp_path, monkeypatch, robot)} == {("J405", "r.urdf.xacro", 20)}


@pytest.mark.parametrize(
    ("definitions", "wrong"),
    [
        ('<xacro:property name="m" default="1"/><xacro:property name="m" value="-2"/>', 'value="-2"'),
        ('<xacro:property name="m"><mass/></xacro:property><xacro:property name="m" value="-2"/>', 'value="-2"'),
        (
            '<xacro:arg default="3"/><xacro:arg name="n" default="-2"/><xacro:property name="m" value="$(arg n)"/>',
            'default="-2"',
        ),
    ],
    ids=["default", "block", "argument without a name"],
)
def test_definitions_without_a_value_or_name_are_skipped(definitions, wrong, tmp_path, monkeypatch):
    robot = ROBOT.replace("<mass value=\"${size['mass']}\"/>", f'\n{definitions}\n<mass value="${{m}}"/>')
    place = ("I501", "r.urdf.xacro", 11, definitions.index(wrong) + 1)
    assert found_in(tmp_path, monkeypatch, robot) == [place]


def test_properties_that_add_others_several_times_are_followed_once(tmp_path):
    sums = [f'<xacro:property name="p{i}" value="${{{" + ".join([f"p{i - 1}"] * 8)}}}"/>' for i in range(1, 12)]
    tensor = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
    lines = [
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">',
        '<xacro:property name="p0" value="-1e-9"/>',
        *sums,
        f'<link name="a"><inertial><mass value="${{p11}}"/>{tensor}</inertial></link></robot>',
    ]
    (tmp_path / "r.urdf.xacro").write_text("\n".join(lines))
    assert [(finding.code, finding.line) for finding in lint(tmp_path, select=["I501"])] == [("I501", 2)]
