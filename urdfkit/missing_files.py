"""Messages for files and folders that do not exist, with the most similar existing path."""

import os
import re
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.errors import may_suggest, nearest


def expanded_path(written: str | Path) -> Path:
    """Return a path with the home folder in place of ``~``; as written if there is no such user."""
    return Path(os.path.expanduser(written))  # noqa: PTH111 (Path.expanduser() fails for unknown users)


def missing_path(written: str | Path, kind: str = "file") -> str:
    """Return the message for a path that does not exist: ``no such file: arn.urdf; did you mean `arm.urdf`?``.

    The suggestion is the path with its first missing name replaced, up to that name if the rest does not exist either.

    Args:
        written: the path as the user wrote it.
        kind: the expected kind: ``file``, ``folder`` or ``file or folder``.
    """
    path = expanded_path(written)
    near = similar_file(path)
    if near is None:
        return f"no such {kind}: {written}"
    missing = _first_missing(path)
    found = missing.parent / near
    whole = found / path.relative_to(missing)
    return f"no such {kind}: {written}" + Suggestion(str(whole if whole.exists() else found), str(written))


def similar_file(path: Path, found: dict[Path, str | None] | None = None, user: Path | None = None) -> str | None:
    """Return the name that is similar to the first part of `path` that does not exist, ignoring case.

    A common suffix from the first dot on does not make two names similar, and only a folder stands for a folder.

    Args:
        path: a path that does not exist.
        found: earlier results by the first part that does not exist, to be used again; None to search again.
        user: the file that names the path, which cannot be meant.
    """
    if not may_suggest():
        return None
    missing = _first_missing(path)
    if found is not None and missing in found:
        return found[missing]
    try:
        children = (child for child in missing.parent.iterdir() if missing == path or child.is_dir())
        names = sorted(child.name for child in children if user is None or not _is_same(child, user))
    except OSError:
        return None
    stem = _stem(missing.name)
    written = [name for name in names if _letters(name) == _letters(missing.name)]
    near = nearest(missing.name, written or [name for name in names if nearest(stem, [_stem(name)]) is not None])
    if found is not None:
        found[missing] = near
    return near


def _first_missing(path: Path) -> Path:
    """Return the first part of a path that does not exist, with the folders before it."""
    missing, parent = path, path.parent
    while not os.path.isdir(parent) and parent != parent.parent:  # noqa: PTH112 (False for a name that is too long)
        missing, parent = parent, parent.parent
    return missing


def _is_same(path: Path, other: Path) -> bool:
    return path.name == other.name and path.absolute() == other.absolute()


def _letters(name: str) -> str:
    """Return a name without its separators: ``arm.gazebo.xacro`` and ``arm_gazebo.xacro`` are similar."""
    return re.sub(r"[\W_]", "", name).lower()


def _stem(name: str) -> str:
    return name.partition(".")[0] or name
