"""One defect is one finding, where it was made: in a property, in a call, in a file that is broken."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
BALL = '<link name="{0}"><visual><geometry><sphere radius="{1}"/></geometry></visual></link>'
WEIGHT = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1.1"/></inertial>'
WHEEL = """<xacro:macro name="wheel" params="name radius">
<link name="${name}"><visual><geometry><sphere radius="${radius}"/></geometry></visual></link>
<joint name="${name}_joint" type="fixed"><parent link="base"/><child link="${name}"/></joint>
</xacro:macro>
<link name="base"/>
"""


def found(tmp_path, body: str, **files: str) -> list[tuple[str, int, str]]:
    (tmp_path / "r.urdf.xacro").write_text(f'<robot name="r" {XACRO}>\n{body}\n</robot>\n')
    for name, text in files.items():
        (tmp_path / f"{name}.xacro").write_text(text)
    return [(f.code, f.line, f.message) for f in lint(tmp_path / "r.urdf.xacro") if f.severity != "note"]


def test_a_size_below_zero_is_reported_at_its_property_and_nothing_that_follows(tmp_path):
    ball = BALL.format("base", "${R}").replace("</link>", f"{WEIGHT}</link>")
    body = f'<xacro:property name="R" value="-0.05"/>\n{ball.replace("visual", "collision", 2)}'
    body = body.replace("<inertial>", "<visual><geometry><sphere radius='${2*R}'/></geometry></visual><inertial>")
    assert [(code, line) for code, line, _ in found(tmp_path, body)] == [("G611", 2)]


def test_a_size_below_zero_is_told_at_the_call_that_gives_it(tmp_path):
    calls = '<xacro:wheel name="a" radius="0.1"/>\n<xacro:wheel name="b" radius="-0.1"/>'
    assert [(code, line) for code, line, _ in found(tmp_path, WHEEL + calls)] == [("G611", 8)]


def test_a_size_below_zero_that_a_property_takes_to_a_call_is_told_at_the_property(tmp_path):
    calls = '<xacro:property name="R" value="-0.1"/><xacro:wheel name="a" radius="${R}"/>\n'
    calls += '<xacro:wheel name="b" radius="${R}"/>'
    assert [(code, line) for code, line, _ in found(tmp_path, WHEEL + calls)] == [("G611", 7)]


@pytest.mark.parametrize(
    "text",
    [
        f'<robot {XACRO}>\n<material name="grey"><color rgba=".5 .5 .5 1"/></material>\n',
        f'<robot {XACRO}>\n<material name="grey"><color rgba=".5 .5 .5 1></material>\n</robot>',
    ],
)
def test_what_a_broken_file_defines_is_not_missed(tmp_path, text):
    use = BALL.format("base", "0.1").replace("</visual>", '<material name="grey"/></visual>')
    use = use.replace("</link>", "<collision><geometry><sphere radius='0.1'/></geometry></collision></link>")
    body = f'<xacro:include filename="parts.xacro"/>\n{use}'
    assert [code for code, *_ in found(tmp_path, body, parts=text)] == ["E001"]


def test_a_macro_of_a_broken_file_is_not_missed_and_another_is(tmp_path):
    text = f'<robot {XACRO}>\n<xacro:macro name="wheel" params="name">\n<link name="${{name}}"/>\n'
    body = '<xacro:include filename="parts.xacro"/>\n<link name="base"/>\n<xacro:wheel name="a"/>\n'
    assert [code for code, *_ in found(tmp_path, body, parts=text)] == ["E001"]
    assert sorted(code for code, *_ in found(tmp_path, f"{body}<xacro:whale/>", parts=text)) == ["E001", "X103"]


def test_an_argument_under_another_name_is_one_finding(tmp_path):
    told = found(tmp_path, WHEEL + '<xacro:wheel name="a" size="0.1"/>')
    assert told == [("X107", 7, "unknown parameter `size` of macro `wheel`, which requires `radius`")]
    told = found(tmp_path, WHEEL + '<xacro:wheel nam="a" radus="0.1"/>')
    assert sorted(message for *_, message in told) == [
        "unknown parameter `nam` of macro `wheel`, which requires `name`",
        "unknown parameter `radus` of macro `wheel`, which requires `radius`",
    ]
    told = found(tmp_path, WHEEL + '<xacro:wheel nam="a"/>')
    assert sorted(message for *_, message in told) == [
        "the call of macro `wheel` lacks `radius`",
        "unknown parameter `nam` of macro `wheel`, which requires `name`",
    ]


def test_numbers_that_cannot_be_read_are_no_other_defect(tmp_path):
    body = """<link name="world"/>
