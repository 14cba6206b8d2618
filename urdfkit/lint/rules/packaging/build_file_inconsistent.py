"""K973 build-file-inconsistent."""

import re
from itertools import pairwise
from typing import Any

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_folder
from urdfkit.description.packages.similar_names import near_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles, build_files, installed_folders
from urdfkit.lint.facts.packaging.cmake_commands import OPTIONS, CMakeCommand, commands, misspelt_word
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect, cmake_defects, misplaced, unbalanced
from urdfkit.lint.finding import Finding, Severity
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import Findings, Model, RobotRule

_COMMANDS = (
    *("cmake_minimum_required", "project", "find_package", "install", "catkin_package", "ament_package"),
    *("add_executable", "add_library", "target_link_libraries", "include_directories", "target_include_directories"),
    *("ament_target_dependencies", "catkin_install_python", "ament_export_dependencies", "add_message_files"),
    *("generate_messages", "add_dependencies", "ament_python_install_package", "catkin_python_setup"),
    *("add_service_files", "add_action_files", "rosidl_generate_interfaces", "ament_export_targets", "ament_add_gtest"),
    *("rclcpp_components_register_node", "rclcpp_components_register_nodes", "ament_export_include_directories"),
    *("pluginlib_export_plugin_description_file", "ament_lint_auto_find_test_dependencies", "ament_export_libraries"),
    *(
        "ament_add_test",
        "ament_add_gtest_executable",
        "ament_add_gtest_test",
        "ament_add_gmock_executable",
        "ament_add_gmock_test",
    ),
    *("ament_add_pytest_test", "target_compile_features", "target_compile_options", "ament_add_gmock"),
)
_TESTED = {
    "roslaunch_add_file_check": 0,
    "add_rostest": 0,
    "catkin_add_nosetests": 0,
    "add_launch_test": 0,
    "ament_add_pytest_test": 1,
    "add_rostest_gtest": 1,
}
"""Command of a test → which of its arguments is a file or folder of the package."""
_WITH_SOURCES = (
    *("add_executable", "add_library", "ament_add_gtest", "ament_add_gmock", "catkin_add_gtest", "add_rostest_gtest"),
)
"""Commands that name source files."""

_GENERATING = (
    r"(?i)add_custom_|configure_file|\bwrap_|execute_process|file\s*\(\s*(?:APPEND|CONFIGURE|COPY|DOWNLOAD|GENERATE|WRITE)"
    r"|\binclude\s*\(\s*(?!GNUInstallDirs|CTest\b|Check\w|CMake\w)"
)
"""Matches commands that can write source files."""

_FIND = r"\$\(find\s+([\w-]+)\)/([\w-]+/[^\s\"'<>$(){}]+)"
_DESTINATIONS = ("share", "lib", "bin", "include", "etc", "libexec", "python", "launch", "config", "meshes")


_BEFORE_PACKAGE = (
    *("project", "find_package", "catkin_python_setup", "generate_messages", "generate_dynamic_reconfigure_options"),
    *("add_message_files", "add_service_files", "add_action_files"),
)
"""Commands before ``catkin_package()``."""


