"""Changes to files that are there, and new files beside them: all of them or none."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.atomic import write_bytes
from urdfkit.errors import ResourceError


@dataclass(frozen=True, slots=True)
class Alteration:
    """What a file is to hold.

    Attributes:
        path: the file.
        before: its bytes as they were read; None: it is not there, and has not been when it is written.
        after: its bytes as they are to be.
    """

    path: Path
    before: bytes | None
    after: bytes

    def diff(self) -> str:
        """Return the change as a unified diff."""
        from difflib import unified_diff

        old, new = ((content or b"").decode("utf-8", "replace") for content in (self.before, self.after))
        shown = self.path.as_posix()
        lines = unified_diff(
            old.splitlines(keepends=True),
            new.splitlines(keepends=True),
            shown if self.before is not None else "/dev/null",
            shown,
        )
        return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines)


def write_all(alterations: Sequence[Alteration]) -> None:
    """Write files; where one cannot be written, those before it are put back as they were.

    Args:
        alterations: what to write, in this order.

    Raises:
        ResourceError: a file was changed or made since it was looked at, or cannot be written.
    """
    for alteration in alterations:
        _check(alteration)
    done: list[Alteration] = []
    try:
        for alteration in alterations:
            alteration.path.parent.mkdir(parents=True, exist_ok=True)
            write_bytes(alteration.path, alteration.after)
            done.append(alteration)
    except BaseException as error:
        for alteration in reversed(done):
            if alteration.before is None:
                alteration.path.unlink(missing_ok=True)
            else:
                write_bytes(alteration.path, alteration.before)
        if isinstance(error, OSError):
            raise ResourceError(f"cannot write {error.filename}: {error.strerror}; nothing was changed") from error
        raise


def _check(alteration: Alteration) -> None:
    path = alteration.path
    try:
        now = path.read_bytes() if path.exists() else None
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error
    if now != alteration.before:
        what = "is already there" if alteration.before is None else "was changed meanwhile"
        raise ResourceError(f"{path} {what}; nothing was changed")


def texts(alterations: Sequence[Alteration]) -> Iterator[tuple[str, str]]:
    """Yield absolute path and text of each file as it is to be.

    Args:
        alterations: of files in UTF-8.
    """
    for alteration in alterations:
        yield str(alteration.path.absolute()), alteration.after.decode("utf-8", "replace").replace("\r\n", "\n")
