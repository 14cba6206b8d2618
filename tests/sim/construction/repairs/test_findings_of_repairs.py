"""Every repair has a finding of its code at its element, for each kind of defect."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from urdfkit import Simulator
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.description import load
from urdfkit.description.model_argument import model_argument
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.xml.source import Source
from urdfkit.description.xml.start_tag import start_tag
from urdfkit.errors import ModelError
from urdfkit.lint import Finding, lint
from urdfkit.sim.construction.repairs.collector import Repairs
from urdfkit.sim.construction.repairs.robot_repairs import repaired

BOX = '<collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>'
INERTIAL = '<inertial><mass value="{}"/><inertia ixx="{}" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>'
GOOD = INERTIAL.format(1, 0.01)

STRUCTURES = {
    "two roots": '<robot name="r"><link name="a"/><link name="b"/></robot>',
    "unknown parent": (
        '<robot name="r"><link name="a"/>'
        '<joint name="j" type="fixed"><parent link="x"/><child link="a"/></joint></robot>'
    ),
    "unknown child": (
        '<robot name="r"><link name="a"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="x"/></joint></robot>'
    ),
    "two links": '<robot name="r"><link name="a"/><link name="a"/></robot>',
    "type and axis": (
        '<robot name="r"><link name="a"/><link name="b"/><link name="c"/>'
        '<joint name="j" type="ball"><parent link="a"/><child link="b"/></joint>'
        '<joint name="k" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 0 0"/></joint></robot>'
    ),
    "numbers": (
        '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent link="a"/>'
        '<child link="b"/><origin xyz="0 0 1 2" rpy="0 0 x"/><axis xyz="0 0 1"/>'
        '<limit lower="1" upper="-1" effort="-5" velocity="nan"/><mimic joint="k"/></joint></robot>'
    ),
}
"""Robots with one defect of their structure or values."""

BASES = {"heavy": GOOD, "free": "", "world": None}

LINKS = {
    "no inertial": (BOX, "I511"),
    "no inertial and no shape": ("", "I511"),
    "no tensor": (BOX + '<inertial><mass value="1"/></inertial>', "E014"),
    "no mass": (BOX + INERTIAL.format(0, 0.01), "I501"),
    "zero tensor": (BOX + INERTIAL.format(1, 0).replace("0.01", "0"), "I504"),
    "impossible tensor": (BOX + INERTIAL.format(1, 0.05), "I503"),
    "mass on a line": (BOX + INERTIAL.format(1, 0.01).replace('iyy="0.01"', 'iyy="0"'), "I502"),
    "note": (BOX + INERTIAL.format(1, 0.020001), "I503"),
    "moment of zero": (BOX + INERTIAL.format(1, 0).replace('izz="0.01"', 'izz="0.05"'), "I502"),
    "negative moment": (BOX + INERTIAL.format(1, -0.01), "I502"),
    "negative moment without mass": (INERTIAL.format(0, -0.01), "I502"),
    "empty shape": (GOOD + BOX.replace("0.2", "0"), "G611"),
    "missing mesh": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="no.stl"'), "G601"),
    "missing package": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="package://no/no.stl"'), "G602"),
    "missing mesh with an absolute path": (
        GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="/no/folder/no.stl"'),
        "G603",
    ),
    "missing mesh of a file URI": (
        GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="file:///no/folder/no.stl"'),
        "G603",
    ),
    "mesh of another machine": (
        GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="http://a.b/c.stl"'),
        "G601",
    ),
    "expression": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="$(find a)/c.stl"'), "G601"),
    "unknown shape": (GOOD + "<collision><geometry><ball/></geometry></collision>", "E008"),
    "shape of another program": (GOOD + "<collision><geometry><drake:ball/></geometry></collision>", "E008"),
    "no shape": (GOOD + "<collision><geometry/></collision>", "E014"),
    "no geometry": (GOOD + "<visual/>", "E014"),
    "mesh without a vertex": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="index.obj"'), "G607"),
    "mesh that is not finite": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="nan.obj"'), "G607"),
    "COLLADA mesh that is not finite": (
        GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="nan.dae"'),
        "G607",
    ),
    "mesh without size": (
        GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="flat.obj" scale="0 0 0"'),
        "G611",
    ),
    "flat collision mesh": (
        GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="flat.obj" scale="1 0 1"'),
        "G611",
    ),
    "visual mesh without size": (
        GOOD + '<visual><geometry><mesh filename="flat.obj" scale="0 0 0"/></geometry></visual>',
        "G611",
    ),
    "negative visual": (GOOD + '<visual><geometry><sphere radius="-1"/></geometry></visual>', "G611"),
    "truncated mesh": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="short.glb"'), "G607"),
    "folder as mesh": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="folder.stl"'), "G607"),
    "empty cylinder": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'cylinder radius="0.1" length="0"'), "G611"),
    "pointer": (GOOD + BOX.replace('box size="0.1 0.2 0.3"', 'mesh\n filename="pointer.stl"'), "G607"),
}


def robot_of(folder: Path, inside: str, base: str = "heavy") -> str:
    """Return a robot whose link `arm` has a content; create the mesh files that it names."""
    (folder / "pointer.stl").write_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n")
    (folder / "index.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
    (folder / "nan.obj").write_text("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "nan.dae").write_text(
        '<COLLADA><library_geometries><geometry><mesh><source id="p"><float_array count="9">0 0 0 1 NaN 0 0 1 0'
        '</float_array></source><vertices id="v"><input source="#p" semantic="POSITION"/></vertices></mesh></geometry>'
        "</library_geometries></COLLADA>"
    )
    (folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "short.glb").write_bytes(b"glTF\x02\0\0\0\x99\0\0\0")
    (folder / "folder.stl").mkdir()
    root = f'<link name="base">{BASES[base]}</link>' if BASES[base] is not None else '<link name="world"/>'
    name = "world" if BASES[base] is None else "base"
    return (
        f'<robot name="r">\n{root}\n<link name="heavy">{GOOD}</link>\n<link name="arm">\n{inside}\n</link>\n'
        f'<joint name="k" type="continuous"><parent link="{name}"/><child link="heavy"/><axis xyz="0 1 0"/></joint>\n'
        '<joint name="j" type="continuous"><parent link="heavy"/><child link="arm"/><axis xyz="0 1 0"/></joint></robot>'
    )


def repairs_of(path: Path, *, floating: bool = True) -> list[Repair]:
    found = Repairs(lambda _: None)
    repaired(load(path), None, found, floating=floating)
    return found.found


def reports(finding: Finding, repair: Repair) -> bool:
    """Return whether a finding has the code of a repair, and marks its element or one of its attributes."""
    assert repair.position is not None
    tag = start_tag(Source(repair.position.file, Path(repair.position.file).read_text()), repair.position)
    if tag is None:  # the position of an attribute
        return finding.code == repair.code and finding.span.start == repair.position
    same = Path(finding.span.file).resolve() == Path(repair.position.file).resolve()
    return same and finding.code == repair.code and tag.span.line <= finding.span.line <= tag.span.end_line


def reported_lines(path: Path) -> set[tuple[str, int]]:
    """Return code and line of each finding, and of the other places that it lists."""
    found = lint(path)
    return {(one.code, place.line) for one in found for place in (one.span, *(each.span for each in one.related))}


@pytest.mark.parametrize("kind", [*LINKS, *STRUCTURES])
def test_repairs_have_the_line_of_their_finding_with_one_attribute_per_line(tmp_path: Path, kind: str) -> None:
    text = robot_of(tmp_path, LINKS[kind][0]) if kind in LINKS else STRUCTURES[kind]
    path = tmp_path / "r.urdf"
    path.write_text(re.sub(r' (?=[\w:]+=")', "\n    ", text))
    simulator = Simulator(path, note=lambda _: None)
    assert simulator.repairs
    shown = ShownRobot.read(model_argument(path))
    lines = reported_lines(path)
    for repair in {*simulator.repairs, *shown.repairs}:
        assert repair.position is not None
        if repair.code != "I511" or kind in LINKS:  # A link of a joint that is not in the tree has no finding of mass.
            assert (repair.code, repair.position.line) in lines, repair


@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("link", LINKS)
def test_every_repair_has_a_finding_of_its_code_at_its_element(tmp_path: Path, base: str, link: str) -> None:
    inside, code = LINKS[link]
    path = tmp_path / "r.urdf"
    path.write_text(robot_of(tmp_path, inside, base))
    repairs = repairs_of(path, floating=base != "world")
    assert code in {repair.code for repair in repairs}
    findings = lint(path)
    for repair in repairs:
        assert any(reports(finding, repair) for finding in findings), (str(repair), [str(each) for each in findings])


def test_an_absolute_path_of_an_expression_is_a_missing_mesh(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf.xacro"
    mesh = BOX.replace('box size="0.1 0.2 0.3"', 'mesh filename="${folder}/no.stl"')
    path.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'<xacro:property name="folder" value="/no/folder"/>\n<link name="base">{GOOD}\n{mesh}</link></robot>'
    )
    (repair,) = repairs_of(path)
    assert repair.code == "G601"
    assert any(reports(finding, repair) for finding in lint(path))


@pytest.mark.parametrize("slip", [1e-5, 9e-5, 1.1e-4, 9e-4, 1e-2])
def test_a_small_slip_of_an_inertia_is_a_note_in_both(tmp_path: Path, slip: float) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r">\n<link name="base">{BOX}{INERTIAL.format(1, 0.02 / (1.0 - slip))}</link></robot>'
    )
    (repair,) = repairs_of(path)
    (finding,) = [each for each in lint(path) if each.code == repair.code == "I503"]
    assert (repair.severity == "note") == (finding.severity == "note") == (slip < 1e-4)


@pytest.mark.parametrize("tensor", ["0.05", "-0.01"])
@pytest.mark.parametrize("mass", [0.04, 0.06])
def test_the_inertia_of_a_link_on_a_heavier_body_is_a_note_in_both(tmp_path: Path, mass: float, tensor: str) -> None:
    small = INERTIAL.format(mass, tensor).replace("0.01", "0.001").replace("0.05", "0.005")
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r">\n<link name="base">{INERTIAL.format(1, 0.11).replace("0.01", "0.11")}</link>\n'
        f'<link name="a">{small}</link>\n'
        '<joint name="j" type="fixed"><parent link="base"/><child link="a"/></joint></robot>'
    )
    (repair,) = repairs_of(path)
    assert repair.link == "a"
    severities = {finding.severity for finding in lint(path) if reports(finding, repair)}
    assert severities == {repair.severity} == {"note" if mass == 0.04 else "warning"}


def test_a_robot_without_any_mass_is_one_repair_and_one_finding(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r">\n<link name="base">{BOX}</link>\n<link name="a">{BOX}</link>\n<link name="b">{BOX}</link>\n'
        '<joint name="j" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/></joint>\n'
        '<joint name="k" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
    )
    for floating in (True, False):
        (repair,) = repairs_of(path, floating=floating)
        assert (repair.link, repair.joint) == ("a", "j")
        assert ("`base` 6 kg, `a` 6 kg, `b` 6 kg" in repair.message) == floating
        assert [finding.severity for finding in lint(path) if reports(finding, repair)] == ["note"]
        assert [finding.severity for finding in lint(path, target="gz") if reports(finding, repair)] == ["error"]


def test_a_robot_without_masses_and_shapes_has_a_finding_for_simulators_only(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        '<robot name="r">\n<link name="world"/>\n<link name="a"/>\n<link name="b"/>\n'
        '<joint name="j" type="continuous"><parent link="world"/><child link="a"/><axis xyz="0 1 0"/></joint>\n'
        '<joint name="k" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint></robot>'
    )
    (repair,) = repairs_of(path, floating=False)
    assert any(reports(finding, repair) for finding in lint(path, target="gz"))
    assert "I511" not in {finding.code for finding in lint(path)}


JOINTS = {
    "reversed limits": ('<limit lower="1" upper="-2" effort="5" velocity="6"/>', "J405", (-2.0, 1.0, 5.0, 6.0), 0.0),
    "effort": ('<limit lower="-1" upper="1" effort="-1" velocity="6"/>', "J410", (-1.0, 1.0, None, 6.0), 0.0),
    "velocity": ('<limit lower="-1" upper="1" effort="5" velocity="-6"/>', "J410", (-1.0, 1.0, 5.0, None), 0.0),
    "damping": (
        '<limit lower="-1" upper="1" effort="5" velocity="6"/>\n<dynamics damping="-1" friction="2"/>',
        "J419",
        (-1.0, 1.0, 5.0, 6.0),
        2.0,
    ),
}


@pytest.mark.parametrize("case", JOINTS)
def test_impossible_values_of_joints_are_repaired_and_reported(tmp_path: Path, case: str) -> None:
    text, code, limits, friction = JOINTS[case]
    text = text.replace(" ", "\n")
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r"><link name="world"/><link name="arm">{GOOD}</link>\n<joint name="j" type="revolute">\n'
        f'<parent link="world"/><child link="arm"/><axis xyz="0 1 0"/>\n{text}\n</joint></robot>'
    )
    found = Repairs(lambda _: None)
    robot, _ = repaired(load(path), None, found, floating=False)
    (repair,) = found.found
    assert (repair.kind, repair.code, repair.joint) == ("joint", code, "j")
    assert any(reports(finding, repair) for finding in lint(path))
    limit, dynamics = robot.joint_by_name["j"].limit, robot.joint_by_name["j"].dynamics
    assert limit is not None
    assert (limit.lower, limit.upper, limit.effort, limit.velocity) == limits
    assert dynamics is None or (dynamics.damping, dynamics.friction) == (0.0, friction)
    Simulator(path, note=lambda _: None).run(0.01)
    with pytest.raises(ModelError, match=r"r\.urdf:"):
        Simulator(path, strict=True)


@pytest.mark.parametrize("type", ["cycle", "floating"])
def test_an_impossible_mimic_is_repaired_and_reported(tmp_path: Path, type: str) -> None:
    first = "floating" if type == "floating" else "continuous"
    mimic = '<mimic joint="j"/>' if type == "cycle" else ""
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r"><link name="world"/><link name="a">{GOOD}</link><link name="b">{GOOD}</link>\n'
        f'<joint name="i" type="{first}"><parent link="world"/><child link="a"/><axis xyz="0 1 0"/>\n{mimic}</joint>\n'
        '<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>\n<mimic joint="i"/>'
        "</joint></robot>"
    )
    repairs = repairs_of(path, floating=False)
    assert {repair.code for repair in repairs} == {"J416"}
    findings = lint(path)
    for repair in repairs:
        assert any(reports(finding, repair) for finding in findings), str(repair)


def test_a_repeated_joint_that_is_left_out_has_the_finding_of_repeated_names(tmp_path: Path) -> None:
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>\n'
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r"><link name="a">{GOOD}</link>\n<link name="b">{GOOD}</link>\n{joint}{joint}</robot>'
    )
    repairs = Simulator(path, note=lambda _: None).repairs
    assert {repair.code for repair in repairs} == {"T207"}
    findings = lint(path)
    for repair in repairs:
        assert any(reports(finding, repair) for finding in findings), str(repair)


def test_an_unknown_mimic_joint_is_not_suggested_to_be_the_joint_itself(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r"><link name="world"/><link name="a">{GOOD}</link>\n'
        '<joint name="j" type="continuous"><parent link="world"/><child link="a"/><axis xyz="0 1 0"/>'
        '<mimic joint="jj"/></joint></robot>'
    )
    (repair,) = Simulator(path, note=lambda _: None).repairs
    assert repair.code == "J416"
    assert "mimics the unknown joint `jj`" in repair.message
    assert "did you mean" not in repair.message


def test_links_that_are_fixed_to_each_other_are_one_repair(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r">\n<link name="base">{GOOD}</link>\n<link name="a"/>\n<link name="b">{BOX}</link>\n'
        f'<link name="c">{BOX}</link>\n'
        '<joint name="i" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/></joint>\n'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>\n'
        '<joint name="k" type="fixed"><parent link="a"/><child link="c"/></joint></robot>'
    )
    (repair,) = repairs_of(path)
    assert repair.link == "b"
    assert "simulated with 12 kg in 2 links that are fixed to each other" in repair.message
    assert any(reports(finding, repair) for finding in lint(path))


def test_a_missing_package_is_one_repair_at_its_first_mesh(tmp_path: Path) -> None:
    mesh = '<geometry><mesh filename="package://no/{}.stl"/></geometry>'
    links = "".join(
        f'<link name="l{n}">{GOOD}\n<visual>{mesh.format(n)}</visual>\n<collision>{mesh.format(n)}</collision></link>'
        f'<joint name="j{n}" type="fixed"><parent link="base"/><child link="l{n}"/></joint>\n'
        for n in range(8)
    )
    path = tmp_path / "r.urdf"
    path.write_text(f'<robot name="r">\n<link name="base">{GOOD}</link>\n{links}</robot>')
    (repair,) = repairs_of(path)
    assert repair.position is not None
    assert repair.position.line == 4
    assert "the collision meshes of `l0`, `l1`, `l2`, `l3`, `l4`, `l5` and 2 others" in repair.message
    assert any(reports(finding, repair) for finding in lint(path))
