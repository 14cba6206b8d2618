"""Every rule on files of its own: ``<!-- expect: CODE -->`` marks lines, good files are silent, fixed ones come out."""

from __future__ import annotations

import ast
import os
import re
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.lint.test_messages import CASES
from urdfkit.lint import RULES, lint
from urdfkit.lint.catalogue import SECTIONS, page, sections, title
from urdfkit.lint.finding import Finding
from urdfkit.lint.fixes.apply import fix
from urdfkit.lint.project.entry_files import Entry, find_entries
from urdfkit.lint.project.options import Options
from urdfkit.lint.rule import Rule

HERE = Path(__file__).parent / "rules"
FOLDER = Path(__file__).parents[2] / "urdfkit" / "lint" / "rules"
FIXTURES = ("bad.*", "good.*", "fixed.*")
MARK = re.compile(r"<!--\s*expect:\s*([A-Z0-9, ]+?)\s*-->")
BY_NAME = {rule.name: rule for rule in RULES}


def files(kind: str) -> list:
    found = sorted(HERE.glob(f"*/{kind}.*"))
    return [pytest.param(path, id=path.parent.name) for path in found]


def target(rule: type[Rule]) -> str | None:
    """The target under which a rule that is only for some is asked."""
    return rule.only_for[0] if rule.only_for else None


def marks(path: Path) -> Counter:
    expected: Counter = Counter()
    for file in sorted(path.rglob("*.*")) if path.is_dir() else [path]:
        for number, line in enumerate(file.read_text().splitlines(), 1) if file.is_file() else ():
            for codes in MARK.findall(line):
                expected.update((code.strip(), number) for code in codes.split(","))
    return expected


def found_in(path: Path) -> list[Finding]:
    """Return the findings of a file in the current folder."""
    return list(lint(path.name, target=target(BY_NAME[path.parent.name])))


def marked(finding: Finding, path: Path) -> Finding:
    """Return the finding, or its related place in a file if it is in the package.xml of the whole folder."""
    is_inside = path in (place := Path(finding.file).absolute(), *place.parents)
    return finding if is_inside or not finding.related else finding.related[0]


def report(found: list[Finding]) -> str:
    """Return all texts and places of findings in the current folder."""
    lines = []
    for finding in found:
        span = finding.span
        place = f"{span.line}:{span.column}-{span.end_line}:{span.end_column}"
        lines.append(f"{span.file}:{place}: {finding.code} {finding.severity}: {finding.message}")
        if finding.link or finding.joint:
            lines.append(f"  in: link {finding.link}, joint {finding.joint}")
        lines += [f"  related: {each.file}:{each.line}" for each in finding.related]
        lines += [f"  expanded from: {' < '.join(call.macro for call in chain)}" for chain in finding.chains]
        if finding.help:
            lines.append(f"  help: {finding.help}")
        if finding.fix:
            lines.append(f"  {finding.fix.safety} fix: {finding.fix.title}")
    return "".join(f"{line}\n" for line in lines).replace(f"{Path.cwd()}/", "")


@pytest.mark.parametrize("path", files("bad"))
def test_bad_files_have_the_marked_findings_with_their_texts(path, monkeypatch):
    """After an intended change, write the expected files with ``python -m tests.lint.test_rules`` and read the diff."""
    monkeypatch.chdir(path.parent)
    found = found_in(path)
    assert Counter((finding.code, marked(finding, path).line) for finding in found) == marks(path), [
        str(f) for f in found
    ]
    assert BY_NAME[path.parent.name].code in {finding.code for finding in found}
    assert report(found) == path.with_name(f"findings.{path.name}.txt").read_text()


NOT_HELD = HERE.parent / "texts_not_held.txt"
"""Texts of rules without a bad file of their own: file and text."""


def message_texts(path: Path) -> Iterator[tuple[str, str]]:
    """Yield the texts with a blank in the functions of a rule, `…` for values, each with its regular expression."""
    tree = ast.parse(path.read_bytes())
    skipped: set[ast.AST] = set()  # parts of f-strings, docstrings, regular expressions, comparisons, causes
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            skipped.update(node.values)
        elif isinstance(node, ast.Expr):
            skipped.add(node.value)
        elif isinstance(node, ast.Call) and ast.unparse(node.func).startswith("re."):
            skipped.update(node.args)
        elif isinstance(node, ast.Compare) or (isinstance(node, ast.keyword) and node.arg == "cause"):
            skipped.update(ast.walk(node))
    for function in ast.walk(tree):
        if not isinstance(function, ast.FunctionDef):
            continue
        for node in ast.walk(function):
            if node in skipped or not isinstance(node, (ast.JoinedStr, ast.Constant)):
                continue
            parts = node.values if isinstance(node, ast.JoinedStr) else [node]
            text = "".join(str(part.value) if isinstance(part, ast.Constant) else "…" for part in parts)
            if re.search(r"[a-z`>] .*[a-z]{2}", text):
                yield text, ".*".join(map(re.escape, re.split(r"…|\{\}", text.strip("…"))))


