"""Findings in the viewer: what the page gets, and mending one of them."""

from pathlib import Path

import pytest

from tests.cli.lab import TWINS
from urdfkit.app.viewer.findings_panel import FindingsPanel
from urdfkit.description import load
from urdfkit.errors import ResourceError, UsageError
from urdfkit.resources import find_model

ROBOT = """<robot name="lab">
  <link name="base"/>
  <link name="mast"><inertial><mass value="1"/>
    <inertia ixx="0.4" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="mast"/>
    <axis xyz="0 0 2"/> <!-- b\u00e4r -->\r
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"""


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "lab.urdf"
    path.write_bytes(ROBOT.encode("latin-1"))  # bytes that are no UTF-8, and one line that ends in CR LF
    return path


def look(path: Path, **options) -> tuple[FindingsPanel, dict[str, dict]]:
    findings = FindingsPanel(find_model([str(path)]), **options)
    return findings, {row["code"]: row for row in findings.lint()["findings"]}


def test_a_row_has_the_lines_the_place_the_rule_and_the_fix(robot: Path) -> None:
    findings, rows = look(robot)
    row = rows["J412"]
    assert (row["joint"], row["line"], row["severity"]) == ("turn", 6, "warning")
    assert row["lines"][0].strip().startswith('<axis xyz="0 0 2"/>')
    assert row["fix"]["title"] == "Normalise the axis"
    assert [line[0] for line in row["fix"]["diff"]] == ["@", "-", "+"]
    assert 'xyz="0 0 1"' in row["fix"]["diff"][2]
    assert row["fix"]["may"]
    assert rows["I503"]["link"] == "mast"
    rules = findings.lint()["rules"]
    assert rules["J412"].startswith("# ")
    assert set(rules) == set(rows)


def test_one_fix_changes_its_line_and_no_other_byte(robot: Path) -> None:
    before = robot.read_bytes()
    robot.chmod(0o640)
    findings, rows = look(robot)
    assert findings.apply_fix(rows["J412"]["number"]).startswith("J412: Normalise the axis, in ")
    assert robot.read_bytes() == before.replace(b'xyz="0 0 2"', b'xyz="0 0 1"')
    assert robot.stat().st_mode & 0o777 == 0o640
    assert list(robot.parent.iterdir()) == [robot]  # no temporary file is left
    assert "J412" not in {row["code"] for row in findings.lint()["findings"]}


def test_only_the_named_finding_is_fixed(tmp_path: Path) -> None:
    path = tmp_path / "two.urdf"
    path.write_text(ROBOT.replace("</robot>", """<link name="eye"/><joint name="look" type="continuous">
      <parent link="base"/><child link="eye"/><axis xyz="0 3 0"/></joint></robot>"""))  # fmt: skip
    findings = FindingsPanel(find_model([str(path)]))
    rows = [row for row in findings.lint()["findings"] if row["code"] == "J412"]
    assert [row["joint"] for row in rows] == ["turn", "look"]
    findings.apply_fix(rows[1]["number"])
    assert 'xyz="0 1 0"' in path.read_text()
    assert 'xyz="0 0 2"' in path.read_text()


@pytest.mark.parametrize("nth", range(4))
def test_one_of_several_equal_findings_is_fixed(tmp_path: Path, nth: int) -> None:
    path = tmp_path / "two.urdf.xacro"
    path.write_text(TWINS)
    findings = FindingsPanel(find_model([str(path)]))
    rows = [row for row in findings.lint()["findings"] if row["code"] == "E024"]
    assert len(rows) == 4
    assert len({row["message"] for row in rows}) == 1
    findings.apply_fix(rows[nth]["number"])
    before, after = TWINS.splitlines(), path.read_text().splitlines()
    assert [line for line, (old, new) in enumerate(zip(before, after, strict=True), 1) if old != new] == [
        rows[nth]["line"]
    ]


def test_a_finding_in_the_text_lists_its_links_and_joints(tmp_path: Path) -> None:
    path = tmp_path / "two.urdf.xacro"
    path.write_text(TWINS)
    findings = FindingsPanel(find_model([str(path)]))
    rows = [row for row in findings.lint(load(path))["findings"] if row["code"] == "E024"]
    assert [row["about"] for row in rows] == [
        [{"link": "a"}],
        [{"link": "b"}],
        [{"joint": "j"}],
        [{"link": "wheel_left"}, {"link": "wheel_right"}],
    ]
    assert [[(call["macro"], call["line"]) for call in chain] for chain in rows[3]["chains"]] == [
        [("wheel", 10)],
        [("wheel", 11)],
    ]
    assert rows[0]["chains"] == []


@pytest.mark.parametrize("number", [0, -1, 99, 10**9])
def test_an_unknown_number_of_a_fix_is_rejected(robot: Path, number: int) -> None:
    findings, _ = look(robot)
    with pytest.raises(UsageError, match="outdated"):
        findings.apply_fix(number)


def test_the_number_of_a_fix_from_an_earlier_check_is_rejected(robot: Path) -> None:
    findings, rows = look(robot)
    findings.lint()
    with pytest.raises(UsageError, match="outdated"):
        findings.apply_fix(rows["J412"]["number"])


def test_what_has_no_safe_fix_is_refused_and_nothing_is_written(robot: Path) -> None:
    before = robot.read_bytes()
    findings, rows = look(robot)
    with pytest.raises(UsageError, match="no safe fix"):
        findings.apply_fix(rows["I503"]["number"])
    assert robot.read_bytes() == before


def test_a_file_that_has_changed_is_not_written(robot: Path) -> None:
    findings, rows = look(robot)
    robot.write_text(robot.read_text("latin-1").replace("0 0 2", "0 0 1"))
    before = robot.read_bytes()
    with pytest.raises(ResourceError, match="no longer occurs"):
        findings.apply_fix(rows["J412"]["number"])
    assert robot.read_bytes() == before


def test_who_may_not_write_does_not(robot: Path) -> None:
    before = robot.read_bytes()
    findings, rows = look(robot, may_write=False)
    assert not rows["J412"]["fix"]["may"]
    with pytest.raises(UsageError, match="cannot change files"):
        findings.apply_fix(rows["J412"]["number"])
    assert robot.read_bytes() == before


def test_a_file_that_cannot_be_read_is_a_fault_and_no_error(robot: Path) -> None:
    findings, _ = look(robot)
    robot.unlink()
    found = findings.lint()
    assert found["findings"] == []
    assert "lab.urdf" in found["fault"]


def test_the_settings_of_the_project_hold_here_too(robot: Path) -> None:
    (robot.parent / "urdfkit.toml").write_text('ignore = ["I5"]\n[per-file-ignores]\n"*.urdf" = ["J412"]\n')
    _, rows = look(robot)
    assert not {"J412", "I503"} & set(rows)
    (robot.parent / "urdfkit.toml").write_text("nonsense = 1\n")
    findings, rows = look(robot)
    assert rows == {}
    assert "nonsense" in findings.lint()["fault"]


def test_findings_are_those_of_the_linter() -> None:
    from urdfkit.lint import lint

    for name in ("artoo", "simpleton"):
        model = find_model([name])
        assert FindingsPanel(model).lint()["findings"] == []  # linted for what its package is built for
    assert lint(model.path) == []
