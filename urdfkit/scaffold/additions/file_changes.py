"""Changes to existing files and new files, written all or none."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.atomic import write_bytes
from urdfkit.errors import ResourceError


@dataclass(frozen=True, slots=True)
class Alteration:
    """New content of a file.

    Attributes:
        path: the file.
        before: its bytes as they were read; None: a new file.
        after: the new bytes.
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
    """Write files; if writing fails, the previous contents are restored.

    Args:
        alterations: the changes, in the order of writing.

    Raises:
        ResourceError: a file was changed or created since it was read, or cannot be written.
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
        problem = "already exists" if alteration.before is None else "was changed in the meantime"
        raise ResourceError(f"{path} {problem}; nothing was changed")


def texts(alterations: Sequence[Alteration]) -> Iterator[tuple[str, str]]:
    """Yield the absolute path and the new text of each file.

    Args:
        alterations: changes of files in UTF-8.
    """
    for alteration in alterations:
        yield str(alteration.path.absolute()), alteration.after.decode("utf-8", "replace").replace("\r\n", "\n")