def test_every_text_of_a_rule_is_held():
    """Each message, help and title of a fix occurs in an expected file of a rule or in a test of the linter."""
    expected = "\n".join(path.read_text() for path in HERE.glob("*/findings.*.txt"))
    expected += "".join(f"{line}\n" for _, _, _, lines in CASES.values() for line in lines)
    tests = "\n".join(path.read_text() for path in HERE.parent.rglob("test_*.py"))
    found = sorted(
        f"{path.relative_to(FOLDER)}: {text}"
        for path in FOLDER.rglob("[!_]*.py")
        for text, pattern in set(message_texts(path))
        if not re.search(pattern, expected) and not re.search(pattern, tests)
    )
    assert found == NOT_HELD.read_text().splitlines(), "write a bad file for a new text; remove a text that is held now"


@pytest.mark.parametrize("rule", [rule for rule in RULES if rule.only_for or rule.not_for], ids=lambda rule: rule.name)
def test_targets_that_do_not_mind_are_spared(rule):
    path = next((HERE / rule.name).glob("bad.*"))
    spared = [None, *rule.not_for] if rule.only_for else sorted(rule.not_for)
    for other in spared:
        assert rule.code not in {finding.code for finding in lint(path, target=other)}


@pytest.mark.parametrize("path", files("good"))
def test_good_files_are_silent(path):
    assert lint(path, target=target(BY_NAME[path.parent.name])) == []


def fixed_texts(bad: Path, options: Options) -> dict[str, bytes]:
    """Return the new bytes of each file that the rule of a bad file, or folder, fixes; by the path in the folder."""
    rule = BY_NAME[bad.absolute().parent.name]
    options = Options(**{**options.__dict__, "target": target(rule)})
    fixed = fix(find_entries([bad]), options, within=[bad], unsafe=rule.fix == "unsafe" or not options.select)
    return {change.path.relative_to(bad.absolute()).as_posix(): change.after for change in fixed.changes}


def read(path: Path) -> dict[str, bytes]:
    """Return the bytes of each file that a fixed file, or folder, holds; see `fixed_texts`."""
    each = [file for file in path.rglob("*") if file.is_file()] if path.is_dir() else [path]
    return {file.relative_to(path).as_posix(): file.read_bytes() for file in each}


@pytest.mark.parametrize("path", files("fixed"))
def test_fixes_give_the_fixed_file_and_do_nothing_more(path):
    bad = path.with_name(path.name.replace("fixed", "bad", 1))
    before = read(bad)
    changed = {file: content for file, content in read(path).items() if before[file] != content}
    assert fixed_texts(bad, Options(select=(BY_NAME[path.parent.name].code,))) == changed
    assert fixed_texts(path, Options()) == {}


def changes_lines(fixed: Path) -> bool:
    """Return whether the fix of a robot adds or removes lines."""
    bad = fixed.with_name(fixed.name.replace("fixed", "bad", 1))
    return fixed.suffix in (".urdf", ".xacro") and fixed.read_bytes().count(b"\n") != bad.read_bytes().count(b"\n")


@pytest.mark.parametrize(
    ("path", "end"),
    [
        pytest.param(path, end, id=f"{one.id}-{end!r}")
        for one in files("fixed")
        if (path := one.values[0]).is_file()
        for end in ("\r\n", *(["\r"] if changes_lines(path) else []))
    ],
)
def test_fixes_keep_to_the_line_ends_of_their_file(path, end, tmp_path, monkeypatch):
    folder = tmp_path / path.parent.name
    shutil.copytree(path.parent, folder)
    monkeypatch.chdir(folder)
    bad = Path(path.name.replace("fixed", "bad", 1))
    bad.write_bytes(bad.read_bytes().replace(b"\n", end.encode()))
    fixed = fixed_texts(bad, Options(select=(BY_NAME[path.parent.name].code,)))
    assert fixed == {".": path.read_bytes().replace(b"\n", end.encode())}


