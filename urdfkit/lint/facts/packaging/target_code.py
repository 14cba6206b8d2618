"""Needs of the code of targets in a CMakeLists.txt: packages, folders of headers and libraries of the package."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect
from urdfkit.lint.facts.packaging.cmake_packages import found_packages, place_of_package, provided
from urdfkit.lint.facts.ros_packages import is_slip, names
from urdfkit.lint.project.code_files import MAX_BYTES
from urdfkit.record import record

_ADDING = ("add_executable", "add_library")
_TESTING = r"(?:ament_add|catkin_add|add_rostest)_(?:ros_isolated_)?(?:gtest|gmock)\w*|catkin_add_executable_with_gtest"
_USES = ("ament_target_dependencies", "target_link_libraries", "target_include_directories")
_KEYWORDS = frozenset(
    (
        *("PUBLIC", "PRIVATE", "INTERFACE", "SYSTEM", "BEFORE", "AFTER", "SHARED", "STATIC", "MODULE", "OBJECT"),
        *("EXCLUDE_FROM_ALL", "WIN32", "MACOSX_BUNDLE", "TIMEOUT", "ENV", "WORKING_DIRECTORY", "SKIP_TEST"),
    )
)
_NO_CODE = ("INTERFACE", "ALIAS", "IMPORTED")
_CODE = r".*\.(?:c|cc|cpp|cxx)"


def _included(path: Path) -> list[str]:
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
        return [word for each in self.uses for word, _ in each.words[1:] if word not in _KEYWORDS]

    @cached_property
    def headers(self) -> list[tuple[Path, str]]:
        """Return the headers that its source files include, each with the file."""
        return [(path, header) for path in self.sources for header in _included(path)]

    def headers_of_all(self, folder: Path) -> list[str]:
        """Return the headers that its source files include, also those in headers of a package in a folder."""
        found: list[str] = []
        left, seen = [*self.sources], set[Path]()
        for path in left:  # The list grows during the iteration.
            for header in _included(path) if path not in seen else ():
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
        if command.name in _USES and command.words:
            uses.setdefault(_named(command, files), []).append(command)
        elif command.name in (*_ADDING, "target_sources") and command.words:
            matches = (re.fullmatch(r"\$<TARGET_OBJECTS:(.+)>", word) for word, _ in command.words)
            names_of_objects = [_without_project(each[1], files) for each in matches if each is not None]
            objects.setdefault(_named(command, files), []).extend(names_of_objects)
    for command in every:
        if not command.words or not (command.name in _ADDING or re.fullmatch(_TESTING, command.name)):
            continue
        texts = [_without_project(word, files) for word, _ in command.words]
        if "$" in texts[0]:
            return None
        if texts[0] in found:
            return None
        sources = [files.folder / word for word in texts[1:] if re.fullmatch(_CODE, word) and "$" not in word]
        code = [path for path in sources if path.is_file()]
        found[texts[0]] = Target(texts[0], command, uses.get(texts[0], []), code, objects.get(texts[0], []))
    return found


def _named(command: CMakeCommand, files: BuildFiles) -> str:
    return _without_project(command.words[0][0], files)


def _without_project(word: str, files: BuildFiles) -> str:
    return re.sub(r"\$\{(?:CMAKE_)?PROJECT_NAME\}", files.name, word) if "$" in word else word


def _linked(target: Target, own: Mapping[str, Target], files: BuildFiles) -> set[str]:
    """Return the libraries of the package that a target links, directly or by another one, and the target itself."""
    found, left = set[str](), [target.name]
    while left:
        name = left.pop()
        if name in own and name not in found:
            found.add(name)
            left += [_without_project(word, files).rpartition("::")[2] for word in own[name].words]
            left += own[name].objects
    return found


def code_defects(files: BuildFiles, source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield packages, folders and libraries that the code of targets needs and their commands do not name."""
    own = targets(files, every)
    found = found_packages(every)
    if not own or found is None or any(each.name in ("link_libraries", "function", "macro") for each in every):
        return
    wrong = list(_libraries(files, source, own, every))
    yield from wrong
    if wrong or any(_named(each, files) not in own for each in every if each.name in _USES and each.words):
        return  # missing packages are a consequence
    is_catkin = "catkin" in found
    folders = {word for each in every if each.name == "include_directories" for word, _ in each.words}
    if is_catkin:
        yield from _without_component(source, own, files, every, found)
    for target in own.values():
        if is_catkin:
            yield from _without_catkin(source, target, own, files)
        elif not folders:
            yield from _without_package(source, target, own, files, found)
        if not _is_computed(target, is_catkin):
            yield from _own_headers(source, target, own, files, folders)


