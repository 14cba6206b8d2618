"""Defects of a CMakeLists.txt: syntax, commands without their package, and places of the installation."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_folder
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import OPTIONS, CMakeCommand, misspelt_word, without_comments
from urdfkit.lint.finding import Severity
from urdfkit.lint.fix_builders import nearest
from urdfkit.record import record

_TOKENS = r"#\[(=*)\[(?s:.*?)(?:\]\1\]|\Z)|#[^\n]*|\"(?:\\(?s:.)|[^\"\\])*\"|\[(=*)\[(?s:.*?)(?:\]\2\]|\Z)|\\.|[()]"
_TOOLS = {
    "ament_package": ("ament_cmake", "ament_cmake_core", "ament_cmake_auto", "ament_cmake_ros", "ament_cmake_python"),
    "catkin_package": ("catkin", "catkin_simple"),
}
"""Command → packages that define it."""

_CATKIN = {
    "CATKIN_PACKAGE_SHARE_DESTINATION": "share/{0}",
    "CATKIN_PACKAGE_ETC_DESTINATION": "etc/{0}",
    "CATKIN_PACKAGE_BIN_DESTINATION": "lib/{0}",
    "CATKIN_PACKAGE_LIB_DESTINATION": "lib",
    "CATKIN_PACKAGE_INCLUDE_DESTINATION": "include/{0}",
    "CATKIN_PACKAGE_PYTHON_DESTINATION": "lib/python3/dist-packages/{0}",
    **{f"CATKIN_GLOBAL_{name}_DESTINATION": name.lower() for name in ("SHARE", "BIN", "LIB", "LIBEXEC", "ETC")},
    "CATKIN_GLOBAL_INCLUDE_DESTINATION": "include",
    "CATKIN_GLOBAL_PYTHON_DESTINATION": "lib/python3/dist-packages",
}
"""Variables of catkin (cmake/catkin_destinations.cmake, all.cmake) and their values; {0} is the package."""

_VARIABLES = (
    *("PROJECT_NAME", "CATKIN_PACKAGE_SHARE_DESTINATION", "CATKIN_PACKAGE_BIN_DESTINATION", "PROJECT_SOURCE_DIR"),
    *("CATKIN_PACKAGE_LIB_DESTINATION", "CATKIN_PACKAGE_INCLUDE_DESTINATION", "CATKIN_GLOBAL_BIN_DESTINATION"),
    *("CATKIN_GLOBAL_INCLUDE_DESTINATION", "CMAKE_CURRENT_SOURCE_DIR", "catkin_INCLUDE_DIRS", "catkin_LIBRARIES"),
)
_PROJECT = r"PROJECT_(NAME|(SOURCE|BINARY)_DIR|VERSION\w*|DESCRIPTION|HOMEPAGE_URL|IS_TOP_LEVEL)"
_FOLDERS = ("launch", "urdf", "meshes", "rviz", "worlds")
"""Folders whose files are found in the share folder of the package."""


@record(eq=False)
class BuildDefect:
    """A defect of a build file, with its text, the offset of it, and the kind of the finding."""

    source: Source
    start: int
    text: str
    message: str
    severity: Severity = "error"
    kind: str = ""


def unbalanced(source: Source) -> BuildDefect | None:
    """Return the first parenthesis of a CMakeLists.txt that is not closed or not opened; None if all are paired."""
    opened: list[int] = []
    for at in re.finditer(_TOKENS, source.text):
        if at[0] == "(":
            opened.append(at.start())
        elif at[0] == ")":
            if not opened:
                return BuildDefect(source, at.start(), ")", "unmatched `)`")
            opened.pop()
    if not opened:
        return None
    name = re.search(r"(?<!\w)\w*[ \t]*$", source.text[: opened[0]])
    start = name.start() if name is not None else opened[0]
    command = source.text[start : opened[0]].strip() or "("
    return BuildDefect(source, start, command, f"the parenthesis of `{command}` is not closed")


def cmake_defects(source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield the defects of the commands of a CMakeLists.txt without syntax errors."""
    yield from _calls(source, every)
    yield from _order(source, every)
    yield from _variables(source, every)
    yield from _targets(source, every)
    for command in every:
        words = [word for word, _ in command.words]
        misspelt = misspelt_word(command)
        if misspelt is not None:
            word, start, near = misspelt
            yield BuildDefect(
                source, start, word, f"unknown argument `{word}` of {command.name}()" + Suggestion(near, word)
            )
            continue
        if command.name not in ("install", "catkin_install_python") or words[:1] not in (
            ["DIRECTORY"],
            ["FILES"],
            ["PROGRAMS"],
        ):
            continue
        end = next((at for at, word in enumerate(words) if word in OPTIONS), len(words))
        listed = command.words[1:end] if words[0] != "DIRECTORY" else ()
        folders = [(word, start) for word, start in listed if is_folder(Path(source.file).parent / word)]
        if folders:
            names = "folder " if len(folders) == 1 else "folders "
            names += ", ".join(f"`{word}`" for word, _ in folders)
            message = f"{command.name}({words[0]}) does not install {names}; write install(DIRECTORY …)"
            yield BuildDefect(source, folders[0][1], folders[0][0], message)
        others = [word for word in words if word.startswith("${") and word[2:-1] not in _CATKIN]
        if "DESTINATION" not in words and "TYPE" not in words and not others:
            yield BuildDefect(source, command.start, command.name, f"{command.name}({words[0]}) has no DESTINATION")


