"""Launch files and YAML of a package and of its neighbours, and how far they are searched for."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.packages.related_files import around, neighbours, package_of

Write = Callable[[str, str], Path]


def names(package: Path, root: Path) -> list[str]:
    """Return the names of the related files, without the package.xml that each of the packages has."""
    return [file.relative_to(root).as_posix() for file in around(package) if file.name != "package.xml"]


@pytest.fixture
def package(write: Write) -> Callable[..., Path]:
    def make(name: str, *dependencies: str) -> Path:
        needs = "".join(f"<exec_depend>{other}</exec_depend>" for other in dependencies)
        return write(f"src/{name}/package.xml", f"<package><name>{name}</name>{needs}</package>").parent.absolute()

    return make


Package = Callable[..., Path]


def test_which_files_and_folders_count(package: Package, write: Write) -> None:
    own = package("bot")
    for name in ("a.launch", "b.launch.xml", "c.launch.py", "d.launch.yaml", "config/e.yaml", "config/f.yml"):
        write(f"src/bot/{name}", "")
    for name in ("g.xml", "h.py", "build/i.yaml", "test/j.yaml", ".git/k.yaml", "config/yaml"):
        write(f"src/bot/{name}", "")
    write("src/bot/inner/package.xml", "<package/>")
    write("src/bot/inner/l.yaml", "")
    assert names(own, own) == [
        "a.launch",
        "b.launch.xml",
        "c.launch.py",
        "config/e.yaml",
        "config/f.yml",
        "d.launch.yaml",
    ]
    assert own / "package.xml" in around(own)


def test_folders_are_searched_to_a_depth_of_four(package: Package, write: Write) -> None:
    own = package("bot")
    for depth in range(7):
        write(f"src/bot/{'sub/' * depth}{depth}.yaml", "")
    assert [Path(name).name for name in names(own, own)] == ["0.yaml", "1.yaml", "2.yaml", "3.yaml", "4.yaml"]


def test_large_files_and_files_beyond_the_limit_are_left_out(package: Package, write: Write) -> None:
    own = package("bot")
    write("src/bot/a.yaml", "#" * 100_000)
    write("src/bot/b.yaml", "#" * 100_001)
    assert names(own, own) == ["a.yaml"]
    for number in range(205):
        write(f"src/bot/many/{number:03}.yaml", "")
    assert names(own, own)[-1] == "many/198.yaml"


def test_only_neighbours_that_depend_on_the_package_are_searched(package: Package, write: Write) -> None:
    own = package("bot")
    package("bot_bringup", "bot")
    package("other", "rclcpp")
    for name in ("bot", "bot_bringup", "other"):
        write(f"src/{name}/a.yaml", "")
    write("src/no_package/a.yaml", "")
    assert names(own, own.parent) == ["bot/a.yaml", "bot_bringup/a.yaml"]
    assert list(neighbours(own)) == ["bot", "bot_bringup", "other"]


def test_packages_named_after_the_robot_belong_to_it_unless_they_use_another_description(
    package: Package, write: Write
) -> None:
    own = package("bot_description")
    package("bot_navigation", "nav2_amcl")
    package("bot_arm", "nav2_amcl", "other_description")
    for name in ("bot_description", "bot_navigation", "bot_arm"):
        write(f"src/{name}/a.yaml", "")
    assert names(own, own.parent) == ["bot_description/a.yaml", "bot_navigation/a.yaml"]


def test_the_package_of_a_file_is_the_nearest_folder_with_a_manifest(package: Package, write: Write) -> None:
    own = package("bot")
    assert package_of(write("src/bot/urdf/arm/r.urdf", "")) == own
    assert package_of(write("src/r.urdf", "")) is None
