"""After an error, a name that nothing has is in doubt only where it could be in what the error has hidden."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint
from urdfkit.lint.model.masked_names import is_typo

TRANSMISSION = (
    '<transmission name="t"><type>transmission_interface/SimpleTransmission</type>'
    '<joint name="m_j"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>'
    '<actuator name="a"/></transmission>'
)
ROBOT = (
    '<link name="base"/>{}<link name="mast"/><joint name="mj" type="fixed"><parent link="bse"/><child link="mast"/>'
    f'</joint><gazebo reference="mst"/>{TRANSMISSION}'
)
MACRO = '<xacro:macro name="m" params="p q"><link name="${p}_x"/></xacro:macro>'
ONE, TWO = '<xacro:macro name="m" params="p">', '<xacro:macro name="m" params="p q">'
SLIPS = {"T201": "bse", "Z801": "mst", "C701": "m_j"}


def found(path, codes=tuple(SLIPS)):
    return {f.code: (f.severity, f.help, f.fix) for f in lint(path, select=codes)}


@pytest.mark.parametrize(
    "fault",
    [
        '<xacro:if value="maybe"/>',
        '<xacro:if value="maybe"><link name="bsf"/></xacro:if>',
        f'{MACRO}<xacro:m p="a"/>',
        f'{MACRO}<xacro:m p="a" q="b" r="c"/>',
        '<xacro:macro name="m" params="p"><xacro:m p="${p}"/><link name="${p}_x"/></xacro:macro><xacro:m p="a"/>',
    ],
)
def test_what_an_error_cannot_have_hidden_is_reported(write, fault):
    assert {code: severity for code, (severity, *_) in found(write("r.xacro", ROBOT.format(fault))).items()} == (
        dict.fromkeys(SLIPS, "error")
    )


@pytest.mark.parametrize(
    ("fault", "why"),
    [
        ('<xacro:nope a="b"/>', "it may be in macro `nope`, which is not defined"),
        ('<xacro:include filename="gone.xacro"/>', "it may be in gone.xacro, which was not found"),
        ('<xacro:include filename="$(find gone)/a.xacro"/>', "it may be in package `gone`, which was not found"),
        ('<xacro:include filename="broken.xacro"/>', "it may be in broken.xacro, which is not well-formed"),
    ],
)
def test_slips_are_reported_as_notes_where_any_name_may_be_missing(write, fault, why):
    write("broken.xacro", b"<robot><link name='x'>")
    assert found(write("r.xacro", ROBOT.format(fault))) == dict.fromkeys(SLIPS, ("note", why, None))
    others = ROBOT.replace("bse", "tower").replace("mst", "turret").replace("m_j", "hinge")
    assert found(write("r.xacro", others.format(fault))) == {}


@pytest.mark.parametrize(
    "fault",
    [
        '<xacro:if value="maybe"><link name="bse"/></xacro:if>',
        f'{ONE}<xacro:if value="maybe"><link name="b${{p}}"/></xacro:if></xacro:macro><xacro:m p="se"/>',
        '<xacro:macro name="m" params="p q"><link name="${q}se"/></xacro:macro><xacro:m p="a"/>',
        f'{TWO}<xacro:unless value="${{q}}"><link name="${{p}}se"/></xacro:unless></xacro:macro><xacro:m p="b"/>',
        f'{ONE}<link name="${{p}}"/></xacro:macro><xacro:if value="maybe"><xacro:m p="bse"/></xacro:if>',
        '<xacro:macro name="m" params="p"><link name="bse"/><xacro:m p="a"/></xacro:macro><xacro:m p="a"/>',
        '<lnk name="bse"/>',
        '<xacro:include filename="broken.xacro"/>',
    ],
)
def test_what_is_written_in_what_an_error_has_hidden_is_let_be(write, fault):
    write("broken.xacro", b"<robot><link name='bse><visual/>")
    assert found(write("r.xacro", ROBOT.format(fault)), ["T201"]) == {}


def test_a_root_is_one_unless_a_joint_to_it_may_be_hidden(write):
    two = '<link name="a"/><link name="b"/>{}'
    joint = '<xacro:if value="{}"><joint name="j" type="fixed"><parent link="a"/><child link="{}"/></joint></xacro:if>'
    assert "T203" in found(write("r.xacro", two.format('<xacro:if value="maybe"/>')), ["T203"])
    assert "T203" in found(write("r.xacro", two.format(joint.format("maybe", "c"))), ["T203"])
    assert "T203" not in found(write("r.xacro", two.format(joint.format("maybe", "b"))), ["T203"])
    assert "T203" not in found(write("r.xacro", two.format('<xacro:nope a="b"/>')), ["T203"])


def test_names_that_could_not_be_evaluated_have_their_fault_already(write):
    joint = '<joint name="j" type="fixed"><parent link="${u}_x"/><child link="a"/></joint>'
    assert found(write("r.xacro", f'<link name="a"/>{joint}<gazebo reference="${{u}}"/>')) == {}


@pytest.mark.parametrize(
    ("name", "near", "slip"),
    [
        ("bse_link", "base_link", True),
        ("baselink", "base_link", True),
        ("Base_Link", "base_link", True),
        ("left_wheel", "right_wheel", False),
        ("link_2", "link_1", False),
        ("link12", "link1", False),
        ("arm_a", "arm_b", False),
        ("wheel_fl", "wheel_fr", False),
        ("front_laser_link", "laser_link", False),
    ],
)
def test_sisters_are_no_slips(name, near, slip):
    assert is_typo(name, near) is slip


def test_a_macro_that_doubles_its_argument_hides_any_name(tmp_path):
    path = tmp_path / "r.urdf.xacro"
    path.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m" params="x">'
        '<link name="${x}"/><xacro:m x="${x}${x}"/></xacro:macro><xacro:m x="a"/><gazebo reference="mst"/></robot>'
    )
    assert [f.code for f in lint(path, select=("X114", "Z801"))] == ["X114"]


def test_macros_that_call_each_other_deep_inside_of_elements(tmp_path):
    """Together deeper than Python's recursion limit."""
    path, macros = tmp_path / "r.urdf.xacro", []
    for k in range(12):
        inner = f'<xacro:m{k + 1} x="a"/>' if k < 11 else '<link name="mst"/>'
        body = f'<xacro:if value="0">{"<a>" * 150}{inner}{"</a>" * 150}</xacro:if>'
        macros.append(f'<xacro:macro name="m{k}" params="x">{body}</xacro:macro>')
    path.write_text(
        f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{"".join(macros)}<link name="base"/>'
        '<xacro:if value="${missing}"><xacro:m0 x="a"/></xacro:if><gazebo reference="mst"/></robot>'
    )
    assert [f.code for f in lint(path, select=("E", "Z801"))] == []
