"""Headers, libraries and source files of the own package that the targets of a CMakeLists.txt need."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect
from urdfkit.lint.facts.packaging.targets import ADDING, CODE, Target, included, linked, without_project
from urdfkit.lint.facts.ros_packages import is_slip


def missing_own_headers(
    source: Source, target: Target, own: Mapping[str, Target], files: BuildFiles, folders: set[str]
) -> Iterator[BuildDefect]:
    """Yield a missing folder of headers of the package, and libraries of the package that a target has to link."""
    reached = linked(target, own, files)
    available = {*folders, *(word for name in reached for word in own[name].words)}
    has_folder = any(_is_folder(word) for word in available)
    needed = [(path, header) for path, header in target.headers if files.has(f"include/{header}")]
    if needed and has_folder and not any(_is_folder(word) for word in {*folders, *target.words}):
        private = [_private_folder(own[name]) for name in sorted(reached - {target.name})]
        shared = [word for name in reached - {target.name} for word in own[name].words if _is_folder(word)]
        hidden = [each for each in private if each is not None]
        if len(hidden) == len(shared) == 1:
            [start] = hidden
            message = f"`{needed[0][1]}` is not found for target `{target.name}`, because this folder is PRIVATE"
            yield BuildDefect(source, start, "PRIVATE", message + Suggestion("PUBLIC", "PRIVATE"))
            return
    if needed and not has_folder:
        near = next((word for word in sorted(available) if is_slip(word, "include")), None)
        if near is None:
            message = f"`{needed[0][1]}` is not found: target `{target.name}` lacks the folder `include` of headers"
            yield BuildDefect(source, target.added.start, target.added.name, message)
            return
    stems = {Path(header).stem: header for _, header in needed}
    for library in own.values():
        if library.name in reached or library.added.name != "add_library" or library.is_module:
            continue
        made = next((path for path in library.sources if path.stem in stems), None)
        if made is None or any(path.stem == made.stem for name in reached for path in own[name].sources):
            continue
        if any(path == made and header == stems[made.stem] for path, header in library.headers):
            message = (
                f"target `{target.name}` uses `{stems[made.stem]}`, but does not link the library `{library.name}`"
            )
            yield BuildDefect(source, *target.place, message)
            reached.add(library.name)


def _is_folder(word: str) -> bool:
    """Return whether a word is a folder of headers of the package."""
    return "include" in word.lower() and "catkin_INCLUDE" not in word


def _private_folder(library: Target) -> int | None:
    """Return the offset of PRIVATE before the folder of headers of a library; None if its users get the folder."""
    for command in library.uses:
        scope: tuple[str, int] = ("", 0)
        for word, start in command.words[1:] if command.name == "target_include_directories" else ():
            scope = (word, start) if word in ("PUBLIC", "PRIVATE", "INTERFACE") else scope
            if _is_folder(word) and scope[0] == "PRIVATE":
                return scope[1]
    return None


def uncompiled_files(
    source: Source, own: Mapping[str, Target], files: BuildFiles, every: list[CMakeCommand]
) -> Iterator[BuildDefect]:
    """Yield targets that include a header of the package whose code in the same folder no target compiles.

    This code has the name of the header, includes it and has no ``main()``.
    """
    words = [word for target in own.values() for word, _ in target.added.words[1:]]
    if any("$" in word and "TARGET_OBJECTS" not in word for word in words):
        return  # a variable may name more files
    others = (name for name in (command.name for command in every) if re.fullmatch(_OTHER_TARGETS, name))
    if any(name not in ADDING for name in others) or any(command.name in _ADDING_FILES for command in every):
        return
    compiled = {path.stem for target in own.values() for path in target.sources}
    headers = (header for target in own.values() for header in target.headers_of_all(files.folder))
    compiled |= {Path(header).stem for header in headers if re.fullmatch(CODE, header)}  # code of templates
    for target in own.values():
        folders = sorted({path.parent for path in target.sources})
        for path, header in target.headers:
            stem = Path(header).stem
            if stem in compiled or not (files.has(f"include/{header}") or is_file(path.parent / header)):
                continue
            beside = [each for folder in folders for each in sorted(folder.glob(f"{stem}.c*"))]
            code = next((each for each in beside if re.fullmatch(CODE, each.name) and _implements(each, header)), None)
            if code is not None and files.folder in code.parents:
                compiled.add(stem)
                name = code.relative_to(files.folder).as_posix()
                message = f"no target compiles `{name}`, but target `{target.name}` uses its header `{header}`"
                yield BuildDefect(source, target.added.start, target.added.name, message, "warning")


def before_messages(
    source: Source, own: Mapping[str, Target], files: BuildFiles, every: list[CMakeCommand]
) -> Iterator[BuildDefect]:
    """Yield targets that include headers of messages of the package, but are not built after these messages.

    Sources: catkin (user guide, "Building messages, services or actions") and rosidl_cmake
    (rosidl_get_typesupport_target, rosidl_target_interfaces).
    """
    names = {each.name for each in every}
    is_catkin = "generate_messages" in names
    if not is_catkin and "rosidl_generate_interfaces" not in names:
        return
    waiting = {
        without_project(each.words[0][0], files)
        for each in every
        if each.name in ("add_dependencies", "rosidl_target_interfaces") and each.words
        if any(re.search(_GENERATED, word) for word, _ in each.words[1:]) or each.name.startswith("rosidl_")
    }
    if any("$" in name for name in waiting):
        return  # a loop over targets
    for target in own.values():
        reached = linked(target, own, files)
        words = [word for name in reached for word in own[name].words]
        is_waiting = not reached.isdisjoint(waiting) or any(
            re.search(r"typesupport|_generate_messages", w) for w in words
        )
        if is_waiting or not _is_plain(words, is_catkin):
            continue
        pattern = re.escape(files.name) + (r"/([A-Z]\w*)\.h" if is_catkin else r"/(?:msg|srv|action)/(\w+)\.hpp")
        headers = [header for header in target.headers_of_all(files.folder) if re.fullmatch(pattern, header)]
        header = next((each for each in headers if not files.has(f"include/{each}")), None)
        if header is not None:
            needed = "add_dependencies()" if is_catkin else "rosidl_get_typesupport_target()"
            message = f"target `{target.name}` includes `{header}`, but may be built before it; call {needed}"
            yield BuildDefect(source, *target.place, message, "warning" if is_catkin else "error")


_GENERATED = r"(?<!catkin)_EXPORTED_TARGETS|_generate_messages|_gencpp|_gencfg"
"""Matches the targets that generate the messages of a package of catkin; those of other packages are in catkin_…."""


def _is_plain(words: list[str], is_catkin: bool) -> bool:
    """Return whether no variable among the words of targets can stand for the messages of the package."""
    accepted = r"\$\{(?:catkin|Boost|EIGEN3?)_\w+\}" if is_catkin else r"\$\{\w+_(?:TARGETS|LIBRARIES|INCLUDE_DIRS)\}"
    accepted += r"|\$<.*>|\$\{PROJECT_NAME\}\w*|\$\{CMAKE_\w+\}.*"
    return all("$" not in word or re.fullmatch(accepted, word) for word in words)


_OTHER_TARGETS = r".*add_(?:library|executable|module|nodelet)"
"""Matches commands that define targets, such as those of ament_cmake_auto and catkin_simple."""

_ADDING_FILES = ("target_sources", "add_subdirectory", "include", "aux_source_directory", "qt5_wrap_cpp")


def _implements(path: Path, header: str) -> bool:
    """Return whether a file in C++ includes a header and is no program."""
    return header in included(path) and re.search(r"\bmain\s*\(", path.read_text("utf-8", "replace")) is None
