"""Texts of the code and other files of a package that no reader of urdfkit parses."""

import ast
import os
from collections.abc import Iterator
from pathlib import Path

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
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(files):
            path = Path(place, name)
            if not name.endswith(endings) or name.endswith(without) or path.is_symlink() or not path.is_file():
                continue
            try:
                if path.stat().st_size <= MAX_BYTES:
                    yield path, path.read_text("utf-8", "replace")
            except OSError:
                continue


def python_tree(text: str) -> ast.Module | None:
    """Return the syntax tree of a module; None if it has a syntax error or is nested too deeply."""
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
