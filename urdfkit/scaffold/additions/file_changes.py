"""Changes to existing files and new files; `urdfkit.atomic.replace_and_move` writes them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path


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


def texts(alterations: Sequence[Alteration]) -> Iterator[tuple[str, str]]:
    """Yield the absolute path and the new text of each file.

    Args:
        alterations: changes of files in UTF-8.
    """
    for alteration in alterations:
        yield str(alteration.path.absolute()), alteration.after.decode("utf-8", "replace").replace("\r\n", "\n")
