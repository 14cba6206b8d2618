"""Texts of the code and other files of a package that no reader of urdfkit parses."""

import ast
import os
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.kept_files import kept
from urdfkit.description.packages.related_files import LAUNCH

CPP = (".cpp", ".cc", ".cxx", ".hpp", ".h")
"""Endings of the names of files in C++."""

MAX_BYTES = 500_000
"""Largest size of a file whose text is read."""


def node_texts(folder: Path) -> Iterator[tuple[Path, str]]:
    """Yield the files of a package in Python and C++, except launch files, with their texts; see `code_texts`."""
    return code_texts(folder, (".py", *CPP), LAUNCH)


def code_texts(folder: Path, endings: tuple[str, ...], without: tuple[str, ...] = ()) -> Iterator[tuple[Path, str]]:
    """Yield the files in a folder that end so and can be read, with their texts, in the order of their names.

    Hidden folders, symbolic links and files larger than `MAX_BYTES` are ignored.

    Args:
        folder: a package.
        endings: endings of the names of files.
        without: endings of the names of files that are ignored.
    """
    for place, names in _names(folder):
        for name in names:
            if name.endswith(endings) and not name.endswith(without):
                path = Path(place, name)
                if (text := _text(path)) is not None:
                    yield path, text


@kept
def _names(folder: Path) -> list[tuple[str, list[str]]]:
    """Return a folder and those in it, each with the names of its files."""
    found = []
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        found.append((place, sorted(files)))
    return found


@kept
def _text(path: Path) -> str | None:
    """Return the text of a file; None for symbolic links, large files and files that cannot be read."""
    try:
        is_read = not path.is_symlink() and path.is_file() and path.stat().st_size <= MAX_BYTES
        return path.read_text("utf-8", "replace") if is_read else None
    except OSError:
        return None


def python_tree(text: str) -> ast.Module | None:
    """Return the syntax tree of a module; None if it has a syntax error or is nested too deeply."""
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
