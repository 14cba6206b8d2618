"""Files that mean harm, or are broken beyond sense: refused in one line, or linted, in little time and memory.

``python tests/bench/fuzz_lint.py`` tries twenty thousand.
"""

from __future__ import annotations

import random
import resource
import subprocess
import sys

import pytest

from tests.bench import fuzz_lint as bench
from tests.bench import growth
from urdfkit import errors
from urdfkit.cli import main
from urdfkit.description.urdf import queries
from urdfkit.description.xml.source import Position, Span
from urdfkit.lint import fix_builders
from urdfkit.lint.facts.suppressions import Suppression, suppressed
from urdfkit.lint.finding import Finding

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
MANY = " ".join(f'a{n}=""' for n in range(20_000))
ENTITIES = '<!ENTITY a0 "ha">' + "".join('<!ENTITY a{} "{}">'.format(n, f"&a{n - 1};" * 10) for n in range(1, 10))

TEN = 10
MACROS = "".join(f"<xacro:macro name='m{n + 1}'>{f'<xacro:m{n}/>' * TEN}</xacro:macro>" for n in range(8))
BLOCKS = "".join(
    f"<xacro:property name='b{n + 1}'>{f'<xacro:insert_block name={chr(34)}b{n}{chr(34)}/>' * TEN}</xacro:property>"
    for n in range(8)
)
LAST = "<xacro:insert_block name='b8'/>"
LAUGHS = "".join(f"<xacro:property name='p{n + 1}' value='{f'${{p{n}}}' * TEN}'/>" for n in range(12))


def computed(expression: str) -> str:
    return f"<robot {XACRO} name='r'><link name='a'/><gazebo><p>${{{expression}}}</p></gazebo></robot>"


HOSTILE = {
    "power.xacro": (computed("9**9**9"), "X126 `${9**9**9}` is too large: it creates an integer of more than 10,000"),
    "text.xacro": (computed("'x' * 3 * 10**9"), "a string of more than 100,000 characters"),
    "list.xacro": (computed("[0] * 10**10"), "lists of more than 100,000 elements in total"),
    "range.xacro": (computed("list(range(10**9))"), "lists of more than 100,000 elements in total"),
    "loops.xacro": (computed("[i for i in range(9999) for j in range(9999)]"), "exceed 1,000,000 steps"),
    "format.xacro": (computed("'%099999999d' % 1"), "a string of more than 100,000 characters"),
    "factorial.xacro": (computed("factorial(10**7)"), "it calls factorial() with more than 1,000"),
    "sum.xacro": (computed("python.sum(python.range(10**12))"), "lists of more than 100,000 elements in total"),
    "deep.xacro": (computed("1+" * 4000 + "1"), "nested"),
    "macros.xacro": (
        f"<robot {XACRO} name='r'><xacro:macro name='m0'><link name='x'/></xacro:macro>{MACROS}<xacro:m8/></robot>",
        "X126 this call exceeds the limit of 10,000 macro calls",
    ),
    "blocks.xacro": (
        f"<robot {XACRO} name='r'><xacro:property name='b0'><a/></xacro:property>{BLOCKS}{LAST}</robot>",
        "more than 150,000 elements and attributes",
    ),
    "laughs.xacro": (
        f"<robot {XACRO} name='r'><xacro:property name='p0' value='lol'/>{LAUGHS}<a b='${{p12}}'/></robot>",
        "a string of more than 100,000 characters",
    ),
    "tags.urdf": (f"<robot name='r'>{'<a/>' * 300_000}</robot>", "tags.urdf:1:400013: E001 the file has 300002 tags"),
    "a bomb of entities.urdf": (f"<!DOCTYPE r [{ENTITIES}]><robot name='r'>&a9;</robot>", "declares the entity `a0`"),
    "an external entity.urdf": ('<!DOCTYPE r SYSTEM "file:///etc/passwd"><robot/>', "external entities are rejected"),
    "nesting.urdf": (f"<robot name='r'>{'<a>' * 10_000}{'</a>' * 10_000}</robot>", "nested deeper than 200"),
    "nesting.xacro": (f"<robot name='r'>{'<a>' * 10_000}{'</a>' * 10_000}</robot>", "nested deeper than 200"),
    "value.urdf": (f"<robot name='{'x' * 10_000_000}'/>", "has 10000000 characters; at most 100000 are read"),
    "value.xacro": (f"<robot name='{'${1}' * 2_500_000}'/>", "has 10000000 characters; at most 100000 are read"),
    "attributes.urdf": (f"<robot {MANY}/>", "has 20000 attributes"),
    "attributes.xacro": (f"<robot {MANY}/>", "has 20000 attributes"),
    "cycle.xacro": (
        f"<robot {XACRO}><xacro:include filename='cycle.xacro'/></robot>",
        "in a cycle: cycle.xacro → cycle",
    ),
    "macro.xacro": (
        f"<robot {XACRO}><xacro:macro name='m'><xacro:m/><xacro:m/></xacro:macro><xacro:m/></robot>",
        "macro `m` calls itself in an infinite recursion",
    ),
    "quotes.urdf": ("<robot name='r'><link name=\"a" + '" x="' * 300_000, "E001"),
    "comments.urdf": ("<robot name='r'><!--" + "<!-- " * 300_000, "E001"),
    "blanks.urdf": (f"<robot name='r'><link {' ' * 2_000_000}", "E001"),
    "brackets.urdf": ("<" * 500_000, "E001"),
    "dollars.xacro": (f"<robot {XACRO} name='r'><link name='a'/>{'${' * 20_000}</robot>", "X125"),
}


