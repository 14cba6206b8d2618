"""K958 launch-path-missing."""

import re
from fnmatch import fnmatchcase
from pathlib import Path

from urdfkit.description.xml.source import Span
from urdfkit.lint.facts.control.launch_package_paths import PackagePath, package_paths
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchPathMissing(RobotRule):
    """A launch file names a file that does not exist.

    ## What it does
    Checks the launch files of the robot's package and of neighbouring packages that depend on it. The rule resolves
    paths after ``$(find …)``, ``get_package_share_directory`` and ``FindPackageShare`` in these packages. A path that
    contains a launch argument is checked with the default of the argument, each of its choices, and each value that an
    including launch file passes. Python launch files are parsed, not executed, so computed paths are not checked. Paths
    that a launch file only tests for existence are not checked either. Gazebo Classic needs the path of its world, not
    only the name.

    Files that CMakeLists.txt or setup.py mentions, or that exist elsewhere in the package, are accepted. Maps,
    recordings and files that git ignores are created by users and programs. A missing file of these kinds is reported
    only if a file with a similar name exists. Missing folders and RViz configurations are reported as warnings, because
    the launch continues without them.

    ## Why is this bad?
    The launch fails, or starts without the robot, the world or the parameters.

    ## Example
    ```diff
     <launch>
    -  <param name="robot_description" command="xacro $(find cart_description)/urdf/carts.urdf"/>
    +  <param name="robot_description" command="xacro $(find cart_description)/urdf/cart.urdf"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K958"
    name = "launch-path-missing"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each path that does not exist in its package."""
        from urdfkit.description.packages.related_files import LAUNCH, neighbours
        from urdfkit.description.packages.similar_names import near_path

        if model.package is None:
            return
        neighbouring: dict[str, Path] | None = None
        for source in model.related_files.values():
            if not source.file.endswith(LAUNCH) or ("find" not in source.text and "hare" not in source.text):
                continue
            neighbouring = neighbours(model.package) if neighbouring is None else neighbouring
            for reference in package_paths(source):
                package = neighbouring.get(reference.package)
                if package is None or _exists(package, reference.path, model):
                    continue
                hint = near_path(package / reference.path)
                if hint or not _is_created_at_run_time(package, reference.path):
                    yield self._missing(reference, source.span(reference.start, reference.end), hint)
        if neighbouring is not None:  # a launch file contains a path
            yield from self._with_arguments(model, neighbouring)

    def _with_arguments(self, model: Model, packages: dict[str, Path]) -> Findings:
        from urdfkit.lint.facts.parameters.argument_paths import argument_paths, worlds_without_path

        for source, start, end, world in worlds_without_path(model):
            message = f"Gazebo finds no world `{world}`; write the path of its file"
            yield self.at_span(source.span(start, end), message, severity="warning")
        for values in argument_paths(model):
            package = packages.get(values[0].path.package)
            missing = [each for each in values if package is not None and not _exists(package, each.path.path, model)]
            missing = [each for each in missing if package and not _is_created_at_run_time(package, each.path.path)]
            for each in missing[:1] if len(missing) == len(values) else missing:
                span = each.source.span(each.path.start, each.path.end)
                if each.value is not None and len(missing) < len(values):
                    source, value = each.value
                    span = source.span(value.start, value.end)
                yield self._missing(each.path, span, "")

    def _missing(self, reference: PackagePath, span: Span, hint: str) -> Finding:
        message = f"`{reference.path}` does not exist in package `{reference.package}`" + hint
        severity = "error" if hint or Path(reference.path).suffix in _REQUIRED else self.severity
        return self.at_span(span, message, severity=severity, names=(Path(reference.path).name,))