class BuildFileInconsistent(RobotRule):
    """CMakeLists.txt or setup.py contradicts the package, or lacks the folders that launch files use.

    ## What it does
    In CMakeLists.txt, checks the syntax, the project name, the order of calls, the call of ``ament_package()`` or
    ``catkin_package()``, and the spelling of commands, variables and packages. Reports missing files and folders that
    ``install`` or a test names. Also reports folders and scripts that launch files use but that are not installed, or
    are installed in the wrong place. The source files of targets must exist, and commands for a target must name a
    defined target. If a target includes a header of its package, a target must compile the source file next to the
    header or with the same name. A target that includes headers of a message package must depend on this package.

    Code must be generated for all message, service and action files, with the packages of their types in
    ``DEPENDENCIES``. package.xml must contain the group and the packages that generated messages need.

    Checks the name, the version, ``packages``, ``data_files`` and the modules of console scripts in setup.py, and the
    script folders in setup.cfg.

    ## Why is this bad?
    The build fails, or the installed package lacks files: "file 'cart.launch.py' was not found in the share directory".

    ## Example
    ```diff title="CMakeLists.txt"
     cmake_minimum_required(VERSION 3.8)
     project(cart_description)
     find_package(ament_cmake REQUIRED)
    -install(DIRECTORY lanch urdf DESTINATION share/${PROJECT_NAME})
    +install(DIRECTORY launch urdf DESTINATION share/${PROJECT_NAME})
     ament_package()
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K973"
    name = "build-file-inconsistent"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each defect of the build files."""
        from urdfkit.lint.facts.packaging.catkin_defects import catkin_defects
        from urdfkit.lint.facts.packaging.cmake_packages import package_defects
        from urdfkit.lint.facts.packaging.installation_defects import installation_defects
        from urdfkit.lint.facts.packaging.plugin_defects import plugin_defects
        from urdfkit.lint.facts.packaging.setup_defects import setup_defects
        from urdfkit.lint.facts.packaging.target_code import code_defects
        from urdfkit.lint.facts.packaging.target_defects import INTERFACES, message_defects, target_defects
        from urdfkit.lint.project.code_files import CPP

        used = _used_paths(model)
        for files in build_files(model):
            paths = used.get(files.name, {})
            folders = {path.partition("/")[0]: use for path, use in reversed(paths.items())}
            named = {path.partition("/")[0] for path, use in paths.items() if use}
            folders = {folder: use or "it contains launch files" for folder, use in folders.items()}
            defects: list[BuildDefect] = []
            broken = unbalanced(files.cmake) if files.cmake is not None else None
            if broken is not None:
                defects = [broken]
            elif files.cmake is not None:
                every = commands(files.cmake)
                elsewhere = misplaced(files, files.cmake, every, {*folders}, named)
                defects = [*cmake_defects(files.cmake, every), *elsewhere]
                model.expanded.packages.watch(files.folder, *INTERFACES, *CPP, ".xml")
                defects += catkin_defects(files, files.cmake, every)
                defects += package_defects(files, files.cmake, every)
                defects += message_defects(files, files.cmake, every)
                defects += target_defects(files, files.cmake, every, _started(model, files.name))
                defects += installation_defects(files, files.cmake, every, _started(model, files.name))
                defects += plugin_defects(files, files.cmake, every)
                defects += code_defects(files, files.cmake, every)
                yield from self._cmake(files, files.cmake, every)
            elif files.setup is not None:
                yield from self._setup(files, files.setup)
                defects = list(setup_defects(files, files.setup, paths))
            for defect in defects:
                yield self._at(
                    defect.source, defect.start, defect.text, defect.message, defect.severity, kind=defect.kind
                )
            if broken is None:
                yield from self._folders(files, folders)
                yield from self._programs(model, files)

    def _cmake(self, files: BuildFiles, source: Source, every: list[CMakeCommand]) -> Findings:
        from urdfkit.lint.facts.ros_packages import misspelling_of
        from urdfkit.lint.model.masked_names import is_typo

        defined = set(re.findall(r"(?i)\b(?:function|macro)\s*\(\s*(\w+)", source.text))
        project = next((command for command in every if command.name == "project"), None)
        for command in every:
            near = nearest(command.name, _COMMANDS, cutoff=0.85) if command.name not in (*_COMMANDS, *defined) else None
            if near is not None and is_typo(command.name, near):
                yield self._at(source, command.start, command.name, "unknown command" + Suggestion(near))
            if command.name == "find_package" and command.words:
                words = [word for at, word in enumerate(command.words) if at == 0 or command.words[0][0] == "catkin"]
                for word, start in words:
                    suggestion = misspelling_of(word, files.dependencies()) if word.islower() else None
                    if suggestion is not None:
                        yield self._at(source, start, word, f"unknown package `{word}`" + Suggestion(suggestion, word))
            if command.name in ("install", "catkin_install_python"):
                yield from self._install(files, source, command)
            if command.name in _WITH_SOURCES:
                yield from self._sources(files, source, command)
            if len(command.words) > (at := _TESTED.get(command.name, len(command.words))):
                word, start = command.words[at]
                if "." in word or near_path(files.folder / word):  # tests may be generated into another folder
                    yield from self._existing(files, source, word, start)
        if project is not None and project.words and "$" not in project.words[0][0]:
            word, start = project.words[0]
            if word != files.name and word == files.folder.name:
                tag = files.tags("name")[0][1]
                message = f"the package is named `{files.name}`, but its folder and its project are named `{word}`"
                names = (files.name, word)
                yield self._at(files.manifest, tag.start, f"<name>{files.name}", message, kind="name", names=names)
            elif word != files.name:
                yield self._at(
                    source, start, word, f"project `{word}` does not have the name of package `{files.name}`"
                )
        called = {command.name for command in every}
        found = {command.words[0][0] for command in every if command.name == "find_package" and command.words}
        for tool, call in (("catkin", "catkin_package"), ("ament_cmake", "ament_package")):
            is_called = any(nearest(name, [call, "ament_auto_package"], cutoff=0.8) for name in called)
            if tool in found and project is not None and not is_called:
                # catkin_package() comes before the targets, ament_package() at the end.
                before = [each for each in every if each.name in _BEFORE_PACKAGE] if tool == "catkin" else every
                start = source.text.find(")", max([before[-1].start, *(at for _, at in before[-1].words)]))
                yield self._at(source, start, ")", f"CMakeLists.txt does not call {call}()")

    def _install(self, files: BuildFiles, source: Source, command: CMakeCommand) -> Findings:
        """Yield a finding for each literal file or folder that does not exist."""
        if not command.words or command.words[0][0] not in ("DIRECTORY", "FILES", "PROGRAMS"):
            return
        misspelt = misspelt_word(command)
        for (option, _), (word, start) in pairwise(command.words):
            first, separator, _ = word.partition("/")
            near = nearest(first, _DESTINATIONS, cutoff=0.7) if option == "DESTINATION" and separator else None
            if near is not None and first not in _DESTINATIONS and "$" not in first:
                yield self._at(source, start, word, f"unknown installation folder `{first}`" + Suggestion(near, first))
        for word, start in command.words[1:]:
            if word in OPTIONS or (misspelt is not None and start == misspelt[1]):
                return
            yield from self._existing(files, source, word, start)

    def _sources(self, files: BuildFiles, source: Source, command: CMakeCommand) -> Findings:
        """Yield a finding for each source file that does not exist in a folder with other files in C++."""
        from urdfkit.lint.facts.ros_packages import is_slip

        is_generated = re.search(_GENERATING, source.text) is not None
        for word, start in command.words[1:] if not is_generated else ():
            folder = (files.folder / word).parent
            first = word.partition("/")[0]
            is_typo = not is_folder(folder) and any(is_slip(first, each.name) for each in files.folder.glob("*/"))
            if re.fullmatch(r"[\w./-]+\.(?:c|cc|cpp|cxx)", word) and (any(folder.glob("*.c*")) or is_typo):
                yield from self._existing(files, source, word, start)

    def _existing(self, files: BuildFiles, source: Source, word: str, start: int) -> Findings:
        if "$" not in word and not files.has(word):
            hint = near_path(files.folder / word)
            yield self._at(source, start, word, f"`{word}` does not exist in this package" + hint, kind="missing")

    def _setup(self, files: BuildFiles, source: Source) -> Findings:
        name = re.search(r"(?m)^\s*(?:package_name\s*=|name\s*=)\s*[\"']([^\"']+)[\"']", source.text)
        if name is not None and name[1] != files.name:
            message = f"the name in setup.py is `{name[1]}`, but the package is named `{files.name}`"
            yield self._at(source, name.start(1), name[1], message, kind="setup.py")
        marker = re.search(r"share/ament_index/resource_index/packages", source.text)
        version = re.search(r"(?m)^\s*version\s*=\s*[\"']([\d.]+)[\"']", source.text)
        released = next((text for text, tag in files.tags("version") if tag.parent is files.root), "")
        if version is not None and released and version[1] != released:
            message = f"the version in setup.py is {version[1]}, but the version in package.xml is {released}"
            yield self._at(source, version.start(1), version[1], message, "note", kind="version")
        data = re.search(r"data_files\s*=", source.text)
        near = re.search(r"[\"'](share/ament_\w+/resource_\w+/\w+)[\"']", source.text)
        if marker is None and data is not None and (near is not None or "resource_index" not in source.text):
            message = "data_files does not install the marker `resource/…` to share/ament_index/resource_index/packages"
            place = (near.start(1), near[1]) if near is not None else (data.start(), "data_files")
            yield self._at(source, *place, message)
        if data is not None and "package.xml" not in source.text:
            yield self._at(source, data.start(), "data_files", "data_files does not install package.xml")

    def _folders(self, files: BuildFiles, used: dict[str, str]) -> Findings:
        """Yield a finding for each folder that launch files use and that is not installed."""
        installed = installed_folders(files)
        source = files.cmake or files.setup
        if installed is None or source is None:
            return
        names, installs = installed
        is_catkin = files.build_tool == "catkin"
        for folder, use in used.items():
            absent = [name for name in names if not files.has(name)]
            if folder in names or not is_folder(files.folder / folder) or nearest(folder, absent) is not None:
                continue
            first = re.search(r"data_files", source.text) or re.search(r"\w+|$", source.text)
            assert first is not None
            last, place = installs[0].folders[-1] if installs else (first[0], first.start())
            message = f"folder `{folder}` is not installed, but {use}"
            severity: Severity = "note" if is_catkin else "warning"
            yield self._at(source, place, last, message, severity, kind="folder")

    def _programs(self, model: Model, files: BuildFiles) -> Findings:
        """Yield a finding for each script that launch files start and that CMakeLists.txt does not install."""
        source = files.cmake
        if source is None or re.search(r"\bforeach\s*\(|\bGLOB\b|ament_auto_package|\binstall_\w+\(", source.text):
            return
        installs = [command for command in commands(source) if "install" in command.name]
        text = " ".join(word for command in installs for word, _ in command.words)
        if not installs or "$" in re.sub(r"\$\{(PROJECT_NAME|CATKIN_\w+)\}", "", text):
            return
        for program in sorted(
            name for name in _started(model, files.name) if name.endswith(".py") and name not in text
        ):
            folder = next((name for name in ("scripts", "nodes", "src", "bin") if files.has(f"{name}/{program}")), None)
            if folder is not None and not re.search(rf"(?<![\w.-]){folder}(?![\w.-])", text):
                message = f"`{folder}/{program}` is not installed, but launch files start it"
                severity: Severity = "note" if files.build_tool == "catkin" else "warning"
                yield self._at(source, installs[0].start, installs[0].name, message, severity)

    def _at(
        self, source: Source, start: int, text: str, message: str, severity: Severity = "error", **details: Any
    ) -> Finding:
        return self.at_span(source.span(start, min(start + len(text), len(source.text))), message, severity, **details)


