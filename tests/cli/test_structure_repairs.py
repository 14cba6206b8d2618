"""A robot that is not one valid tree: tf, info, view and sim repair it with the same warnings; --strict refuses it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")

from urdfkit.cli import main
from urdfkit.lint import lint

BODY = (
    '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    '<collision><geometry><box size="0.4 0.3 0.1"/></geometry></collision>'
)
AXIS = '<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>'
ROBOT = f"""<robot name="bad">
  <link name="base">{BODY}</link>
  <link name="arm">{BODY}</link>
  <joint name="turn" type="revolute"><parent link="bse"/><child link="arm"/><origin xyz="0 0 0.5"/>{AXIS}</joint>
  <link name="stray"/>
  <link name="hand">{BODY}</link>
  <joint name="wrist" type="revolute"><parent link="arm"/><child link="hand"/>{AXIS}
    <mimic joint="wrist"/></joint>
</robot>
"""
WARNINGS = [
    (
        "T201",
        4,
        "its parent link `bse` does not exist; an empty link `bse` is added, fixed to the origin of `base`",
    ),
    ("T203", 5, "is missing; `stray` is fixed to the origin of `base`"),
    ("J416", 8, "mimic joints form a cycle: `wrist` → `wrist`; joint `wrist` moves by itself"),
]


@pytest.fixture(autouse=True)
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = Path("bad.urdf")
    path.write_text(ROBOT)
    return path


COMMANDS = {
    "tf": ["tf", "bad.urdf", "--tree", "--json"],
    "transform": ["tf", "bad.urdf", "base", "hand", "--json"],
    "info": ["info", "bad.urdf", "--json"],
    "sim": ["sim", "run", "bad.urdf", "--for", "0.01", "--world", "void", "--json"],
}


def test_the_commands_print_the_same_warnings(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["view", "bad.urdf", "--html", "page.html"]) == 0
    expected = [line for line in capsys.readouterr().err.splitlines() if line.startswith("urdfkit: warning: ")]
    assert len(expected) == 3
    for name, words in COMMANDS.items():
        assert main(words) == 0
        out, err = capsys.readouterr()
        assert [line for line in err.splitlines() if line.startswith("urdfkit: ")] == expected, name
        repairs = json.loads(out)["repairs"]
        assert [f"urdfkit: warning: bad.urdf:{r['line']}:{r['column']}: {r['message']}" for r in repairs] == expected


def test_the_linter_reports_each_repair_at_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(COMMANDS["info"]) == 0
    repairs = [(r["code"], r["line"], r["message"]) for r in json.loads(capsys.readouterr().out)["repairs"]]
    findings = {(finding.code, finding.line) for finding in lint("bad.urdf")}
    for (code, line, message), (its_code, its_line, its_message) in zip(WARNINGS, repairs, strict=True):
        assert (code, line) == (its_code, its_line)
        assert message in its_message
        assert (code, line) in findings


@pytest.mark.parametrize("command", COMMANDS)
def test_strict_refuses_the_robot(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*COMMANDS[command], "--strict"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.splitlines()[-1] == (
        "urdfkit: bad.urdf:4:38: joint `turn`: its parent link `bse` does not exist; did you mean `base`?"
    )


@pytest.mark.parametrize("command", ["tf", "sim"])
def test_quiet_prints_warnings_and_no_notes(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    main(COMMANDS[command])
    lines = capsys.readouterr().err.splitlines()
    assert main([*COMMANDS[command], "-q"]) == 0
    warnings = capsys.readouterr().err.splitlines()
    assert warnings == [line for line in lines if line.startswith("urdfkit: warning: ")]
    assert any("its parent link `bse` does not exist" in line for line in warnings)


def test_many_undefined_parents_are_one_warning_in_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    joint = '<joint name="j{0}" type="fixed"><parent link="gone{0}"/><child link="l{0}"/></joint>\n'
    parts = "".join(f'<link name="l{i}"/>\n{joint.format(i)}' for i in range(30))
    Path("bad.urdf").write_text(f'<robot name="bad"><link name="base">{BODY}</link>\n{parts}</robot>')
    expected = (
        "`j0`: its parent link `gone0` does not exist; an empty link `gone0` is added, fixed to the origin of `base` "
        "(and 29 more of this kind; `urdfkit lint --target urdfkit` lists them)"
    )
    for words in (*COMMANDS.values(), ["view", "bad.urdf", "--html", "page.html"]):
        if "hand" in words:
            continue
        assert main(words) == 0
        out, err = capsys.readouterr()
        (warning,) = [line for line in err.splitlines() if line.startswith("urdfkit: warning")]
        assert expected in warning
        assert "--json" not in words or len(json.loads(out)["repairs"]) == 30
