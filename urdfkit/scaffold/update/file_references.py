"""Search for references to files that an update would remove."""

import os
import re
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path, PurePosixPath

_READ = frozenset(
    (
        *(".cmake", ".dsv", ".launch", ".py", ".rviz", ".sdf", ".txt", ".urdf", ".world", ".xacro", ".xml"),
        *(".yaml", ".yml"),
    )
)
"""Suffixes of files that may refer to other files of a package."""
_LARGEST = 1_000_000
"""Size limit [bytes]; larger files are data."""


def needed(removed: Sequence[Path], folder: Path, generated: Collection[Path]) -> dict[Path, Path]:
    """Return the files to remove that are still referenced, each with the file that refers to it.

    Files referenced by needed files are needed, too. If a whole package would be removed, a reference to its name makes
    all of its files needed.

    Args:
        removed: the files to remove, relative to `folder`.
        folder: the folder of the packages.
        generated: files that are removed or match the template, and therefore refer only to files of the template.
    """
    tops = {path.parts[0] for path in removed}
    staying = {path: _text(folder / path) for path in _files(folder, tops) if path not in generated}
    whole = tops - {path.parts[0] for path in staying} - {path.parts[0] for path in set(generated) - set(removed)}
    references: dict[Path, Path] = {}
    new = staying
    while new:
        named = {
            path: by
            for path in removed
            if path not in references
            and (by := next((by for by, text in new.items() if _names(by, text, path, whole)), None)) is not None
        }
        references |= named
        new = {path: _text(folder / path) for path in named}
    return references


def _names(by: Path, text: str, path: Path, whole: Collection[str]) -> bool:
    """Return whether a file refers to another by relative path, path in the package, quoted name, or package name."""
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
    """Yield the files of the affected packages and of other packages in the folder, relative to `folder`."""
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
