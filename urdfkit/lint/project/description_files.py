"""The descriptions and fragments in a folder or near a file, with their texts without comments."""

import os
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.errors import ResourceError

SUFFIXES = (".urdf", ".xacro")
_SKIPPED = frozenset(("build", "install", "devel", "log", "node_modules", "__pycache__"))
_IGNORE_MARKS = frozenset(("CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"))
_MAX_DEPTH = 12
MAX_FILES = 200
"""Maximum number of files to search outside of a package."""
_MAX_BYTES = 10**7
"""Number of bytes in which the root element and the includes of a file are searched."""
_COMMENT = r"(?s)<!--.*?(?:-->|\Z)"  # an unclosed comment is scanned once


def walk(folder: Path, depth: int = 0) -> Iterator[Path]:
    """Yield the descriptions and fragments in a folder, sorted, without hidden, built and ignored folders."""
    try:
        with os.scandir(folder) as scan:
            children = sorted(scan, key=lambda child: child.name)
    except OSError:
        return
    if any(child.name in _IGNORE_MARKS for child in children):
        return
    for child in children:
        if child.is_dir(follow_symlinks=False):
            if depth < _MAX_DEPTH and child.name not in _SKIPPED and not child.name.startswith("."):
                yield from walk(folder / child.name, depth + 1)
        # A dangling symbolic link, such as an editor's lock file, is not a file.
        elif child.name.lower().endswith(SUFFIXES) and child.is_file():
            yield folder / child.name


def descriptions(folder: Path) -> Iterator[tuple[Path, str]]:
    """Yield every description and fragment in a folder with its text, without comments."""
    yield from ((path, text_of(path)) for path in walk(folder))


def near_descriptions(
    package: Path | None, path: Path, endings: tuple[str, ...] = (".xacro",)
) -> Iterator[tuple[Path, str]]:
    """Yield the descriptions of a package; without a package, those in the file's folder and its subfolders.

    Args:
        package: the package folder.
        path: a file, for descriptions without a package.
        endings: the file names without a package end like this.
    """
    if package is not None:
        yield from descriptions(package)
        return
    folder = path.absolute().parent
    patterns = (f"{place}*{end}" for end in endings for place in ("", "*/"))
    files = sorted(file for pattern in patterns for file in folder.glob(pattern) if file.is_file())
    yield from ((file, text_of(file)) for file in files[:MAX_FILES])


def text_of(path: Path) -> str:
    """Return the text of a file without comments."""
    text = written_text(path)
    return re.sub(_COMMENT, "", text) if "<!--" in text else text


def written_text(path: Path) -> str:
    """Return the text of a file as written; empty for a link that leads out of a confinement."""
    from urdfkit.description.xml.source import Source

    try:
        return Source.read(path, most=_MAX_BYTES).text
    except ResourceError as error:
        from urdfkit.description.packages.resolver import OUTSIDE

        if getattr(error.__cause__, "strerror", None) != OUTSIDE:
            raise
        return ""  # `Confinement` reports it
