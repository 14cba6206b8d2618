"""FileWatch: detects changed files by polling their modification time and size."""

from collections.abc import Iterable
from pathlib import Path

Signature = tuple[int, int] | None


class FileWatch:
    """Detects saved files. A change is reported when two checks in a row agree, so half-written files are skipped.

    Attributes:
        missing: files that existed before, and did not at the last two checks.
        unsettled: whether the last check found a change that is not reported yet.

    Args:
        files: the watched files; a missing file counts as changed when it appears, and does not hide other changes.
        optional: more files; these count as changed when they disappear, too.
    """

    def __init__(self, files: Iterable[Path], optional: Iterable[Path] = ()) -> None:
        self._settled: dict[Path, Signature] = {}
        self._last: dict[Path, Signature] = {}
        self.missing: tuple[Path, ...] = ()
        self.unsettled = False
        self.follow(files, optional)

    def follow(self, files: Iterable[Path], optional: Iterable[Path] = ()) -> None:
        """Watch these files from now on, starting from their current state."""
        self._needed = tuple(dict.fromkeys(files))
        paths = dict.fromkeys((*self._needed, *optional))
        # Keep the previous signatures: a save between reading a file and this call must still be detected.
        self._settled = {path: self._settled.get(path, _signature(path)) for path in paths}
        self._last = dict(self._settled)

    def changed(self) -> bool:
        """Check the files; return whether they have changed since the last call that returned True."""
        now = {path: _signature(path) for path in self._settled}
        steady = now == self._last
        self._last = now
        self.unsettled = now != self._settled
        if not steady:
            return False
        missing = tuple(path for path in self._needed if now[path] is None and self._settled[path] is not None)
        returned, self.missing = self.missing, missing
        if missing or not (returned or now != self._settled):
            return False
        self._settled = now
        self.unsettled = False
        return True


def _signature(path: Path) -> Signature:
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size
