"""Arguments and namespace of a launch file while it is read, and the xacro commands, packages and nodes found in it."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import ResourceError
from urdfkit.record import field, record

UNKNOWN = "\0"
"""Character that stands for a computed part of a text."""

MAX_TEXT = 10_000
"""Maximum length of an evaluated text; longer texts count as computed."""

_MAX_DEPTH = 8
_MAX_FILES = 100
_SHARE = "\1", "\2"
"""Characters around the name of a package, where a launch file writes its share folder."""


@record(eq=False)
class XacroCommand:
    """A xacro command of a launch file.

    Attributes:
        description: the file that xacro expands.
        arguments: its arguments with constant values.
    """

    description: Path
    arguments: Mapping[str, str]


class PlacedText(NamedTuple):
    """An evaluated text, with the line and the column in its launch file, from 1."""

    text: str
    line: int
    column: int


@record(eq=False)
class LaunchNode:
    """A node that a launch file starts; texts contain `UNKNOWN` for each computed part.

    Attributes:
        path: the launch file.
        line: line of the action in it, from 1.
        column: column of the action, from 1.
        package: package of the node.
        program: its executable.
        name: its name; empty if it has none.
        namespace: its namespace with those of the groups and includes around it, without slashes at its ends.
        arguments: its command line arguments.
        remappings: old name → new name.
        files: its parameter files that were found, with the namespace that the launch file puts around their contents.
        is_open: whether it can have further arguments, parameters or remappings.
        is_skipped: whether it does not start with these launch arguments.
        spaced_at: file, line and column of the innermost namespace, or of the action.
    """

    path: Path
    line: int
    column: int
    package: str
    program: str
    name: str
    namespace: str
    arguments: tuple[PlacedText, ...] = ()
    remappings: Mapping[str, str] = field(default_factory=dict)
    files: tuple[tuple[Path, str], ...] = ()
    is_open: bool = False
    is_skipped: bool = False
    spaced_at: tuple[Path, int, int] | None = None


@record(eq=False)
class LaunchContents:
    """Xacro commands, packages and nodes of a launch file and of the files it includes.

    Attributes:
        path: the launch file.
        commands: its xacro commands.
        started: packages whose nodes or launch files it starts, and programs it executes.
        included: the launch files it includes, directly or indirectly.
        descriptions: launch argument → its description.
        nodes: its nodes, including nodes that these launch arguments do not start.
        outside: package of each included launch file that was not found, and the namespace.
    """

    path: Path
    commands: list[XacroCommand] = field(default_factory=list)
    started: set[str] = field(default_factory=set)
    included: list[Path] = field(default_factory=list)
    descriptions: dict[str, str] = field(default_factory=dict)
    nodes: list[LaunchNode] = field(default_factory=list)
    outside: list[tuple[str, str]] = field(default_factory=list)


class LaunchScope:
    """The arguments of one launch file, and the record of its contents.

    Args:
        path: the file.
        packages: finds packages.
        found: the record, shared with included files.
        read: reads an included file.
        arguments: values of arguments from the including file.
        depth: number of including files.

    Attributes:
        namespace: namespace of the actions that are read, without slashes at its ends.
        is_skipped: whether these actions do not start with these arguments.
        spaced_at: file, line and column of the innermost namespace; None without one.
    """

    def __init__(
        self,
        path: Path,
        packages: Packages,
        found: LaunchContents,
        read: Callable[[LaunchScope], None],
        arguments: Mapping[str, str] | None = None,
        depth: int = 0,
    ) -> None:
        self.path, self.packages, self.found, self._read, self._depth = path, packages, found, read, depth
        self.arguments = dict(arguments or {})
        self.namespace, self.is_skipped = "", False
        self.spaced_at: tuple[Path, int, int] | None = None

    def declare(self, name: str, default: str, description: str = "") -> None:
        """Declare an argument, whose default applies unless the including file gives a value."""
        self.arguments.setdefault(name, default)
        if description and UNKNOWN not in description:
            self.found.descriptions.setdefault(name, " ".join(description.split()))

    def value(self, name: str) -> str:
        """Return the value of an argument."""
        return self.arguments.get(name, UNKNOWN)

    def share(self, package: str) -> str:
        """Return the mark for the share folder of a package."""
        return UNKNOWN if UNKNOWN in package else package.join(_SHARE)

    def constant(self, text: str) -> str | None:
        """Return a text with the folders of its packages; None if it is computed or a package is not found."""
        head, *rest = text.split(_SHARE[0])
        for part in rest:
            package, _, after = part.partition(_SHARE[1])
            try:
                head += f"{self.packages.find(package)}{after}"
            except ResourceError:
                return None
        return None if UNKNOWN in head or len(head) > MAX_TEXT else head

    def start(self, package: str) -> None:
        """Record a package whose node is started, or a program that is executed."""
        if package and UNKNOWN not in package and not self.is_skipped:
            self.found.started.add(package)

    def command(self, text: str) -> None:
        """Record a command, if it runs xacro on a file with a known path."""
        try:
            words = shlex.split(text)
        except ValueError:
            return
        programs = [at for at, word in enumerate(words) if word.rpartition("/")[2] in ("xacro", "xacro.py")]
        if programs:
            files = [word for word in words[programs[-1] + 1 :] if ":=" not in word and not word.startswith("-")]
            pairs = (word.partition(":=") for word in words[programs[-1] + 1 :] if ":=" in word)
            self.expansion(files[0] if files else UNKNOWN, {name: value for name, _, value in pairs})

    def expansion(self, file: str, arguments: Mapping[str, str]) -> None:
        """Record the expansion of a file with arguments; computed arguments are ignored."""
        if not self.is_skipped and (description := self.file(file)) is not None:
            values = {name: self.constant(value) for name, value in arguments.items() if UNKNOWN not in name}
            written = {name: value for name, value in values.items() if value is not None}
            self.found.commands.append(XacroCommand(description, written))

    def include(self, file: str, arguments: Mapping[str, str]) -> None:
        """Read an included launch file with these arguments."""
        package = file[1:].partition(_SHARE[1])[0] if file.startswith(_SHARE[0]) else ""
        self.start(package)
        path = self.file(file)
        if path is None or self._depth >= _MAX_DEPTH or len(self.found.included) >= _MAX_FILES:
            self.found.outside.append((package, self.namespace))
            return
        self.found.included.append(path)
        scope = LaunchScope(path, self.packages, self.found, self._read, arguments, self._depth + 1)
        scope.namespace, scope.is_skipped, scope.spaced_at = self.namespace, self.is_skipped, self.spaced_at
        self._read(scope)

    def below(self, namespace: str) -> str:
        """Return a namespace inside the current one, without slashes at its ends."""
        outer = "" if namespace.startswith("/") else self.namespace
        return f"{outer}/{namespace.strip('/')}".strip("/")

    def file(self, text: str) -> Path | None:
        """Return the file at a path; None if the path is computed or no file has it."""
        constant = self.constant(text)
        if constant is None or not os.path.isabs(constant):  # noqa: PTH117 - may hold any character
            return None
        path = Path(os.path.normpath(constant))
        try:
            if is_file(path):
                return path
            moved = self.packages.relocate(path)
        except (OSError, ValueError):
            return None
        return moved if moved is not None and is_file(moved) else None


def is_false(text: str) -> bool:
    """Return whether a condition is false; computed conditions are not."""
    return text.strip().lower() in ("false", "0")


def is_true(text: str) -> bool:
    """Return whether a condition is true; computed conditions are not."""
    return text.strip().lower() in ("true", "1")