def _is_computed(target: Target, is_catkin: bool) -> bool:
    """Return whether variables of a target can stand for libraries of the package."""
    accepted = r"\$\{(?:CMAKE_)?PROJECT_NAME\}|\$<.*>|\$\{\w+_(?:LIBRARIES|INCLUDE_DIRS|TARGETS)\}|\$\{CMAKE_CURRENT_.*"
    accepted += r"|\$\{PROJECT_SOURCE_DIR\}.*"
    return any("$" in word and not re.fullmatch(accepted, word) for word in target.words)


def _libraries(
    files: BuildFiles, source: Source, own: Mapping[str, Target], every: list[CMakeCommand]
) -> Iterator[BuildDefect]:
    """Yield targets without source files, misspelt libraries of the package, and uses before the definition."""
    extended = {_named(each, files) for each in every if each.name in ("target_sources", "qt5_wrap_cpp") and each.words}
    order = {id(each): at for at, each in enumerate(every)}
    for target in own.values():
        words = [word for word, _ in target.added.words[1:] if word in _NO_CODE or word not in _KEYWORDS]
        if not words and target.name not in extended and target.added.name in _ADDING:
            yield BuildDefect(
                source, target.added.start, target.added.name, f"target `{target.name}` has no source files"
            )
        early = next((each for each in target.uses if order[id(each)] < order[id(target.added)]), None)
        if early is not None:
            message = f"{early.name}() is called before {target.added.name}() defines the target `{target.name}`"
            yield BuildDefect(source, early.start, early.name, message)
        for command in target.uses:
            for word, start in command.words[1:] if command.name == "target_link_libraries" else ():
                is_defined = word in own or word in names() or not re.fullmatch(r"\w+", word)
                others = (name for name in own if is_slip(word, name) and name != target.name)
                near = None if is_defined else next(others, None)
                if near is not None:
                    message = f"no command defines the library `{word}`" + Suggestion(near, word)
                    yield BuildDefect(source, start, word, message)


def _without_catkin(
    source: Source, target: Target, own: Mapping[str, Target], files: BuildFiles
) -> Iterator[BuildDefect]:
    """Yield an executable with the headers of roscpp that is not linked with the libraries of catkin.

    A library can be linked without them; its executables then name them.
    """
    is_user = any(header in ("ros/ros.h", "nodelet/nodelet.h") for _, header in target.headers)
    if target.added.name != "add_executable" or not is_user:
        return
    words = [word for name in _linked(target, own, files) for word in own[name].words]
    if any("LIBRAR" in word or word == "roscpp" for word in words):
        return
    if not any("$" in word and "PROJECT_NAME" not in word and "<" not in word for word in words):
        message = f"target `{target.name}` is not linked with `${{catkin_LIBRARIES}}`"
        yield BuildDefect(source, *target.place, message)


