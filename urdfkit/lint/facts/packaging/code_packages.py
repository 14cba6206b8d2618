"""Packages that the Python code of a package imports, and packages that its CMakeLists.txt finds."""

import ast
import re
from collections.abc import Collection, Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.cmake_commands import commands
from urdfkit.lint.facts.ros_packages import names
from urdfkit.lint.project.code_files import code_texts, python_tree

_IMPORT = r"(?m)^(?:from[ \t]+(\w+)[\w.]*[ \t]+import\b|import[ \t]+(\w+))"
"""Matches an import without a condition, and a line of a text that begins like one."""

_SHORT = ("rclpy", "rospy", "xacro")
"""Modules of packages without an underscore in the name; those of other packages can be modules of Python too."""

_OF_CLIENTS = frozenset(
    (
        *("action_msgs", "ament_index_python", "builtin_interfaces", "launch", "launch_ros", "lifecycle_msgs"),
        *("rcl_interfaces", "rosgraph_msgs"),
    )
)
"""Packages on which rclpy and ros2launch depend."""

_FOLDERS = frozenset(("build", "doc", "docs", "examples", "launch", "test", "tests"))
_FILES = ("setup.py", "conf.py", "conftest.py")
_MAX_FILES = 60

_ROS = ("nodelet", "pluginlib", "rclcpp", "rclpy", "roscpp", "rospy", "tf", "tf2", "urdf", "xacro")
"""Packages without an underscore in the name that CMake finds by this name; others can be libraries of the system."""


def packages_in_code(folder: Path, others: Collection[str]) -> Iterator[tuple[Source, str, int, int]]:
    """Yield file, package, start and end offset of each import of a ROS package in the Python code of a package.

    Args:
        folder: the package.
        others: further packages, such as those of the workspace.
    """
    count = 0
    for path, text in code_texts(folder, (".py",), LAUNCH):
        parts = path.relative_to(folder).parts
        if not _FOLDERS.isdisjoint(parts[:-1]) or path.name in _FILES or path.name.startswith("test_"):
            continue
        count += 1
        if count > _MAX_FILES:
            return
        source: Source | None = None
        lines: set[int] = set()
        for at in re.finditer(_IMPORT, text):
            group = 1 if at[1] is not None else 2
            name = at[group]
            is_package = name in others or (name in names() and ("_" in name or name in _SHORT))
            if is_package and name not in _OF_CLIENTS and not (folder / name).is_dir():
                lines = lines if source is not None else lines_of_imports(text)
                source = source or Source(shown_path(path), text)
                if source.position(at.start()).line in lines:
                    yield source, name, at.start(group), at.end(group)


def lines_of_imports(text: str) -> set[int]:
    """Return the lines of the imports without a condition; none for a file that is not valid Python."""
    tree = python_tree(text)
    body = tree.body if tree is not None else []
    return {each.lineno for each in body if isinstance(each, (ast.Import, ast.ImportFrom))}


def packages_found(cmake: Source, others: Collection[str]) -> Iterator[tuple[str, int, int]]:
    """Yield name, start and end offset of each ROS package that a CMakeLists.txt needs, without those of conditions."""
    depth = 0
    for command in commands(cmake):
        depth += (command.name == "if") - (command.name == "endif")
        words = [word for word, _ in command.words]
        if command.name != "find_package" or not words or depth > 0 or ("QUIET" in words and "REQUIRED" not in words):
            continue
        of_catkin = words[0] == "catkin"
        first = words.index("COMPONENTS") + 1 if of_catkin and "COMPONENTS" in words else len(words)
        last = words.index("OPTIONAL_COMPONENTS") if "OPTIONAL_COMPONENTS" in words else len(words)
        for name, start in command.words[first:last] if of_catkin else command.words[:1]:
            is_package = name in others or (name in names() and ("_" in name or name in _ROS))
            if is_package and not name.startswith("ament_"):
                yield name, start, start + len(name)
