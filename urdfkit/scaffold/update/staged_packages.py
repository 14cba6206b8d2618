"""Checks of an update: the updated packages are assembled in a temporary folder and compared with the current ones."""

import os
import shutil
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.scaffold.update.file_references import needed

_MODELS = (".urdf", ".xacro")


@dataclass(frozen=True, slots=True)
class PackageFault:
    """A fault of a result.

    Attributes:
        message: the problem, in one line.
        is_error: whether it is an error; otherwise it is a warning.
        file: name of the file; empty if the fault has no place.
        line: line in the file.
    """

    message: str
    is_error: bool = True
    file: str = ""
    line: int = 0

    def __str__(self) -> str:
        """Return the message with its place."""
        return f"{self.message} ({self.file}:{self.line})" if self.file else self.message


Checker = Callable[[Path], Sequence[PackageFault]]
"""Checks the rendered folder before it is moved into place; returns its faults."""


def worsened(
    check: Checker,
    folder: Path,
    staged: Path,
    tops: Collection[str],
    *,
    put: Iterable[Path],
    removed: Iterable[Path],
    added: Collection[Path] = (),
) -> tuple[list[PackageFault], list[Path]]:
    """Return the faults that a change would add, and the new model files that no other file refers to.

    A model file that nothing includes would be reported on its own, although it is not part of any model.

    Args:
        check: returns the faults of a folder.
        folder: the folder of the packages.
        staged: the folder with the new files, which also has room for temporary copies.
        tops: names of the packages' folders.
        put: files that replace or add files in `folder`.
        removed: files to remove.
        added: those of `put` that are not checked if no remaining file refers to them.
    """
    before, after = staged / ".before", staged / ".after"
    for place in (before, after):
        place.mkdir()
        for top in tops:
            if (folder / top).is_dir():
                shutil.copytree(folder / top, place / top, copy_function=link_or_copy, symlinks=True)
    for path in removed:
        (after / path).unlink(missing_ok=True)
    for path in put:
        (after / path).unlink(missing_ok=True)
        (after / path).parent.mkdir(parents=True, exist_ok=True)
        link_or_copy(str(staged / path), str(after / path))
    parts = sorted(path for path in added if path.suffix in _MODELS)
    used = needed(parts, after, set(parts)) if parts else {}
    unused = [path for path in parts if path not in used]
    for path in unused:
        (after / path).unlink()
    counts = Counter((fault.message, fault.file) for fault in check(before))
    new = []
    for fault in check(after):
        counts[fault.message, fault.file] -= 1
        if counts[fault.message, fault.file] < 0:
            new.append(fault)
    shutil.rmtree(before)
    shutil.rmtree(after)
    return new, unused


def link_or_copy(source: str, target: str) -> None:
    """Make `target` a hard link to `source`, or a copy where the file system has no links.

    Args:
        source: a file or a symbolic link, which is not followed.
        target: a path that does not exist.
    """
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:  # a file system without links
        shutil.copy2(source, target, follow_symlinks=False)
