"""Packages and libraries that the code of targets in a CMakeLists.txt needs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect
from urdfkit.lint.facts.packaging.cmake_packages import found_packages, place_of_package, provided
from urdfkit.lint.facts.packaging.own_code import before_messages, missing_own_headers, uncompiled_files
from urdfkit.lint.facts.packaging.targets import ADDING, KEYWORDS, USES, Target, linked, named, targets
from urdfkit.lint.facts.ros_packages import is_slip, names

_NO_CODE = ("INTERFACE", "ALIAS", "IMPORTED")


def code_defects(files: BuildFiles, source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield packages, folders and libraries that the code of targets needs and their commands do not name."""
    own = targets(files, every)
    found = found_packages(every)
    if not own or found is None or any(each.name in ("link_libraries", "function", "macro") for each in every):
        return
    wrong = list(_libraries(files, source, own, every))
    yield from wrong
    if wrong or any(named(each, files) not in own for each in every if each.name in USES and each.words):
        return  # missing packages are a consequence
    yield from uncompiled_files(source, own, files, every)
    yield from before_messages(source, own, files, every)
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
            yield from missing_own_headers(source, target, own, files, folders)


def _is_computed(target: Target, is_catkin: bool) -> bool:
    """Return whether variables of a target can stand for libraries of the package."""
    accepted = r"\$\{(?:CMAKE_)?PROJECT_NAME\}|\$<.*>|\$\{\w+_(?:LIBRARIES|INCLUDE_DIRS|TARGETS)\}|\$\{CMAKE_CURRENT_.*"
    accepted += r"|\$\{PROJECT_SOURCE_DIR\}.*"
    return any("$" in word and not re.fullmatch(accepted, word) for word in target.words)


def _libraries(
    files: BuildFiles, source: Source, own: Mapping[str, Target], every: list[CMakeCommand]
) -> Iterator[BuildDefect]:
    """Yield targets without source files, misspelt libraries of the package, and uses before the definition."""
    extended = {named(each, files) for each in every if each.name in ("target_sources", "qt5_wrap_cpp") and each.words}
    order = {id(each): at for at, each in enumerate(every)}
    for target in own.values():
        words = [word for word, _ in target.added.words[1:] if word in _NO_CODE or word not in KEYWORDS]
        if not words and target.name not in extended and target.added.name in ADDING:
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
    words = [word for name in linked(target, own, files) for word in own[name].words]
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
    words = {word for name in linked(target, own, files) for word in own[name].words}
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
    others = linked(target, own, files) - {target.name}
    covered.update(header.partition("/")[0] for name in others for header in own[name].headers_of_all(files.folder))
    for header in target.headers_of_all(files.folder):
        package = header.partition("/")[0]
        if "/" in header and package in checked and package not in {*covered, files.name}:
            covered.add(package)
            message = f"target `{target.name}` includes headers of `{package}`, but does not depend on it"
            yield BuildDefect(source, *target.place, message)


_SYSTEM = frozenset(("Eigen3", "Threads", "pthread", "m", "dl", "stdc++fs", "rt"))
"""Libraries that bring no package of ROS."""
