"""Parameters that launch files and YAML files set for the nodes of a workspace, compared with the code of these nodes.

Sources: rclpy (node.py, declare_parameter), rclcpp (node_parameters.cpp) and rospy (client.py, get_param); launch_ros
(utilities/evaluate_parameters.py): a number in a launch file keeps its type, and a text is read as YAML.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator
from fnmatch import fnmatchcase
from pathlib import Path

from urdfkit.description.launch.python_constants import launch_reader, name_of
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import start_of, yamls
from urdfkit.lint.facts.launch.actions import launch_elements
from urdfkit.lint.facts.launch.python.names import python_files
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.parameters.declared_types import OPEN, SHOWN, declared_in, type_of_python, type_of_text
from urdfkit.lint.facts.parameters.schemas import schemas
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts
from urdfkit.record import record

Defects = Iterator[tuple[Source, tuple[int, int], str]]

_EVERY_NODE = ("use_sim_time", "qos_overrides", "start_type_description_service", "ros__parameters")
_ALL_NAMES = r"\b(?:declare_parameters?|get_param)\s*(?:<[^<>]*>)?\s*\(\s*(?:\"\"\s*,|''\s*,)?\s*(?![\"'\[])"
"""Matches a call that declares or reads a parameter with a computed name."""

_NUMBER = "number"
"""Type of a parameter of ROS 1, which may be an integer or a number with a decimal point."""

_OTHER_BASE = r"class\s+\w+\s*\(\s*(?!(?:\w+\.)*Node\b)\w|:\s*public\s+(?!rclcpp::Node\b)\w"
_NUMBER_OF_ROS1 = r"\bget_param\s*\(\s*[\"']~([\w/]+)[\"']\s*,\s*[-+]?[\d.]+\s*\)"
"""Matches a call that reads a private parameter of rospy whose default is a number."""

_FROM_ROS1 = r"\bget_param\s*\(\s*[\"']~([\w/]+)[\"']"


@record(eq=False)
class _Code:
    """The parameters in the code of a node: name → type, empty if unknown, and whether there can be no others."""

    types: dict[str, str]
    is_complete: bool
    text: str


@record(eq=False)
class _Setting:
    """A parameter of a launched node outside of files: its name, and its value with its type, empty if unknown."""

    source: Source
    package: str
    program: str
    name: Named
    value: Named
    type: str


def undeclared_parameters(model: Model) -> Iterator[tuple[Source, tuple[int, int], str, str | None]]:
    """Yield the parameters that the code of their node neither declares nor names: file, place, name, right name."""
    code = _Codes(model)
    groups: dict[tuple[str, str, str], list[tuple[Source, Named]]] = {}
    for each in _settings(model):
        groups.setdefault((each.source.file, each.package, each.program), []).append((each.source, each.name))
    programs = {node.name.name: (node.package, node.program) for node in launched_nodes(model) if node.name is not None}
    for source in yamls(model):
        for key, group in sections(source) if PARAMETERS in source.text else ():
            package, program = programs.get(key.last_name, ("", ""))
            for parameter, _ in group.entries if program else ():
                at = Named(parameter.text, start_of(source, parameter))
                groups.setdefault((source.file, package, program), []).append((source, at))
    for (_, package, program), names in groups.items():
        found = code.of(package, program)
        if found is None:
            continue
        written = {name.name for _, name in names}
        left = [name for name in found.types if name not in written]
        for source, name in names:
            first = name.name.partition(".")[0]
            is_named = re.search(rf"(?<!\w){re.escape(first)}(?!\w)", found.text)
            if first in _EVERY_NODE or is_named or "$" in first:
                continue
            near = nearest(name.name, left, cutoff=0.6)
            if near is not None or (found.is_complete and left):
                yield source, (name.start, name.end), name.name, near


def wrong_types_in_launch(model: Model) -> Defects:
    """Yield the parameters in launch files that have another type than the code of their node declares."""
    code = _Codes(model)
    for each in _settings(model):
        found = code.of(each.package, each.program) if each.type else None
        expected = found.types.get(each.name.name, "") if found is not None else ""
        if expected == _NUMBER:
            if each.type == "text" and not re.search(r"\d[-+*/ ]+\d|\(", each.value.name):
                message = f"`{each.name.name}` is `{each.value.name}`, which is not a number"
                yield each.source, (each.value.start, each.value.end), message
        elif expected and expected != each.type:
            yield _wrong_type(each, expected, "node ")


class _Codes:
    """The code of the nodes of a workspace, by package and executable."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self._found: dict[tuple[str, str], _Code | None] = {}

    def of(self, package: str, program: str) -> _Code | None:
        """Return the code of a node; None if it has none that can be read, or if it accepts all parameters."""
        key = (package, program.removesuffix(".py"))
        if key not in self._found:
            folder = neighbours(self._model.package).get(package) if self._model.package is not None else None
            self._found[key] = self._read(folder, key[1]) if folder is not None else None
        return self._found[key]

    def _read(self, folder: Path, program: str) -> _Code | None:
        self._model.expanded.packages.watch(folder)
        texts = [(path, text) for path, text in node_texts(folder) if path.stem == program]
        if len(texts) != 1 or re.search(OPEN, texts[0][1]):
            return None
        path, text = texts[0]
        types = dict(declared_in(path, text)) | dict.fromkeys(re.findall(_FROM_ROS1, text), "")
        types |= dict.fromkeys(re.findall(_NUMBER_OF_ROS1, text), _NUMBER)
        is_complete = not re.search(_ALL_NAMES, text) and not re.search(_OTHER_BASE, text)
        return _Code(types, is_complete, text) if types else None


