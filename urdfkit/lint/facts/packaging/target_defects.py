"""Targets and messages of a CMakeLists.txt: messages that are not generated, packages and places of targets.

Sources: genmsg (cmake/pkg-genmsg.cmake.em), rosidl_cmake (rosidl_generate_interfaces.cmake), ros2cli (ros2pkg,
get_executable_paths), roslib (rospack).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand, without_comments
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect, evaluated
from urdfkit.lint.facts.packaging.cmake_packages import provided
from urdfkit.lint.facts.packaging.interface_defects import interface_defects
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.project.code_files import code_texts

INTERFACES = (".msg", ".srv", ".action")
"""Endings of the names of files with messages, services and actions."""

_OF_CATKIN = {"msg": "add_message_files", "srv": "add_service_files", "action": "add_action_files"}
"""Folder → the command of catkin that generates its files."""

_GENERATOR = "rosidl_generate_interfaces"


def message_defects(files: BuildFiles, source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield messages that CMakeLists.txt does not generate, and missing packages of their types."""
    generators = [each for each in every if each.name in (_GENERATOR, "generate_messages")]
    if len(generators) != 1 or re.search(r"\binclude\s*\(", source.text):
        return
    generator = generators[0]
    texts = [(path, text) for path, text in code_texts(files.folder, INTERFACES) if path.parent.parent == files.folder]
    is_catkin = generator.name == "generate_messages"
    dependencies = files.dependencies()
    lines = list(interface_defects(files, texts, dependencies, 1 if is_catkin else 2))
    yield from lines
    misspelt = {defect.text for defect in lines}
    paths = [path for path, _ in texts]
    missing, meant = _missing(files, source, every, generator, paths)
    yield from missing
    yield from _ungenerated(source, every, generator, [path for path in paths if path not in meant])
    words = [word for word, _ in generator.words]
    at = words.index("DEPENDENCIES") if "DEPENDENCIES" in words else len(words)
    end = next((i for i, word in enumerate(words) if i > at and word.isupper()), len(words))
    covered = None if any("$" in word for word in words[at:end]) else provided(words[at + 1 : end], {})
    start, word = (generator.words[at][1], words[at]) if at < len(words) else (generator.start, generator.name)
    seen = {files.name, *(covered or ())}
    for path, text in texts if covered is not None else ():
        for package in _packages(path, text, is_catkin):
            if package not in seen and path.name in source.text and package not in misspelt:
                seen.add(package)
                message = f"`{path.name}` uses `{package}`, which is missing in DEPENDENCIES"
                yield BuildDefect(source, start, word, message)
    if not is_catkin and "SKIP_INSTALL" not in words:
        yield from _manifest_of_interfaces(files)


def _packages(path: Path, text: str, is_catkin: bool) -> list[str]:
    """Return the packages of the types in a file with a message, service or action, in their order."""
    found = re.findall(r"(?m)^[ \t]*(\w+)/\w+(?:\[[<=\d]*\])?[ \t]+\w+", text)
    found += ["std_msgs"] if is_catkin and re.search(r"(?m)^[ \t]*Header[ \t]+\w+", text) else []
    found += ["actionlib_msgs"] if is_catkin and path.suffix == ".action" else []  # in the messages of the action
    return list(dict.fromkeys(found))


def _missing(
    files: BuildFiles, source: Source, every: list[CMakeCommand], generator: CMakeCommand, paths: list[Path]
) -> tuple[list[BuildDefect], list[Path]]:
    """Return the files that commands generate from and that do not exist, and the existing files that are meant."""
    if re.search(_WRITING, without_comments(source.text)):
        return [], []
    named: list[tuple[Path, str, int]] = []
    for command in every if generator.name != _GENERATOR else [generator]:
        folder = next((folder for folder, name in _OF_CATKIN.items() if name == command.name), "")
        words = [word for word, _ in command.words]
        if (command is generator) == bool(folder) or "DIRECTORY" in words:
            continue
        for word, start in command.words:
            if Path(word).suffix in INTERFACES and re.fullmatch(r"[\w./-]+", word):
                named.append((files.folder / folder / word, word, start))
    left = [path for path in paths if path not in [each for each, _, _ in named]]
    found: list[BuildDefect] = []
    meant: list[Path] = []
    for path, word, start in named:
        if is_file(path):
            continue
        same = [each for each in left if each.suffix == path.suffix]
        near = nearest(path.name, [each.name for each in same], cutoff=0.6)
        only = same[0].name if len(same) == 1 else None
        meant += [each for each in same if each.name == (near or only)]
        message = f"`{path.relative_to(files.folder).as_posix()}` does not exist in this package"
        found.append(BuildDefect(source, start, word, message + Suggestion(near or only, path.name), kind="missing"))
    return found, meant


