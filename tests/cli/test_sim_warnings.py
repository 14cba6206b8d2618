"""Warnings with one cause share a line in the terminal; the JSON output keeps each repair."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.cli.sim.warnings import GroupedWarnings, grouped
from urdfkit.description.urdf.repair_record import ALL_PLACES
from urdfkit.notice import Notice
from urdfkit.position import Position

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
MESH = '<geometry><mesh filename="package://missing_meshes/{}.stl"/></geometry>'


@pytest.mark.parametrize("command", ["run", "teleop"])
def test_a_missing_package_is_one_warning(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    links = "".join(
        f'<link name="l{n}">{INERTIAL}\n<visual>{MESH.format(n)}</visual>\n<collision>{MESH.format(n)}</collision>\n'
        f'</link><joint name="j{n}" type="fixed"><parent link="base"/><child link="l{n}"/></joint>\n'
        for n in range(6)
    )
    path = tmp_path / "r.urdf"
    path.write_text(f'<robot name="r">\n<link name="base">{INERTIAL}</link>\n{links}</robot>')
    monkeypatch.setattr("urdfkit.app.simulation.loop.DriveLoop.run", lambda loop: None)
    options = ["--for", "0.001"] if command == "run" else ["--no-browser"]
    assert main(["sim", command, str(path), *options]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if "missing_meshes" in line]
    assert len(lines) == 1
    assert "(1 more with this cause: " in lines[0]
    assert "r.urdf:4:" in lines[0]


def test_warnings_of_one_cause_share_a_line() -> None:
    places = [Position("r.urdf", n, 1) for n in range(1, 8)]
    alike = [Notice(f"{at}: mesh part{at.line}.dae is broken", position=at, cause="mesh") for at in places]
    few = [Notice(f"unknown plugin `{name}`", cause="plugin") for name in "ab"]
    gone = [Notice(f"{name}: no package `p`", cause=name, package="p") for name in "cd"]
    plain = [Notice("no plugin"), Notice("slip of 1e-5", "note"), Notice("slip of 2e-5")]
    assert grouped([few[0], *alike, few[1], *gone, *plain]) == [
        *few,
        f"{alike[0]} (6 more with this cause: r.urdf:2:1, r.urdf:3:1, r.urdf:4:1, …; {ALL_PLACES})",
        f"{gone[0]} (1 more with this cause; {ALL_PLACES})",
        *plain,
    ]


@pytest.mark.parametrize(
    ("notice", "line"),
    [
        ("plain", "urdfkit: warning: plain"),
        (Notice("a hint", "note"), "urdfkit: note: a hint"),
        (Notice("compiling …", "progress"), "compiling …"),
    ],
)
def test_a_line_begins_with_its_severity(notice: str, line: str, capsys: pytest.CaptureFixture[str]) -> None:
    for quiet in (False, True):
        with GroupedWarnings(quiet=quiet) as warnings:
            warnings(notice)
    assert capsys.readouterr().err.splitlines() == [line] * (1 if isinstance(notice, Notice) else 2)


@pytest.mark.parametrize("quiet", [False, True])
def test_a_part_that_is_not_simulated_names_the_target_of_lint(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], quiet: bool
) -> None:
    path = tmp_path / "r.urdf"
    plugin = '<gazebo><plugin name="p" filename="libown.so"/></gazebo>'
    path.write_text(f'<robot name="r"><link name="base">{INERTIAL}</link>{plugin}</robot>')
    assert main(["sim", "run", str(path), "--for", "0.001", *["-q"] * quiet]) == 0
    err = capsys.readouterr().err
    assert "libown.so" in err
    assert ("`urdfkit lint --target urdfkit` reports" in err) is not quiet
    assert main(["lint", str(path), "--target", "urdfkit"]) == 1
    assert "libown.so" in capsys.readouterr().out


def test_fewer_warnings_are_separate_lines() -> None:
    texts = [Notice(f"unknown plugin `p{n}`", cause="plugin") for n in range(3)]
    assert grouped(texts) == texts
