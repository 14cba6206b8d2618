"""Targets, programs and headers that install() leaves out or installs to a wrong place.

Sources: CMake (install), ament_cmake (ament_export_targets.cmake), class_loader and ros2cli (ros2pkg).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_folder
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import MODES, OPTIONS, CMakeCommand, misspelt_word
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect, evaluated
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.finding import Severity

_KINDS = ("ARCHIVE", "LIBRARY", "RUNTIME")
_STATIC = ("STATIC", "MODULE", "OBJECT", "INTERFACE", "ALIAS", "IMPORTED")
_TEST = r"BUILD_TESTING|CATKIN_ENABLE_TESTING|\w*BUILD_(?:TESTS?|EXAMPLES?)\w*"
_PROGRAM = r".*\.(?:py|sh|bash|pl|rb)"


def installation_defects(
    files: BuildFiles, source: Source, every: list[CMakeCommand], programs: Collection[str]
) -> Iterator[BuildDefect]:
    """Yield targets, programs and headers that are not installed, or not where they are searched.

    Args:
        files: the build files of the package.
        source: its CMakeLists.txt.
        every: the commands of it.
        programs: the executables of the package that launch files start.
    """
    wrong = [defect for each in every if each.name == "install" for defect in _arguments(source, each)]
    yield from wrong
    if wrong or any(misspelt_word(each) is not None for each in every):
        return
    installs = [each for each in every if each.name == "install" and each.words]
    yield from _exports(source, every, installs)
    yield from _programs(files, source, every, programs)
    is_open = any(each.name in ("include", "function", "macro", "ament_auto_package") for each in every)
    if not is_open and installs:
        yield from _targets(files, source, every, installs, programs)
        yield from _headers(files, source, every, installs)


def _arguments(source: Source, command: CMakeCommand) -> Iterator[BuildDefect]:
    """Yield a missing first word of install(), and a missing DESTINATION or folder."""
    words = [word for word, _ in command.words]
    if misspelt_word(command) is not None or not words:
        return
    if words[0] not in MODES and "$" not in words[0]:
        message = f"install() does not begin with one of {', '.join(MODES)}"
        yield BuildDefect(source, command.start, command.name, message)
        return
    for at, (word, start) in enumerate(command.words):
        following = words[at + 1] if at + 1 < len(words) else ""
        if word == "DESTINATION" and (not following or following in OPTIONS or following in _KINDS):
            yield BuildDefect(source, start, word, "DESTINATION has no folder")
            return
        is_bare = following in (*_KINDS, "") or not _is_keyword(following)
        if words[0] == "TARGETS" and word in _KINDS and is_bare:
            yield BuildDefect(source, start, word, f"`{word}` of install() has no DESTINATION")
            return
    has_files = len(words) > 1 and not _is_keyword(words[1])
    if words[0] in ("TARGETS", "FILES", "PROGRAMS", "DIRECTORY") and not has_files:
        yield BuildDefect(source, command.start, command.name, f"install({words[0]}) does not name anything to install")


def _exports(source: Source, every: list[CMakeCommand], installs: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield names of exports that ament_export_targets() and install() do not share."""
    made = {word[0]: word[1] for each in installs for word in _after(each, "EXPORT") if each.words[0][0] == "TARGETS"}
    exported = [word for each in every if each.name == "ament_export_targets" for word in each.words]
    exported = [(word, start) for word, start in exported if not word.isupper()]
    if any("$" in word for word in (*made, *(word for word, _ in exported))):
        return
    for word, start in exported:
        if word not in made and not any(each.words[0][0] == "EXPORT" for each in installs):
            near = next((name for name in made if is_slip(word, name)), None) or (
                next(iter(made)) if len(made) == 1 else None
            )
            yield BuildDefect(source, start, word, f"no install() creates the export `{word}`" + Suggestion(near, word))
    is_ament = any(each.name == "ament_package" for each in every)
    if made and not exported and is_ament and not any(each.words[0][0] == "EXPORT" for each in installs):
        word, start = next(iter(made.items()))
        message = f"ament_export_targets() is missing for the export `{word}`"
        yield BuildDefect(source, start, word, message, "warning")