_WRITING = r"(?i)add_custom_|configure_file|execute_process|\bfile\s*\("
"""Matches commands that can write files."""


def _ungenerated(
    source: Source, every: list[CMakeCommand], generator: CMakeCommand, paths: list[Path]
) -> Iterator[BuildDefect]:
    """Yield the files of the folders of messages that the commands do not name."""
    for path in paths:
        folder = path.parent.name
        if folder not in _OF_CATKIN or path.suffix != f".{folder}" or path.name in source.text:
            continue
        command, of = generator, ""
        if generator.name != _GENERATOR:
            command = next((each for each in every if each.name == _OF_CATKIN[folder]), generator)
            if command is not generator and "FILES" not in [word for word, _ in command.words]:
                continue  # the command generates all files of the folder
            of = f"; {_OF_CATKIN[folder]}() does not name it"
        if any("$" in word for word, _ in command.words[1 if command is generator else 0 :]):
            continue
        message = f"`{folder}/{path.name}` is not generated" + (of or f"; {generator.name}() does not name it")
        yield BuildDefect(source, command.start, command.name, message, "warning")


def _manifest_of_interfaces(files: BuildFiles) -> Iterator[BuildDefect]:
    """Yield the missing group and dependency in the package.xml of a package with messages."""
    groups = files.tags("member_of_group")
    needed = files.tags("depend", "exec_depend", "run_depend", "build_export_depend")
    last = max((tag for _, tag in (*needed, *files.tags("buildtool_depend"))), key=lambda tag: tag.start, default=None)
    if last is None:
        return
    place = (files.manifest, last.start, files.manifest.text[last.start : last.end])
    if not any(text == "rosidl_interface_packages" for text, _ in groups):
        message = f"{_GENERATOR}() needs <member_of_group>rosidl_interface_packages</member_of_group> in package.xml"
        yield BuildDefect(*place, message)
    elif not any(text == "rosidl_default_runtime" for text, _ in needed):
        message = "missing dependency on `rosidl_default_runtime`, which generated messages need"
        yield BuildDefect(*place, message, "warning")


def target_defects(
    files: BuildFiles, source: Source, every: list[CMakeCommand], programs: Collection[str]
) -> Iterator[BuildDefect]:
    """Yield targets without a package whose headers they include, and executables in another place than ROS searches.

    Args:
        files: the build files of the package.
        source: its CMakeLists.txt.
        every: the commands of it.
        programs: the executables of the package that launch files start.
    """
    added = [each for each in every if each.name in ("add_executable", "add_library") and each.words]
    executables = {each.words[0][0] for each in added if each.name == "add_executable"}
    for command in every:
        words = [word for word, _ in command.words]
        if command.name != "install" or words[:1] != ["TARGETS"] or "DESTINATION" not in words[:-1]:
            continue
        runtime = words.index("RUNTIME") + 1 if "RUNTIME" in words[:-2] else words.index("DESTINATION")
        if words[runtime] != "DESTINATION":
            continue
        written, start = command.words[runtime + 1]
        place = evaluated(written, files.name)
        target = next((word for word in words[1:runtime] if word in executables and word in programs), None)
        if target is not None and place is not None and place not in (f"lib/{files.name}", f"share/{files.name}"):
            message = f"executable `{target}` is installed to `{place}`, but launch files need it in `lib/{files.name}`"
            yield BuildDefect(source, start, written, message)
