"""Findings that vanish with the cause of another one are ignored."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Span
from urdfkit.lint import lint
from urdfkit.lint.engine.consequences import without_consequences
from urdfkit.lint.finding import Finding


def finding(code: str, message: str, line: int = 1, **others: object) -> Finding:
    return Finding(code, "x", "warning", message, Span("a", line, 1, line, 2), **others)  # type: ignore[arg-type]


CASES = {
    "line": (
        finding("E014", "<mass> has no attribute `value`", kind="attribute"),
        finding("E007", "unexpected text"),
        True,
    ),
    "flag of a publisher": (finding("K971", "`flag` is false, but true"), finding("K985", "flag is false"), True),
    "unit and type": (finding("K970", "`wheelbase` is 1100 m"), finding("K974", "an integer"), True),
    "state of the other group": (
        finding("M107", "joints of another group", kind="foreign"),
        finding("M106", "duplicate state"),
        True,
    ),
    "value beyond a limit": (finding("M107", "beyond the limit"), finding("M106", "duplicate state"), False),
    "parameter of the SRDF": (finding("L110", "not from `a`"), finding("L104", "unknown name", kind="name"), True),
    "huge mesh in another link": (
        finding("G604", "1000 m", link="a"),
        finding("S909", "a, b", 9, names=("a", "b")),
        True,
    ),
    "huge mesh elsewhere": (finding("G604", "1000 m", link="c"), finding("S909", "a, b", 9, names=("a", "b")), False),
    "huge mesh in a footprint": (finding("G604", "1000 m", link="a"), finding("K979", "1 m", 9, kind="size"), True),
    "package": (
        finding("K973", "named `a`", kind="name", names=("a", "b")),
        finding("M111", "unknown package `b`", 9, names=("b",)),
        True,
    ),
    "other package": (
        finding("K973", "named `a`", kind="name", names=("a", "b")),
        finding("M111", "unknown package `c`", 9, names=("c",)),
        False,
    ),
    "other line": (
        finding("E014", "<mass> has no attribute `value`", kind="attribute"),
        finding("E007", "text", 2),
        False,
    ),
    "name": (finding("S907", "wheels", joint="a", names=("b",)), finding("S909", "joints", names=("b", "c")), True),
    "other name": (finding("S907", "wheels", joint="a"), finding("S909", "joints `a`", 9, names=("c", "d")), False),
    "call": (finding("T206", "link", chains=(("c",),)), finding("T207", "joint", 9, chains=(("c",),)), True),
    "other call": (finding("T206", "link", chains=(("c",),)), finding("T207", "joint", 9, chains=(("d",),)), False),
    "inner call": (finding("T206", "link", chains=(("c",),)), finding("T207", "joint", 9, chains=(("d", "c"),)), True),
    "outer call": (finding("T206", "link", chains=(("d", "c"),)), finding("T207", "joint", 9, chains=(("c",),)), False),
    "meant": (
        finding("K960", "unknown controller `a`", suggestion=Suggestion("arm", "a")),
        finding("M112", "no launch file spawns controller `arm`", 9, kind="unspawned", names=("arm",)),
        True,
    ),
    "other meant": (
        finding("K960", "unknown controller `a`", suggestion=Suggestion("arm", "a")),
        finding("M112", "no launch file spawns controller `leg`", 9, kind="unspawned", names=("leg",)),
        False,
    ),
    "shape": (finding("G620", "a", link="b"), finding("I513", "centre of mass", 9, link="b"), True),
    "ground": (finding("G620", "a", link="b"), finding("S921", "into the ground", 9, joint="c"), True),
    "hanging": (finding("G620", "a", link="b"), finding("S917", "cannot lift", 9, names=("a", "b")), True),
    "other shape": (finding("G620", "a", link="b"), finding("I513", "centre of mass", 9, link="c"), False),
    "no call": (finding("T206", "duplicate link `a`"), finding("T207", "duplicate joint `b`", 9), False),
    "robot": (finding("T207", "duplicate joint `a`"), finding("K959", "joint `b` does not exist", 9), True),
    "sensor": (finding("Z817", "a"), finding("K969", "no Gazebo topic `b`", 9, kind="topic"), True),
    "type": (finding("Z817", "a"), finding("K969", "unknown type `b`", 9), False),
    "height": (finding("S911", "a"), finding("K968", "into the ground", 9, kind="height"), True),
    "option": (finding("S911", "a"), finding("K968", "unknown option", 9, kind="option"), False),
    "kind": (finding("C707", "a", kind="undefined"), finding("K965", "b", 9, kind="joint"), True),
    "other kind": (finding("C707", "a", kind="undefined"), finding("K965", "b", 9, kind="interface"), False),
    "words": (finding("C707", "undefined joint `a`"), finding("K965", "lacks joint `b`", 9), False),
    "no cause": (finding("E010", "bad number"), finding("K959", "joint `b` does not exist", 9), False),
}


@pytest.mark.parametrize("case", CASES)
def test_consequences_are_left_out(case: str) -> None:
    cause, effect, is_left_out = CASES[case]
    assert without_consequences([effect, cause]) == ([cause] if is_left_out else [effect, cause])


def test_a_consequence_whose_fix_corrects_the_cause_is_kept(tmp_path: Path) -> None:
    shape = '<visual><geometry>\n<cylinder radius="1" {}/>\n</geometry></visual>'
    robot = f'<robot name="arm"><link name="a">{shape}</link></robot>'
    (tmp_path / "arm.urdf").write_text(robot.format('lenght="1"'))
    (tmp_path / "leg.urdf").write_text(robot.format('tall="1"'))
    assert {found.code for found in lint(tmp_path / "arm.urdf") if found.line == 2} == {"E014", "E009"}
    assert {found.code for found in lint(tmp_path / "leg.urdf") if found.line == 2} == {"E014"}


RULES = Path(__file__).parents[1] / "rules"
SHAPE_IN_DEGREES = '<visual><origin rpy="0 90 0"/><geometry><box size="0.4'


@pytest.mark.parametrize(
    ("rule", "file", "old", "new", "codes"),
    [
        ("fingers-not-opposed", "good.urdf", 'upper="0.03"', 'upper="40"', {"J422"}),
        ("fingers-not-opposed", "good.urdf", 'lower="0" upper="0.03"', 'lower="0.03" upper="0"', {"J405"}),
        ("tool-frame-inside-body", "good.urdf.xacro", 'rpy="${-pi/2} 0 ${-pi/2}', 'rpy="${-pi/2} 0 ${pi/2}', {"S905"}),
        ("inertia-unlike-shapes", "good.urdf.xacro", '<visual><geometry><box size="0.4', SHAPE_IN_DEGREES, {"J408"}),
        ("joint-without-controller", "bad.yaml", "[position]", "[velocity]", {"K965"}),
    ],
)
def test_one_mistake_has_one_finding(tmp_path: Path, rule: str, file: str, old: str, new: str, codes: set[str]) -> None:
    for source in (RULES / rule).iterdir():
        if source.name in ("package.xml", "arm.urdf"):
            (tmp_path / source.name).write_text(source.read_text())
    text = (RULES / rule / file).read_text()
    assert old in text
    (tmp_path / file).write_text(text.replace(old, new, 1))
    assert {found.code for found in lint(tmp_path)} == codes


LINK = '<link name="{}"><inertial><mass value="{}"/><inertia ixx="{i}" iyy="{i}" izz="{i}" ixy="0" ixz="0" iyz="0"/>'
LINK += '</inertial><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>'
JOINT = '<joint name="{0}" type="fixed"><parent link="{1}"/><child link="{2}"/><origin {3}/></joint>'
MACRO = '<xacro:macro name="part" params="{}">{}</xacro:macro>'
BALL = '<link name="${name}"><visual><geometry><sphere radius="${width}"/></geometry></visual></link>'
TOOL = '<link name="${p}tool"/><link name="${p}arm"/>' + JOINT.format("${p}joint", "${p}arm", "tool", "")
A = LINK.format("a", 1, i=0.002)
B = A.replace('"a"', '"b_link"')
ARM = '<link name="${p}arm"/><link name="${p}hand"/>' + JOINT.format("${p}wrist", "${p}arm", "${p}hand", "")
ARMS = '<link name="base"/>' + MACRO.format("p", ARM) + '<xacro:part p="left_"/>' * 2
ARMS += JOINT.format("left", "base", "left_arm", "") + JOINT.format("right", "base", "right_arm", "")
ROBOTS = {
    "T204": '<link name="base"/>'
    + A
    + B
    + JOINT.format("a_joint", "base", "a", "")
    + JOINT.format("b_joint", "a", "a", ""),
    "T205": A + B + '<link name="c"/>' + JOINT.format("d", "a", "b_link", "") + JOINT.format("e", "c", "b_link", ""),
    "T206": ARMS + '<link name="tool"/>' + JOINT.format("grip", "right_hand", "tool", ""),
    "X104": MACRO.format("name wdth colour:=red", BALL) + '<xacro:part name="a" width="1"/>',
    "T202": MACRO.format("p", TOOL) + '<xacro:part p="left_"/>',
    "J408": A + '<link name="optical_frame"/>' + JOINT.format("eye", "a", "optical_frame", 'rpy="-90 0 -90"'),
    "I514": LINK.format("a", 9000, i=0.002),
}
EFFECTS = {
    "T204": "T203",
    "T205": "T203",
    "T206": "T201",
    "X104": "X107",
    "T202": "N304",
    "J408": "S905",
    "I514": "I508",
}


@pytest.mark.parametrize("cause", ROBOTS)
def test_a_mistake_of_a_robot_has_one_finding(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cause: str) -> None:
    path, effect = tmp_path / "arm.xacro", EFFECTS[cause]
    path.write_text(f'<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{ROBOTS[cause]}</robot>')
    assert {cause, effect} & {each.code for each in lint(path)} == {cause}
    monkeypatch.setattr("urdfkit.lint.engine.consequences._CODES", frozenset())
    assert {cause, effect} <= {each.code for each in lint(path)}


def test_a_macro_without_its_block_may_define_any_of_its_links(tmp_path: Path) -> None:
    part = MACRO.format("*origin", '<link name="hand"/>') + '<xacro:part/>\n<link name="c"/>'
    text = A + part + JOINT.format("d", "hand", "c", "") + JOINT.format("e", "foot", "a", "")
    (tmp_path / "arm.xacro").write_text(f'<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{text}</robot>')
    found = [each.message for each in lint(tmp_path) if each.code in ("X107", "T201")]
    assert found == ["macro `part` needs more blocks inside its call", "undefined parent link `foot` of joint `e`"]


def test_a_macro_call_that_repeats_another_is_one_finding(tmp_path: Path) -> None:
    (tmp_path / "arm.xacro").write_text(f'<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{ARMS}</robot>')
    found = [each.text for each in lint(tmp_path) if each.code in ("T201", "T206", "T207")]
    message = "the call of macro `part` repeats 2 links of another call, such as `left_arm`"
    assert found == [f"{message}; pass another name or prefix"]


def test_a_joint_of_the_other_hand_in_a_group_is_one_finding(tmp_path: Path) -> None:
    joint = '<joint name="{0}" type="prismatic"><parent link="a"/><child link="{0}_tip"/><axis xyz="1 0 0"/>'
    joint += '<limit lower="0" upper="1" effort="1" velocity="1"/></joint><link name="{0}_tip"/>'
    fingers = "".join(joint.format(f"{side}_finger") for side in ("left", "right"))
    (tmp_path / "arm.urdf").write_text(f'<robot name="arm">{A}{fingers}</robot>')
    group = '<group name="right"><joint name="left_finger"/></group>'
    state = '<group_state name="{}" group="right"><joint name="right_finger" value="0.5"/></group_state>'
    text = f'<robot name="arm">{group}{state.format("open")}{state.format("closed")}</robot>'
    (tmp_path / "arm.srdf").write_text(text)
    (tmp_path / "package.xml").write_text('<package format="3"><name>arm</name><version>1.0.0</version></package>')
    found = [each.message for each in lint(tmp_path / "arm.urdf") if each.code == "M107"]
    assert found == ["group `right` contains joint `left_finger`, but its states have values for `right_finger`"]


def test_a_mesh_shows_a_cylinder_with_radius_and_length_swapped() -> None:
    from urdfkit.description.urdf.robot import Box, Cylinder, Pose
    from urdfkit.lint.rules.geometry.collision_unlike_visual import _defect

    box, pose = ((Box((0.9, 0.3, 0.9)), Pose()),), Pose(rpy=(1.5707963267948966, 0.0, 0.0))
    swapped, right = _defect(box, ((Cylinder(0.3, 0.45), pose),)), _defect(box, ((Cylinder(0.45, 0.3), pose),))
    assert (swapped, right) == (
        ("has the radius and length of the visual shape swapped", "swap radius and length", "geometry"),
        None,
    )


LIFT = """  <joint name="{0}_lift" type="prismatic"><parent link="base"/><child link="{0}_load"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.1" effort="5" velocity="1"/></joint>"""


