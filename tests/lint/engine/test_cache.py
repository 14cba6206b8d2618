"""The cache of findings: quick when nothing has changed, silent when anything has, deaf to damaged files."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from urdfkit.lint.engine import cache, checker
from urdfkit.lint.engine.cache import folder
from urdfkit.lint.engine.run import Outcome, run
from urdfkit.lint.project.entry_files import find_entries
from urdfkit.lint.project.options import Options

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
MODEL = """<xacro:include filename="$(find p)/urdf/part.xacro"/>
<xacro:part n="a"/>
<link name="b"><visual><geometry><mesh filename="package://p/meshes/b.stl"/></geometry></visual></link>"""
PART = '<xacro:macro name="part" params="n"><link name="${n}" kind="x"/></xacro:macro>'


@pytest.fixture
def package(write, monkeypatch, tmp_path):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))
    write("p/package.xml", "<package><name>p</name></package>")
    write("p/urdf/part.xacro", PART)
    return write("p/urdf/r.urdf.xacro", MODEL)


def lint(*paths: Path, **options) -> Outcome:
    return run(find_entries(paths), Options(**options), cached=True)


def codes(outcome: Outcome) -> list[str]:
    return [finding.code for finding in outcome.findings]


def test_the_second_run_gives_the_same_and_looks_at_nothing(package, monkeypatch):
    first = lint(package)
    assert (first.cached, codes(first)) == (0, ["E009", "T203", "G601"])
    monkeypatch.setattr(checker, "model_of", None)
    second = lint(package)
    assert second.cached == 1
    assert second.findings == first.findings
    assert second.files == first.files
    for finding in second.findings:
        assert second.sources[finding.file].text == Path(finding.file).read_text()


CHANGES = {
    "the entry": lambda: Path("p/urdf/r.urdf.xacro").write_text(f"{HEAD}<link name='a'/></robot>"),
    "an include": lambda: Path("p/urdf/part.xacro").write_text(f"{HEAD}{PART.replace(' kind=', ' sort=')}</robot>"),
    "package.xml": lambda: Path("p/package.xml").write_text("<package><name>p</name><depend>q</depend></package>"),
    "a new CMakeLists.txt": lambda: Path("p/CMakeLists.txt").write_text("install(DIRECTORY urdf)"),
    "a mesh that appears": lambda: (Path("p/meshes").mkdir(), Path("p/meshes/b.stl").write_bytes(b"no mesh")),
    "an include that goes": lambda: Path("p/urdf/part.xacro").unlink(),
}


@pytest.mark.parametrize("what", CHANGES)
def test_whatever_was_read_or_looked_for_counts(package, what):
    lint(package)
    CHANGES[what]()
    changed = lint(package)
    assert changed.cached == 0
    assert changed.findings == run(find_entries([package]), Options()).findings
    assert lint(package).cached == 1


def test_the_content_of_meshes_counts(package):
    mesh = Path("p/meshes/b.stl")
    mesh.parent.mkdir()
    mesh.write_text("solid b\nendsolid b\n")
    before = lint(package)
    assert lint(package).cached == 1
    mesh.write_text("version https://git-lfs.github.com/spec/v1\n")
    after = lint(package)
    assert after.cached == 0
    assert [f.message for f in after.findings] != [f.message for f in before.findings]


def test_large_files_count_by_size_and_times_once_they_are_older_than_the_clock_can_tell(package, monkeypatch):
    mesh = write_large(Path("p/meshes/b.stl"), b"a")
    lint(package)
    read: list[str] = []
    monkeypatch.setattr(cache, "content_of", lambda path: read.append(path.name) or path.read_bytes())
    assert lint(package).cached == 1
    assert "b.stl" in read, "it has just been written"
    monkeypatch.setattr(cache, "_JUST_CHANGED", 0)
    write_large(mesh, b"b")
    assert lint(package).cached == 0
    read.clear()
    assert lint(package).cached == 1
    assert "b.stl" not in read
    write_large(mesh, b"c")
    assert lint(package).cached == 0


def write_large(path: Path, content: bytes) -> Path:
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(content * 300_000)
    return path


def test_a_touched_file_is_the_same_file(package):
    lint(package)
    os.utime(package, (1, 1))
    assert lint(package).cached == 1


def test_a_package_that_appears_counts(write, package):
    write("q.urdf.xacro", '<xacro:include filename="$(find lost)/x.xacro"/><link name="a"/>')
    first = lint(Path("q.urdf.xacro"))
    assert "X113" in codes(first)
    assert lint(Path("q.urdf.xacro")).cached == 1
    write("lost/package.xml", "<package><name>lost</name></package>")
    write("lost/x.xacro", "")
    found = lint(Path("q.urdf.xacro"))
    assert (found.cached, codes(found)) == (0, [])


@pytest.mark.parametrize(
    "options",
    [{"select": ("T",)}, {"ignore": ("G",)}, {"target": "gz"}, {"arguments": {"x": "1"}}, {"guess_target": True}],
)
def test_how_it_is_linted_counts(package, options):
    lint(package)
    assert lint(package, **options).cached == 0
    assert lint(package, **options).cached == 1


def test_the_environment_counts(package, monkeypatch):
    package.write_text(f'{HEAD}<link name="$(optenv PART b)"/></robot>')
    lint(package)
    assert lint(package).cached == 1
    monkeypatch.setenv("PART", "c")
    assert lint(package).cached == 0
    package.write_text(f'{HEAD}<xacro:property name="n" value="A"/><link name="$(optenv P${{n}}RT b)"/></robot>')
    lint(package)
    assert lint(package).cached == 1
    monkeypatch.delenv("PART")
    assert lint(package).cached == 0
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/nowhere")
    assert lint(package).cached == 0


def kept() -> list[Path]:
    return sorted(path for path in folder().rglob("*") if path.is_file())


@pytest.mark.parametrize("damage", [b"", b"x" * 40, None])
def test_damaged_files_are_made_anew(package, damage):
    first = lint(package)
    (file,) = kept()
    content = file.read_bytes()
    file.write_bytes(content[:-7] + b"\x00" * 7 if damage is None else damage)
    again = lint(package)
    assert (again.cached, again.findings) == (0, first.findings)
    assert kept() == [file]
    assert file.read_bytes() == content
    assert lint(package).cached == 1


def test_no_writable_place_is_no_error(package, monkeypatch):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", "/dev/null/x")
    assert lint(package).cached == 0
    assert lint(package).cached == 0


def test_old_findings_make_room(package, monkeypatch):
    from urdfkit.lint.engine import cache

    monkeypatch.setattr(cache, "_MAX_FILES", 0)
    lint(package)
    assert kept() == []


def test_yaml_files_count(package):
    package.write_text(f"{HEAD}<link name=\"${{xacro.load_yaml('n.yaml')['n']}}\"/></robot>")
    lint(package)
    assert lint(package).cached == 1
    package.with_name("n.yaml").write_text("n: a")
    assert codes(lint(package)) == []
    assert lint(package).cached == 1
    package.with_name("n.yaml").write_text("n: a b")
    assert codes(lint(package)) == ["N302"]


def test_several_processes_find_the_same(write, package, monkeypatch):
    monkeypatch.setattr("urdfkit.lint.engine.run._MIN_PARALLEL", 2)
    for number in range(5):
        write(f"p/urdf/{number}.urdf", f'<robot name="r{number}"><link name="a" kind="x"/></robot>')
    entries = find_entries(["p"])
    alone = run(entries, Options())
    together = run(entries, Options(), cached=True, jobs=2)
    assert together.findings == alone.findings
    assert together.cached == 0
    assert {file: source.text for file in alone.sources if (source := together.sources[file])} == {
        file: source.text for file, source in alone.sources.items()
    }
    assert run(entries, Options(), cached=True, jobs=2).cached == len(entries)


def test_errors_come_back_from_other_processes(write, package, monkeypatch):
    from urdfkit.errors import ModelError
    from urdfkit.lint.project.entry_files import Entry

    monkeypatch.setattr("urdfkit.lint.engine.run._MIN_PARALLEL", 2)
    write("w.urdf", b"<sdf/>")
    with pytest.raises(ModelError, match="<sdf> is not a robot description"):
        run([Entry(package), Entry(Path("w.urdf"))], Options(), jobs=2)


@pytest.mark.parametrize("before", [[], ["--format", "json"], ["--statistics"]])
def test_what_was_found_before_is_shown_with_its_lines(write, monkeypatch, tmp_path, capsys, before):
    from urdfkit.cli import main

    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))
    path = str(write("c.urdf", '<link name="a"/>\n<link name="b" kind="x"/>'))
    assert main(["lint", path, *before]) == 1
    capsys.readouterr()
    assert main(["lint", path]) == 1
    again = capsys.readouterr().out
    assert main(["lint", path, "--no-cache"]) == 1
    assert again == capsys.readouterr().out
    assert "^^^^" in again


def test_findings_in_files_that_have_gone_come_without_lines(write, monkeypatch, tmp_path):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))
    path = write("c.urdf", '<link name="a" kind="x"/>')
    lint(path)
    again = lint(path)
    path.unlink()
    assert again.sources.get("c.urdf") is None
    assert again.sources.get("d.urdf") is None


CONTROLLERS = """controller_manager:
  ros__parameters:
    arm:
      type: joint_trajectry_controller/JointTrajectoryController