<link name="w"><visual><origin rpy="1.5708 0 0"/><geometry><cylinder radius=".1" length=".02"/></geometry></visual>
<inertial><mass value="1,5"/><inertia ixx=".01" ixy="0" ixz="0" iyy=".01" iyz="0" izz=".01"/></inertial></link>
<joint name="j" type="continuous"><parent link="world"/><child link="w"/><axis xyz="0, 1, 0"/></joint>
<gazebo><plugin name="p" filename="libgazebo_ros_joint_state_publisher.so"/></gazebo>"""
    assert [(c, line) for c, line, _ in found(tmp_path, body) if c != "G610"] == [("E010", 4), ("E010", 5)]


def test_a_property_that_is_nearly_a_number_is_reported_where_it_is_written(tmp_path):
    body = """<xacro:property name="track" value="O.4"/>
<link name="base"/><link name="a"/><link name="b"/>
<joint name="j" type="fixed"><parent link="base"/><child link="a"/><origin xyz="0 ${track/2} 0"/></joint>
<joint name="k" type="fixed"><parent link="base"/><child link="b"/><origin xyz="0 ${-track/2} 0"/></joint>"""
    assert found(tmp_path, body) == [("X124", 2, "`O.4` is used in an expression, but is not a number")]
    told = found(tmp_path, body.replace("${track/2}", "${track}").replace("${-track/2}", "${track}"))
    assert [(code, line) for code, line, _ in told] == [("E010", 2)]


def test_what_fails_for_another_reason_is_reported_where_it_fails(tmp_path):
    body = f'<xacro:property name="side" value="left"/>\n{BALL.format("base", "${side / 2}")}'
    assert [(code, line) for code, line, _ in found(tmp_path, body) if code != "G610"] == [("X124", 3)]


def test_of_properties_below_zero_the_one_that_is_a_size_is_blamed(tmp_path):
    body = """<xacro:property name="radius" value="-0.05"/><xacro:property name="wheel_z" value="-0.01"/>
<xacro:macro name="caster" params="radius z">
<xacro:property name="half" value="${(radius - z) / 2}"/>
<link name="c"><collision><geometry><sphere radius="${half}"/></geometry></collision></link></xacro:macro>
<xacro:caster radius="${radius}" z="${wheel_z}"/>"""
    assert [(code, line) for code, line, _ in found(tmp_path, body)] == [("G611", 2)]


def test_a_child_with_letters_swapped_is_one_finding_with_a_hint(tmp_path):
    joint = '<joint name="j" type="fixed"><parent link="base"/><child link="amr"/></joint>'
    told = found(tmp_path, f'<link name="base"/><link name="arm"/>\n{joint}')
    assert told == [("T202", 3, "undefined child link `amr` of joint `j`; did you mean `arm`?")]


BOX = """<link name="{0}"><visual><geometry><box size="{1} {1} {1}"/></geometry></visual>
<collision><geometry><box size="{1} {1} {1}"/></geometry></collision>
<xacro:weight side="{2}"/></link>
"""
WEIGHED = """<xacro:macro name="weight" params="side"><inertial><mass value="1"/>
<inertia ixx="${side*side/6}" ixy="0" ixz="0" iyy="${side*side/6}" iyz="0" izz="${side*side/6}"/></inertial>
</xacro:macro>
"""
JOINT = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'


@pytest.mark.parametrize(("given", "code"), [("1", "I507"), ("0.004", "I508")])
def test_an_inertia_is_told_at_the_call_where_other_calls_are_right(tmp_path, given, code):
    body = WEIGHED + BOX.format("a", "0.1", given) + BOX.format("b", "0.2", "0.2") + JOINT
    assert [(c, line) for c, line, _ in found(tmp_path, body)] == [(code, 7)]
    body = WEIGHED + BOX.format("a", "0.1", given)
    assert [(c, line) for c, line, _ in found(tmp_path, body)] == [(code, 3)]