def _exists(package: Path, path: str, model: Model) -> bool:
    """Return whether a file exists in the package, is installed from another folder, or is generated by the build."""
    packages = model.expanded.packages
    if packages.whereabouts(package / path):
        return True
    packages.watch(package, ".txt")
    build_files = [file for name in ("CMakeLists.txt", "setup.py") if (file := package / name).is_file()]
    texts = [re.sub(_OWN_NAME, "", file.read_text("utf-8", "replace")) for file in build_files]
    inside = [file for pattern in (f"*/{path}", f"*/*/{path}", f"{path}.*") for file in package.glob(pattern)]
    inside = [file for file in inside if file.is_file()]
    if len(inside) == 1 and inside[0].name == path and _keeps_folder(inside[0].parent.name, texts):
        return False
    if inside:
        return True
    name, _, ending = Path(path).name.partition(".")
    is_code = re.fullmatch(_CODE, ending) is not None
    stem = rf"(?<![\w-]){re.escape(name)}(?![\w-])" + ("" if is_code else rf"(?!\.{_CODE}\b)")
    return any(re.search(stem, text) for text in texts)


_CODE = r"(?:py|c|cc|cpp|cxx|h|hpp|msg|srv|action)"
"""Matches the ending of a file that no other file is generated from under the same name."""


def _keeps_folder(folder: str, texts: list[str]) -> bool:
    """Return whether the build installs the files of a folder into a folder with the same name only.

    A build that also installs files of computed names may install them into another folder.
    """
    name = re.escape(folder)
    cmake = rf"install\s*\(\s*DIRECTORY\b[^()]*?[\s/]{name}(?:\s[^()]*)?\)"
    setup = rf"[/'\"]{name}/?['\"]\s*\)?\s*,\s*(?:glob|\[|sorted|list)[^)\]]*"
    is_kept = False
    for text in (each for each in texts if folder in each):
        rest = re.sub(setup, "", text)
        in_cmake = re.search(cmake, text) and f"{folder}/" not in text and not re.search(_COMPUTED_SOURCES, text)
        in_setup = rest != text and not re.search(rf"['\"](?:\./)?(?:{name}\b|\*)|\bwalk\b", rest)
        is_kept = bool(in_cmake) or in_setup
        if not is_kept:
            return False
    return is_kept


def _is_created_at_run_time(package: Path, path: str) -> bool:
    """Return whether a user or a program creates the file: maps, recordings and results, or what git ignores.

    The MoveIt Setup Assistant writes launch files with the database ``default_warehouse_mongo_db``.
    """
    file = Path(path)
    if (
        path == "default_warehouse_mongo_db"
        or file.suffix in _RECORDINGS
        or not _RUN_TIME_FOLDERS.isdisjoint(part.lower() for part in file.parts[:-1])
    ):
        return True
    ignored: list[str] = []
    for folder in (package, *list(package.parents)[:3]):
        try:
            ignored += (folder / ".gitignore").read_text("utf-8", "replace").split()
        except OSError:
            continue
    patterns = [pattern.strip("/") for pattern in ignored if not pattern.startswith(("#", "!"))]
    places = [path, file.name, *file.parts[:-1], f"{package.name}/{path}"]
    return any(fnmatchcase(place, pattern) for place in places for pattern in patterns)


_REQUIRED = frozenset((".launch", ".py", ".sdf", ".srdf", ".urdf", ".world", ".xacro", ".xml", ".yaml", ".yml"))
"""Suffixes of files without which the launch stops, or the robot, the world or the parameters are missing."""

_RECORDINGS = frozenset((".bag", ".db3", ".mcap", ".log", ".csv", ".pcd", ".pgm", ".pbstream", ".posegraph", ".pickle"))
_RUN_TIME_FOLDERS = frozenset(
    ("bag", "bags", "rosbag", "rosbags", "log", "logs", "map", "maps", "output", "results", "recordings", "tmp")
)

_COMPUTED_SOURCES = r"(?:install|file)\s*\(\s*(?:DIRECTORY|FILES|PROGRAMS|COPY)\b(?:(?!\bDESTINATION\b)[^()$])*\$"
"""Matches the installation of files whose names are variables in CMakeLists.txt."""

_OWN_NAME = r"(?m)^\s*(?:project\s*\([^)]*\)|(?:(?:package_)?name|description)\s*=.*)"
"""Matches the name of the package in build files, often also that of the robot, and its description."""
