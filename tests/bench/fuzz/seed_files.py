"""Files to start from, and copies of their packages in which one file is changed."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from urdfkit.description.packages.related_files import package_of

ROOT = Path(__file__).parents[3]
OWN = (ROOT / "robots", ROOT / "urdfkit", ROOT / "templates", ROOT / "tests")
FOLDERS = (*OWN, ROOT.parent / "shared" / "corpus")
MAX_BYTES = 100_000


@cache
def seeds(*suffixes: str) -> list[Path]:
    """Return the files with one of these suffixes, the same for each process."""
    return sorted(
        path
        for folder in FOLDERS
        if folder.is_dir()
        for path in folder.rglob("*")
        if path.name.endswith(suffixes) and path.is_file() and 0 < path.stat().st_size < MAX_BYTES
    )


def text_of(path: Path) -> str:
    """Return the text of a file; bytes that are not UTF-8 are replaced."""
    return path.read_text("utf-8", "replace")


@cache
def files_read(path: Path) -> tuple[Path, ...]:
    """Return the files of its package that a description includes or reads, itself first."""
    from urdfkit.description.loading import load_repaired
    from urdfkit.errors import UrdfkitError

    try:
        read = load_repaired(path).files
    except UrdfkitError:
        read = ()
    top = _top(path)
    inside = {top / each.resolve().relative_to(top.resolve()) for each in map(Path, read) if _is_below(each, top)}
    return path, *sorted(each for each in inside - {path} if 0 < each.stat().st_size < MAX_BYTES)


def _is_below(path: Path, top: Path) -> bool:
    return path.is_file() and path.resolve().is_relative_to(top.resolve())


@cache
def _top(path: Path) -> Path:
    """Return the package of a file; its folder if it is in none."""
    return package_of(path) or path.parent


def with_changed(folder: Path, original: Path, changed: Path, content: bytes) -> Path:
    """Create a copy of the package of a file with one changed file; all other files are links to the originals.

    Returns:
        The path of `original` in the copy.
    """
    top = _top(original)
    place = folder / top.name
    place.mkdir()
    _link(top, place, changed.relative_to(top).parts)
    (place / changed.relative_to(top)).write_bytes(content)
    return place / original.relative_to(top)


def _link(source: Path, place: Path, way: tuple[str, ...]) -> None:
    """Link the entries of a folder, except for the way to the changed file, whose folders are created."""
    for entry in source.iterdir():
        if entry.name != way[0]:
            (place / entry.name).symlink_to(entry)
        elif len(way) > 1:
            (place / entry.name).mkdir()
            _link(entry, place / entry.name, way[1:])
