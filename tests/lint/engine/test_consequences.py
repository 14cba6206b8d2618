"""Findings that vanish with the cause of another one are left out."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.xml.source import Span
from urdfkit.lint import lint
from urdfkit.lint.engine.consequences import without_consequences
from urdfkit.lint.finding import Finding


def finding(code: str, message: str, line: int = 1, **others: object) -> Finding:
    return Finding(code, "x", "warning", message, Span("a", line, 1, line, 2), **others)  # type: ignore[arg-type]


CASES = {
    "line": (
        finding("E014", "<mass> lacks its attribute `value`", kind="attribute"),
        finding("E007", "unexpected text"),
        True,
    ),
    "other line": (
        finding("E014", "<mass> lacks its attribute `value`", kind="attribute"),
        finding("E007", "text", 2),
        False,
    ),
    "name": (finding("S907", "wheels", joint="a", names=("b",)), finding("S909", "joints", names=("b", "c")), True),
    "other name": (finding("S907", "wheels", joint="a"), finding("S909", "joints `a`", names=("c", "d")), False),
    "call": (finding("T206", "link", chains=(("c",),)), finding("T207", "joint", 9, chains=(("c",),)), True),
    "other call": (finding("T206", "link", chains=(("c",),)), finding("T207", "joint", 9, chains=(("d",),)), False),
    "no call": (finding("T206", "duplicate link `a`"), finding("T207", "duplicate joint `b`", 9), False),
    "robot": (finding("T207", "duplicate joint `a`"), finding("K959", "joint `b` does not exist", 9), True),
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


@pytest.mark.parametrize(
    ("rule", "file", "old", "new", "codes"),
    [
        ("fingers-not-opposed", "good.urdf", 'upper="0.03"', 'upper="40"', {"J422"}),
        ("fingers-not-opposed", "good.urdf", 'lower="0" upper="0.03"', 'lower="0.03" upper="0"', {"J405"}),
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
ROBOTS = {
    "X104": MACRO.format("name wdth", BALL) + '<xacro:part name="a" width="1"/>',
    "T202": MACRO.format("p", TOOL) + '<xacro:part p="left_"/>',
    "J408": A + '<link name="optical_frame"/>' + JOINT.format("eye", "a", "optical_frame", 'rpy="-90 0 -90"'),
    "I514": LINK.format("a", 9000, i=0.002),
}
EFFECTS = {"X104": "X107", "T202": "N304", "J408": "S905", "I514": "I508"}


@pytest.mark.parametrize("cause", ROBOTS)
def test_a_mistake_of_a_robot_has_one_finding(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cause: str) -> None:
    path, effect = tmp_path / "arm.xacro", EFFECTS[cause]
    path.write_text(f'<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{ROBOTS[cause]}</robot>')
    assert {cause, effect} & {each.code for each in lint(path)} == {cause}
    monkeypatch.setattr("urdfkit.lint.engine.consequences._CODES", frozenset())
    assert {cause, effect} <= {each.code for each in lint(path)}