def limits() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (600 * 10**6, 600 * 10**6))
    resource.setrlimit(resource.RLIMIT_CPU, (5, 5))


@pytest.mark.slow
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_are_refused_in_a_line(name, tmp_path):
    text, message = HOSTILE[name]
    (tmp_path / name).write_text(text)
    done = subprocess.run(
        [sys.executable, "-m", "urdfkit", "lint", "--no-cache", name],
        cwd=tmp_path,
        preexec_fn=limits,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, "")
    (line,) = [line for line in done.stdout.splitlines() if message in line]
    assert len(line) < 300
    assert max(map(len, done.stdout.splitlines())) < 500


DEEP_LAUNCH_FILES = {
    "a.launch": "<launch>" + "<group>" * 3_000 + "</group>" * 3_000 + "</launch>",
    "b.launch.yaml": "launch:\n- group: " + "[{group: " * 3_000 + "1" + "}]" * 3_000,
    "c.launch.py": "x = " + "(" * 150 + "1" + ")" * 150 + "\ny = " + "-" * 60_000 + "1",
    "d.launch.py": "def generate_launch_description():\n    return a" + " + a" * 20_000,
}


@pytest.mark.slow
@pytest.mark.parametrize("name", DEEP_LAUNCH_FILES)
def test_deeply_nested_launch_files_cause_no_error_of_ours(name, tmp_path, capsys):
    (tmp_path / "package.xml").write_text("<package format='3'><name>deep</name></package>")
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / name).write_text(DEEP_LAUNCH_FILES[name])
    (tmp_path / "robot.urdf").write_text("<robot name='r'><link name='base_link'/></robot>")
    assert main(["lint", "--no-cache", str(tmp_path / "robot.urdf")]) in {0, 1}
    assert "a bug in urdfkit" not in "".join(capsys.readouterr())


HOSTILE_YAML = {
    "lists of lists": "[" * 99_000,
    "lists in one line": "a: 1\nb:\n" + "- " * 49_000,
    "maps of maps": "a: " + "{" * 99_000,
    "long word": "x: " + "x" * 99_000,
    "empty name": (
        "controller_manager:\n  ros__parameters:\n"
        "    arm: {type: joint_trajectory_controller/JointTrajectoryController}\n"
        "arm: {ros__parameters: {joints: [elbow], gains: {'': 1}}}\n"
    ),
}
ARM = (
    "<robot name='r'><link name='a'/><link name='b'/>"
    "<joint name='elbow' type='continuous'><parent link='a'/><child link='b'/></joint></robot>"
)


@pytest.mark.parametrize("name", HOSTILE_YAML)
def test_hostile_settings_of_controllers_cause_no_error_of_ours(name, tmp_path, capsys):
    (tmp_path / "package.xml").write_text("<package format='3'><name>deep</name></package>")
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "controllers.yaml").write_text(HOSTILE_YAML[name])
    (tmp_path / "robot.urdf").write_text(ARM)
    assert main(["lint", "--no-cache", str(tmp_path / "robot.urdf")]) in {0, 1}
    output = "".join(capsys.readouterr())
    assert "a bug in urdfkit" not in output
    assert "linting takes" not in output


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 200, 50))
def test_broken_files_bring_no_traceback(first):
    counts, failures, _ = bench.work((first, first + 50, ""))
    assert failures == []
    assert counts.total() == 50