@pytest.mark.parametrize(("heavy", "lifts"), [("left_load", ["right_lift"]), ("base", ["left_lift", "right_lift"])])
def test_a_wrong_mass_explains_only_the_lift_that_carries_it(tmp_path: Path, heavy: str, lifts: list[str]) -> None:
    links = "".join(
        LINK.format(name, 9000 if name == heavy else 10, i=0.02) for name in ("base", "left_load", "right_load")
    )
    (tmp_path / "lift.urdf").write_text(
        f'<robot name="lift">{links}{LIFT.format("left")}{LIFT.format("right")}</robot>'
    )
    assert [each.joint for each in lint(tmp_path / "lift.urdf") if each.code == "J429"] == lifts


def test_a_malformed_yaml_file_is_one_finding(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text('<package format="3"><name>arm</name><version>1.0.0</version></package>')
    (tmp_path / "config").mkdir()
    (tmp_path / "config/sizes.yaml").write_text("base:\n    length: 0.7\n  width: 0.5\n")
    load = """<xacro:property name="sizes" value="${xacro.load_yaml('config/sizes.yaml')}"/>"""
    text = f'<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{load}<link name="a"/></robot>'
    (tmp_path / "arm.urdf.xacro").write_text(text)
    found = [(each.code, each.line) for each in lint(tmp_path) if each.code in ("K966", "X124")]
    assert found == [("K966", 2)]


def test_a_block_of_a_macro_explains_only_the_joints_in_the_blocks_of_its_calls(tmp_path: Path) -> None:
    macro = '<xacro:macro name="group" params="*parts"><link name="a"/></xacro:macro>'
    joint = JOINT.format("wrist", "a", "b", "")
    call = f'<xacro:group><parts>{joint}<link name="b"/></parts></xacro:group>'
    hardware = "<hardware><plugin>mock_components/GenericSystem</plugin></hardware>"
    control = "".join(f'<joint name="{name}"><state_interface name="position"/></joint>' for name in ("wrist", "elbow"))
    control = f'<ros2_control name="arm" type="system">{hardware}{control}</ros2_control>'
    text = f'<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{macro}{call}{control}</robot>'
    (tmp_path / "arm.urdf.xacro").write_text(text)
    found = [(each.code, each.joint) for each in lint(tmp_path / "arm.urdf.xacro") if each.code in ("X128", "C707")]
    assert found == [("X128", None), ("C707", "elbow")]


def test_a_malformed_file_does_not_make_its_macros_calls_of_others(tmp_path: Path) -> None:
    (tmp_path / "arm.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n<xacro:macro name="robot_arm" params="name">\n'
        '<link name="${name}">\n<visul>\n</visual>\n</link>\n</xacro:macro>\n<visual/>\n</robot>'
    )
    head = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="arm.xacro"/>'
    macro = '<xacro:macro name="robot_am" params="name"><link name="base"/></xacro:macro>'
    text = f'{head}{macro}<xacro:robot_am name="base"/><xacro:robot_arm name="arm"/></robot>'
    (tmp_path / "robot.urdf.xacro").write_text(text)
    assert [(each.code, each.line) for each in lint(tmp_path / "robot.urdf.xacro")] == [("E001", 4)]