def _without_component(
    source: Source, own: Mapping[str, Target], files: BuildFiles, every: list[CMakeCommand], found: Mapping[str, int]
) -> Iterator[BuildDefect]:
    """Yield the packages in package.xml whose headers targets include, and that ``find_package(catkin …)`` lacks."""
    near = neighbours(files.folder)
    covered = provided(found, near)
    if covered is None:
        return
    built = {text for text, _ in files.tags("depend", "build_depend", "build_export_depend")}
    for target in own.values():
        for header in target.headers_of_all(files.folder):
            package = header.partition("/")[0]
            is_needed = package in built and (package in names() or package in near)
            if is_needed and package not in {*covered, files.name} and not files.has(f"include/{header}"):
                covered.add(package)
                message = f"find_package(catkin) lacks `{package}`, whose headers target `{target.name}` includes"
                yield BuildDefect(source, *place_of_package(every, package), message, "warning")


def _without_package(
    source: Source, target: Target, own: Mapping[str, Target], files: BuildFiles, found: Mapping[str, int]
) -> Iterator[BuildDefect]:
    """Yield the packages that CMake finds, whose headers a target includes, and that no command gives to it."""
    words = {word for name in _linked(target, own, files) for word in own[name].words}
    words = {re.sub(r"\$\{(\w+)_(?:TARGETS|LIBRARIES|INCLUDE_DIRS)\}", r"\1", word) for word in words}
    words = {word for word in words if not re.fullmatch(r"\$<.*>|include/?|\$\{CMAKE_CURRENT_SOURCE_DIR\}.*", word)}
    packages = {word.partition("::")[0] for word in words if word not in own and word.rpartition("::")[2] not in own}
    if any("$" in word for word in packages):
        return
    near = neighbours(files.folder)
    covered, checked = provided(packages - _SYSTEM, near), {*found}
    if covered is None:  # what an unknown package provides is no package of this workspace only
        covered = provided({name for name in packages if name in near}, near) or set()
        checked = {name for name in found if name in near and name not in names()}
    # A package that a linked library lacks is reported at the library.
    others = _linked(target, own, files) - {target.name}
    covered.update(header.partition("/")[0] for name in others for header in own[name].headers_of_all(files.folder))
    for header in target.headers_of_all(files.folder):
        package = header.partition("/")[0]
        if "/" in header and package in checked and package not in {*covered, files.name}:
            covered.add(package)
            message = f"target `{target.name}` includes headers of `{package}`, but does not depend on it"
            yield BuildDefect(source, *target.place, message)


_SYSTEM = frozenset(("Eigen3", "Threads", "pthread", "m", "dl", "stdc++fs", "rt"))
"""Libraries that bring no package of ROS."""


def _own_headers(
    source: Source, target: Target, own: Mapping[str, Target], files: BuildFiles, folders: set[str]
) -> Iterator[BuildDefect]:
    """Yield a missing folder of headers of the package, and libraries of the package that a target has to link."""
    linked = _linked(target, own, files)
    available = {*folders, *(word for name in linked for word in own[name].words)}
    has_folder = any("include" in word.lower() and "catkin_INCLUDE" not in word for word in available)
    needed = [(path, header) for path, header in target.headers if files.has(f"include/{header}")]
    if needed and not has_folder:
        near = next((word for word in sorted(available) if is_slip(word, "include")), None)
        if near is None:
            message = f"`{needed[0][1]}` is not found: target `{target.name}` lacks the folder `include` of headers"
            yield BuildDefect(source, target.added.start, target.added.name, message)
            return
    stems = {Path(header).stem: header for _, header in needed}
    for library in own.values():
        if library.name in linked or library.added.name != "add_library" or library.is_module:
            continue
        made = next((path for path in library.sources if path.stem in stems), None)
        if made is None or any(path.stem == made.stem for name in linked for path in own[name].sources):
            continue
        if any(path == made and header == stems[made.stem] for path, header in library.headers):
            message = (
                f"target `{target.name}` uses `{stems[made.stem]}`, but does not link the library `{library.name}`"
            )
            yield BuildDefect(source, *target.place, message)
            linked.add(library.name)