def test_a_fault_of_ours_and_a_hang_are_noticed(monkeypatch, tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text("<robot name='r'/>")
    assert bench.judged(path) == "found"

    def broken(*_):
        raise KeyError("x")

    monkeypatch.setattr(bench, "run", broken)
    assert "KeyError" in bench.judged(path)

    def endless(*_):
        while True:
            pass

    monkeypatch.setattr(bench, "SECONDS", 0.05)
    monkeypatch.setattr(bench, "run", endless)
    assert bench.judged(path).startswith("more than 0.05 s")


QUADRATIC = (
    "undefined_parents", "duplicate_joints", "same_child", "one_cycle", "long_chain", "suppressions", "launch_files",
    "missing_meshes", "undefined_parameters", "undefined_controllers",
)  # fmt: skip
"""Families of files for which a lint took a time that grew with the square of their size."""


@pytest.mark.slow
@pytest.mark.parametrize("family", QUADRATIC)
def test_thousands_of_defects_are_linted_within_the_limits(family, tmp_path):
    growth.write(tmp_path / "r_description", growth.FAMILIES[family](1500))
    done = subprocess.run(
        [sys.executable, "-m", "urdfkit", "lint", "--no-cache", "--quiet", "r_description"],
        cwd=tmp_path,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (10, 10)),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 1)
    assert done.stderr == ""


def test_names_are_compared_only_up_to_the_limit():
    names = [f"wheel_{number}" for number in range(errors.MAX_COMPARED // 4)]
    with errors.LimitedSuggestions():
        assert [errors.nearest("wheel_x1", names) for _ in range(5)] == ["wheel_1"] * 4 + [None]
        assert errors.nearest("WHEEL_1", names) == "wheel_1"  # needs no comparison
    assert errors.nearest("wheel_x1", names) == "wheel_1"
    assert errors.nearest("x" * 90_000, ["x" * 90_001]) is None


def test_roots_are_not_compared_with_each_misspelt_child(monkeypatch, tmp_path):
    path = growth.write(tmp_path / "r_description", growth.misspelt_children(30))
    path.write_text(path.read_text().replace("</robot>", '<link name="more"/></robot>'))  # more roots than children
    calls = []
    for module in (errors, fix_builders, queries):
        monkeypatch.setattr(module, "nearest", lambda *words, **options: calls.append(1))  # As beyond the limit.
    assert main(["lint", str(path), "--no-cache", "--select", "T203"]) == 1
    assert len(calls) <= 3 * 31


@pytest.mark.parametrize("seed", range(20))
def test_suppressions_meet_the_same_findings_as_one_by_one(seed):
    chance = random.Random(seed)
    position = Position("r.urdf", 1, 1)

    def item() -> Suppression:
        first = chance.randrange(1, 30)
        codes = tuple(chance.sample(("A1", "B2", "C3"), chance.randrange(3)))
        verb = chance.choice(("ignore", "ignore", "ignore", "ignore-file", "ignor"))
        return Suppression(
            verb, codes, Position("r.urdf", chance.randrange(10**9), 1), first, first + chance.randrange(9)
        )

    items = [item() for _ in range(chance.randrange(12))]
    found = [
        Finding(chance.choice(["A1", "B2", "C3"]), "n", "error", "m", Span(f, line, 1, line, 1))
        for f, line in ((chance.choice(("r.urdf", "other.urdf")), chance.randrange(40)) for _ in range(60))
    ]

    def covers(one: Suppression, finding: Finding) -> bool:
        return (
            finding.file == position.file
            and one.verb in ("ignore", "ignore-file")
            and (not one.codes or finding.code in one.codes)
            and (one.verb == "ignore-file" or one.first <= finding.line <= one.last)
        )

    left, used = suppressed(found, {"r.urdf": items})
    assert left == [each for each in found if not any(covers(one, each) for one in items)]
    assert used == {(one, each.code) for one in items for each in found if covers(one, each)}
