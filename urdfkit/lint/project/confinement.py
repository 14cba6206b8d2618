"""Confinement: refuse to read files outside of given folders, for untrusted descriptions."""

import os
import sys
import sysconfig
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from urdfkit.description.packages.resolver import OUTSIDE

_EVENTS = ("open", "os.listdir", "os.scandir")


class Confinement:
    """Refuses to open or list paths outside of some folders, with `PermissionError`.

    `start` adds an audit hook to the process, which cannot be removed: the confinement holds until the process ends,
    whichever module opens a file. Symbolic links are followed first. Files of Python and of urdfkit can be read.

    Args:
        folders: the folders that may be read.

    Attributes:
        refused: paths of existing files that were not opened since `take_refused`.
    """

    def __init__(self, folders: Iterable[Path]) -> None:
        self.folders = tuple(dict.fromkeys(os.path.realpath(folder) for folder in folders))
        self.refused: dict[str, None] = {}
        self._process = 0

    def permits(self, path: str | Path) -> bool:
        """Return whether a path is in one of the folders."""
        return _is_in(os.path.realpath(path), self.folders)

    def start(self) -> None:
        """Confine this process."""
        if self._process == os.getpid():
            return
        self._process = os.getpid()
        self._programs = tuple(_programs())
        sys.addaudithook(self._check)

    def take_refused(self) -> tuple[str, ...]:
        """Return the refused paths, and forget them."""
        found = tuple(self.refused)
        self.refused.clear()
        return found

    def _check(self, event: str, arguments: tuple[Any, ...]) -> None:
        if event not in _EVENTS or not isinstance(arguments[0], (str, bytes, os.PathLike)):
            return
        path = os.path.realpath(os.fsdecode(arguments[0]))
        if path == os.devnull or _is_in(path, self.folders) or _is_in(path, self._programs):
            return
        if event == "open" and os.path.lexists(path):
            self.refused.setdefault(os.fsdecode(arguments[0]))
        raise PermissionError(13, OUTSIDE, os.fsdecode(arguments[0]))


def confinement_of(paths: Iterable[str], package_path: Iterable[Path]) -> Confinement:
    """Return the confinement to packages, their workspaces and the package path.

    Args:
        paths: the files and folders to lint, as named by the user.
        package_path: folders of packages.
    """
    from urdfkit.description.packages.discovery import workspace
    from urdfkit.description.packages.package_search import VARIABLES
    from urdfkit.description.packages.related_files import package_of

    folders = list(package_path)
    for variable in VARIABLES:
        folders += [Path(word) for word in os.environ.get(variable, "").split(os.pathsep) if word]
    for word in paths:
        path = Path(word).absolute()
        folder = path if path.is_dir() else path.parent
        package = package_of(folder / "x") or folder
        folders += [folder, package, *filter(None, [workspace(package)])]
    return Confinement(folder for folder in folders if folder != Path(folder.anchor))


def _is_in(path: str, folders: tuple[str, ...]) -> bool:
    return any(path == folder or path.startswith(folder.rstrip(os.sep) + os.sep) for folder in folders)


def _programs() -> Iterable[str]:
    """Yield the folders of Python's modules and their bytecode, of urdfkit and of its bundled robots."""
    from urdfkit.resources import robots_dir

    here = os.path.realpath(".")
    folders = [*sys.path, *sysconfig.get_paths().values(), str(Path(__file__).parents[2]), str(robots_dir())]
    folders.append(sys.pycache_prefix or "")
    yield from (real for folder in folders if folder and (real := os.path.realpath(folder)) not in (here, os.sep))
