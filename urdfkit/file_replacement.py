"""Replacement of several files, all or none: contents are prepared in a folder first, and old ones kept there."""

from __future__ import annotations

import errno
import shutil
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from urdfkit.errors import ResourceError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Protocol

    class Replacement(Protocol):
        """New content of a file: `path`, its bytes `before` (None: a new file) and `after`."""

        @property
        def path(self) -> Path: ...  # noqa: D102
        @property
        def before(self) -> bytes | None: ...  # noqa: D102
        @property
        def after(self) -> bytes: ...  # noqa: D102


CONTENTS = ".urdfkit-files"
"""Folder in a temporary folder with the old and new contents of files to replace."""

_LIST = "list"
"""File in that folder with a row for each file, for `restore_files`: digest before, digest after, path."""


def read_bytes(path: Path) -> bytes:
    """Return the content of a file.

    Raises:
        ResourceError: it cannot be read.
    """
    try:
        return path.read_bytes()
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error


def check_unchanged(changes: Sequence[Replacement]) -> None:
    """Raise if a file is not as it was read.

    Args:
        changes: the files.

    Raises:
        ResourceError: a file was changed or created, or cannot be read.
    """
    for change in changes:
        now = read_bytes(change.path) if change.path.exists() else None
        if now != change.before:
            problem = "already exists" if change.before is None else "was changed in the meantime"
            raise ResourceError(f"{change.path} {problem}; nothing was changed")


def replace_files(changes: Sequence[Replacement], staged: Path) -> None:
    """Write files in two steps: all contents into `staged`, then each into its place; if one fails, none is changed.

    After a kill, `restore_files` restores the old contents from `staged`.

    Args:
        changes: the files, in the order of writing.
        staged: an existing folder.

    Raises:
        ResourceError: a file cannot be written.
    """
    made: list[Path] = []
    try:
        (staged / CONTENTS).mkdir()
        for number, change in enumerate(changes):
            path = change.path
            made += [parent for parent in path.parents if not parent.exists()]
            path.parent.mkdir(parents=True, exist_ok=True)
            new = staged / CONTENTS / f"{number}.new"
            new.write_bytes(change.after)
            if change.before is not None:
                shutil.copy2(path, staged / CONTENTS / f"{number}.old")
                new.chmod(path.stat().st_mode & 0o7777)
        rows = [f"{_digest(each.before)} {_digest(each.after)} {each.path.resolve()}" for each in changes]
        write_list(staged / CONTENTS / _LIST, rows)
        for number, change in enumerate(changes):
            path = change.path
            _move(staged / CONTENTS / f"{number}.new", path.resolve())
    except BaseException as error:
        restore_files(staged)
        for parent in made:
            with suppress(OSError):  # not empty
                parent.rmdir()
        if isinstance(error, OSError):
            raise ResourceError(f"cannot write {path}: {error.strerror}; nothing was changed") from error
        raise


def write_list(path: Path, rows: Sequence[str]) -> None:
    """Write rows into a file that exists only when it is complete.

    Args:
        path: the file.
        rows: without line ends.

    Raises:
        OSError: it cannot be written.
    """
    part = path.with_name(f"{path.name}.part")
    part.write_text("\n".join(rows), encoding="utf-8", errors="surrogateescape")
    part.rename(path)


def _move(source: Path, target: Path) -> None:
    """Move a file in one step; between file systems, a copy of it next to the target."""
    try:
        source.replace(target)
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
        with tempfile.TemporaryDirectory(prefix=".urdfkit-", dir=target.parent) as folder:
            shutil.copy2(source, Path(folder) / source.name)
            (Path(folder) / source.name).replace(target)


def _digest(content: bytes | None) -> str:
    from hashlib import sha256

    return "-" if content is None else sha256(content).hexdigest()


def restore_files(staged: Path) -> None:
    """Restore the files of an unfinished replacement, unless one of them was edited since.

    The replacement is finished when all files are new and nothing else is left in `staged`.

    Args:
        staged: the folder given to `replace_files`.

    Raises:
        OSError: a file cannot be read or written.
    """
    if not (staged / CONTENTS / _LIST).is_file():
        return
    text = (staged / CONTENTS / _LIST).read_text(encoding="utf-8", errors="surrogateescape")
    rows = [row.split(" ", 2) for row in text.split("\n") if row]
    now = [_digest(Path(path).read_bytes() if Path(path).is_file() else None) for _, _, path in rows]
    is_finished = all(child.name.startswith(".urdfkit-") for child in staged.iterdir()) and all(
        digest == after for digest, (_, after, _) in zip(now, rows, strict=True)
    )
    is_edited = any(digest not in (before, after) for digest, (before, after, _) in zip(now, rows, strict=True))
    if is_finished or is_edited:
        return
    for number, (digest, (before, _, path)) in enumerate(zip(now, rows, strict=True)):
        if digest != before and before == "-":
            Path(path).unlink()
        elif digest != before:
            _move(staged / CONTENTS / f"{number}.old", Path(path))