def _started(model: Model, package: str) -> set[str]:
    """Return the executables of a package that launch files start."""
    from urdfkit.lint.facts.control.launched_nodes import launches, started

    return {node.program for launch in launches(model) for node in started(launch) if node.package == package}


def _used_paths(model: Model) -> dict[str, dict[str, str]]:
    """Return package → its paths that launch files use, with the place of the use; launch files with an empty text."""
    from pathlib import Path

    from urdfkit.description.packages.related_files import LAUNCH, SRDF, manifest, name_in, package_of
    from urdfkit.lint.facts.control.launch_package_paths import package_paths

    found: dict[str, dict[str, str]] = {}
    for name, source in model.related_files.items():
        package = package_of(Path(name)) if name.endswith(LAUNCH) else None
        if package is None:
            continue
        for path in package_paths(source):
            if "/" in path.path.strip("/"):
                line = source.position(path.start).line
                uses, inner = found.setdefault(path.package, {}), path.path.strip("/")
                uses[inner] = uses.get(inner) or f"{name}:{line} uses it"
        inner = Path(name).absolute().relative_to(package).as_posix()
        if inner.startswith("launch/"):
            own = name_in(manifest(package), package.name)
            found.setdefault(own, {}).setdefault(inner, "")
    for name, source in model.expanded.sources.items():
        holder = package_of(Path(name))
        for use in re.finditer(_FIND, source.text):  # not-installed reports folders of the own package
            comments = model.document(name).comments
            is_comment = any(start <= use.start() < end for start, end, _ in comments)
            if not is_comment and holder is not None and use[1] != name_in(manifest(holder), holder.name):
                line = source.position(use.start()).line
                found.setdefault(use[1], {}).setdefault(use[2], f"{name}:{line} uses it")
    for name in model.related_files:
        package = package_of(Path(name)) if name.endswith(SRDF) else None
        if package is not None and Path(name).absolute().parent == package / "config":
            inner = Path(name).absolute().relative_to(package).as_posix()
            found.setdefault(name_in(manifest(package), package.name), {}).setdefault(inner, "MoveIt reads it")
    return found
