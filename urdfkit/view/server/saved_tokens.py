"""The key of a page, kept for a while, so that a page finds its way back when urdfkit is started anew.

Token and cookie are written to a file that only this user can read, named by the port, in the folder that the system
empties when the user logs out (``XDG_RUNTIME_DIR``), or in the user's cache. They are used again by a server on the
same port within `AGE` of the last one's start; the page that was open then goes on. Where no file can be kept safely,
every start has a new key, and the page says that the new address has to be opened.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import re
import secrets
import stat
import sys
import time
from pathlib import Path

AGE = 12 * 3600.0
"""Seconds after which a key is not used again."""
WELL_FORMED = re.compile(r"[\w-]{32}")


def keys_of(port: int) -> dict[str, str]:
    """Return token and session of a port: those of the last hours, or new ones; nothing where none can be kept."""
    if sys.platform == "win32":
        return {}
    try:
        path = private_folder() / f"page-{port}.json"
        found = _read(path) or {"token": secrets.token_urlsafe(24), "session": secrets.token_urlsafe(24)}
        write_private(path, json.dumps(found))
    except OSError:
        return {}
    return found


def private_folder() -> Path:
    """Return the folder, which nobody else may look into.

    Raises:
        OSError: it cannot be made, or it is somebody else's.
    """
    runtime = os.environ.get("XDG_RUNTIME_DIR")
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = (Path(runtime) if runtime else cache) / "urdfkit"
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    status = folder.lstat()
    if not stat.S_ISDIR(status.st_mode) or status.st_uid != os.getuid():
        raise PermissionError(f"{folder} belongs to somebody else")
    if status.st_mode & 0o077:
        folder.chmod(0o700)
    return folder


def _read(path: Path) -> dict[str, str] | None:
    text = read_private(path, age=AGE)
    if text is None:
        return None
    try:
        found = json.loads(text)
        keys = {name: str(found[name]) for name in ("token", "session")}
    except (ValueError, KeyError, TypeError):
        return None
    return keys if all(WELL_FORMED.fullmatch(key) for key in keys.values()) else None


def read_private(path: Path, *, age: float = math.inf) -> str | None:
    """Return what is in a file that only this user can read; None where there is none, or it is not to be trusted.

    Args:
        path: the file.
        age: seconds after which it counts as none.

    Raises:
        OSError: it cannot be read, or is a link.
    """
    try:
        handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    except FileNotFoundError:
        return None
    with os.fdopen(handle, encoding="utf-8", errors="replace") as file:
        status = os.fstat(file.fileno())
        if status.st_uid != os.getuid() or status.st_mode & 0o077 or time.time() - status.st_mtime > age:
            return None
        return file.read(1000)


def write_private(path: Path, text: str) -> None:
    """Write a file anew that nobody else can read.

    Raises:
        OSError: it cannot be written.
    """
    with contextlib.suppress(FileNotFoundError):
        path.unlink()
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o600)
    with os.fdopen(handle, "w", encoding="utf-8") as file:
        file.write(text)
