"""Packages: ``$(find …)``, ``package://``, ``model://``, ``file://`` and relative paths, with or without ROS."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import exists, is_folder
from urdfkit.description.packages.package_search import PackageSearch
from urdfkit.description.packages.related_files import CODE, around, state_of
from urdfkit.description.packages.similar_names import near_package
from urdfkit.description.xml.source import absolute
from urdfkit.errors import ResourceError
from urdfkit.missing_files import similar_file
from urdfkit.position import Position

NOT_READ = "is not read, because --confined hides the environment"
OUTSIDE = "outside the package, its workspace and the package path"

_LONGEST_NAME = 255
"""Length of the longest file name that Linux and macOS accept [bytes]."""


class Packages:
    """Search for packages by name, lazy and cached.

    The order is: `search`, the package around `near`, its workspace, ``ROS_PACKAGE_PATH``, ``AMENT_PREFIX_PATH``,
    ``CMAKE_PREFIX_PATH``, the model paths of Gazebo, ``~/.gazebo/models``, the caches of Gazebo Fuel, the bundled
    robots and models, and last a folder of that name around `near` without a package.xml.

    Args:
        search: folders to search first: packages, folders of packages, or install prefixes.
        near: a file or folder of the workspace to search.
        environment: environment variables; the environment of the process when None.
        permits: whether a path may be read; every path when None. With it, ``$(env …)`` finds no variable.
    """

    def __init__(
        self,
        search: Iterable[str | Path] = (),
        near: str | Path | None = None,
        *,
        environment: Mapping[str, str] | None = None,
        permits: Callable[[Path], bool] | None = None,
    ) -> None:
        self.search = tuple(absolute(folder) for folder in search)
        self.near = None if near is None else absolute(near)
        self.variables: Mapping[str, str] = os.environ if permits is None else {}
        """The environment variables that ``$(env …)`` finds."""
        self.hides_variables = permits is not None
        """Whether ``$(env …)`` finds none."""
        self._found: dict[str, Path] = {}
        self._package_search = PackageSearch(
            self.search, self.near, os.environ if environment is None else environment, permits, {}
        )
        self._states: dict[tuple[str, ...], str] = {}
        self._similar_files: dict[Path, str | None] = {}
        self.notes: dict[str, str] = {}
        """Notes on files that were found under a name with other capital letters, in order."""
        self.answers: dict[tuple[str, ...], str] = {}
        """Query → its result, for each query so far; a cached result is valid as long as `answer` returns the same."""

    def __getstate__(self) -> dict[str, object]:
        """Return the attributes, without the environment of this process: a copy uses that of its own process."""
        return vars(self) | {"variables": None if self.variables is os.environ else self.variables}

    def __setstate__(self, state: dict[str, object]) -> None:
        """Set the attributes."""
        vars(self).update(state | ({"variables": os.environ} if state["variables"] is None else {}))

    def answer(self, question: tuple[str, ...]) -> str:
        """Return the current result of a query in `answers`: a path, or the error message after ``!``."""
        kind, *words = question
        try:
            if kind == "find":
                return str(self.find(words[0]))
            if kind == "resolve":
                return str(self._resolved(words[0], words[1], self._similar_files))
            if kind == "files":
                return self._state_of(question)
            if kind == "variable":
                value = self.variable(words[0])
                return "!" if value is None else f"={value}"
            if kind == "around":
                if question not in self._states:
                    self._states[question] = "\n".join(map(str, around(Path(words[0]))))
                return self._states[question]
            return self._moved(words[0])
        except ResourceError as error:
            return f"!{error.message}"

    def variable(self, name: str) -> str | None:
        """Return the value of an environment variable, as ``$(env …)`` finds it; None if it is not set."""
        value = self.variables.get(name)
        self.answers["variable", name] = "!" if value is None else f"={value}"
        return value

    def is_as_written(self, question: tuple[str, ...], answer: str) -> bool:
        """Return whether a result is the file that a URI names itself; it holds as long as that file exists."""
        kind, *words = question
        return kind == "resolve" and answer == str(self._path_of(words[0], Path(words[1])))

    def near_file(self, near: str | Path) -> Packages:
        """Return a resolver that searches near another file and shares the cache of folders."""
        search = self._package_search
        other = Packages(self.search, near, environment=search.environment, permits=search.permitted)
        other._package_search.scanned, other._states, other._similar_files = (
            search.scanned,
            self._states,
            self._similar_files,
        )
        return other

    def find(self, name: str) -> Path:
        """Return the folder of a package: the folder of its package.xml, or its share folder when installed.

        Args:
            name: name of the package, as in ``$(find name)``.

        Raises:
            ResourceError: unknown package; lists the searched folders and the most similar name.
        """
        if name not in self._found:
            found = self._package_search.look_up(name) if _is_plain(name) else None
            if found is None:
                is_long = len(name) > _LONGEST_NAME
                hint = "" if is_long else near_package(name, self._package_search.seen)
                shown = f"{name[:60]}…" if is_long else name
                advice = "" if hint else "; add folders with --package-path"
                message = f"no package `{shown}` (searched: {self._package_search.places_searched()}{advice})" + hint
                self.answers[("find", name)] = f"!{message}"
                raise ResourceError(message, kind="package", package=name)
            self._found[name] = found
            self.answers[("find", name)] = str(found)
        return self._found[name]

    def resolve(self, uri: str, relative_to: str | Path) -> Path:
        """Return the file of a mesh or texture URI.

        Args:
            uri: ``package://name/path``, ``model://name/path``, ``file:///path``, or a path.
            relative_to: the description file (or its folder) that a relative path starts from.

        Raises:
            ResourceError: the package or file does not exist; names the most similar file.
        """
        question = ("resolve", uri, str(relative_to))
        try:
            path = self._resolved(uri, relative_to)
        except ResourceError as error:
            self.answers[question] = f"!{error.message}"
            raise
        self.answers[question] = str(path)
        return path

    def resolve_in_any_case(self, uri: str, relative_to: str | Path, position: Position | None = None) -> Path:
        """Return the file of a URI as `resolve` does, also one whose path differs in capital letters; add to `notes`.

        Descriptions written where capital letters do not count, as on Windows, name such files.

        Args:
            uri: the URI.
            relative_to: see `resolve`.
            position: of the URI in the description.

        Raises:
            ResourceError: the package or file does not exist, or several files differ in capital letters only.
        """
        try:
            return self.resolve(uri, relative_to)
        except ResourceError:
            path = self.in_any_case(self._path_of(uri, Path(relative_to)), uri, position)
            if path is None:
                raise
        return path

    def in_any_case(self, path: Path, written: str, position: Position | None = None) -> Path | None:
        """Return the one existing file whose path differs in capital letters; add to `notes`. None without one.

        Args:
            path: a path that does not exist.
            written: the path as in the description.
            position: its first position in the description.
        """
        from urdfkit.description.packages.similar_names import in_any_case

        found = in_any_case(path) if self.permits(path) else None
        if found is None or not self.permits(found):
            return None
        place = "" if position is None else f"{position}: "
        name = f"the name of the file is {found.name} in {found.parent}; correct the capital letters"
        self.notes.setdefault(written, f"{place}{written}: {name}")
        return found

    def _resolved(self, uri: str, relative_to: str | Path, found: dict[Path, str | None] | None = None) -> Path:
        path = self._path_of(uri, Path(relative_to))
        if not self.permits(path):
            raise ResourceError(f"{uri} is {OUTSIDE}")
        try:
            if path.exists():
                return path
        except OSError as error:
            raise ResourceError(f"no file {uri}: {(error.strerror or 'not readable').lower()}", kind="file") from None
        if (moved := self._relocated(path)) is not None:
            return moved
        if "%" in uri:
            from urllib.parse import unquote

            decoded = Path(unquote(str(path)))
            if exists(decoded):
                return decoded
        near = similar_file(path, found)
        raise ResourceError(f"no file {uri}" + Suggestion(near), kind="file", near=near)

    def relocate(self, path: str | Path) -> Path | None:
        """Return the path in the source folder for a path that exists only in an installed package.

        Packages whose CMake installs ``description/*`` into the share folder can be read from source too:
        ``$(find pkg)/urdf/x`` is ``<source>/description/urdf/x`` there.

        Args:
            path: a path that does not exist.

        Returns:
            The existing path, or None.
        """
        moved = self._relocated(path)
        self.answers[("relocate", str(path))] = str(moved or "")
        return moved

    def whereabouts(self, path: str | Path) -> str:
        """Return the path if it exists, else the result of `relocate`; empty if neither exists."""
        answer = self.answers[("relocate", str(path))] = self._moved(str(path))
        return answer

    def around(self, package: str | Path) -> list[Path]:
        """Return the launch files and YAML around a description; see `related_files.around`."""
        found = around(Path(package))
        self.answers[("around", str(package))] = "\n".join(map(str, found))
        return found

    def watch(self, folder: Path, *endings: str) -> None:
        """Add the files of a package to `answers`: names, and versions of code, neighbours and files with endings."""
        for question in (("files", str(folder), *CODE, *endings), ("files", str(folder.parent))):
            self.answers[question] = self._state_of(question)

    def _state_of(self, question: tuple[str, ...]) -> str:
        if question not in self._states:
            self._states[question] = state_of(question[1], question[2:])
        return self._states[question]

    def _moved(self, path: str) -> str:
        """Return the path if it exists now, else its relocated path."""
        return path if exists(path) else str(self._relocated(path) or "")

    def _relocated(self, path: str | Path) -> Path | None:
        wanted = absolute(path)
        for folder in dict.fromkeys(self._found.values()):
            if folder in wanted.parents:
                moved = folder / "description" / wanted.relative_to(folder)
                if exists(moved):
                    return moved
        return None

    def _path_of(self, uri: str, relative_to: Path) -> Path:
        scheme, separator, rest = uri.partition("://")
        if not separator:
            base = relative_to if is_folder(relative_to) else relative_to.parent
            return base / uri
        if scheme in ("package", "model"):
            name, _, inside = rest.partition("/")
            return self.find(name) / inside
        if scheme == "file":
            return Path(rest.removeprefix("localhost"))
        message = f"{uri}: files are read from this machine only; use package://, model:// or a path"
        raise ResourceError(message, kind="file")

    def permits(self, path: str | Path) -> bool:
        """Return whether a path may be read."""
        return self._package_search.permits(path)


def _is_plain(name: str) -> bool:
    return (
        0 < len(name.encode("utf-8", "replace")) <= _LONGEST_NAME
        and "/" not in name
        and "\\" not in name
        and name not in (".", "..")
    )
