"""Findings with one cause are shown as one, with every place."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import find_entries
from urdfkit.lint.project.options import Options
from urdfkit.lint.report.groups import SMALLEST, SMALLEST_ALIKE, grouped

LINK = '<link name="l{n}"><visual><geometry><mesh filename="{mesh}"/></geometry></visual>{more}</link>'
JOINT = '<joint name="j{n}" type="fixed"><parent link="l0"/><child link="l{n}"/></joint>'

UNIT = '<inertial><mass value="1" unit="kg"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'


def robot(path: Path, meshes: list[str], more: str = "") -> Path:
    links = [LINK.format(n=n, mesh=mesh, more=more) for n, mesh in enumerate(meshes)]
    joints = [JOINT.format(n=n) for n in range(1, len(meshes))]
    path.write_text("\n".join(['<robot name="r">', *links, *joints, "</robot>"]))
    return path


def lint_json(path: Path, *options: str) -> list[dict]:
    command = [sys.executable, "-m", "urdfkit", "lint", "--no-cache", "--format", "json", str(path), *options]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=False).stdout)


@pytest.mark.parametrize("count", [SMALLEST - 1, SMALLEST, 40])
def test_missing_files_of_one_folder_are_one_finding_from_four_on(count: int, tmp_path: Path) -> None:
    path = robot(tmp_path / "r.urdf", [f"meshes/part_{n}.stl" for n in range(count)])
    found = lint_json(path, "--select", "G601")
    if count < SMALLEST:
        assert [(one["line"], one["related"]) for one in found] == [(n + 2, []) for n in range(count)]
        return
    assert len(found) == 1
    assert found[0]["message"] == "mesh `meshes/part_0.stl` not found"
    places = [(one["line"], one["link"], one["message"]) for one in found[0]["related"]]
    assert places == [(n + 2, f"l{n}", f"mesh `meshes/part_{n}.stl` not found") for n in range(1, count)]


@pytest.mark.slow
@pytest.mark.parametrize("count", [1, 2, 100])
def test_meshes_of_one_missing_package_are_one_finding_with_every_place(count: int, tmp_path: Path) -> None:
    meshes = [f"package://{package}/part_{n}.stl" for package in ("nowhere", "gone") for n in range(count)]
    path = robot(tmp_path / "r.urdf", meshes)
    found = lint_json(path, "--select", "G602")
    starts = [(2, 2 + count), (2 + count, 2 + 2 * count)]
    assert [(one["line"], *(each["line"] for each in one["related"])) for one in found] == [
        tuple(range(*lines)) for lines in starts
    ]
    command = [sys.executable, "-m", "urdfkit", "lint", "--format", "sarif", "--select", "G602", str(path)]
    log = json.loads(subprocess.run(command, capture_output=True, text=True, check=False).stdout)
    places = [one.get("relatedLocations", []) for one in log["runs"][0]["results"]]
    lines = [[place["physicalLocation"]["region"]["startLine"] for place in each] for each in places]
    assert lines == [list(range(first + 1, last)) for first, last in starts]


def test_errors_with_other_causes_and_other_severities_stay_apart(tmp_path: Path) -> None:
    path = robot(
        tmp_path / "r.urdf", [f"{folder}/{n}.stl" for folder in ("a", "b") for n in range(SMALLEST_ALIKE)], UNIT
    )
    outcome = run(find_entries([path]), Options())
    findings = outcome.findings
    left = SMALLEST_ALIKE - 1
    groups = [one for one in grouped(findings, outcome.sources) if one.code == "G601"]
    assert [(one.link, len(one.related)) for one in groups] == [("l0", left), (f"l{left + 1}", left)]
    notes = [one for one in grouped(findings, outcome.sources) if one.code == "E009"]
    assert [(one.severity, len(one.related)) for one in notes] == [("note", 2 * SMALLEST_ALIKE - 1)]
    assert sum(1 + len(one.related) for one in grouped(findings, outcome.sources)) == len(findings)


def test_text_lists_ten_places_errors_first_and_ends_with_commands(tmp_path: Path) -> None:
    more = '<collision><origin rpy="1.57 0 0"/><geometry><box size="1 1 1" kind="x"/></geometry></collision>'
    path = robot(tmp_path / "r.urdf", [f"meshes/part_{n}.stl" for n in range(30)], more)
    command = [sys.executable, "-m", "urdfkit", "lint", "--no-cache", path.name]
    output = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path).stdout
    assert output.index(" G601 ") < output.index(" note: ")
    assert output.count("not found") == 10
    assert "29 more places:\n    r.urdf:3:" in output
    assert "    and 20 more\n" in output
    *_, last = output.split("Found ")
    assert "in " in last.splitlines()[0]
    assert all("`urdfkit lint r.urdf --" in line for line in last.splitlines()[1:])


INERTIA = '<inertial><mass value="1"/><inertia ixx="{0}" ixy="0" ixz="0" iyy="1.25" iyz="0" izz="{1}"/></inertial>'
IN_COPIES = '<robot name="r"><link name="base{n}">{inertial}</link></robot>'


@pytest.mark.parametrize(("copies", "values", "groups"), [(3, 1, 3), (4, 1, 1), (4, 2, 2), (5, 2, 1)])
def test_errors_in_copies_of_a_robot_are_one_finding_for_each_value(copies, values, groups, tmp_path) -> None:
    for value in range(values):
        inertial = INERTIA.format("2.5", f"{4 + value}.75")
        for n in range(copies):
            (tmp_path / f"hand_{value}_{n}.urdf").write_text(IN_COPIES.format(n=n, inertial=inertial))
    found = lint_json(tmp_path, "--select", "I503")
    assert len(found) == groups
    assert sum(1 + len(one["related"]) for one in found) == copies * values


def test_meshes_of_another_format_are_one_finding(tmp_path: Path) -> None:
    (tmp_path / "meshes").mkdir()
    for n in range(SMALLEST):
        (tmp_path / f"meshes/part_{n}.glb").write_bytes(b"")
    path = robot(tmp_path / "r.urdf", [f"meshes/part_{n}.dae" for n in range(SMALLEST)])
    (found,) = lint_json(path, "--select", "G601")
    assert found["related"][0]["message"].endswith("did you mean `part_1.glb`?")


def test_included_packages_that_do_not_exist_are_one_finding(tmp_path: Path) -> None:
    for n in range(SMALLEST):
        (tmp_path / f"arm_{n}.urdf.xacro").write_text(
            '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
            f'<xacro:include filename="$(find arm_{n}_support)/arm.xacro"/><xacro:arm_{n} prefix=""/>'
            '<link name="a"/></robot>'
        )
    (found,) = lint_json(tmp_path)
    assert (found["code"], len(found["related"])) == ("X113", SMALLEST - 1)


def test_warnings_of_one_kind_are_one_finding_and_others_stay_apart(tmp_path: Path) -> None:
    limits = ['lower="0" upper="0"'] * SMALLEST + [""] * SMALLEST
    joints = [
        f'<joint name="j{n}" type="revolute"><parent link="a"/><child link="l{n}"/><limit {limit} effort="1" '
        f'velocity="1"/></joint><link name="l{n}"/>'
        for n, limit in enumerate(limits)
    ]
    path = tmp_path / "r.urdf"
    path.write_text("\n".join(['<robot name="r"><link name="a"/>', *joints, "</robot>"]))
    found = lint_json(path, "--select", "J406")
    assert [len(one["related"]) for one in found] == [SMALLEST - 1] * 2


def test_findings_in_files_that_were_not_read_stay_apart_by_their_messages(tmp_path: Path) -> None:
    findings = run(find_entries([robot(tmp_path / "r.urdf", ["a.stl"], UNIT * SMALLEST)]), Options()).findings
    assert [len(one.related) for one in grouped(findings, {})] == [0] * len(findings)
