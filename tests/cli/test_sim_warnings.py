"""Warnings with one cause share a line in the terminal; the JSON output keeps each repair."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.cli.sim.warnings import grouped
from urdfkit.description.urdf.repair_record import ALL_PLACES

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


def test_warnings_that_differ_in_names_only_share_a_line() -> None:
    alike = [f"r.urdf:{n}:1: mesh part{n}.dae is a Git LFS pointer; shape `s{n}` is ignored" for n in range(1, 8)]
    others = ["r.urdf:9:1: unknown plugin `a`", "r.urdf:10:1: unknown plugin `b`", "no plugin", "note: slip of 1e-5"]
    found = grouped([others[0], *alike, *others[1:]])
    assert found == [
        *others[:2],
        f"{alike[0]} (6 more with this cause: r.urdf:2:1, r.urdf:3:1, r.urdf:4:1, …; {ALL_PLACES})",
        *others[2:],
    ]


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
    texts = [f"r.urdf:{n}:1: unknown plugin `p{n}`" for n in range(3)]
    assert grouped(texts) == texts