def _variables(source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield misspelt variables, and destinations of variables that neither CMake nor catkin defines."""
    from urdfkit.lint.model.masked_names import is_typo

    text = without_comments(source.text)
    assigned = re.findall(r"(?i)\b(?:set|foreach|option|list\s*\(\s*\w+|file\s*\(\s*\w+)\s*\(?\s*(\w+)", text)
    packages = {command.words[0][0] for command in every if command.name == "find_package" and command.words}
    is_whole = not any(command.name == "include" for command in every) and not any("$" in name for name in packages)
    defined = {*_VARIABLES, *_CATKIN, *assigned}
    places = re.finditer(r"DESTINATION\s+([^\s()]*)", text)
    destinations = {place.start(1) + use.start() for place in places for use in re.finditer(r"\$\{", place[1])}
    for use in re.finditer(r"\$\{(\w+)\}", text):
        name = use[1]
        is_destination = use.start() in destinations
        if name in _CATKIN and is_whole and is_destination and "catkin" not in packages and name not in assigned:
            yield BuildDefect(source, use.start(1), name, f"variable `{name}` is empty without find_package(catkin)")
        if name in defined or re.fullmatch(_PROJECT, name):
            continue
        near = nearest(name, _VARIABLES, cutoff=0.85)
        if near is not None and is_typo(name, near):
            message = f"unknown variable `{name}`" + Suggestion(near, name)
            yield BuildDefect(source, use.start(1), name, message)
            continue
        if is_whole and is_destination and re.fullmatch(r"PROJECT(_\w+)?|CATKIN_(PACKAGE|GLOBAL)_\w+", name):
            yield BuildDefect(source, use.start(1), name, f"variable `{name}` does not exist")


_ADDING = ("add_executable", "add_library", "add_custom_target", "ament_auto_add_executable", "ament_auto_add_library")
_OF_TARGET = (
    *("target_link_libraries", "ament_target_dependencies", "target_include_directories", "target_compile_features"),
    *("target_compile_definitions", "target_compile_options", "target_sources", "rclcpp_components_register_node"),
    *("rclcpp_components_register_nodes",),
)
"""Commands whose first argument is a target of the package."""

_MAKING = (
    r"include|add_subdirectory|function|macro|foreach|\w*add_module|\w*_add_\w+|generate_\w+|rosidl_\w+|add_\w+"
    r"|fetchcontent_\w+|externalproject_\w+|cpm\w+|pkg_\w+"
)
"""Matches commands that can define further targets."""

_TEST = r"\w*add_(?:rostest_)?(?:gtest|gmock|google_benchmark|executable_with_gtest)\w*"
"""Matches commands that define a target of a test (ament_cmake_gtest, catkin, rostest)."""


def _targets(source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield the targets that a command uses and none defines; where several do, the definition with another name."""
    from urdfkit.lint.facts.ros_packages import names as ros_packages

    project = next((each.words[0][0] for each in every if each.name == "project" and each.words), "")

    def named(word: str) -> str:
        return re.sub(r"\$\{(?:PROJECT_NAME|CMAKE_PROJECT_NAME)\}", project, word)

    defined = {named(each.words[0][0]): each.words[0] for each in every if each.name in _ADDING and each.words}
    others = {each.name for each in every} - {*_ADDING, "add_dependencies", "add_definitions", "add_compile_options"}
    is_open = any(
        re.fullmatch(_MAKING, name) and not re.search(r"test|message|service|action", name) for name in others
    )
    if not defined or is_open or any("$" in name for name in defined):
        return
    conditions = [word for each in every if each.name in ("if", "elseif") for word in pairwise(each.words)]
    accepted = {*defined, *(named(word) for (key, _), (word, _) in conditions if key == "TARGET")}
    accepted |= {named(each.words[0][0]) for each in every if each.words and re.fullmatch(_TEST, each.name)}
    found = {each.words[0][0] for each in every if each.name == "find_package" and each.words}
    around = neighbours(Path(source.file).absolute().parent)
    # Packages of the system can define targets of any name.
    has_others = not found <= {*ros_packages(), "catkin", *around}
    uses: list[tuple[str, int]] = []
    for each in every:
        words = each.words[:1] if each.name in _OF_TARGET else ()
        if each.name == "install" and each.words and each.words[0][0] == "TARGETS":
            end = next((at for at, (word, _) in enumerate(each.words) if at and word.isupper()), len(each.words))
            words = each.words[1:end]
        uses += ((named(word), start) for word, start in words)
    missing = [
        (name, start)
        for name, start in uses
        if name not in accepted
        and not re.search(r"[$:]", name)
        and not (has_others and nearest(name, sorted(defined), cutoff=0.6) is None)
    ]
    unused = [name for name in defined if name not in {use for use, _ in uses}]
    names = {name for name, _ in missing}
    if len(missing) > 1 and len(names) == len(unused) == 1:
        word, start = defined[unused[0]]
        yield BuildDefect(source, start, word, f"the other commands call this target `{missing[0][0]}`")
        return
    for name, start in missing[: 1 if len(names) == 1 else None]:
        near = unused[0] if len(unused) == 1 else nearest(name, sorted(defined), cutoff=0.5)
        yield BuildDefect(source, start, name, f"no command defines the target `{name}`" + Suggestion(near, name))


def _calls(source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield a missing project(), and the calls of a build tool that find_package does not find."""
    from urdfkit.lint.facts.ros_packages import misspelling_of, names

    defined = {command.name for command in every}
    if "include" in defined:
        return
    if every and not any(nearest(name, ["project"], cutoff=0.8) for name in defined):
        yield BuildDefect(source, every[0].start, every[0].name, "CMakeLists.txt does not call project()")
    found = [command.words[0] for command in every if command.name == "find_package" and command.words]
    packages = [name for name, _ in found]
    for command in every if not any("$" in name for name in packages) else ():
        tools = _TOOLS.get(command.name, ())
        if not tools or any(name in tools for name in packages):
            continue
        near = nearest(tools[0], [name for name in packages if name not in names()], cutoff=0.85)
        if near is None and not any("cmake" in name and name not in names() for name in packages):
            message = f"{command.name}() needs find_package({tools[0]} REQUIRED)"
            # The other build tool stands for the missing one, unless its own command is called too.
            of_other = [
                (start, name)
                for name, start in found
                for other, build_tools in _TOOLS.items()
                if name == build_tools[0] and other not in defined
            ]
            start, text = of_other[0] if of_other else (command.start, command.name)
            yield BuildDefect(source, start, text, message, kind="find_package")
        elif near is not None and misspelling_of(near, ()) is None:  # the rule reports other misspelt packages
            message = f"unknown package `{near}`" + Suggestion(tools[0], near)
            yield BuildDefect(source, dict(found)[near], near, message)


def _order(source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield calls in the wrong order: catkin_package() before catkin is found, and commands after ament_package().

    Sources: catkin, user guide of CMakeLists.txt; ament_cmake, ament_cmake_core/cmake/core/ament_package.cmake, and the
    checks of ament_cmake_export_*.
    """
    names = [command.name for command in every]
    finds = [at for at, each in enumerate(every) if each.name == "find_package" and each.words[:1]]
    catkin = [at for at in finds if every[at].words[0][0] in _TOOLS["catkin_package"]]
    if "catkin_package" in names and catkin and names.index("catkin_package") < catkin[0]:
        command = every[names.index("catkin_package")]
        yield BuildDefect(source, command.start, command.name, "catkin_package() is called before find_package(catkin)")
    for tool in _TOOLS:
        places = [at for at, name in enumerate(names) if name == tool]
        for first, second in pairwise(places):
            is_early = tool == "catkin_package" and bool(catkin) and first < catkin[0]
            if not is_early and not {"if", "else", "elseif", "endif", "return"} & {*names[first:second]}:
                yield BuildDefect(
                    source, every[second].start, tool, f"{tool}() is called twice; remove one of the calls"
                )
    if names.count("ament_package") != 1:
        return
    for command in every[names.index("ament_package") + 1 :]:
        if command.name == "install" or command.name.startswith("ament_export_"):
            severity: Severity = "warning" if command.name == "install" else "error"
            message = f"{command.name}() is called after ament_package(), which must be the last call"
            yield BuildDefect(source, command.start, command.name, message, severity)
            return


def misplaced(
    files: BuildFiles, source: Source, every: list[CMakeCommand], used: set[str], named: set[str]
) -> Iterator[BuildDefect]:
    """Yield the installations of folders to another place than the share folder of the package.

    Args:
        files: the build files of the package.
        source: its CMakeLists.txt.
        every: the commands of it.
        used: folders of the package that launch files use, and the folder of its launch files.
        named: folders whose paths in the share folder other files name.
    """
    share, right, wrong = f"share/{files.name}", set[str](), list[tuple[str, BuildDefect]]()
    for command in every:
        words = [word for word, _ in command.words]
        if command.name != "install" or words[:1] != ["DIRECTORY"] or "DESTINATION" not in words[:-1]:
            continue
        written, start = command.words[words.index("DESTINATION") + 1]
        place = evaluated(written, files.name)
        written_folders = words[1 : next(i for i, word in enumerate(words) if word in OPTIONS)]
        folders = [word.strip("/") for word in written_folders]
        if place is None or place == share or place.startswith((f"{share}/", "/")):
            for word, folder in zip(written_folders, folders, strict=True):
                # CMake installs the folder itself, or with a final slash its content.
                installed = place if word.endswith("/") or place is None else f"{place}/{folder.rpartition('/')[2]}"
                if installed in (None, f"{share}/{folder}") or "/" in folder or "$" in word or folder not in named:
                    right.add(folder)
                    continue
                message = f"folder `{folder}` is installed as `{installed}`, but its files are looked up in"
                wrong.append((folder, BuildDefect(source, start, written, f"{message} `{share}/{folder}`")))
            continue
        is_share = re.fullmatch(r"share(/\w+)?", place) is not None
        is_elsewhere = is_share or place.partition("/")[0] in (files.name, "lib", "bin", "include", "etc", "launch")
        for folder in folders if is_elsewhere else ():
            if folder.partition("/")[0] in {*used, *_FOLDERS}:
                message = f"folder `{folder}` is installed to `{place}`, but its files are looked up in `{share}`"
                wrong.append((folder, BuildDefect(source, start, written, message)))
    yield from (defect for folder, defect in wrong[:1] if folder not in right)


def evaluated(written: str, package: str) -> str | None:
    """Return a destination without variables; None if it has others than those of the project and of catkin."""
    values = {"PROJECT_NAME": package, "CMAKE_PROJECT_NAME": package, "CMAKE_INSTALL_PREFIX": "/prefix"}
    values |= {name: value.format(package) for name, value in _CATKIN.items()}
    text = re.sub(r"\$\{(\w+)\}", lambda use: values.get(use[1], use[0]), written)
    return None if "$" in text else text.rstrip("/")
