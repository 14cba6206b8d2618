"""Packages as they would be after an update: put together beside them, and looked at before anything is changed."""

from __future__ import annotations

import os
import re
import shutil
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from pathlib import Path

_LINE = re.compile(r":\d+\)$")


def worsened(
    check: Callable[[Path], Sequence[str]],
    folder: Path,
    stage: Path,
    tops: Collection[str],
    *,
    put: Iterable[Path],
    removed: Iterable[Path],
) -> list[str]:
    """Return what is wrong with packages after a change, and was not before.

    Args:
        check: says what is wrong, a line each.
        folder: of the packages.
        stage: holds what is put; there is room for copies in it.
        tops: the packages' folders.
        put: files that take the place of those in `folder`.
        removed: files that go.
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
    known = Counter(_LINE.sub("", line) for line in check(before))
    found = []
    for line in check(after):
        known[_LINE.sub("", line)] -= 1
        if known[_LINE.sub("", line)] < 0:
            found.append(line)
    shutil.rmtree(before)
    shutil.rmtree(after)
    return found


def _linked(source: str, target: str) -> None:
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:  # a file system without links
        shutil.copy2(source, target, follow_symlinks=False)
