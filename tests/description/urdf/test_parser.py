# ruff: noqa: E501 - one case a line
from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description.urdf.parser import parse
from urdfkit.description.urdf.queries import cycles, loop_closed_by, tree_order
from urdfkit.description.urdf.robot import JOINT_TYPES, Box, Capsule, Cylinder, Mesh, Pose, Robot, Sphere
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number, numbers, why_not
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Origin, Position, Source

EVERYTHING = """<robot name="all">
  <material name="red"><color rgba="1 0 0 0.5"/><texture filename="package://p/t.png"/></material>
  <link name="base">
    <inertial><origin xyz=" 1  2 3 " rpy="0 0 1.5"/><mass value=" 2.5 "/>
      <inertia ixx="1" ixy="2" ixz="3" iyy="4" iyz="5" izz="6"/></inertial>
    <visual name="v"><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
    <visual><geometry><mesh filename="package://p/m.stl" scale="1 1 -1"/></geometry>
      <material name="own"><color rgba="0 0 0 1"/></material></visual>
    <collision name="c"><geometry><cylinder radius=".5" length="1e-1"/></geometry></collision>
    <collision><geometry><sphere radius="+0.5"/></geometry></collision>
    <collision><geometry><capsule radius="0.5" length="2"/></geometry></collision>
  </link>
  <link name="tip"/>
  <joint name="j" type="revolute">
    <origin xyz="1 0 0" rpy="0 1 0"/><parent link="base"/><child link="tip"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/><dynamics damping="0.1" friction="0.2"/>
    <mimic joint="k" multiplier="-2" offset="0.5"/>
    <safety_controller soft_lower_limit="-0.9" soft_upper_limit="0.9" k_position="20" k_velocity="15"/>
    <calibration rising="0.1" falling="0.2"/>
  </joint>
  <transmission name="t"><type>transmission_interface/SimpleTransmission</type>
    <joint name="j"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
    <actuator name="m"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>
  <gazebo><plugin name="d" filename="libd.so"><a>1</a></plugin></gazebo>
  <gazebo reference="tip"><sensor name="s" type="camera"><plugin name="p" filename="libp.so"/></sensor></gazebo>
  <ros2_control name="r" type="system"><hardware/></ros2_control>
</robot>"""


def read(text: str) -> Robot:
    return parse(document_of(Source("f", text)))


def joint(inside: str, kind: str = "revolute") -> Robot:
    return read(
        f'<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="{kind}">'
        f'<parent link="a"/><child link="b"/>{inside}</joint></robot>'
    )


