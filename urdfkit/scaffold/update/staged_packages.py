"""Packages as they would be after an update: put together beside them, and looked at before anything is changed."""

from __future__ import annotations

import os
import re
import shutil
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.scaffold.update.file_references import needed

_LINE = re.compile(r":\d+\)$")
_MODELS = (".urdf", ".xacro")


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong with a result.

    Attributes:
        said: what, and where, in a line.
        is_error: whether it does not work so; otherwise it had better not be.
    """

    said: str
    is_error: bool = True

    def __str__(self) -> str:
        """Return what is wrong."""
        return self.said


Checker = Callable[[Path], Sequence[Fault]]
"""Looks at the rendered folder before it is moved into place; returns what is wrong with it."""


def worsened(
    check: Checker,
    folder: Path,
    stage: Path,
    tops: Collection[str],
    *,
    put: Iterable[Path],
    removed: Iterable[Path],
    added: Collection[Path] = (),
) -> tuple[list[Fault], list[Path]]:
    """Return what is wrong with packages after a change, and was not before; and what of it nothing uses yet.

    A part of a model that nothing includes is a mistake on its own, and none of the model.

    Args:
        check: says what is wrong.
        folder: of the packages.
        stage: holds what is put; there is room for copies in it.
        tops: the packages' folders.
        put: files that take the place of those in `folder`.
        removed: files that go.
        added: of what is put, what may be left out of the look where nothing that stays names it.
    """
    before, after = stage / ".before", stage / ".after"
    for place in (before, after):
        place.mkdir()
        for top in tops:
            if (folder / top).is_dir():
                shutil.copytree(folder / top, place / top, copy_function=_linked, symlinks=True)
    for path in removed:
        (after / path).unlink(missing_ok=True)
    for path in put:
        (after / path).unlink(missing_ok=True)
        (after / path).parent.mkdir(parents=True, exist_ok=True)
        _linked(str(stage / path), str(after / path))
    parts = sorted(path for path in added if path.suffix in _MODELS)
    used = needed(parts, after, set(parts)) if parts else {}
    unused = [path for path in parts if path not in used]
    for path in unused:
        (after / path).unlink()
    known = Counter(_known(fault) for fault in check(before))
    found = []
    for fault in check(after):
        known[_known(fault)] -= 1
        if known[_known(fault)] < 0:
            found.append(fault)
    shutil.rmtree(before)
    shutil.rmtree(after)
    return found, unused


def _known(fault: Fault) -> str:
    return _LINE.sub("", fault.said)


def _linked(source: str, target: str) -> None:
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:  # a file system without links
        shutil.copy2(source, target, follow_symlinks=False)