"""
EXPORT = "PLUGINLIB_EXPORT_CLASS(joint_trajectry_controller::JointTrajectoryController, ci::ControllerInterface)"


def test_files_that_rules_search_count(package):
    Path("p/config").mkdir()
    Path("p/config/arm.yaml").write_text(CONTROLLERS)
    lint(package)
    assert lint(package).cached == 1
    code = Path("p/src/arm.cpp")
    code.parent.mkdir()
    code.write_text(EXPORT)
    exported = lint(package)
    assert (exported.cached, "K962" in codes(exported)) == (0, False)
    code.write_text(f"// {EXPORT[:9]}")
    misspelt = lint(package)
    assert (misspelt.cached, "K962" in codes(misspelt)) == (0, True)
    Path("q").mkdir()
    Path("q/package.xml").write_text("<package><name>q</name></package>")
    assert lint(package).cached == 0, "a neighbour"
    assert lint(package).cached == 1


def test_findings_keep_what_their_groups_need(tmp_path, monkeypatch):
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path / "cache"))
    path = tmp_path / "r.urdf"
    joint = (
        '<joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit effort="1" velocity="1"/></joint>'
    )
    path.write_text(f'<robot name="r"><link name="a"/><link name="b"/>{joint}</robot>')
    new, kept = (run(find_entries([path]), Options(), cached=True) for _ in range(2))
    assert kept.cached == 1
    kinds = [(one.kind, one.names) for one in new.findings]
    assert ("omitted", ()) in kinds
    assert [(one.kind, one.names) for one in kept.findings] == kinds
