"""Paths with a name that no file can have, and in folders that may not be searched."""

from pathlib import Path

import pytest

from urdfkit.description.control.ros1_launch import read_launch
from urdfkit.description.packages.existence import exists, is_file, is_folder
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.packages.similar_names import in_any_case, near_path
from urdfkit.description.sdf import load_world
from urdfkit.errors import ResourceError
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

LONG = "x" * 300
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
MESH = '<link name="a"><visual><geometry><mesh filename="%s"/></geometry></visual></link>'


@pytest.mark.parametrize("name", [LONG, f"{LONG}/a", f"a/{LONG}", "a\0b"])
def test_no_file_has_the_name(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    assert (is_file(path), is_folder(path), exists(path)) == (False, False, False)
    assert near_path(path) == ""
    assert in_any_case(path) is None


def test_a_file_and_a_folder_exist(tmp_path: Path) -> None:
    assert (is_file(tmp_path), is_folder(tmp_path), exists(tmp_path)) == (False, True, True)
    assert (is_file(__file__), is_folder(__file__), exists(__file__)) == (True, False, True)


@pytest.mark.parametrize(
    ("element", "code"),
    [
        (f'<xacro:include filename="{LONG}/a.xacro"/>', "X113"),
        (f'<xacro:include filename="$(find p)/{LONG}/a.xacro"/>', "X113"),
        (MESH % f"package://p/{LONG}/a.stl", ""),
        (MESH % f"{LONG}/a%20.stl", ""),
        (f"<gazebo><plugin name='a' filename='liba.so'><parameters>/{LONG}</parameters></plugin></gazebo>", ""),
    ],
)
def test_linting_a_name_that_is_too_long(tmp_path: Path, element: str, code: str) -> None:
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    path = tmp_path / "r.urdf.xacro"
    path.write_text(f'<robot name="r" {XACRO}>{element}<link name="base"/></robot>')
    findings = run([Entry(path)], Options(guess_target=True)).findings
    assert [each.code for each in findings if each.code == code] == [code] * bool(code)


def test_a_world_with_a_name_that_is_too_long(tmp_path: Path) -> None:
    for uri in (f"model://{LONG}", f"model://a/{LONG}", f"{LONG}/model.sdf"):
        path = tmp_path / "w.sdf"
        path.write_text(f'<sdf version="1.9"><world name="w"><include><uri>{uri}</uri></include></world></sdf>')
        with pytest.raises(ResourceError, match="no model"):
            load_world(path)
    with pytest.raises(ResourceError, match="no such file"):
        load_world(f"{LONG}.sdf")


def test_a_launch_file_with_a_name_that_is_too_long(tmp_path: Path) -> None:
    path = tmp_path / "a.launch"
    path.write_text(f'<launch><rosparam file="{LONG}/a.yaml"/></launch>')
    assert read_launch(path, Packages([tmp_path], path)).settings is None
