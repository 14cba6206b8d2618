"""Watch: which of some files changed on disk, by looking at them now and then."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

Signature = tuple[int, int] | None


class Watch:
    """Notices saves. A change is reported once the files look the same twice in a row, so half-written saves pass by.

    Attributes:
        missing: files that were not there at the last two looks.

    Args:
        files: what to look at; a file that is not there counts as changed when it appears.
    """

    def __init__(self, files: Iterable[Path]) -> None:
        self._settled: dict[Path, Signature] = {}
        self._last: dict[Path, Signature] = {}
        self.missing: tuple[Path, ...] = ()
        self.follow(files)

    @property
    def files(self) -> tuple[Path, ...]:
        """The files looked at."""
        return tuple(self._settled)

    def follow(self, files: Iterable[Path]) -> None:
        """Look at these files from now on, as they are now."""
        paths = dict.fromkeys(files)
        # Keep what was known: a save between reading a file and this call must still be noticed.
        self._settled = {path: self._settled.get(path, _signature(path)) for path in paths}
        self._last = dict(self._settled)

    def changed(self) -> bool:
        """Look; whether there is a new state to read since the last time this said so."""
        now = {path: _signature(path) for path in self._settled}
        steady = now == self._last
        self._last = now
        if not steady:
            return False
        missing = tuple(path for path, signature in now.items() if signature is None)
        returned, self.missing = self.missing, missing
        if missing or not (returned or now != self._settled):
            return False
        self._settled = now
        return True


def _signature(path: Path) -> Signature:
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size