def test_every_element_and_attribute() -> None:
    robot = read(EVERYTHING)
    assert [problem.kind for problem in robot.problems] == ["version"]  # the capsule
    assert robot.name == "all"
    red = robot.materials[0]
    assert (red.name, red.rgba, red.texture) == ("red", (1.0, 0.0, 0.0, 0.5), "package://p/t.png")
    base = robot.links[0]
    assert base.inertial is not None
    assert base.inertial.origin == Pose((1.0, 2.0, 3.0), (0.0, 0.0, 1.5))
    assert base.inertial.mass == 2.5
    inertia = base.inertial.inertia
    assert inertia is not None
    assert (inertia.ixx, inertia.ixy, inertia.ixz, inertia.iyy, inertia.iyz, inertia.izz) == (1, 2, 3, 4, 5, 6)
    assert [v.geometry for v in base.visuals] == [Box((1, 2, 3)), Mesh("package://p/m.stl", (1, 1, -1))]
    assert [v.name for v in base.visuals] == ["v", None]
    assert base.visuals[0].origin == Pose((0, 0, 1), (0, 0, 0))
    assert base.visuals[0].material is not None
    assert base.visuals[0].material.rgba is None
    assert base.visuals[1].material is not None
    assert base.visuals[1].material.rgba == (0, 0, 0, 1)
    assert [c.geometry for c in base.collisions] == [Cylinder(0.5, 0.1), Sphere(0.5), Capsule(0.5, 2)]
    j = robot.joints[0]
    assert (j.name, j.type, j.parent, j.child, j.axis) == ("j", "revolute", "base", "tip", (0, 0, 2))
    assert j.origin == Pose((1, 0, 0), (0, 1, 0))
    assert j.limit is not None
    assert (j.limit.lower, j.limit.upper, j.limit.effort, j.limit.velocity) == (-1, 1, 10, 2)
    assert j.dynamics is not None
    assert (j.dynamics.damping, j.dynamics.friction) == (0.1, 0.2)
    assert j.mimic is not None
    assert (j.mimic.joint, j.mimic.multiplier, j.mimic.offset) == ("k", -2, 0.5)
    safety = j.safety_controller
    assert safety is not None
    assert (safety.soft_lower_limit, safety.soft_upper_limit, safety.k_position, safety.k_velocity) == (
        -0.9,
        0.9,
        20,
        15,
    )
    assert j.calibration is not None
    assert (j.calibration.rising, j.calibration.falling) == (0.1, 0.2)
    t = robot.transmissions[0]
    assert (t.name, t.type) == ("t", "transmission_interface/SimpleTransmission")
    assert t.joints[0].hardware_interfaces == ("hardware_interface/EffortJointInterface",)
    assert t.actuators[0].mechanical_reduction == 50
    assert robot.gazebo[0].reference is None
    assert robot.gazebo[0].plugins[0].filename == "libd.so"
    assert robot.gazebo[1].reference == "tip"
    assert robot.gazebo[1].sensors[0].type == "camera"
    assert robot.gazebo[1].sensors[0].plugins[0].name == "p"
    assert (robot.ros2_control[0].name, robot.ros2_control[0].type) == ("r", "system")


def test_the_defaults_of_optional_elements_and_attributes() -> None:
    inside = '<origin/><limit effort="1" velocity="2"/><dynamics/><mimic joint="k"/><safety_controller k_velocity="1"/>'
    (found,) = joint(inside).joints
    assert (found.origin, found.axis) == (Pose((0, 0, 0), (0, 0, 0)), (1, 0, 0))
    assert found.dynamics is not None
    assert (found.dynamics.damping, found.dynamics.friction) == (0, 0)
    assert found.mimic is not None
    assert (found.mimic.multiplier, found.mimic.offset) == (1, 0)
    safety = found.safety_controller
    assert safety is not None
    assert (safety.soft_lower_limit, safety.soft_upper_limit, safety.k_position) == (0, 0, 0)
    mesh = (
        '<robot name="r"><link name="a"><visual><geometry><mesh filename="m.stl"/></geometry></visual></link></robot>'
    )
    assert read(mesh).links[0].visuals[0].geometry == Mesh("m.stl", (1, 1, 1))


@pytest.mark.parametrize(("version", "problems"), [("1.0", ["version"]), ("1.1", []), ("1.2", [])])
def test_capsules_belong_to_urdf_since_1_1(version: str, problems: list[str]) -> None:
    robot = read(EVERYTHING.replace('name="all"', f'name="all" version="{version}"'))
    assert [problem.kind for problem in robot.problems] == problems


def test_defaults_of_urdf() -> None:
    robot = joint('<limit effort="1" velocity="1"/><dynamics/><mimic joint="j"/>')
    j = robot.joints[0]
    assert j.axis == (1.0, 0.0, 0.0)
    assert j.origin == Pose()
    assert j.limit is not None
    assert (j.limit.lower, j.limit.upper) == (None, None)
    assert j.dynamics is not None
    assert (j.dynamics.damping, j.dynamics.friction) == (0.0, 0.0)
    assert j.mimic is not None
    assert (j.mimic.multiplier, j.mimic.offset) == (1.0, 0.0)
    assert robot.problems == ()


@pytest.mark.parametrize("kind", JOINT_TYPES)
def test_the_six_joint_types(kind: str) -> None:
    robot = joint("", kind)
    assert robot.problems == ()
    assert robot.joints[0].is_movable is (kind != "fixed")


def link(inside: str) -> str:
    return f'<robot name="r"><link name="l">{inside}</link></robot>'