def _is_keyword(word: str) -> bool:
    return re.fullmatch(r"[A-Z_]+", word) is not None


def _after(command: CMakeCommand, key: str) -> tuple[tuple[str, int], ...]:
    words = [word for word, _ in command.words]
    at = words.index(key) + 1 if key in words else len(words)
    return command.words[at : at + 1]


def _programs(
    files: BuildFiles, source: Source, every: list[CMakeCommand], programs: Collection[str]
) -> Iterator[BuildDefect]:
    """Yield scripts that are installed as files, or that launch files do not find in their folder."""
    for command in every:
        words = [word for word, _ in command.words]
        mode = words[0] if words else ""
        if command.name == "catkin_install_python" and mode != "PROGRAMS" and "$" not in mode:
            yield BuildDefect(source, command.start, command.name, f"{command.name}() does not begin with PROGRAMS")
            continue
        if command.name != "install" or mode not in ("FILES", "PROGRAMS") or "DESTINATION" not in words[:-1]:
            continue
        written, start = _after(command, "DESTINATION")[0]
        place = evaluated(written, files.name)
        scripts = [word for word in words[1 : words.index("DESTINATION")] if re.fullmatch(_PROGRAM, word)]
        if mode == "FILES" and scripts and place == f"lib/{files.name}" and "PERMISSIONS" not in words:
            message = f"`{scripts[0]}` is not executable after install(FILES); write install(PROGRAMS …)"
            yield BuildDefect(source, command.words[0][1], mode, message)
        launched = next((word for word in scripts if word.rpartition("/")[2] in programs), None)
        searched = (
            (f"lib/{files.name}", f"share/{files.name}") if files.build_tool == "catkin" else (f"lib/{files.name}",)
        )
        if launched is not None and place is not None and place not in searched:
            message = f"`{launched}` is installed to `{place}`, but launch files need it in `lib/{files.name}`"
            yield BuildDefect(source, start, written, message)


def _targets(
    files: BuildFiles,
    source: Source,
    every: list[CMakeCommand],
    installs: list[CMakeCommand],
    programs: Collection[str],
) -> Iterator[BuildDefect]:
    """Yield targets that are not installed, and libraries in a place where programs do not search them."""
    of_targets = [each for each in installs if each.words[0][0] == "TARGETS"]
    named: dict[str, CMakeCommand] = {}
    for command in of_targets:
        words = [word for word, _ in command.words]
        end = next((at for at, word in enumerate(words) if at and _is_keyword(word)), len(words))
        named.update((_name(word, files), command) for word in words[1:end])
    if any("$" in name for name in named):
        return
    added = {_name(each.words[0][0], files): at for at, each in enumerate(every) if "add_" in each.name and each.words}
    if not {*added}.issuperset(named):
        return  # the name of a target is wrong
    for number, each in enumerate(every):
        early = next((name for name in named if named[name] is each and added[name] > number), None)
        if early is not None:
            message = f"install() is called before the target `{early}` is defined"
            yield BuildDefect(source, each.start, each.name, message)
    tested = 0
    is_catkin = files.build_tool == "catkin"
    linked = {
        _name(word, files).rpartition("::")[2]
        for each in every
        if each.name == "target_link_libraries" and _name(each.words[0][0] if each.words else "", files) in named
        for word, _ in each.words[1:]
    }
    plugins = _plugins(files, every)
    for command in every:
        tested += command.name == "if" and (tested > 0 or any(re.fullmatch(_TEST, word) for word, _ in command.words))
        tested -= command.name == "endif" and tested > 0
        texts = [word for word, _ in command.words]
        if (
            command.name not in ("add_executable", "add_library")
            or not texts
            or tested
            or "$" in _name(texts[0], files)
        ):
            continue
        name, is_program = _name(texts[0], files), command.name == "add_executable"
        if any(word in _STATIC for word in texts) or any(re.search(r"\btests?/", word) for word in texts):
            continue
        if name in named:
            yield from _place_of_library(files, source, named[name], name, is_program)
            continue
        use = "but launch files start it" if name in programs else ""
        if not is_program and name in {*plugins, *linked}:
            use = "but a target links it" if name in linked else "but it has plugins"
        if not use and (is_catkin or not is_program or not named):
            continue
        severity: Severity = "note" if is_catkin else "warning"
        at = of_targets[0] if of_targets else command
        message = f"target `{name}` is not installed" + (f", {use}" if use else "")
        yield BuildDefect(source, at.start, at.name, message, severity)


