"""Packages of a workspace that belong to none of its robots, such as the navigation of a robot of another workspace."""

from collections.abc import Iterable
from pathlib import Path

from urdfkit.description.packages.discovery import packages_below
from urdfkit.description.packages.related_files import (
    dependencies_in,
    manifest,
    neighbours,
    package_of,
    packages_around,
)


def unrelated_packages(folder: Path, robots: Iterable[Path]) -> list[Path]:
    """Return the packages in a folder without files that the check of a robot reads, sorted.

    Args:
        folder: the folder.
        robots: the descriptions that are checked.
    """
    below = [path for path in packages_below(folder).values() if (path / "package.xml").is_file()]
    own = dict.fromkeys(package_of(robot) for robot in robots)
    read: set[Path] = set()
    near: dict[Path, dict[str, Path]] = {}
    needed: dict[Path, dict[str, set[str]]] = {}
    for package in own:
        if package is None:
            continue
        place = package.parent
        if place not in near:
            near[place] = neighbours(package)
            needed[place] = {name: dependencies_in(manifest(one)) for name, one in near[place].items()}
        read.update((package, *packages_around(package, near[place], needed[place])))
    return sorted(path for path in below if path.absolute() not in read)
