"""Which files that are to go are named in files that stay."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path, PurePosixPath

_READ = {
    ".cmake",
    ".dsv",
    ".launch",
    ".py",
    ".rviz",
    ".sdf",
    ".txt",
    ".urdf",
    ".world",
    ".xacro",
    ".xml",
    ".yaml",
    ".yml",
}
"""What names other files of a package so that it does not work without them."""
_LARGEST = 1_000_000
"""A file of more bytes than that is data."""


def needed(gone: Sequence[Path], folder: Path, ours: Collection[Path]) -> dict[Path, Path]:
    """Return what is to go and yet is named in what stays, and by which file.

    What is named by what is needed is needed, too. Of a package of which all is to go, all is needed where its name is.

    Args:
        gone: what is to go, from `folder`.
        folder: of the packages.
        ours: what goes, or is as the template has it: it names nothing that the template does not make.
    """
    tops = {path.parts[0] for path in gone}
    staying = {path: _text(folder / path) for path in _files(folder, tops) if path not in ours}
    whole = tops - {path.parts[0] for path in staying} - {path.parts[0] for path in set(ours) - set(gone)}
    found: dict[Path, Path] = {}
    fresh = staying
    while fresh:
        named = {
            path: by
            for path in gone
            if path not in found
            and (by := next((by for by, text in fresh.items() if _names(by, text, path, whole)), None)) is not None
        }
        found |= named
        fresh = {path: _text(folder / path) for path in named}
    return found


def _names(by: Path, text: str, path: Path, whole: Collection[str]) -> bool:
    """Whether a file names another: from its own folder, from the package's, in quotes, or the package it is all of."""
    if by == path or not text:
        return False
    if path.parts[0] in whole:
        return by.parts[0] != path.parts[0] and _has(text, path.parts[0])
    here = PurePosixPath(os.path.relpath(path, by.parent)).as_posix()
    if path.parts[0] == by.parts[0] and not here.startswith("../") and _has(text, here):
        return True
    inside = "/".join(path.parts[1:])
    return (len(path.parts) > 2 and _has(text, inside)) or f'"{path.name}"' in text or f"'{path.name}'" in text


def _has(text: str, name: str) -> bool:
    return re.search(rf"(?<![\w.-]){re.escape(name)}(?![\w-])", text) is not None


def _files(folder: Path, tops: Collection[str]) -> Iterator[Path]:
    """Yield the files of packages that something is to go from, and of those beside them, from `folder`."""
    for top in sorted(folder.iterdir()):
        if top.name.startswith(".") or not (top.name in tops or (top / "package.xml").is_file()):
            continue
        for path in sorted(top.rglob("*")):
            if path.suffix in _READ and path.is_file():
                yield path.relative_to(folder)


def _text(path: Path) -> str:
    try:
        if path.suffix not in _READ or path.stat().st_size > _LARGEST:
            return ""
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return re.sub(r"(?s)<!--.*?-->", "", text)
