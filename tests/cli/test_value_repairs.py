"""Values that a robot cannot have: every command repairs them with the same warning, where the linter reports them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

import urdfkit
from urdfkit.cli import main
from urdfkit.lint import lint

BODY = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
ROBOT = """<robot name="r"
  {version}>
  <link name="base">{body}</link>
  <link name="arm">{body}{shape}</link>
  <joint name="j" type="revolute">
    <parent link="base"/><child link="arm"/>
    <origin xyz="1 0 0"
      {turn}/>
    <axis xyz="0 1 0"/>
    <limit lower="-1" {limit}/>
  </joint>
</robot>
"""
LIMIT = 'upper="1" effort="1" velocity="1"'
CAPSULE = (
    '\n<visual><geometry><capsule\n radius="0.1" length="0.4"/></geometry></visual>'
    '\n<collision><geometry><capsule radius="0.1" length="0.4"/></geometry></collision>'
)
TURN = 'quat_xyzw="0 0 0.6 0.8"'
CASES = {
    "zero": (
        ('version="1.2"', "", 'quat_xyzw="0 0 0 0"', LIMIT),
        "E024",
        8,
        "is not a rotation; it is read as",
    ),
    "quaternion": (("", "", TURN, LIMIT), "E021", 8, "`quat_xyzw` needs URDF 1.1, but the robot is URDF 1.0; it is"),
    "1.0": (('version="1.0"', "", TURN, LIMIT), "E021", 8, "needs URDF 1.1"),
    "capsule": (("", CAPSULE, "", LIMIT), "E021", 5, "<capsule> needs URDF 1.1"),
    "1.3": (('version="1.3"', "", TURN, LIMIT), "E020", 2, "unknown version `1.3` of URDF; it is read as version 1.2"),
    "limits": (("", "", "", '\nupper="-2" effort="1" velocity="1"'), "J405", 10, "the two limits are swapped"),
    "effort": (("", "", "", 'upper="1"\neffort="-1" velocity="1"'), "J410", 11, "effort limit -1 N·m"),
    "velocity": (("", "", "", 'upper="1"\neffort="1"\nvelocity="-2"'), "J410", 12, "velocity limit -2 rad/s"),
    "jerk": (('version="1.2"', "", "", f'{LIMIT}\njerk="-1"'), "J410", 11, "jerk limit -1 rad/s³"),
}
COMMANDS = {
    "tf": ["tf", "r.urdf", "base", "arm", "--json"],
    "info": ["info", "r.urdf", "--json"],
    "view": ["view", "r.urdf", "--html", "page.html"],
    "sim": ["sim", "run", "r.urdf", "--for", "0.01", "--world", "void", "--json"],
}


@pytest.fixture(autouse=True)
def working_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def _write(case: str) -> None:
    version, shape, turn, limit = CASES[case][0]
    Path("r.urdf").write_text(ROBOT.format(version=version, body=BODY, shape=shape, turn=turn, limit=limit))


@pytest.mark.parametrize("case", CASES)
def test_every_command_warns_where_the_linter_reports(case: str, capsys: pytest.CaptureFixture[str]) -> None:
    _write(case)
    _, code, line, words = CASES[case]
    findings = {(one.code, one.line, one.column) for one in lint("r.urdf") if one.severity != "note"}
    warnings = []
    for name in COMMANDS:
        assert main(COMMANDS[name]) == 0
        out, err = capsys.readouterr()
        warnings.append([text for text in err.splitlines() if text.startswith("urdfkit: ")])
        if name != "view":
            (repair,) = json.loads(out)["repairs"]
            assert (repair["code"], repair["line"], repair["severity"]) == (code, line, "warning")
            assert (code, line, repair["column"]) in findings
    assert warnings == [warnings[0]] * len(COMMANDS)
    (warning,) = warnings[0]
    assert warning.startswith(f"urdfkit: warning: r.urdf:{line}:")
    assert words in warning


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("case", ["zero", "quaternion", "capsule", "1.3", "limits", "effort"])
def test_strict_refuses(case: str, command: str, capsys: pytest.CaptureFixture[str]) -> None:
    _write(case)
    assert main([*COMMANDS[command], "--strict"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"urdfkit: r.urdf:{CASES[case][2]}:")
    assert not any(words in err for words in ("it is", "exchanged"))


def test_a_limit_of_minus_one_at_every_joint_is_a_note(capsys: pytest.CaptureFixture[str]) -> None:
    joint = (
        '<joint name="{0}" type="continuous"><parent link="{1}"/><child link="{0}"/><axis xyz="0 1 0"/>\n'
        '<limit effort="-1" velocity="1"/></joint>'
    )
    links = "".join(f'<link name="{name}">{BODY}</link>' for name in "abc")
    Path("r.urdf").write_text(f'<robot name="r">{links}{joint.format("b", "a")}{joint.format("c", "b")}</robot>')
    assert [one.severity for one in lint("r.urdf") if one.code == "J410"] == ["note", "note"]
    assert main(["tf", "r.urdf"]) == 0
    assert [line.split(": ")[1] for line in capsys.readouterr().err.splitlines()] == ["note"]
    assert main(["tf", "r.urdf", "--strict"]) == 0
    for options in ([], ["--strict"]):
        assert main(["sim", "run", "r.urdf", "--for", "0.001", *options]) == 0
        assert [line.split(": ")[1] for line in capsys.readouterr().err.splitlines()] == ["note"]


def test_load_accepts_what_every_reader_reads() -> None:
    _write("quaternion")
    robot = urdfkit.load("r.urdf")
    assert (robot.joints[0].origin.rpy, robot.repairs) == ((0.0, 0.0, 0.0), ())


def test_an_empty_file_name_of_a_mesh_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    mesh = '<geometry>\n<mesh filename=" "/></geometry>'
    shapes = f"<visual>{mesh}</visual><collision>{mesh}</collision>"
    Path("r.urdf").write_text(f'<robot name="r"><link name="base">{BODY}{shapes}</link></robot>')
    words = "the file name of <mesh> is empty"
    findings = lint("r.urdf")
    assert [(one.code, one.line, one.message) for one in findings if one.code[0] in "EG"] == [
        ("E014", 2, f"link `base`: {words}"),
        ("E014", 3, f"link `base`: {words}"),
    ]
    assert main(["view", "r.urdf", "--html", "page.html"]) == 0
    warnings = [line for line in capsys.readouterr().err.splitlines() if "warning" in line]
    assert warnings == [f"urdfkit: warning: r.urdf:2:1: {words}; a placeholder is shown"]
    assert main(["view", "r.urdf", "--html", "page.html", "--strict"]) == 2
    assert words in capsys.readouterr().err
    assert main(COMMANDS["sim"]) == 0
    assert words in capsys.readouterr().err
