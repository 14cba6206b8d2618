"""A package.xml that cannot be read is a finding, and the robots of its package are linted."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

GOOD = "<package><name>p</name><version>0.0.1</version></package>"


@pytest.mark.parametrize(
    ("text", "line"),
    [("<package>\n<name>p</name>\n<version>0.0.1\n</package>\n", 4), ("", 1), ("  \n", 1), ("nothing", 1)],
)
def test_a_manifest_that_is_no_xml_is_told_in_its_place(tmp_path, monkeypatch, text, line):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text(text)
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf" / "r.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    (found,) = lint(tmp_path)
    assert (found.code, found.severity, found.file, found.line) == ("K964", "error", "package.xml", line)
    (tmp_path / "package.xml").write_text(GOOD)
    assert lint(tmp_path) == []


def manifest(name: str, *needed: str) -> str:
    depends = "".join(f"<exec_depend>{each}</exec_depend>" for each in needed)
    people = '<maintainer email="a@example.com">A</maintainer><license>MIT</license>'
    build = "<buildtool_depend>ament_cmake</buildtool_depend>"
    return (
        f'<package format="3"><name>{name}</name><version>0.0.1</version><description>d</description>'
        f"{people}{build}{depends}<export><build_type>ament_cmake</build_type></export></package>"
    )


def test_a_dependency_on_the_package_itself_stands_for_the_missing_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    packages = {
        "arm_description": manifest("arm_description"),
        "arm_gazebo": manifest("arm_gazebo", "arm_description"),
        "arm_bringup": manifest("arm_bringup", "arm_bringup", "arm_description"),
    }
    for name, text in packages.items():
        (tmp_path / name / "launch").mkdir(parents=True)
        (tmp_path / name / "package.xml").write_text(text)
    (tmp_path / "arm_description" / "arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>')
    launch = '<launch><include file="$(find-pkg-share arm_gazebo)/launch/world.launch.xml"/></launch>'
    (tmp_path / "arm_bringup" / "launch" / "arm.launch.xml").write_text(launch)
    (tmp_path / "arm_gazebo" / "launch" / "world.launch.xml").write_text("<launch/>")
    found = [(each.code, each.message) for each in lint(tmp_path) if each.file.endswith("bringup/package.xml")]
    assert found == [("K972", "package `arm_bringup` depends on itself")]
    assert "K956" not in {each.code for each in lint(tmp_path)}
    (tmp_path / "arm_bringup" / "package.xml").write_text(manifest("arm_bringup", "arm_description"))
    assert "missing dependency on `arm_gazebo`" in {each.message for each in lint(tmp_path)}
