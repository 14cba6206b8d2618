"""The targets of a CMakeLists.txt with their commands, source files and headers."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path

from urdfkit.description.packages.existence import is_file
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand
from urdfkit.lint.project.code_files import MAX_BYTES
from urdfkit.record import record

ADDING = ("add_executable", "add_library")
_TESTING = r"(?:ament_add|catkin_add|add_rostest)_(?:ros_isolated_)?(?:gtest|gmock)\w*|catkin_add_executable_with_gtest"
USES = ("ament_target_dependencies", "target_link_libraries", "target_include_directories")
KEYWORDS = frozenset(
    (
        *("PUBLIC", "PRIVATE", "INTERFACE", "SYSTEM", "BEFORE", "AFTER", "SHARED", "STATIC", "MODULE", "OBJECT"),
        *("EXCLUDE_FROM_ALL", "WIN32", "MACOSX_BUNDLE", "TIMEOUT", "ENV", "WORKING_DIRECTORY", "SKIP_TEST"),
    )
)
CODE = r".*\.(?:c|cc|cpp|cxx)"


def included(path: Path) -> list[str]:
    """Return the headers that a file in C++ includes without a condition."""
    text = path.read_text("utf-8", "replace") if path.stat().st_size <= MAX_BYTES else ""
    text = re.sub(r"(?s)/\*.*?\*/", "", text)
    guard = re.match(r"(?:\s|//[^\n]*\n)*#[ \t]*ifndef\b[^\n]*\n", text)
    text = text[guard.end() :] if guard is not None else text
    depth = 0
    found: list[str] = []
    for line in re.finditer(r"(?m)^[ \t]*#[ \t]*(?:(if|endif)|include[ \t]*[<\"]([\w./-]+)[>\"])", text):
        is_guard = line[1] == "if" and re.match(r"n?def\b|ndef", text[line.end() :]) is None
        depth += (line[1] == "if") - (line[1] == "endif") if line[1] else 0
        if line[2] and depth <= 0 and not is_guard:
            found.append(line[2])
    return found


@record(eq=False)
class Target:
    """A target with its commands.

    Attributes:
        name: its name, without variables.
        added: the command that defines it.
        uses: commands with its packages, libraries and folders of headers.
        sources: its source files in the package.
        objects: the libraries of the package whose object files it contains.
    """

    name: str
    added: CMakeCommand
    uses: list[CMakeCommand]
    sources: list[Path]
    objects: list[str]

    @cached_property
    def words(self) -> list[str]:
        """Return the packages, libraries and folders of headers that commands give to the target."""
        return [word for each in self.uses for word, _ in each.words[1:] if word not in KEYWORDS]

    @cached_property
    def headers(self) -> list[tuple[Path, str]]:
        """Return the headers that its source files include, each with the file."""
        return [(path, header) for path in self.sources for header in included(path)]

    def headers_of_all(self, folder: Path) -> list[str]:
        """Return the headers that its source files include, also those in headers of a package in a folder."""
        found: list[str] = []
        left, seen = [*self.sources], set[Path]()
        for path in left:  # The list grows during the iteration.
            for header in included(path) if path not in seen else ():
                found.append(header)
                left += [each for each in (folder / "include" / header, path.parent / header) if is_file(each)][:1]
            seen.add(path)
        return found

    @property
    def is_module(self) -> bool:
        """Whether the target is a library that others cannot link."""
        return any(word == "MODULE" for word, _ in self.added.words)

    @property
    def place(self) -> tuple[int, str]:
        """Offset and name of the command to which a package or library is to be added."""
        command = next((each for each in self.uses if each.name != "target_include_directories"), self.added)
        return command.start, command.name


def targets(files: BuildFiles, every: list[CMakeCommand]) -> dict[str, Target] | None:
    """Return the targets of the package, tests included; None if their names are computed.

    None as well if a target has several definitions, as in branches of a condition: none of them counts alone.
    """
    found: dict[str, Target] = {}
    uses: dict[str, list[CMakeCommand]] = {}
    objects: dict[str, list[str]] = {}
    for command in every:
        if command.name in USES and command.words:
            uses.setdefault(named(command, files), []).append(command)
        elif command.name in (*ADDING, "target_sources") and command.words:
            matches = (re.fullmatch(r"\$<TARGET_OBJECTS:(.+)>", word) for word, _ in command.words)
            names_of_objects = [without_project(each[1], files) for each in matches if each is not None]
            objects.setdefault(named(command, files), []).extend(names_of_objects)
    for command in every:
        if not command.words or not (command.name in ADDING or re.fullmatch(_TESTING, command.name)):
            continue
        texts = [without_project(word, files) for word, _ in command.words]
        if "$" in texts[0]:
            return None
        if texts[0] in found:
            return None
        sources = [files.folder / word for word in texts[1:] if re.fullmatch(CODE, word) and "$" not in word]
        code = [path for path in sources if path.is_file()]
        found[texts[0]] = Target(texts[0], command, uses.get(texts[0], []), code, objects.get(texts[0], []))
    return found


def named(command: CMakeCommand, files: BuildFiles) -> str:
    """Return the first word of a command with the name of the project."""
    return without_project(command.words[0][0], files)


def without_project(word: str, files: BuildFiles) -> str:
    """Return a word with the name of the project in place of its variable."""
    return re.sub(r"\$\{(?:CMAKE_)?PROJECT_NAME\}", files.name, word) if "$" in word else word


def linked(target: Target, own: Mapping[str, Target], files: BuildFiles) -> set[str]:
    """Return the libraries of the package that a target links, directly or by another one, and the target itself."""
    found, left = set[str](), [target.name]
    while left:
        name = left.pop()
        if name in own and name not in found:
            found.add(name)
            left += [without_project(word, files).rpartition("::")[2] for word in own[name].words]
            left += own[name].objects
    return found
