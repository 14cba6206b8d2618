"""A rule that fails by a fault of its own: its file is named in one line, everything else comes out."""

from __future__ import annotations

import json
import threading

import pytest

from urdfkit.cli import main
from urdfkit.lint import lint
from urdfkit.lint.editor.open_files import Project
from urdfkit.lint.project.options import Options
from urdfkit.lint.rules.joints.axis_zero import AxisZero

JOINT = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
FAILS = f'<link name="a" sort="x"/><link name="b"/>{JOINT.replace("fixed", "continuous")}'
FAILS = FAILS.replace("</joint>", '<axis xyz="0 0 0"/></joint>')
FINE = f'<link name="a" kind="x"/><link name="b"/>{JOINT}'


@pytest.fixture(autouse=True)
def failing(monkeypatch, tmp_path):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))

    def check(self, model):
        raise OverflowError("too\nlarge")
        yield

    monkeypatch.setattr(AxisZero, "check", check)


def told(text: str, file: str) -> bool:
    (line,) = text.splitlines()
    start = (
        f"urdfkit: {file}: J411 axis-zero could not check this file: a bug in urdfkit, not in your files: OverflowError"
    )
    return line.startswith(start)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_the_others_of_a_folder_are_linted_and_the_other_rules_asked(write, capsys, monkeypatch, jobs):
    # A new process would have the rule as it is; a thread of another test must not prevent the fork.
    monkeypatch.setattr(threading, "active_count", lambda: 1)
    write("bad.urdf", FAILS)
    for name in "abcdefgh":
        write(f"{name}.urdf", FINE)
    for _ in range(2):  # what was not looked at is not kept
        assert main(["lint", ".", "--format", "json", "--jobs", jobs]) == 2
        printed = capsys.readouterr()
        found = {(row["file"], row["code"]) for row in json.loads(printed.out)}
        assert found >= {("bad.urdf", "E009"), *((f"{name}.urdf", "E009") for name in "abcdefgh")}
        assert told(printed.err, "bad.urdf")


def test_a_file_alone_has_its_other_findings(write, capsys):
    path = write("bad.urdf", FAILS)
    assert main(["lint", str(path)]) == 2
    printed = capsys.readouterr()
    assert "E009" in printed.out
    assert told(printed.err, "bad.urdf")


def test_where_nobody_wants_to_go_on_it_is_raised(write):
    with pytest.raises(OverflowError):
        lint(write("bad.urdf", FAILS))


def test_what_fails_before_the_rules_is_reported_too(write, capsys, monkeypatch):
    from urdfkit.description.urdf import parser

    def parse(root, **more):
        if root.origin.position.file == "bad.urdf":
            raise KeyError("x")
        return known(root, **more)

    known = parser.parse
    monkeypatch.setattr(parser, "parse", parse)
    write("bad.urdf", FAILS)
    write("good.urdf", FINE)
    assert main(["lint", ".", "--format", "json"]) == 2
    printed = capsys.readouterr()
    assert {row["file"] for row in json.loads(printed.out)} == {"good.urdf"}
    assert printed.err.startswith("urdfkit: bad.urdf: a bug in urdfkit, not in your files: KeyError: 'x' (")


def test_an_editor_is_notified(write):
    path = write("bad.urdf", FAILS).resolve()
    project = Project(Options())
    assert [finding.code for finding in project.findings(path)[path]].count("E009") == 1
    (line,) = project.failures(path)
    assert line.startswith(f"{path}: J411 axis-zero could not check this file: a bug in urdfkit")
