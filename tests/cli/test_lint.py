"""``urdfkit lint`` and ``urdfkit rule`` as commands."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.cli import main

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
BAD = (
    f'{HEAD}\n<macro name="part" params="n"><link name="${{n}}"/></macro>\n<part n="a"/>\n<link name="b"/>\n</robot>\n'
)


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "p"
    (folder / "urdf").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>p</name></package>")
    (folder / "urdf" / "clean.urdf").write_text('<robot name="c"><link name="a"/></robot>')
    (folder / "urdf" / "bad.urdf.xacro").write_text(BAD)
    monkeypatch.chdir(folder)
    return folder


def test_exit_codes_and_output(package, capsys):
    assert main(["lint", "urdf/clean.urdf"]) == 0
    assert capsys.readouterr().out == "All checks passed.\n"
    assert main(["lint"]) == 1
    out = capsys.readouterr().out
    assert "urdf/bad.urdf.xacro:2:1: X101 [*] directive `<macro>`" in out
    assert out.endswith("Found 3 errors (2 fixable with --fix).\n")
    assert main(["lint", "--ignore", "X,T", "."]) == 0
    assert main(["lint", "--select", "T203", "urdf"]) == 1
    assert capsys.readouterr().out.endswith("Found 1 error.\n")


def test_notes_do_not_make_it_fail(package, capsys):
    tensor = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="2.0001"/>'
    Path("note.urdf").write_text(
        f'<robot name="n"><link name="a"><inertial><mass value="1"/>{tensor}</inertial></link></robot>'
    )
    assert main(["lint", "note.urdf"]) == 0
    assert "I503 note:" in capsys.readouterr().out


def test_json_is_one_value_with_the_agreed_keys(package, capsys):
    assert main(["lint", "urdf", "--format", "json"]) == 1
    findings = json.loads(capsys.readouterr().out)
    assert [finding["code"] for finding in findings] == ["X101", "X102", "T203"]
    keys = "code name severity message file line column end_line end_column link joint expansions fix"
    assert all(set(keys.split()) <= set(finding) for finding in findings)
    assert findings[0]["fix"]["safety"] == "safe"
    edit = {"file": "urdf/bad.urdf.xacro", "line": 2, "column": 2, "end_line": 2, "end_column": 2, "text": "xacro:"}
    assert findings[0]["fix"]["edits"][0] == edit
    assert (findings[2]["link"], findings[2]["fix"], findings[2]["severity"]) == ("b", None, "error")
    assert main(["lint", "urdf/clean.urdf", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out) == []


def test_fix_writes_and_reports_what_is_left(package, capsys):
    assert main(["lint", "--fix"]) == 1
    captured = capsys.readouterr()
    assert captured.err == "Fixed 2 findings in 1 file (1 × X101, 1 × X102).\n"
    assert captured.out.endswith("Found 1 error.\n")
    assert Path("urdf/bad.urdf.xacro").read_text() == BAD.replace("macro name", "xacro:macro name").replace(
        "</macro>", "</xacro:macro>"
    ).replace("<part", "<xacro:part")
    assert main(["lint", "--fix", "--format", "json"]) == 1
    captured = capsys.readouterr()
    assert (captured.err, len(json.loads(captured.out))) == ("", 1)


def test_diff_writes_nothing(package, capsys):
    assert main(["lint", "--diff"]) == 1
    captured = capsys.readouterr()
    assert '+<xacro:part n="a"/>\n' in captured.out
    assert captured.err == "1 finding would remain; nothing was written.\n"
    assert Path("urdf/bad.urdf.xacro").read_text() == BAD
    assert main(["lint", "--diff", "urdf/clean.urdf"]) == 0
    assert capsys.readouterr().out == ""


def test_statistics(package, capsys):
    assert main(["lint", "--statistics"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["1", "T203", "error", "multiple-roots"]
    assert lines[-1].startswith("Found 3 errors")


def test_xacro_arguments(package, capsys):
    Path("arg.xacro").write_text(f'{HEAD}<link name="$(arg prefix)base"/></robot>')
    assert main(["lint", "arg.xacro"]) == 1
    assert main(["lint", "arg.xacro", "prefix:=left_"]) == 0


def test_a_misspelt_xacro_argument_is_named(package, capsys):
    text = (
        '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="prefix" default="x"/>{}</robot>'
    )
    (package / "arg.xacro").write_text(text.format('<link name="$(arg prefix)base"/>'))
    assert main(["lint", "arg.xacro", "prefx:=left_"]) == 0
    warning = "urdfkit: warning: no file uses the argument `prefx`; did you mean `prefix`?"
    assert warning in capsys.readouterr().err.splitlines()
    assert main(["lint", "arg.xacro", "prefix:=left_"]) == 0
    assert "no file uses" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["urdf/claen.urdf"], "did you mean `urdf/clean.urdf`"),
        (["simpelton"], "did you mean `simpleton`"),
        (["/no/where"], "no such file"),
        (["--select", "I53"], "--select I53: unknown rule"),
        (["--target", "gzz"], "did you mean `gz`"),
        (["--unsafe-fixes"], "--unsafe-fixes requires --fix or --diff"),
        ([":=5"], "has no key"),
        (["--format", "jsn"], "did you mean `json`"),
        (["--package-path", "nowhere"], "--package-path: no such folder: nowhere"),
        (["empty"], "no robot description"),
    ],
)
def test_mistakes_are_one_line_and_exit_2(package, capsys, words, complaint):
    Path("empty").mkdir()
    assert main(["lint", *words]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert complaint in captured.err
    assert "Traceback" not in captured.err


def test_hostile_files_are_findings(package, capsys):
    bomb = '<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><robot name="&b;"><link name="a"/></robot>'
    Path("bomb.urdf").write_text(bomb)
    Path("bytes.urdf").write_bytes(bytes(range(256)))
    Path("empty.urdf").write_bytes(b"")
    for name in ("bomb", "bytes", "empty"):
        assert main(["lint", f"{name}.urdf", "--format", "json"]) == 1
        (finding,) = json.loads(capsys.readouterr().out)
        assert (finding["code"], finding["file"]) == ("E001", f"{name}.urdf")


def test_colour_choices(package, capsys, monkeypatch):
    assert main(["lint", "--color", "always"]) == 1
    assert "\x1b[" in capsys.readouterr().out
    assert main(["lint"]) == 1
    assert "\x1b[" not in capsys.readouterr().out
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "60")
    assert main(["lint"]) == 1
    assert "\x1b[" in capsys.readouterr().out
    monkeypatch.setenv("NO_COLOR", "1")
    assert main(["lint"]) == 1
    assert "\x1b[" not in capsys.readouterr().out


@pytest.mark.parametrize("arguments", [["rule", "I503"], ["lint", "--diff"], ["format", "--diff"]], ids=" ".join)
def test_diffs_are_in_color_in_a_terminal(arguments, package, capsys, monkeypatch):
    Path("ugly.urdf").write_text('<robot name="cart" >\n <link name="base" ></link>\n</robot>\n')
    main(arguments)
    plain = capsys.readouterr().out
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    main(arguments)
    colored = capsys.readouterr().out
    assert colored.count("\x1b[31m-") >= 1
    assert colored.count("\x1b[32m+") >= 1
    assert re.sub(r"\x1b\[\d+m", "", colored) == plain
    monkeypatch.setenv("NO_COLOR", "1")
    main(arguments)
    assert capsys.readouterr().out == plain


def test_the_process_loads_no_heavy_modules(package):
    code = (
        "import sys; from urdfkit.cli import main; main(['lint', 'urdf/clean.urdf'])\n"
        "heavy = {'numpy', 'pinocchio', 'trimesh', 'dataclasses', 'inspect', 'json', 'difflib', 'shutil'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.stderr, done.stdout) == ("", "All checks passed.\n[]\n")


def test_terminals_without_our_letters(package):
    tensor = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3"/>'
    Path("r.urdf").write_text(f'<robot name="n"><link name="a"><inertial>{tensor}</inertial></link></robot>')
    command = [sys.executable, "-m", "urdfkit", "lint", "r.urdf"]
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert (done.returncode, done.stderr) == (1, "")
    assert "3.00 kg?m?: 1.00 + 1.00 < 3.00" in done.stdout


def test_a_reader_that_goes_away(package):
    command = f"{sys.executable} -m urdfkit lint . | head -1"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False, env={**os.environ})
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1


def test_rule_pages_and_catalogue(capsys):
    assert main(["rule", "I503"]) == 0
    page = capsys.readouterr().out
    assert main(["rule", "inertia-triangle-inequality"]) == 0
    assert capsys.readouterr().out == page
    assert page.startswith("# inertia-triangle-inequality (I503)\n")
    assert main(["rule"]) == 0
    catalogue = capsys.readouterr().out.splitlines()
    assert any(line.split()[:3] == ["X101", "error", "[*]"] for line in catalogue)
    assert main(["rule", "I5033"]) == 2
    assert "did you mean `I503`" in capsys.readouterr().err


def test_rules_are_found_by_words_of_their_pages(capsys):
    assert main(["rule", "--search", "MESH", "unit"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[:-2]] == ["G608", "G617", "G619", "I518"]
    assert main(["rule", "--search", "quaternions", "bananas"]) == 2
    assert "no page of a rule contains `quaternions` and `bananas`" in capsys.readouterr().err
    assert main(["rule", "mesh"]) == 2
    assert "`urdfkit rule --search mesh`" in capsys.readouterr().err
    assert main(["rule", "I503", "--search", "mesh"]) == 2


def test_of_several_files_the_broken_ones_do_not_hide_the_others(package, capsys):
    Path("world.urdf").write_text("<sdf/>")
    Path("cut.urdf").write_text('<robot name="x"><link')
    assert main(["lint", "world.urdf", "cut.urdf", "urdf/clean.urdf", "--jobs", "1", "--no-cache"]) == 2
    reported = capsys.readouterr()
    assert "cut.urdf:1:17: E001" in reported.out
    message = "<sdf> is not a robot description; a world goes after --world of `urdfkit sim run`"
    assert reported.err == f"urdfkit: world.urdf:1:1: {message}\n"
    assert main(["lint", "world.urdf"]) == 2


def test_a_broken_file_in_a_folder_is_not_passed_over(package, capsys):
    broken = {"empty.urdf": "", "cut.xacro": "<robo", "pointer.urdf": "version https://git-lfs.github.com/spec/v1\n"}
    broken["root.urdf"] = '<rbot name="r"><link name="a"/></rbot>'
    for name, text in broken.items():
        Path("urdf", name).write_text(text)
    Path("urdf", "other.xacro").write_text("<launch/>")
    assert main(["lint", "urdf", "--select", "E", "--format", "json"]) == 1
    found = {Path(one["file"]).name: one["code"] for one in json.loads(capsys.readouterr().out)}
    assert found == {"empty.urdf": "E001", "cut.xacro": "E001", "pointer.urdf": "E001", "root.urdf": "E008"}
    assert main(["lint", "urdf/root.urdf", "--fix", "--unsafe-fixes"]) == 0
    assert Path("urdf", "root.urdf").read_text().strip() == '<robot name="r"><link name="a"/></robot>'


def test_of_several_paths_those_that_are_not_there_do_not_hide_the_others(package, capsys):
    Path("empty").mkdir()
    assert main(["lint", "none.urdf", "empty", "urdf/bad.urdf.xacro"]) == 2
    out, err = capsys.readouterr()
    assert out.endswith("Found 3 errors (2 fixable with --fix).\n")
    assert [line[:40] for line in err.splitlines()] == [
        "urdfkit: no such file or folder: none.ur",
        "urdfkit: no robot description (a .urdf o",
    ]
    assert main(["lint", "--diff", "none.urdf", "urdf/bad.urdf.xacro"]) == 2
    out, err = capsys.readouterr()
    assert "+<xacro:part" in out
    assert "no such file or folder: none.urdf" in err
    assert main(["lint", "--fix", "none.urdf", "urdf/bad.urdf.xacro"]) == 2
    assert "<xacro:part" in Path("urdf/bad.urdf.xacro").read_text()


def test_where_nothing_is_there_nothing_passes(package, capsys):
    assert main(["lint", "none.urdf", "nothing"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 2
