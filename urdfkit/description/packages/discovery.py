"""Find the packages below a folder, of a workspace and of an install prefix."""

import os
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.existence import is_file

_NAME = re.compile(r"<name>\s*([^<\s]+)\s*</name>")
_SKIPPED = {"build", "install", "devel", "log", "node_modules", "__pycache__", "site-packages"}
_IGNORE_MARKS = {"CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE", "NO_SUBMODULES"}
_WORKSPACE_MARKS = {".git", ".catkin_workspace", ".catkin_tools", ".colcon", ".hg", "colcon.meta"}
_MAX_DEPTH = 5
_MAX_FOLDERS = 5_000


def packages_below(top: Path) -> dict[str, Path]:
    """Return the packages in and below a folder, by name; does not search inside packages, like catkin and colcon."""
    found: dict[str, Path] = {}
    budget = _MAX_FOLDERS
    level = [top]
    for _ in range(_MAX_DEPTH + 1):
        below: list[Path] = []
        for folder in level:
            budget -= 1
            if budget < 0:
                break
            below += _enter(folder, found)
        level = below
    return found


def workspace(package: Path) -> Path | None:
    """Return the folder of the workspace's sources: ``src`` above the package, or the top of the repository."""
    for folder in package.parents[:6]:
        if folder == Path.home() or folder == folder.parent:
            return None
        if folder.name == "src":
            return folder
        if any((folder / mark).exists() for mark in _WORKSPACE_MARKS):
            return folder / "src" if (folder / "src").is_dir() else folder
    return None


def _enter(folder: Path, found: dict[str, Path]) -> list[Path]:
    """Add a folder that is a package, or return its subfolders to search."""
    try:
        with os.scandir(folder) as entries:
            children = sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return []
    names = {child.name for child in children}
    if names & _IGNORE_MARKS:
        return []
    if "package.xml" in names:
        found.setdefault(package_name(folder) or folder.name, folder)
        return []
    if "model.config" in names:
        found.setdefault(folder.name, folder)
        return []
    return [
        Path(child.path)
        for child in children
        if child.name not in _SKIPPED and not child.name.startswith(".") and child.is_dir(follow_symlinks=False)
    ]


def package_name(folder: Path) -> str | None:
    """Return the name in a folder's package.xml, the folder's name if it has none; None without a package.xml."""
    file = folder / "package.xml"
    try:
        if not is_file(file):
            return None
        manifest = file.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return None
    written = _NAME.search(manifest)
    return written[1] if written else folder.name


def share_folders(prefix: Path) -> list[Path]:
    """Return the share folders of an install prefix, merged or isolated (colcon)."""
    try:
        isolated = [child / "share" for child in sorted(prefix.iterdir()) if (child / "share").is_dir()]
    except OSError:
        return []
    return [share for share in (prefix / "share", *isolated) if share.is_dir()]


def fuel_models(cache: Path, name: str) -> Iterator[Path]:
    """Yield the folders of a model in a cache of Gazebo Fuel, the newest version first.

    Source: gz-fuel-tools 9, src/LocalCache.cc: SERVER/OWNER/models/NAME/VERSION, the name in lower case.
    """
    for spelling in dict.fromkeys((name.lower(), name)):
        versions = [each for each in cache.glob(f"*/*/models/{spelling}/*") if each.name.isdigit()]
        yield from sorted(versions, key=lambda each: -int(each.name))
