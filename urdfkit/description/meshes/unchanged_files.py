"""Results for files, kept until the files change: an editor needs them at each key."""

from __future__ import annotations

import time
from functools import lru_cache, wraps

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from typing import TypeVar

    Result = TypeVar("Result")

_FILES = 2_000
"""Number of files whose results are remembered."""
_JUST_CHANGED = 2_000_000_000
"""Age of files from which on results are remembered [ns].

Of two changes within the resolution of the file system's clock, the second one would not be seen.
"""


def remembered(read: Callable[[Path], Result]) -> Callable[[Path], Result]:
    """Return a function of a file that is called again only if the file has changed.

    The function raises an OSError if the file does not exist.
    """

    @lru_cache(maxsize=_FILES)
    def of_version(path: Path, *_version: int) -> Result:
        return read(path)

    @wraps(read)
    def current(path: Path) -> Result:
        status = path.stat()
        times = (status.st_mtime_ns, status.st_ctime_ns)
        if time.time_ns() - max(times) <= _JUST_CHANGED:
            return read(path)
        return of_version(path, status.st_ino, status.st_size, *times)

    return current