def wrong_types_of_released_nodes(model: Model) -> Defects:
    """Yield the parameters of well-known ROS 2 nodes in launch files that have another type than their nodes declare.

    The types are those of `schemas`.
    """
    for each in _settings(model, _KINDS):
        kind = _KINDS[each.package] if each.package != "robot_localization" else _FILTERS.get(each.program, "")
        for pattern, type in schemas().get(kind, ()) if each.type and not _is_ros1(each.source) else ():
            expected = type.partition(" ")[0]
            if not fnmatchcase(each.name.name, pattern) or expected in ("keys", "list") or each.type == expected:
                continue
            yield _wrong_type(each, expected)


def _wrong_type(setting: _Setting, expected: str, word: str = "") -> tuple[Source, tuple[int, int], str]:
    """Return the defect of a value of another type than its node declares; `word` is written before the node."""
    value = setting.value
    right = f"; write {value.name}.0" if (expected, setting.type) == ("double", "int") else ""
    shown = value.name.strip("\"'")
    message = f"`{setting.name.name}` is `{shown}`, but {word}`{setting.program}` declares {SHOWN[expected]}"
    return setting.source, (value.start, value.end), message + right


def _is_ros1(source: Source) -> bool:
    return source.file.endswith((".launch", ".xml")) and reads_ros1(source)


_KINDS = {
    **{"joy": "joy_node", "teleop_twist_joy": "teleop_twist_joy_node", "twist_mux": "twist_mux"},
    **{"robot_localization": "ekf", "slam_toolbox": "slam_toolbox", "nav2_amcl": "amcl"},
    **{"nav2_controller": "controller_server", "nav2_planner": "planner_server"},
    **{"nav2_lifecycle_manager": "lifecycle_manager", "nav2_velocity_smoother": "velocity_smoother"},
}
_FILTERS = {"ekf_node": "ekf", "ukf_node": "ekf", "navsat_transform_node": "navsat_transform"}
"""Package, or executable of robot_localization → its name in the schemas."""


def _settings(model: Model, packages: Collection[str] | None = None) -> Iterator[_Setting]:
    """Yield the parameters of nodes of some packages, or of the workspace, in launch files outside of parameter files.

    Args:
        model: the linted model.
        packages: the packages; None for those of the workspace.
    """
    own: Collection[str] = packages or (neighbours(model.package) if model.package is not None else {})
    yield from _in_python(model, own)
    yield from _in_elements(model, own)


def _in_python(model: Model, packages: Collection[str]) -> Iterator[_Setting]:
    for source, tree in python_files(model):
        reader = launch_reader(tree)
        for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call) and name_of(each.func) == "Node"):
            words = {word.arg: word.value for word in call.keywords}
            package, program = (reader.text(words[key]) if key in words else None for key in ("package", "executable"))
            listed = reader.items(words.get("parameters"))
            if package is None or program is None or not listed:
                continue
            if package not in packages:
                continue
            items = [reader.assigned.get(item.id) if isinstance(item, ast.Name) else item for item in listed]
            for item in (each for each in items if isinstance(each, ast.Dict)):
                for key, value in zip(item.keys, item.values, strict=True):
                    if isinstance(key, ast.Constant) and isinstance(key.value, str):
                        text = value.value if isinstance(value, ast.Constant) else None
                        type = type_of_text(text) if isinstance(text, str) else type_of_python(value)
                        start, end = place(source, value)
                        name = Named(key.value, place(source, key)[0] + 1)
                        yield _Setting(source, package, program, name, Named(source.text[start:end], start), type)


def _in_elements(model: Model, packages: Collection[str]) -> Iterator[_Setting]:
    for source, element in (each for each in launch_elements(model) if each[1].tag == "node"):
        at = element.attributes
        program = at.get("exec") or at.get("type")
        if "pkg" not in at or program is None or at["pkg"].name not in packages:
            continue
        for child in (each.attributes for each in element.children if each.tag == "param"):
            name, value = child.get("name"), child.get("value")
            if name is not None and value is not None:
                type = type_of_text(value.name) if "type" not in child else ""
                yield _Setting(source, at["pkg"].name, program.name, name, value, type)