def _name(word: str, files: BuildFiles) -> str:
    return re.sub(r"\$\{(?:CMAKE_)?PROJECT_NAME\}", files.name, word)


def _plugins(files: BuildFiles, every: list[CMakeCommand]) -> set[str]:
    """Return the targets with components, and the libraries that descriptions of plugins name."""
    from urdfkit.lint.facts.packaging.plugin_defects import descriptions

    nodes = {
        _name(each.words[0][0], files) for each in every if each.name.startswith("rclcpp_components_") and each.words
    }
    paths = [
        path
        for source in descriptions(files)
        for path in re.findall(r"<library\s[^>]*path\s*=\s*[\"']([^\"']+)", source.text)
    ]
    names = {path.strip().rpartition("/")[2].removesuffix(".so") for path in paths}
    return {*nodes, *names, *(name.removeprefix("lib") for name in names)}


def _place_of_library(
    files: BuildFiles, source: Source, command: CMakeCommand, name: str, is_program: bool
) -> Iterator[BuildDefect]:
    """Yield the place of a shared library where nothing loads it, and a missing place of a program."""
    words = [word for word, _ in command.words]
    if "DESTINATION" not in words:
        return
    kind = "RUNTIME" if is_program else "LIBRARY"
    has_all = not any(word in _KINDS for word in words[: words.index("DESTINATION")])
    at = words.index(kind) if kind in words else words.index("DESTINATION") - 1 if has_all else None
    if at is None or words[at + 1] != "DESTINATION":
        if is_program and not has_all and kind not in words:
            start = command.words[words.index("DESTINATION") - 1][1]
            message = f"install() has no RUNTIME DESTINATION for the executable `{name}`"
            yield BuildDefect(source, start, words[words.index("DESTINATION") - 1], message)
        return
    written, start = command.words[at + 2]
    place = evaluated(written, files.name)
    if place is None:
        return
    if not is_program and place in ("bin", "share", f"lib/{files.name}", f"share/{files.name}"):
        message = f"library `{name}` is installed to `{place}`, but programs search for it in `lib`"
        yield BuildDefect(source, start, written, message, "warning")
    elif is_program and (place == "lib" or (place.startswith("share") and files.build_tool != "catkin")):
        message = f"executable `{name}` is installed to `{place}`, but ROS searches for it in `lib/{files.name}`"
        yield BuildDefect(source, start, written, message)


def _headers(
    files: BuildFiles, source: Source, every: list[CMakeCommand], installs: list[CMakeCommand]
) -> Iterator[BuildDefect]:
    """Yield the folder of headers that the package exports and does not install."""
    exporting = [each for each in every if each.name in ("ament_export_include_directories", "ament_export_targets")]
    exporting += [
        each for each in every if each.name == "catkin_package" and "INCLUDE_DIRS" in [word for word, _ in each.words]
    ]
    if not exporting or not is_folder(files.folder / "include"):
        return
    text = " ".join(word for each in installs for word, _ in each.words if each.words[0][0] in ("DIRECTORY", "FILES"))
    if re.search(r"(?<!\w)include\b|\.h(?:pp|h)?\b|HEADER", text) or re.search(r"\$\{(?!PROJECT_NAME|CATKIN_)", text):
        return
    # Packages with interface libraries and generated headers install them in other ways.
    if "FILE_SET" in source.text or "PUBLIC_HEADER" in source.text:
        return
    severity: Severity = "note" if files.build_tool == "catkin" else "warning"
    message = "folder `include` is not installed, but the package exports its headers"
    at = next((each for each in installs if each.words[0][0] == "DIRECTORY"), installs[0])
    yield BuildDefect(source, at.start, at.name, message, severity)