def test_each_rule_has_its_files():
    for rule in RULES:
        kinds = {path.stem.partition(".")[0] for path in (HERE / rule.name).iterdir()}
        assert kinds >= {"good", "bad"} | ({"fixed"} if rule.fix != "none" else set()), rule.name


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_the_examples_of_a_page_are_true(rule: type[Rule], tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    diff = re.fullmatch(r'```diff(?: title="(.*)")?\n(.*)\n```', sections(rule)["Example"], re.DOTALL)
    assert diff, f"the example of {rule.code} is one block of a diff"
    for is_bad, other in ((True, "+"), (False, "-")):
        example = "\n".join(line[1:] for line in diff[2].splitlines() if not line.startswith(other))
        is_xacro = "xacro" in example and any((HERE / rule.name).glob("*.xacro"))
        file = tmp_path / (diff[1] or ("example.urdf.xacro" if is_xacro else "example.urdf"))
        beside = [path for path in (HERE / rule.name).glob("bad.*") if path.suffix in (".launch", ".yaml", ".srdf")]
        if beside and not diff[1]:  # A rule on what lies around the description.
            file = tmp_path / f"example{beside[0].suffix}"
        if (HERE / rule.name / "good.package").is_dir():  # A rule on the files of a package.
            shutil.copytree(HERE / rule.name / "good.package", tmp_path, dirs_exist_ok=True)
            file = tmp_path / (diff[1] or "package.xml")
        file.write_text(example)
        # Meshes and manifests that examples need lie next to the files of the rule.
        shutil.copytree(HERE / rule.name, tmp_path, dirs_exist_ok=True, ignore=shutil.ignore_patterns(*FIXTURES))
        linted = tmp_path if file.parent.name == "scripts" else file  # The code of a node belongs to a package.
        codes = {finding.code for finding in lint(linted, target=target(rule))}
        assert (rule.code in codes) is is_bad
        assert codes <= {rule.code}


def test_pages_have_their_sections_in_order():
    for rule in RULES:
        headings = list(sections(rule))
        assert headings == [heading for heading in SECTIONS if heading in headings], rule.name
        assert set(SECTIONS[:3]) <= set(headings), rule.name
        assert ("Fix safety" in headings) is (rule.fix != "none"), rule.name
        assert page(rule).startswith(f"# {rule.name} ({rule.code})")
        assert title(rule).endswith("."), rule.name


def test_every_class_in_the_folder_is_registered():
    registered = {f"{rule.__module__}.{rule.__name__}" for rule in RULES}
    written = set()
    for file in FOLDER.rglob("*.py"):
        module = ".".join(("urdfkit.lint.rules", *file.relative_to(FOLDER).with_suffix("").parts))
        classes = re.findall(r"^class (\w+)\(\w*Rule\):", file.read_text(), re.MULTILINE)
        assert len(classes) == (file.name != "__init__.py"), f"{file} holds one rule"
        written.update(f"{module}.{name}" for name in classes)
    assert written == registered


def test_codes_and_names_are_unique_and_well_formed():
    assert len({rule.code for rule in RULES}) == len({rule.name for rule in RULES}) == len(RULES)
    assert all(re.fullmatch(r"[A-Z]\d{3}", rule.code) for rule in RULES)
    assert all(re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", rule.name) for rule in RULES)
    assert [rule.code for rule in RULES] == sorted(rule.code for rule in RULES)


@pytest.mark.slow
@pytest.mark.parametrize("path", files("bad"))
def test_rules_left_out_by_the_table_would_find_nothing(path, monkeypatch):
    from urdfkit.lint import rules
    from urdfkit.lint.engine import rule_runner

    few = lint(path, target=target(BY_NAME[path.parent.name]))
    monkeypatch.setattr(rule_runner, "source_rules", lambda _: rules.source_rules())
    monkeypatch.setattr(rule_runner, "robot_rules", lambda *_: rules.robot_rules())
    assert lint(path, target=target(BY_NAME[path.parent.name])) == few


def test_the_axis_that_a_wheel_is_told_rolls_it_ahead():
    (found,) = lint(HERE / "axis-not-along-wheel" / "bad.urdf", select=("J414",))
    assert "the axis of the wheel, 0 1 0 in the joint frame" in found.message


def test_what_could_not_be_computed_is_not_missing(tmp_path):
    text = (HERE / "moving-link-without-inertial" / "good.urdf").read_text()
    (tmp_path / "r.urdf.xacro").write_text(text.replace('<mass value="', '<mass value="${mas}', 1))
    assert {finding.code for finding in lint(tmp_path)} == {"X104"}


def test_of_a_link_that_is_there_twice_no_shapes_are_compared(tmp_path):
    heavy = "<inertial><mass value='9'/><inertia ixx='.1' ixy='0' ixz='0' iyy='.1' iyz='0' izz='.1'/></inertial>"
    small = "<link name='a'><collision><geometry><box size='.01 .01 .01'/></geometry></collision>"
    (tmp_path / "r.urdf").write_text(f"<robot name='r'><link name='a'>{heavy}</link>{small}</link></robot>")
    assert {finding.code for finding in lint(tmp_path) if finding.severity != "note"} == {"T206"}


def test_sensors_of_gz_sim_are_none_of_the_classic_one():
    good = HERE / "sensor-type-unknown" / "good.urdf"
    found = [(f.code, f.line) for f in lint(good, target="classic")]
    assert found == [("Z827", 5)]


@pytest.mark.parametrize(
    ("code", "mass", "moment", "severity"),
    [
        ("I507", "0.01", "0.01", "note"),
        ("I507", "2", "2", "warning"),
        ("I508", "0.01", "1e-9", "note"),
        ("I508", "2", "2e-8", "warning"),
    ],
)
def test_an_implausible_inertia_of_a_link_fixed_to_a_heavier_one_is_a_note(tmp_path, code, mass, moment, severity):
    inertia = f"<inertia ixx='{moment}' ixy='0' ixz='0' iyy='{moment}' iyz='0' izz='{moment}'/>"
    sensor = f"<inertial><mass value='{mass}'/>{inertia}</inertial>"
    trunk = "<inertial><mass value='6'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
    shape = "<visual><geometry><box size='{0} {0} {0}'/></geometry></visual>"
    (tmp_path / "r.urdf").write_text(
        f"<robot name='r'><link name='trunk'>{trunk}{shape.format(1)}</link>"
        f"<link name='sensor'>{sensor}{shape.format(0.02)}</link>"
        "<joint name='j' type='fixed'><parent link='trunk'/><child link='sensor'/></joint></robot>"
    )
    found = lint(tmp_path, select=["I507", "I508"])
    assert [(finding.code, finding.severity) for finding in found] == [(code, severity)]


DRIVEN = """<robot name="cart">
  <link name="base">
    <visual><geometry><box size="1 1 1"/></geometry></visual>
    <collision><geometry><box size="1 1 1"/></geometry></collision>
    <inertial><mass value="0"/><inertia ixx="1.5" ixy="0" ixz="0" iyy="1.5" iyz="0" izz="1.5"/></inertial>
  </link>
  {wheels}
  <gazebo>
    <plugin name="gz::sim::systems::DiffDrive" filename="libgazebo_ros_diff_drive.so">
      <leftJoint>left</leftJoint>
      <rightJoint>right</rightJoint>
      <wheelSeparation>9</wheelSeparation>
      <nonsense>1</nonsense>
    </plugin>
  </gazebo>
</robot>
"""
WHEEL = """<link name="{side}_wheel">
    <visual><geometry><sphere radius="0.1"/></geometry></visual>
    <inertial><mass value="1"/><inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial>
  </link>
  <joint name="{side}" type="continuous">
    <parent link="base"/>
    <child link="{side}_wheel"/>
    <origin xyz="0 {y} 0"/>
    <axis xyz="0 1 0"/>
  </joint>"""


def test_wheels_that_sink_a_mass_that_lacks_and_what_a_foreign_plugin_hides(tmp_path):
    wheels = "\n".join((WHEEL.format(side="left", y="0.6"), WHEEL.format(side="right", y="-0.6")))
    (tmp_path / "r.urdf").write_text(DRIVEN.format(wheels=wheels))

    def serious(target):
        return sorted(f.code for f in lint(tmp_path, target=target) if f.severity != "note")

    assert serious("ros1") == ["G610", "G610", "I501", "S901", "S902", "S908", "Z805"]
    assert serious("gz") == ["I501", "S908", "Z807"]


def test_launch_files_in_python_are_read_and_never_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    (tmp_path / "r.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    (tmp_path / "a.launch.py").write_text("def generate_launch_description(:\n    pass\n")
    (tmp_path / "b.launch.py").write_text("raise SystemExit\n")
    assert [(f.code, f.file, f.line) for f in lint(tmp_path)] == [("K964", "a.launch.py", 1)]


def test_what_follows_from_another_defect_is_not_reported(tmp_path):
    link = '<collision><geometry><sphere radius="-1"/></geometry></collision>'
    mass = '<inertial><mass value="1"/><inertia ixx="0.4" ixy="0" ixz="0" iyy="0.41" iyz="0" izz="0.42"/></inertial>'
    loop = '<origin xyz="0.1 0.1 0"/><parent link="b"/><child link="b"/>'
    (tmp_path / "r.urdf").write_text(
        f'<robot name="r"><link name="a">{link}{mass}</link><link name="b"/>'
        f'<joint name="j" type="fixed">{loop}</joint></robot>'
    )
    codes = {f.code for f in lint(tmp_path)}
    assert codes >= {"G611", "T204"}
    assert codes.isdisjoint({"I514", "S906"})


WHEEL_FILE = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="wheel"><link name="w"/></xacro:macro>
</robot>"""


def test_the_file_whose_include_was_forgotten_is_named(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "wheel.xacro").write_text(WHEEL_FILE)
    cart = tmp_path / "cart.urdf.xacro"
    text = '<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">\n  <xacro:wheel/>\n</robot>\n'
    cart.write_text(text)
    (found,) = lint(cart)
    assert (found.code, found.help) == ("X103", "include parts/wheel.xacro, which defines `wheel`")
    fixed = fix([Entry(cart)], Options(), within=[tmp_path], unsafe=True)
    include = '\n  <xacro:include filename="parts/wheel.xacro"/>\n'
    assert [change.after.decode() for change in fixed.changes] == [text.replace("\n", include, 1)]
    (tmp_path / "parts" / "other.xacro").write_text(WHEEL_FILE)
    (found,) = lint(cart)
    assert found.fix is None, "two files define it: which one is meant is not known"


def test_a_misspelt_type_is_mended_where_its_limits_are_missing(tmp_path):
    (tmp_path / "arm.urdf").write_text(
        '<robot name="arm"><link name="a"/><link name="b"/>\n<joint name="j" type="revolut"><parent link="a"/>'
        '<child link="b"/><axis xyz="0 0 1"/></joint></robot>'
    )
    fixed = fix([Entry(tmp_path / "arm.urdf")], Options(), within=[tmp_path], unsafe=False)
    assert [b'type="revolute"' in change.after for change in fixed.changes] == [True]


def test_a_formula_with_a_slip_is_one_finding(tmp_path):
    (tmp_path / "can.urdf.xacro").write_text(
        """<robot name="can" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="can" params="m r h">
    <link name="can">
      <visual><geometry><cylinder radius="${r}" length="${h}"/></geometry></visual>
      <inertial><mass value="${m}"/>
        <inertia ixx="${m*(3*r*r+h*h)/12}" ixy="0" ixz="0" iyy="${m*(3*r*r+h*h)/12}" iyz="0" izz="${m*r/2}"/>
      </inertial>
    </link>
  </xacro:macro>
  <xacro:can m="2" r="0.05" h="0.1"/>
</robot>
"""
    )
    assert [finding.code for finding in lint(tmp_path) if finding.severity != "note"] == ["X119"]


def test_a_misspelt_child_is_one_finding(tmp_path):
    (tmp_path / "arm.urdf").write_text(
        '<robot name="arm"><link name="a"/><link name="gripper"/>\n'
        '<joint name="j" type="fixed"><parent link="a"/><child link="griper"/></joint></robot>'
    )
    assert [finding.code for finding in lint(tmp_path)] == ["T202"]


@pytest.mark.parametrize(
    ("hardware", "wrong", "right"),
    [
        ("gazebo_ros2_control/GazeboSystem", ("gz", "ros2-jazzy"), ("ros2", "classic", None)),
        ("gz_ros2_control/GazeboSimSystem", ("classic",), ("ros2", "gz", "ros2-humble", None)),
    ],
)
def test_hardware_of_another_gazebo_than_the_target_is_found_without_a_plugin(tmp_path, hardware, wrong, right):
    (tmp_path / "r.urdf").write_text(
        f'<robot name="r"><link name="a"/><ros2_control name="s" type="system"><hardware><plugin>{hardware}</plugin>'
        "</hardware></ros2_control></robot>"
    )
    for target in wrong:
        assert {f.code for f in lint(tmp_path, target=target)} == {"C709"}
    for target in right:
        assert "C709" not in {f.code for f in lint(tmp_path, target=target)}


if __name__ == "__main__":
    for parameter in files("bad"):
        bad: Path = parameter.values[0]
        os.chdir(bad.parent)
        Path(f"findings.{bad.name}.txt").write_text(report(found_in(bad)))
