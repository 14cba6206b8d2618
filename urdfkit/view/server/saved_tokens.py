"""Tokens that are saved for some hours, so that an open page can reconnect after urdfkit was restarted.

Token and cookie are written to a file that only this user can read, named after the port, in the folder that the
system empties when the user logs out (``XDG_RUNTIME_DIR``), or in the cache of the user. A server on the same port
uses them again if the last one was started less than `AGE` ago. If no private file can be written, each start has a
new token, and open pages instruct the user to open the new address.
"""

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
"""Seconds after which a token is not used again."""
WELL_FORMED = re.compile(r"[\w-]{32}")


def tokens_of(port: int) -> dict[str, str]:
    """Return token and session of a port, saved or new; an empty dictionary if no file can be written."""
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
    """Return the folder for private files, readable by this user only.

    Raises:
        OSError: it cannot be created, or belongs to another user.
    """
    runtime = os.environ.get("XDG_RUNTIME_DIR")
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = (Path(runtime) if runtime else cache) / "urdfkit"
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    status = folder.lstat()
    if not stat.S_ISDIR(status.st_mode) or status.st_uid != os.getuid():
        raise PermissionError(f"{folder} belongs to another user")
    if status.st_mode & 0o077:
        folder.chmod(0o700)
    return folder


def _read(path: Path) -> dict[str, str] | None:
    text = read_private(path, age=AGE)
    if text is None:
        return None
    try:
        found = json.loads(text)
        tokens = {name: str(found[name]) for name in ("token", "session")}
    except (ValueError, KeyError, TypeError):
        return None
    return tokens if all(WELL_FORMED.fullmatch(token) for token in tokens.values()) else None


def read_private(path: Path, *, age: float = math.inf) -> str | None:
    """Return the content of a private file; None if it is missing, too old or accessible to other users.

    Args:
        path: the file.
        age: seconds after which the content is ignored.

    Raises:
        OSError: the file cannot be read, or is a symbolic link.
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
    """Write a new file that only this user can read, replacing an existing one.

    Raises:
        OSError: the file cannot be written.
    """
    with contextlib.suppress(FileNotFoundError):
        path.unlink()
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o600)
    with os.fdopen(handle, "w", encoding="utf-8") as file:
        file.write(text)
