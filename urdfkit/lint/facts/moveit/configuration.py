"""MoveIt packages that launch files read: ``MoveItConfigsBuilder`` and the file ``.setup_assistant``.

Source: moveit_configs_utils, moveit_configs_builder.py (Humble to Rolling).
"""

import ast
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfkit.description.launch.python_constants import launch_reader, name_of
from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.similar_names import near_path
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.description.xml.source import Source, Span
from urdfkit.errors import ResourceError
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import Node, documents
from urdfkit.lint.facts.launch.python.names import python_files
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_SUFFIX = "_moveit_config"
_METHODS = {"urdf": "robot_description", "srdf": "robot_description_semantic"}
"""Key of ``.setup_assistant`` → method of the builder that replaces its path."""


@record(eq=False)
class Builder:
    """A call of ``MoveItConfigsBuilder``.

    Attributes:
        robot: name of the robot.
        robot_place: place of this name.
        package: name of the MoveIt package.
        place: place of this name, or of the robot that it follows from.
        replaced: the keys of ``.setup_assistant`` that the launch file replaces with a path of its own.
        source: the launch file.
        tree: its syntax tree.
        call: the call.
    """

    robot: str
    robot_place: Span
    package: str
    place: Span
    replaced: frozenset[str]
    source: Source
    tree: ast.Module
    call: ast.Call


def builders(model: Model) -> Iterator[Builder]:
    """Yield the calls of ``MoveItConfigsBuilder`` with literal names in launch files."""
    for source, tree in python_files(model):
        if "MoveItConfigsBuilder" not in source.text:
            continue
        reader = launch_reader(tree)
        replaced = frozenset(key for key, method in _METHODS.items() if re.search(rf"\.{method}\(\s*\w", source.text))
        for call in ast.walk(tree):
            if not isinstance(call, ast.Call) or name_of(call.func) != "MoveItConfigsBuilder":
                continue
            words = {word.arg: word.value for word in call.keywords}
            robot_node = call.args[0] if call.args else words.get("robot_name")
            node = words.get("package_name", robot_node)
            robot = reader.text(robot_node) if robot_node is not None else None
            package = reader.text(node) if node is not None else None
            if robot_node is not None and node is not None and robot is not None and package is not None:
                spans = [source.span(*place(source, each)) for each in (robot_node, node)]
                package = package if "package_name" in words else f"{robot}{_SUFFIX}"
                yield Builder(robot, spans[0], package, spans[1], replaced, source, tree, call)


def missing_paths(
    folder: Path | None, replaced: frozenset[str], packages: Mapping[str, Path], model: Model
) -> Iterator[tuple[Source, Node, str]]:
    """Yield the paths in ``.setup_assistant`` that do not exist in their package: source, YAML node, message.

    Args:
        folder: the MoveIt package; None if it is not in the workspace.
        replaced: the keys that are not read.
        packages: the packages of the workspace by name.
        model: the linted model.
    """
    file = folder / ".setup_assistant" if folder is not None else None
    if folder is None or file is None or not is_file(file):
        return
    model.expanded.packages.watch(folder, file.name)
    try:
        source = read_source(file, shown_as=shown_path(file), texts=model.texts)
    except ResourceError:
        return
    for document in documents(source):
        config = document.find("moveit_setup_assistant_config")
        for key in ("urdf", "srdf", "URDF", "SRDF"):
            section = config.find(key) if config is not None else None
            path = section.find("relative_path") if section is not None else None
            named = section.find("package") if section is not None else None
            package = packages.get(named.text) if named is not None else folder
            is_read = path is not None and path.text and key.lower() not in replaced
            if path is not None and package is not None and is_read and not (package / path.text).exists():
                where = f"package `{named.text}`" if named is not None else "this package"
                yield source, path, f"`{path.text}` does not exist in {where}" + near_path(package / path.text)
