"""``lint --confined`` opens nothing outside the package, its workspace and the package path."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.lint.project.confinement import Confinement

RUN = """
import json, sys
from urdfkit.lint.project.confinement import Confinement

opened = []

def record(event, arguments):
    if event in ("open", "os.listdir", "os.scandir"):
        opened.append(str(arguments[0]))

def start(self, start=Confinement.start):
    start(self)
    sys.addaudithook(record)  # called only for what the confinement permits

Confinement.start = start
if "--confined" not in sys.argv:
    sys.addaudithook(record)
from urdfkit.cli import main

code = main(sys.argv[1:])
print("OPENED", json.dumps(opened), file=sys.stderr)
sys.exit(code)
"""
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
LINK = '<link name="a"/>'


def robot(inside: str) -> str:
    return f'<robot name="r" {XACRO}>{LINK}{inside}</robot>'


def include(here: Path, name: str) -> str:
    return robot(f'<xacro:include filename="{name}"/>')


def through_link(here: Path, name: str, to: Path) -> None:
    path = here / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    path.symlink_to(to)


def linked(name: str, to: str) -> Callable[[Path, Path], str]:
    """Return a maker of a robot with a link of the package that leads out."""

    def make(here: Path, secret: Path) -> str:
        through_link(here, name, secret / to)
        return robot(f'<xacro:include filename="$(find p)/{name}"/>' if to.endswith(".xacro") else "")

    return make


def mesh(uri: str) -> Callable[[Path, Path], str]:
    def make(here: Path, secret: Path) -> str:
        through_link(here, "meshes/linked.stl", secret / "secret.stl")
        shape = f'<mesh filename="{uri.format(secret=secret)}" scale="1 1 1"/>'
        return robot(f'<link name="b"><collision><geometry>{shape}</geometry></collision></link>')

    return make


READS: dict[str, Callable[[Path, Path], str]] = {
    "an absolute include": lambda here, secret: include(here, f"{secret}/secret.xacro"),
    "a relative include": lambda here, secret: include(here, "../../../../secret/secret.xacro"),
    "a pattern": lambda here, secret: include(here, f"{secret}/*.xacro"),
    "an include through a link": linked("urdf/linked.xacro", "secret.xacro"),
    "load_yaml": lambda here, secret: robot(f"<link name=\"${{xacro.load_yaml('{secret}/secret.yaml')['name']}}\"/>"),
    "a launch file": linked("launch/a.launch", "secret.launch"),
    "controller settings": linked("config/a.yaml", "secret.yaml"),
}
"""Kind of read → a maker of a robot; the secret is opened without the confinement."""

NAMED: dict[str, Callable[[Path, Path], str]] = {
    "a mesh": mesh("file://{secret}/secret.stl"),
    "a mesh through a link": mesh("package://p/meshes/linked.stl"),
    "a mesh through parents": mesh("package://p/../../../secret/secret.stl"),
    "a variable": lambda here, secret: robot('<link name="$(env SECRET)"/>'),
    "a variable in an expression": lambda here, secret: robot("<link name=\"$(eval env('SECRET'))\"/>"),
    "an optional variable": lambda here, secret: robot('<link name="$(optenv SECRET a)"/>'),
    "a package": lambda here, secret: robot('<xacro:include filename="$(find secret)/secret.xacro"/>'),
}
"""Kind of read → a maker of a robot; the name of the secret, or its value, is used."""


@pytest.fixture
def lint(tmp_path: Path) -> Callable[..., tuple[list[dict], list[str], str]]:
    """Returns findings, opened paths and all output of a lint of a package in a workspace."""
    secret, here = tmp_path / "secret", tmp_path / "ws" / "src" / "p"
    secret.mkdir()
    (here / "urdf").mkdir(parents=True)
    (secret / "secret.xacro").write_text(f'<robot {XACRO}><link name="classified"/></robot>')
    (secret / "secret.yaml").write_text("name: classified\n")
    (secret / "secret.launch").write_text("<launch><classified></launch>")
    (secret / "secret.stl").write_text("solid classified\nendsolid\n")
    (secret / "package.xml").write_text("<package><name>secret</name></package>")
    (here / "package.xml").write_text("<package><name>p</name></package>")

    def run(make: Callable[[Path, Path], str], *options: str) -> tuple[list[dict], list[str], str]:
        (here / "urdf" / "r.urdf.xacro").write_text(make(here, secret))
        done = subprocess.run(
            [sys.executable, "-c", RUN, "lint", "--no-cache", "--format", "json", str(here), *options],
            cwd=here,
            env={**os.environ, "SECRET": "classified"},
            capture_output=True,
            text=True,
            check=False,
        )
        errors, _, opened = done.stderr.rpartition("OPENED ")
        assert done.returncode in (0, 1), done.stderr
        return json.loads(done.stdout), json.loads(opened), done.stdout + errors

    run.secret, run.here = str(secret), here
    return run


def outside(opened: list[str], secret: str) -> list[str]:
    return [path for path in opened if os.path.realpath(path).startswith(secret)]


@pytest.mark.parametrize("kind", READS)
def test_a_read_that_leads_out_is_refused_with_a_finding(lint, kind) -> None:
    _, opened, _ = lint(READS[kind])
    assert outside(opened, lint.secret) != []  # without the confinement it is read
    findings, opened, output = lint(READS[kind], "--confined")
    assert outside(opened, lint.secret) == []
    assert "classified" not in output
    assert any("outside the package, its workspace and the package path" in each["message"] for each in findings)


@pytest.mark.parametrize("kind", NAMED)
def test_what_is_named_outside_is_not_used(lint, kind) -> None:
    findings, opened, output = lint(NAMED[kind], "--confined")
    assert outside(opened, lint.secret) == []
    assert "classified" not in output
    assert kind == "an optional variable" or [each for each in findings if each["severity"] == "error"]
    is_hidden = any("'SECRET' is not read, because --confined hides" in each["message"] for each in findings)
    assert is_hidden is (kind in ("a variable", "an optional variable"))


def test_a_manifest_that_is_a_link_is_refused(lint) -> None:
    def make(here: Path, secret: Path) -> str:
        through_link(here, "package.xml", secret / "package.xml")
        return robot("")

    findings, opened, _ = lint(make, "--confined")
    assert outside(opened, lint.secret) == []
    assert any("package.xml` is not read" in each["message"] for each in findings)


@pytest.mark.parametrize("name", ["link.urdf", "link.xacro", "config/link.yaml", "launch/link.launch", "folder"])
def test_a_link_that_leads_out_is_one_finding_and_the_rest_is_linted(tmp_path: Path, name: str) -> None:
    package, outside = tmp_path / "ws" / "p", tmp_path / "secret.txt"
    outside.write_text(robot(""))
    package.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>p</name></package>")
    for number in range(2):
        (package / f"r{number}.urdf").write_text(robot('<link name="a"/>'))  # a duplicate
    through_link(package, name, tmp_path if name == "folder" else outside)
    command = [sys.executable, "-m", "urdfkit", "lint", "--confined", "--no-cache", "--format", "json", "ws"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.count("not read")) == (1, 0), done.stderr
    findings = json.loads(done.stdout)
    refused = [(each["file"], each["line"], each["column"]) for each in findings if "is not read" in each["message"]]
    assert refused == ([] if name == "folder" else [(f"ws/p/{name}", 1, 1)])  # folders that are links are not entered
    duplicates = [each["file"] for each in findings if each["code"] == "T206"]
    assert sorted(set(duplicates)) == ["ws/p/r0.urdf", "ws/p/r1.urdf"], findings


def test_settings_do_not_widen_it(lint) -> None:
    (lint.here / "urdfkit.toml").write_text('[lint]\npackage-path = ["../../../secret"]\n')
    make = NAMED["a package"]
    assert outside(lint(make)[1], lint.secret) != []
    findings, opened, _ = lint(make, "--confined")
    assert outside(opened, lint.secret) == []
    assert any(each["severity"] == "error" for each in findings)


def test_the_package_path_of_the_command_line_may_be_read(lint) -> None:
    findings, opened, _ = lint(NAMED["a package"], "--confined", "--package-path", lint.secret)
    assert outside(opened, lint.secret) != []
    assert not [each for each in findings if each["code"] in ("X112", "X113", "X125")]


def test_names_that_begin_alike_are_other_folders(tmp_path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "out").symlink_to(tmp_path)
    inside = Confinement([tmp_path / "a"])
    assert inside.permits(tmp_path / "a" / "x")
    assert not inside.permits(tmp_path / "ab" / "x")
    assert not inside.permits(tmp_path / "a" / ".." / "x")
    assert not inside.permits(tmp_path / "a" / "out" / "x")


def test_bytecode_outside_of_the_modules_may_be_read(lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPYCACHEPREFIX", str(tmp_path / "bytecode"))
    monkeypatch.delenv("PYTHONDONTWRITEBYTECODE", raising=False)
    lint(NAMED["a package"], "--package-path", lint.secret)  # writes the bytecode
    findings, _, _ = lint(NAMED["a package"], "--confined", "--package-path", lint.secret)
    assert not [each for each in findings if each["code"] in ("X112", "X113", "X125")]
