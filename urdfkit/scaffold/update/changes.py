"""Changes of files that an update makes, all or none."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from urdfkit.atomic import undisturbed
from urdfkit.errors import ResourceError
from urdfkit.scaffold.update.staged_packages import link_or_copy

Kind = Literal["add", "replace", "remove", "new_version", "keep", "needed"]


@dataclass(frozen=True, slots=True)
class Change:
    """The change of one file.

    Attributes:
        kind: ``add`` a new file; ``replace`` an unedited file; ``remove`` a file that the template no longer has;
            write a ``new_version`` next to an edited file; ``keep`` an edited or deleted file; or keep a removed file
            that is ``needed`` because a remaining file refers to it.
        path: path relative to the output folder; for ``new_version``, that of the edited file.
        before: current content; empty if the file does not exist.
        after: new content; empty if the file is removed.
        because: for ``needed``, the file that refers to it.
        at: for ``new_version``, the path of the new version.
    """

    kind: Kind
    path: Path
    before: bytes = b""
    after: bytes = b""
    because: Path | None = None
    at: Path | None = None

    @property
    def is_empty(self) -> bool:
        """Whether the file is unchanged."""
        return self.kind in ("keep", "needed")


@dataclass(frozen=True, slots=True)
class Update:
    """Changes that are ready to be applied.

    Attributes:
        changes: the changes, by path.
        refused: the reason why the update is refused; empty if it can be applied.
        warned: faults that the linter would report after the update only, one line each.
        unused: new model files that no file refers to before edited files are merged.
    """

    changes: tuple[Change, ...]
    refused: str
    warned: tuple[str, ...]
    unused: tuple[Path, ...]
    _staged: Path
    _folder: Path

    @property
    def new_versions(self) -> tuple[Change, ...]:
        """New versions of edited files, to be merged by the user."""
        return tuple(change for change in self.changes if change.kind == "new_version")

    def apply(self) -> None:
        """Apply the changes; if one fails, all are reverted.

        Raises:
            ResourceError: the update is refused, or a file cannot be written.
        """
        if self.refused:
            raise ResourceError(f"nothing was changed: {self.refused}")
        self._make(self.changes)

    def apply_new_versions(self) -> None:
        """Write only the new versions of edited files.

        Raises:
            ResourceError: a file cannot be written.
        """
        self._make(self.new_versions)

    def _make(self, changes: Sequence[Change]) -> None:
        undo: list[tuple[Path, Path]] = []
        with undisturbed():
            try:
                for number, change in enumerate(changes):
                    if not change.is_empty:
                        target = self._folder / (change.at or change.path)
                        undo.append(self._make_one(change, target, self._staged / ".old" / str(number)))
            except OSError as error:
                for here, there in reversed(undo):
                    here.replace(there)
                raise ResourceError(f"nothing was changed: cannot write {target}: {error.strerror}") from error
            for change in changes:
                if change.kind == "remove":
                    _remove_empty(self._folder / change.path.parent, self._folder)

    def _make_one(self, change: Change, target: Path, backup: Path) -> tuple[Path, Path]:
        """Make a change in one step, so that a killed update loses no file; return the move that reverts it."""
        backup.parent.mkdir(exist_ok=True)
        if change.kind == "remove":
            target.rename(backup)
            return backup, target
        staged, existed = self._staged / change.path, os.path.lexists(target)
        target.parent.mkdir(parents=True, exist_ok=True)
        if existed:
            link_or_copy(str(target), str(backup))
        staged.replace(target)
        return (backup, target) if existed else (target, staged)


def _remove_empty(folder: Path, above: Path) -> None:
    """Remove empty folders from `folder` upwards, excluding `above`."""
    while folder != above and folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent
