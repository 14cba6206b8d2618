"""Order and arguments of the calls of catkin, and the Python modules of a package with CMakeLists.txt.

Sources: catkin (catkin_package.cmake, catkin_python_setup.cmake, user guide of CMakeLists.txt), genmsg
(pkg-genmsg.cmake.em), and ament_cmake_python (ament_python_install_package.cmake).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_folder
from urdfkit.description.packages.similar_names import near_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand, misspelt_word
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect
from urdfkit.lint.facts.ros_packages import is_slip, names

_ADDING_FILES = ("add_message_files", "add_service_files", "add_action_files")
_TARGETS = ("add_executable", "add_library")


def catkin_defects(files: BuildFiles, source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield calls in the wrong order, wrong arguments of catkin_package(), and modules that are not installed."""
    if any(each.name == "include" for each in every):
        return
    yield from _order(source, every)
    for command in every:
        words = {word for word, _ in command.words}
        if command.name in _ADDING_FILES and words and not words & {"FILES", "DIRECTORY"}:
            if misspelt_word(command) is None and not any("$" in word for word in words):
                message = f"{command.name}() does not begin with FILES or DIRECTORY"
                yield BuildDefect(source, command.start, command.name, message)
        elif command.name == "catkin_package" and misspelt_word(command) is None:
            yield from _arguments(files, source, command, every)
    yield from _modules(files, source, every)


def _order(source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    first: dict[str, int] = {}
    for at, command in enumerate(every):
        first.setdefault(command.name, at)
    generated, package = first.get("generate_messages"), first.get("catkin_package")
    if (
        package is not None
        and (target := min((first[name] for name in _TARGETS if name in first), default=package)) < package
    ):
        command = every[package]
        message = f"catkin_package() is called after {every[target].name}(), which needs the folders that it sets"
        yield BuildDefect(source, command.start, command.name, message)
    adding = [at for at, command in enumerate(every) if command.name in _ADDING_FILES]
    late = next((at for at in adding if generated is not None and at > generated), None)
    if generated is not None and late is not None:
        # The command that is alone on the wrong side of the others is the wrong one.
        wrong = generated if len(adding) > 1 and all(at > generated for at in adding) else late
        message = f"{every[late].name}() is called after generate_messages(), which needs its files"
        yield BuildDefect(source, every[wrong].start, every[wrong].name, message)
    if generated is None and adding and not any(each.name.startswith("generate_") for each in every):
        command = every[adding[-1]]
        message = f"generate_messages() is missing after {command.name}()"
        yield BuildDefect(source, command.start, command.name, message)
    if generated is not None and package is not None and package < generated:
        command = every[generated]
        message = "generate_messages() is called after catkin_package(), which exports its messages"
        yield BuildDefect(source, command.start, command.name, message)


def _arguments(
    files: BuildFiles, source: Source, command: CMakeCommand, every: list[CMakeCommand]
) -> Iterator[BuildDefect]:
    """Yield folders and libraries of catkin_package() that do not exist."""
    libraries = {
        each.words[0][0].replace("${PROJECT_NAME}", files.name)
        for each in every
        if each.name == "add_library" and each.words
    }
    key = ""
    for word, start in command.words:
        if re.fullmatch(r"[A-Z_]+", word):
            key = word
        elif not key and "$" not in word:
            yield BuildDefect(source, start, word, f"`{word}` does not follow a keyword of catkin_package()")
            return
        elif key == "INCLUDE_DIRS" and "$" not in word and not is_folder(files.folder / word):
            message = f"folder `{word}` does not exist in this package" + near_path(files.folder / word)
            yield BuildDefect(source, start, word, message, kind="missing")
            key = "DONE"
        elif key == "LIBRARIES" and "$" not in word and word not in libraries:
            near = next((name for name in sorted(libraries) if is_slip(word, name)), None)
            if near is not None:
                yield BuildDefect(
                    source, start, word, f"no command defines the library `{word}`" + Suggestion(near, word)
                )
            elif word in files.dependencies() and word in names():
                message = f"`{word}` is a catkin package; list it in CATKIN_DEPENDS"
                yield BuildDefect(source, start, word, message)
                return


def _modules(files: BuildFiles, source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield a missing call that installs the Python modules of the package, and missing modules."""
    called = {each.name for each in every}
    at = next((each for each in every if each.name in ("catkin_package", "ament_package")), None)
    if files.build_tool == "catkin" and files.setup is not None and at is not None:
        text = files.setup.text
        if "catkin_python_setup" not in called and "generate_distutils_setup" in text:
            message = "catkin_python_setup() is missing, which installs the modules in setup.py"
            yield BuildDefect(source, at.start, at.name, message)
        packages = re.search(r"packages\s*=\s*\[\s*[\"']([\w/]+)[\"']\s*\]", text)
        inner = re.search(r"package_dir\s*=\s*\{\s*[\"']{2}\s*:\s*[\"']([\w/]+)[\"']", text)
        if packages is not None:
            folder = f"{inner[1]}/{packages[1]}" if inner is not None else packages[1]
            if inner is not None and not files.has(inner[1]):
                message = f"folder `{inner[1]}` does not exist in this package" + near_path(files.folder / inner[1])
                yield BuildDefect(files.setup, inner.start(1), inner[1], message, kind="missing")
            elif not files.has(folder):
                message = f"`{folder}` does not exist in this package" + near_path(files.folder / folder)
                yield BuildDefect(files.setup, packages.start(1), packages[1], message, kind="missing")
        return
    if files.build_tool != "ament_cmake" or at is None or files.setup is not None:
        return
    for command in every:
        if (
            command.name != "ament_python_install_package"
            or not command.words
            or "PACKAGE_DIR" in [word for word, _ in command.words]
        ):
            continue
        word, start = command.words[0]
        folder = word.replace("${PROJECT_NAME}", files.name)
        if "$" not in folder and not files.has(f"{folder}/__init__.py"):
            what = f"`{folder}/__init__.py`" if files.has(folder) else f"folder `{folder}`"
            yield BuildDefect(
                source,
                start,
                word,
                f"{what} does not exist in this package" + near_path(files.folder / folder / "__init__.py"),
                kind="missing",
            )
    is_imported = re.compile(rf"(?m)^[ \t]*(?:from|import)[ \t]+{re.escape(files.name)}\b(?!\.(?:msg|srv|action)\b)")
    if "ament_python_install_package" not in called and files.has(f"{files.name}/__init__.py"):
        scripts = [
            files.folder / word
            for each in every
            if each.name == "install"
            for word, _ in each.words
            if word.endswith(".py")
        ]
        user = next(
            (path for path in scripts if path.is_file() and is_imported.search(path.read_text("utf-8", "replace"))),
            None,
        )
        if user is not None:
            message = f"ament_python_install_package() is missing for the modules that `{user.name}` imports"
            yield BuildDefect(source, at.start, at.name, message)
