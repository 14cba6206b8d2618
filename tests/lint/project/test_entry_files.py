"""What is linted for what is named: a part with the robots that include it, wherever these lie."""

from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.lint import lint
from urdfkit.lint.project.entry_files import find_entries

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
PART = f"""<robot {XACRO}>
  <link name="laser"/>
  <joint name="laser_joint" type="fixed"><parent link="base"/><child link="laser"/></joint>
  <xacro:include filename="frame.xacro"/>
</robot>
"""
FRAME = PART.replace("laser", "frame").replace("base", "laser").replace('<xacro:include filename="frame.xacro"/>', "")


def robot(*includes: str) -> str:
    lines = "".join(f'  <xacro:include filename="{include}"/>\n' for include in includes)
    return f'<robot name="r" {XACRO}>\n  <link name="base"/>\n{lines}</robot>\n'


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "sensors").mkdir()
    (tmp_path / "sensors" / "laser.xacro").write_text(PART)
    (tmp_path / "sensors" / "frame.xacro").write_text(FRAME)
    (tmp_path / "r.urdf.xacro").write_text(robot("sensors/laser.xacro"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_parts_without_a_package_are_linted_with_their_robot(folder, capsys):
    named = ["r.urdf.xacro", "sensors/laser.xacro", "sensors/frame.xacro"]
    assert main(["lint", "--quiet", *named]) == 0, capsys.readouterr().out
    assert [entry.path for entry in find_entries(named)] == [Path("r.urdf.xacro")] * 3
    (folder / "sensors" / "laser.xacro").write_text(PART.replace('"base"', '"bass"'))
    assert main(["lint", "--quiet", "sensors/laser.xacro"]) == 1
    assert "bass" in capsys.readouterr().out


def test_a_part_that_nothing_includes_stays_by_itself(folder, capsys):
    (folder / "r.urdf.xacro").write_text(robot())
    assert main(["lint", "--quiet", "sensors/laser.xacro"]) == 1
    assert find_entries(["sensors/laser.xacro"])[0].path == Path("sensors/laser.xacro")


@pytest.mark.parametrize("has_package", [True, False])
@pytest.mark.parametrize("ending", [".new", ".new.2"])
def test_what_waits_to_be_merged_includes_its_parts(folder, capsys, has_package, ending):
    (folder / "r.urdf.xacro").write_text(robot())
    (folder / f"r.urdf.xacro{ending}").write_text(robot("sensors/laser.xacro"))
    if has_package:
        (folder / "package.xml").write_text("<package><name>p</name></package>")
    for named in (["."], ["r.urdf.xacro", "sensors/laser.xacro", "sensors/frame.xacro"]):
        assert main(["lint", "--quiet", "--select", "X,T,J", *named]) == 0, capsys.readouterr().out
    (folder / f"r.urdf.xacro{ending}").unlink()
    capsys.readouterr()
    # The fragment alone: an error, or a note if the package defines its parent link elsewhere.
    assert main(["lint", "--quiet", "--select", "X,T,J", "."]) == (0 if has_package else 1)
    assert "T201" in capsys.readouterr().out


PARTS = {
    "package.xml": "<package><name>arm_description</name></package>",
    "urdf/arm.urdf.xacro": '<robot name="arm"><xacro:include filename="{}"/><link name="base"/></robot>',
    "urdf/chain.xacro": '<robot><xacro:tube name="upper" length="${reach}"/><link name="a"/></robot>',
    "urdf/tube.xacro": '<robot><xacro:macro name="tube" params="name"><link name="b"/></xacro:macro></robot>',
}


@pytest.mark.parametrize(
    ("include", "is_reached"),
    [
        ("parts.xacro", False),
        ("$(find arm_description)/urdf/parts.xacro", False),
        ("$(find gripper_description)/urdf/parts.xacro", True),
        ("$(find arm_description)/urdf/arm.gazebo", True),
    ],
)
def test_parts_that_a_missing_file_may_include_are_not_linted_by_themselves(tmp_path, include, is_reached):
    for name, text in PARTS.items():
        path = tmp_path / "arm_description" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.replace("{}", include))
    found = {entry.path.name: entry.is_library for entry in find_entries([tmp_path])}
    assert found == {"arm.urdf.xacro": False, "tube.xacro": True, **({"chain.xacro": False} if is_reached else {})}


@pytest.mark.parametrize(("name", "codes"), [("", set()), (' name="chain"', {"X103"})])
def test_a_part_that_uses_macros_of_its_robot_lacks_none(tmp_path, name, codes):
    for file, text in PARTS.items():
        path = tmp_path / "arm_description" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        text = text.replace("{}", "tube.xacro").replace(' length="${reach}"', "").replace("<robot>", f"<robot{name}>")
        path.write_text(text.replace("<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'))
    assert {finding.code for finding in lint(tmp_path) if finding.code.startswith("X")} == codes
