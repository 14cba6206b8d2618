"""Third-party rules, drives, sensors and controllers, from the entry points of installed packages.

`importlib.metadata` would do the same, but takes longer to import than linting a file takes; so this
module reads the few files itself.
"""

from __future__ import annotations

import os
import sys
import time
from importlib import import_module

from urdfkit.errors import ResourceError
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any, TypeAlias

    Found: TypeAlias = list[tuple[str, "EntryPoint"]]
    """Group and entry point."""

PLUGIN_GROUPS = ("urdfkit.drives", "urdfkit.sensors", "urdfkit.controllers")
"""Groups of classes that simulate Gazebo plugins."""


@record(order=True)
class EntryPoint:
    """One line of an entry point section: ``name = module:attribute``.

    Attributes:
        name: its name in the package.
        value: ``module:attribute``.
        distribution: the folder it was read from, for messages.
    """

    name: str
    value: str
    distribution: str

    def load(self) -> Any:
        """Import the module and return the attribute.

        Raises:
            ResourceError: it cannot be imported; names the broken package.
        """
        module, _, attributes = self.value.partition(":")
        try:
            found: Any = import_module(module.strip())
            for attribute in filter(None, attributes.strip().split(".")):
                found = getattr(found, attribute)
        except Exception as error:
            raise ResourceError(f"{self.distribution}: entry point {self.name} = {self.value}: {error}") from error
        return found


def entry_points(*groups: str, path: Iterable[str] | None = None) -> list[EntryPoint]:
    """Return the entry points of groups, sorted by name.

    Args:
        groups: e.g. ``urdfkit.rules``.
        path: folders to search for installed packages; ``sys.path`` when None.
    """
    found: dict[tuple[str, str], EntryPoint] = {}
    for folder in sys.path if path is None else path:
        for group, entry in _entry_points_in(folder or os.curdir, groups):
            found.setdefault((group, entry.name), entry)
    return sorted(found.values())


def load(group: str) -> list[Any]:
    """Import and return all entry points of a group.

    Raises:
        ResourceError: an entry point cannot be imported.
    """
    return [entry.load() for entry in entry_points(group)]


_read_before: dict[tuple[str, tuple[str, ...]], tuple[tuple[int, ...], Found]] = {}
"""Folder and groups → state of the folder, which every installation changes, and its entry points."""
_SETTLED = 10 * 10**9
"""An installation may still write into folders that changed later than this [ns]."""


def _entry_points_in(folder: str, groups: tuple[str, ...]) -> Found:
    """Return the entry points of the packages in a folder.

    The folder is read again only after a change, but a folder of sources each time: installing it again changes files
    in place.
    """
    try:
        status = os.stat(folder)  # noqa: PTH116 - a path takes longer
        state = (status.st_dev, status.st_ino, status.st_mtime_ns)
        before = _read_before.get((folder, groups))
        if before is not None and before[0] == state:
            return before[1]
        names = os.listdir(folder)  # noqa: PTH208 - only names are needed
    except OSError:
        return []
    found: Found = []
    for name in names:
        if name.endswith((".dist-info", ".egg-info")):
            found += _read(f"{folder}/{name}/entry_points.txt", groups, name)
    is_source = not folder.endswith("-packages") and any(name.endswith(".egg-info") for name in names)
    if not is_source and time.time_ns() - status.st_mtime_ns > _SETTLED:
        _read_before[folder, groups] = state, found
    return found


def _read(file: str, groups: tuple[str, ...], distribution: str) -> Found:
    headings = [f"[{group}]" for group in groups]
    try:  # A hundred of these on every start: unbuffered, because buffered reading takes three times as long.
        descriptor = os.open(file, os.O_RDONLY)
        try:
            content = os.read(descriptor, os.fstat(descriptor).st_size)
        finally:
            os.close(descriptor)
        if not any(heading.encode() in content for heading in headings):
            return []
        text = content.decode()
    except (OSError, UnicodeDecodeError):
        return []
    found: Found = []
    section = ""
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("["):
            section = line
        elif section in headings and "=" in line and not line.startswith(("#", ";")):
            name, _, value = line.partition("=")
            found.append((section, EntryPoint(name.strip(), value.partition("[")[0].strip(), distribution)))
    return found
