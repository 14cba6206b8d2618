"""Existence of paths that a description contains.

Unlike the methods of `Path` before Python 3.14, these return False for a name that is too long and for a folder that
may not be searched.
"""

import os
import re
from pathlib import Path


def is_file(path: str | Path) -> bool:
    """Return whether a path is a file, or a link to one."""
    return os.path.isfile(path)  # noqa: PTH113


def is_folder(path: str | Path) -> bool:
    """Return whether a path is a folder, or a link to one."""
    return os.path.isdir(path)  # noqa: PTH112


def exists(path: str | Path) -> bool:
    """Return whether a path is a file or folder, or a link to one."""
    return os.path.exists(path)  # noqa: PTH110


def is_absolute(uri: str) -> bool:
    """Return whether a URI is an absolute path, which is valid on one machine only."""
    return re.match(r"\s*(?:file:/+[^$]|/|[A-Za-z]:[\\/])", uri) is not None