@pytest.mark.parametrize(
    ("text", "kind", "message", "attribute"),
    [
        (link('<visual><origin xyz="0,5 0 0"/><geometry><sphere radius="1"/></geometry></visual>'), "bad-number", "write a decimal point", "xyz"),
        (link('<visual><origin rpy="0, 0, 0"/><geometry><sphere radius="1"/></geometry></visual>'), "bad-number", "not commas", "rpy"),
        (link('<visual><origin xyz="0 0"/><geometry><sphere radius="1"/></geometry></visual>'), "wrong-arity", "expected 3 numbers, found 2", "xyz"),
        (link('<visual><geometry><box size="1"/></geometry></visual>'), "wrong-arity", "expected 3 numbers, found 1", "size"),
        (link('<visual><geometry><sphere radius="1 2"/></geometry></visual>'), "wrong-arity", "expected 1 number, found 2", "radius"),
        (link('<visual><geometry><sphere radius="${r}"/></geometry></visual>'), "bad-number", "not evaluated", "radius"),
        (link('<visual><geometry><sphere radius="5cm"/></geometry></visual>'), "bad-number", "SI", "radius"),
        (link('<visual><geometry><sphere radius=""/></geometry></visual>'), "bad-number", "empty", "radius"),
        (link('<visual><geometry><sphere radius="−1"/></geometry></visual>'), "bad-number", "minus sign", "radius"),
        (link("<visual><geometry><sphere/></geometry></visual>"), "missing", "has no attribute `radius`", "radius"),
        (link("<visual><geometry><box/></geometry></visual>"), "missing", "`size`", "size"),
        (link("<visual><geometry><mesh/></geometry></visual>"), "missing", "`filename`", "filename"),
        (link("<visual/>"), "missing", "lacks <geometry>", None),
        (link("<collision><geometry/></collision>"), "missing", "is empty", None),
        (link("<collision><geometry><cylindre/></geometry></collision>"), "unknown-value", "did you mean `cylinder`?", None),
        (link('<inertial><mass value="1"/></inertial>'), "missing", "lacks <inertia>", None),
        (link('<inertial><mass value="nan"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'), "not-finite", "not finite", "value"),
        ('<robot name="r"><material name="m"><color rgba="1 1 1"/></material></robot>', "wrong-arity", "expected 4", "rgba"),
        ('<robot name="r"><joint name="j" type="Revolute"><parent link="a"/><child link="b"/></joint></robot>', "unknown-value", "did you mean `revolute`?", "type"),
        ('<robot name="r"><joint name="j"><parent link="a"/><child link="b"/></joint></robot>', "missing", "missing attribute `type`", "type"),
        ('<robot name="r"><joint name="j" type="fixed"><child link="b"/></joint></robot>', "missing", "missing <parent link=…>", None),
        ('<robot name="r"><joint name="j" type="fixed"><parent/><child link="b"/></joint></robot>', "missing", "`link`", "link"),
        ('<robot name="r"><transmission><actuator><mechanicalReduction>x</mechanicalReduction></actuator></transmission></robot>', "bad-number", "`x` is not a number", None),
        ("<robot/>", "missing", "<robot> has no attribute `name`", "name"),
        ('<robot name="r"><link/></robot>', "missing", "<link> has no attribute `name`", "name"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_noted(text: str, kind: str, message: str, attribute: str | None) -> None:
    robot = read(text)
    assert [(problem.kind, problem.attribute) for problem in robot.problems] == [(kind, attribute)]
    assert message in robot.problems[0].message


def test_problems_name_link_or_joint_and_have_a_place() -> None:
    problem = read(link('<visual><origin xyz="a b c"/><geometry><sphere radius="1"/></geometry></visual>')).problems[0]
    assert problem.message.startswith("link `l`: xyz of <origin>")
    assert str(problem.origin.position) == "f:1:40"


def test_values_that_cannot_be_used_are_none_or_the_default() -> None:
    robot = read(
        link(
            '<inertial><origin xyz="x"/><mass value="?"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0"/></inertial>'
            '<visual><geometry><cylinder radius="1" length="x"/></geometry></visual>'
        )
    )
    inertial = robot.links[0].inertial
    assert inertial is not None
    assert (inertial.mass, inertial.inertia, inertial.origin) == (None, None, Pose())
    assert robot.links[0].visuals[0].geometry is None


def test_limits_may_be_infinite() -> None:
    robot = joint('<limit lower="-inf" upper="inf" effort="inf" velocity="1e16"/>')
    assert robot.problems == ()
    assert robot.joints[0].limit is not None
    assert robot.joints[0].limit.upper == math.inf


tags = st.sampled_from(
    [
        "robot",
        "link",
        "joint",
        "inertial",
        "mass",
        "inertia",
        "origin",
        "visual",
        "collision",
        "geometry",
        "box",
        "sphere",
        "cylinder",
        "mesh",
        "material",
        "color",
        "texture",
        "parent",
        "child",
        "axis",
        "limit",
        "dynamics",
        "mimic",
        "safety_controller",
        "calibration",
        "transmission",
        "type",
        "actuator",
        "hardwareInterface",
        "mechanicalReduction",
        "gazebo",
        "plugin",
        "sensor",
        "ros2_control",
        "foo",
    ]
)
attributes = st.dictionaries(
    st.sampled_from(
        [
            "name",
            "type",
            "value",
            "xyz",
            "rpy",
            "link",
            "joint",
            "size",
            "radius",
            "length",
            "filename",
            "scale",
            "rgba",
            "lower",
            "upper",
            "effort",
        ]
    ),
    st.one_of(
        st.text(max_size=8), st.sampled_from(["1", "1 2 3", "nan", "", "fixed", "revolute", "1e999", "-", "1_0"])
    ),
    max_size=4,
)
origin = Origin(Position("f", 1, 1))
elements = st.recursive(
    st.builds(Element, tags, attributes, st.just([]), st.text(max_size=4), st.just(origin)),
    lambda children: st.builds(Element, tags, attributes, st.lists(children, max_size=5), st.text(max_size=4), st.just(origin)),
    max_leaves=25,
)  # fmt: skip


@pytest.mark.slow
@given(st.lists(elements, max_size=6))
def test_parsing_never_raises_and_queries_work_on_anything(children: list[Element]) -> None:
    robot = parse(Element("robot", {}, children, "", origin))
    assert len(robot.links) == sum(child.tag == "link" for child in children)
    for loop in cycles(robot):
        assert all(below.child == after.parent for below, after in itertools.pairwise(loop))
    assert len(tree_order(robot)) <= len(robot.joints)


@given(st.floats(allow_nan=False))
def test_numbers_of_every_size(value: float) -> None:
    assert number(f" {value!r}\n") == value


@pytest.mark.parametrize("text", ["", " ", "1,5", "1_000", "٣", "0x10", "one", "1 2", "--1", "1e", "1\u00a0"])
def test_what_is_no_number(text: str) -> None:
    assert number(text) is None


def test_lists_of_numbers() -> None:
    assert numbers(" 1\t2\n3 ") == [1.0, 2.0, 3.0]
    assert numbers("") == []
    assert numbers("1 b") is None
    assert why_not("seven") == ""


@pytest.mark.parametrize(
    ("joints", "most", "loop"),
    [
        ("ab bc", 9, []),
        ("ab bc cb", 9, ["b", "c"]),
        ("ab bc cd db", 9, ["b", "c", "d"]),
        ("ab bc cd db", 2, []),  # too long to follow
        ("ab cb", 9, []),  # two parents, and no loop
        ("ab bb", 9, ["b"]),
    ],
)
def test_the_loop_that_a_second_parent_closes(joints: str, most: int, loop: list[str]) -> None:
    links = "".join(f'<link name="{name}"/>' for name in "abcd")
    text = "".join(
        f'<joint name="{pair}" type="fixed"><parent link="{pair[0]}"/><child link="{pair[1]}"/></joint>'
        for pair in joints.split()
    )
    robot = read(f'<robot name="r">{links}{text}</robot>')
    assert loop_closed_by(robot, robot.joints[-1], most=most) == loop
