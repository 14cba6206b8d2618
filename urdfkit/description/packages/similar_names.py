"""Suggestions for packages and files that do not exist: similar names, and paths in other letter case."""

import re
from collections.abc import Iterable
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file, is_folder
from urdfkit.errors import did_you_mean, may_suggest, nearest


def near_package(name: str, packages: Iterable[str]) -> str:
    """Return a did-you-mean hint for a package; a common last word (``_description``) does not count."""
    if not may_suggest():
        return ""
    stem, _, last = name.rpartition("_")
    parts = ((other, *other.rpartition("_")[::2]) for other in packages)
    return did_you_mean(name, [other for other, own, end in parts if end != last or nearest(stem, [own], cutoff=0.7)])


def near_path(path: Path, user: Path | None = None) -> str:
    """Return a did-you-mean hint for the first part of `path` that does not exist; see `similar_file`."""
    return Suggestion(similar_file(path, user=user))


def similar_file(path: Path, found: dict[Path, str | None] | None = None, user: Path | None = None) -> str | None:
    """Return the name that is similar to the first part of `path` that does not exist, ignoring case.

    A common suffix from the first dot on does not make two names similar, and only a folder stands for a folder.

    Args:
        path: a path that does not exist.
        found: earlier results by the first part that does not exist, to be used again; None to search again.
        user: the file that names the path, which cannot be meant.
    """
    if not may_suggest():
        return None
    missing, parent = path, path.parent
    while not is_folder(parent) and parent != parent.parent:
        missing, parent = parent, parent.parent
    if found is not None and missing in found:
        return found[missing]
    try:
        children = (child for child in parent.iterdir() if missing is path or child.is_dir())
        names = sorted(child.name for child in children if user is None or not _is_same(child, user))
    except OSError:
        return None
    stem = _stem(missing.name)
    written = [name for name in names if _letters(name) == _letters(missing.name)]
    near = nearest(missing.name, written or [name for name in names if nearest(stem, [_stem(name)]) is not None])
    if found is not None:
        found[missing] = near
    return near


def _is_same(path: Path, other: Path) -> bool:
    return path.name == other.name and path.absolute() == other.absolute()


def _letters(name: str) -> str:
    """Return a name without its separators: ``arm.gazebo.xacro`` and ``arm_gazebo.xacro`` are similar."""
    return re.sub(r"[\W_]", "", name).lower()


def _stem(name: str) -> str:
    return name.partition(".")[0] or name


def in_any_case(path: Path) -> Path | None:
    """Return the one existing file whose path differs in capital letters; None without one, or with several.

    Args:
        path: a path that does not exist.
    """
    missing: list[str] = []
    while not is_folder(path):
        if path == path.parent:
            return None
        missing.insert(0, path.name)
        path = path.parent
    for name in missing:
        try:
            found = [child for child in path.iterdir() if child.name.lower() == name.lower()]
        except OSError:
            return None
        exact = [child for child in found if child.name == name]
        if len(exact or found) != 1:
            return None
        path = (exact or found)[0]
    return path if is_file(path) else None
