"""Robots that are not one valid tree: the rest of the robot is loaded, and each fault is named where lint names it."""

from __future__ import annotations

from math import radians
from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.description.loading import load_repaired
from urdfkit.errors import ModelError
from urdfkit.lint import lint

LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'


def links(*names: str) -> str:
    return "".join(f'<link name="{name}"/>' for name in names)


def joint(name: str, parent: str, child: str, type: str = "fixed", inside: str = "") -> str:
    return f'<joint name="{name}" type="{type}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


CASES = {
    "several roots": (
        links("a", "b") + joint("j", "a", "b") + "\n" + links("c"),
        "T203",
        "`c` is fixed to the origin of `a`",
    ),
    "undefined parent": (
        links("a", "b") + "\n" + joint("j", "aa", "b"),
        "T201",
        "an empty link `aa` is added, fixed to the origin of `a`",
    ),
    "undefined child": (
        links("a", "b") + joint("k", "a", "b") + "\n" + joint("j", "a", "bb"),
        "T202",
        "empty link `bb`",
    ),
    "two parents": (
        links("a", "b", "c") + joint("k", "a", "b") + joint("m", "a", "c") + "\n" + joint("j", "b", "c"),
        "T205",
        "joint `j` is ignored",
    ),
    "joint of a link with itself": (
        links("a", "b") + joint("k", "a", "b") + "\n" + joint("j", "b", "b"),
        "T204",
        "joint `j` connects link `b` with itself; the joint is ignored",
    ),
    "link behind a joint without a parent": (
        links("a", "b") + "\n" + joint("j", "a", "b").replace('<parent link="a"/>', "<parent/>"),
        "E014",
        "the joint is ignored; `b` is fixed to the origin of `a`",
    ),
    "misspelt child": (
        links("a", "tip ") + "\n" + joint("j", "a", "tip"),
        "T202",
        "an empty link `tip` is added; `tip ` is fixed to the origin of `a`",
    ),
    "loop": (
        links("a", "b", "c") + joint("k", "b", "c") + "\n" + joint("j", "c", "b"),
        "T204",
        "joint `j` is ignored",
    ),
    "loop of everything": (
        links("a", "b") + joint("k", "a", "b") + "\n" + joint("j", "b", "a"),
        "T204",
        "joint `j` is ignored",
    ),
    "two links of a name": (links("a", "b") + joint("j", "a", "b") + "\n" + links("b"), "T206", "this one is ignored"),
    "two joints of a name": (
        links("a", "b", "c") + joint("j", "a", "b") + "\n" + joint("j", "a", "c"),
        "T207",
        "this one is renamed",
    ),
    "unknown type": (links("a", "b") + "\n" + joint("j", "a", "b", "hinge"), "J402", "the joint is fixed"),
    "no limits": (links("a", "b") + "\n" + joint("j", "a", "b", "revolute"), "J403", "it moves without limits"),
    "zero axis": (
        links("a", "b") + "\n" + joint("j", "a", "b", "continuous", '<axis xyz="0 0 0"/>'),
        "J411",
        "it is 1 0 0",
    ),
    "axis whose length is zero as a number": (
        links("a", "b") + "\n" + joint("j", "a", "b", "continuous", '<axis xyz="0 0 1e-200"/>'),
        "J411",
        "it is 1 0 0",
    ),
    "unknown master": (
        links("a", "b") + "\n" + joint("j", "a", "b", "continuous", '<axis xyz="0 0 1"/><mimic joint="q"/>'),
        "J416",
        "it moves by itself",
    ),
    "no number": (
        links("a", "b") + "\n" + joint("j", "a", "b", inside='<origin xyz="0 0 one"/>'),
        "E010",
        "the value is ignored",
    ),
    "not finite": (
        links("a", "b") + "\n" + joint("j", "a", "b", inside='<origin xyz="0 0 inf"/>'),
        "E012",
        "the value is ignored",
    ),
    "no parent": (
        links("a", "b", "c") + joint("k", "a", "c") + "\n" + joint("j", "a", "b").replace('<parent link="a"/>', ""),
        "E014",
        "the joint is ignored",
    ),
    "no name": (links("a", "b") + joint("j", "a", "b") + "\n<link/>", "E014", "it is called `unnamed_link`"),
}


@pytest.mark.parametrize("case", CASES)
def test_the_rest_is_one_tree_and_the_fault_is_named_at_the_line_of_the_finding(case: str, tmp_path: Path) -> None:
    inside, code, effect = CASES[case]
    path = tmp_path / "r.urdf"
    path.write_text(f'<robot name="r">{inside}</robot>\n')
    robot = load_repaired(path)
    repair = next(repair for repair in robot.repairs if effect in repair.message)
    assert (repair.code, repair.position.line) == (code, 2)
    assert any(f.code == code and f.line == 2 for f in lint(path))
    findings = {(f.code, f.line) for f in lint(path)}
    assert all((r.code, r.position.line) in findings for r in robot.repairs)
    names = [link.name for link in robot.links]
    assert len(robot.roots()) == 1
    assert len(set(names)) == len(names)
    assert len({joint.name for joint in robot.joints}) == len(robot.joints) == len(names) - 1
    assert {"a"} <= set(names)
    with pytest.raises(ModelError) as caught:
        load(path)
    assert caught.value.position is not None
    assert caught.value.position.line in [repair.position.line for repair in robot.repairs if repair.position]


def test_one_fault_is_one_repair(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(f'<robot name="r">{links("a", "b", "c")}{joint("j", "aa", "b")}{joint("k", "a", "c")}</robot>')
    robot = load_repaired(path)
    assert [repair.code for repair in robot.repairs] == ["T201"]
    assert robot.roots()[0].name == "a"
    assert {(j.parent, j.child) for j in robot.joints} == {("aa", "b"), ("a", "c"), ("a", "aa")}


def test_a_valid_robot_stays_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(f'<robot name="r">{links("a", "b")}{joint("j", "a", "b", "revolute", LIMIT)}</robot>')
    robot = load_repaired(path)
    assert robot.repairs == ()
    assert [joint.name for joint in robot.joints] == ["j"]


@pytest.mark.parametrize(
    "text", ['<robot name="r"/>', "<sdf/>", '<robot name="r"><joint name="j" type="fixed"/></robot>']
)
def test_a_file_without_a_robot_is_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(text)
    with pytest.raises(ModelError):
        load_repaired(path)


@pytest.mark.parametrize(
    ("inside", "code", "effect", "roll"),
    [
        (
            '<origin rpy="0 0 1" quat_xyzw="1 0 0 1"/><limit lower="-1" upper="1"/>',
            "E023",
            "`quat_xyzw` is used",
            90,
        ),
        ('<limit upper="1"/>', "E014", "it is 0", 0),
    ],
)
def test_defects_of_urdf_1_2_are_repaired(tmp_path: Path, inside: str, code: str, effect: str, roll: int) -> None:
    path = tmp_path / "robot.urdf"
    parts = links("a", "b") + joint("j", "a", "b", "revolute", inside)
    path.write_text(f'<robot name="r" version="1.2">{parts}</robot>')
    robot = load_repaired(path)
    (repair,) = robot.repairs
    assert (repair.code, repair.joint) == (code, "j")
    assert repair.message.endswith(effect)
    assert robot.joints[0].origin.rpy == pytest.approx((radians(roll), 0.0, 0.0))
    assert code in {finding.code for finding in lint(path)}
    with pytest.raises(ModelError):
        load(path)
