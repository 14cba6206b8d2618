"""Suggestions for packages and files that do not exist: similar names, and paths in other letter case."""

from collections.abc import Iterable
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file, is_folder
from urdfkit.errors import did_you_mean, may_suggest, nearest
from urdfkit.missing_files import similar_file


def near_package(name: str, packages: Iterable[str]) -> str:
    """Return a did-you-mean hint for a package; a common last word (``_description``) does not count."""
    if not may_suggest():
        return ""
    stem, _, last = name.rpartition("_")
    parts = ((other, *other.rpartition("_")[::2]) for other in packages)
    return did_you_mean(name, [other for other, own, end in parts if end != last or nearest(stem, [own], cutoff=0.7)])


def near_path(path: Path, user: Path | None = None) -> str:
    """Return a did-you-mean hint for the first part of `path` that does not exist; see `missing_files.similar_file`."""
    return Suggestion(similar_file(path, user=user))


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
