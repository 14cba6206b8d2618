"""Robots of the package robot_descriptions, from a package and a cache that the test writes."""

from __future__ import annotations

from pathlib import Path

import pytest

import urdfkit
from urdfkit.errors import ResourceError
from urdfkit.resources import find_model

MODULE = """
from os import getenv as _getenv
from os import path as _path
from ._cache import clone_to_cache as _clone_to_cache
raise RuntimeError("imported")
REPOSITORY_PATH: str = _clone_to_cache("example-robot-data", commit=_getenv("ROBOT_DESCRIPTION_COMMIT", None))
PACKAGE_PATH: str = _path.join(REPOSITORY_PATH, "robots", "toy_description")
"""
REPOSITORIES = """
REPOSITORIES: Dict[str, Repository] = {
    "example-robot-data": Repository(url="https://nowhere.invalid/x.git", commit="1", cache_path="example_data"),
}
"""


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Write the package with three robots, and return the folder of its cache."""
    package = tmp_path / "site" / "robot_descriptions"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("raise RuntimeError('imported')")
    (package / "_repositories.py").write_text(REPOSITORIES)
    urdf = 'URDF_PATH: str = _path.join(PACKAGE_PATH, "urdf", "toy.urdf")\n'
    xacro = 'XACRO_PATH = _path.join(PACKAGE_PATH, "toy.urdf.xacro")\nXACRO_ARGS = {"name": "toy_x"}\n'
    (package / "toy_description.py").write_text(MODULE + urdf)
    (package / "toyx_description.py").write_text(MODULE + xacro)
    (package / "toy_mj_description.py").write_text(MODULE + 'MJCF_PATH = _path.join(PACKAGE_PATH, "toy.xml")\n')
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    monkeypatch.setenv("ROBOT_DESCRIPTIONS_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("ROBOT_DESCRIPTION_COMMIT", raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "cache"


def fill(cache: Path, folder: str = "example_data") -> Path:
    home = cache / folder / "robots" / "toy_description"
    (home / "urdf").mkdir(parents=True)
    (home / "urdf" / "toy.urdf").write_text('<robot name="toy"><link name="base"/></robot>')
    (home / "toy.urdf.xacro").write_text('<robot name="toy"><link name="$(arg name)"/></robot>')
    return home


def test_a_robot_of_the_cache(cache: Path) -> None:
    home = fill(cache)
    assert find_model(["toy_description"]).path == home / "urdf" / "toy.urdf"
    assert urdfkit.load("toy_description").name == "toy"


def test_xacro_arguments_of_the_module(cache: Path) -> None:
    fill(cache)
    assert find_model(["toyx_description"]).arguments == {"name": "toy_x"}
    assert [link.name for link in urdfkit.load("toyx_description").links] == ["toy_x"]
    assert find_model(["toyx_description", "name:=other"]).arguments == {"name": "other"}


def test_the_commit_of_the_environment(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    home = fill(cache, "example_data-abc/example_data")
    monkeypatch.setenv("ROBOT_DESCRIPTION_COMMIT", "abc")
    assert find_model(["toy_description"]).path == home / "urdf" / "toy.urdf"


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("toy_description", "download it with `python -m robot_descriptions pull toy_description`"),
        ("toy_mj_description", "`toy_mj_description` of robot_descriptions has no URDF"),
        ("tpy_description", "no robot `tpy_description` in the package robot_descriptions; did you mean"),
    ],
)
def test_robots_that_are_not_in_the_cache(cache: Path, name: str, message: str) -> None:
    with pytest.raises(ResourceError, match=message):
        find_model([name])


def test_without_the_package_one_line_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("urdfkit.robot_descriptions_cache.find_spec", lambda name: None)
    with pytest.raises(ResourceError, match="`pip install robot_descriptions`"):
        find_model(["panda_description"])
    with pytest.raises(ResourceError, match=r"pull panda_description`; did you mean `panda_description`\?"):
        find_model(["panda_descripton"])


def test_a_misspelt_end_of_a_name_is_compared_with_all_robots(cache: Path) -> None:
    with pytest.raises(ResourceError, match=r"pull toy_description`; did you mean `toy_description`\?"):
        find_model(["tpy_descripton"])
