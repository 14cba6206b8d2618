"""Nodes that launch files start, with their names, parameter files and remappings."""

import ast
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of, parsed
from urdfkit.description.packages.kept_files import kept
from urdfkit.description.packages.related_files import LAUNCH, neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.actions import LaunchAction, launch_files, resolved_text, roots_of, share_of
from urdfkit.lint.facts.nodes.namespaces import PUSHED, LaunchPlace, included_in_namespace, inside
from urdfkit.lint.facts.nodes.python_bindings import Binding, bindings, resolved
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_WRAPPERS = ("ParameterFile", "RewrittenYaml", "ReplaceString")
"""Classes that return a changed copy of a parameter file (launch_ros, nav2_common)."""

_DECLARATIONS = ("DeclareLaunchArgument", "DeclareBooleanLaunchArg")
_BRANCHES = (ast.If, ast.IfExp)
_ARGUMENT = r"\$\((?:var|arg)\s+([\w.-]+)\s*\)"


@record(eq=False)
class LaunchedNode:
    """A node in a launch file.

    Attributes:
        source: the launch file.
        package: its package; empty if it is computed.
        program: its executable; empty if it is computed.
        name: its name; None if it has none, or a computed one.
        has_name: whether the launch file names it.
        files: package and path of the parameter files that it loads.
        remappings: old and new name of each remapping with constant names.
        place: first and last offset of its executable.
        inline: names of its parameters outside of files; None if there can be others. The parameters that
            MoveItConfigsBuilder reads count as ``robot_description``.
        has_more_remappings: whether there can be more remappings, with computed names.
        namespace: its namespace in the launch file without slashes at its ends; None if it is computed.
        spaced_by: the innermost attribute that sets the namespace.
        is_conditional: whether the launch file starts it under a condition only.
        file_places: first and last offset of the path of each of its parameter files.
    """

    source: Source
    package: str
    program: str
    name: Named | None
    has_name: bool
    files: tuple[tuple[str, str], ...]
    remappings: tuple[tuple[Named, Named], ...]
    place: tuple[int, int] | None = None
    inline: frozenset[str] | None = None
    has_more_remappings: bool = False
    namespace: str | None = ""
    spaced_by: Named | None = None
    is_conditional: bool = False
    file_places: tuple[tuple[int, int], ...] = ()


@kept
def launched_nodes(model: Model) -> list[LaunchedNode]:
    """Return the nodes in the launch files of the model's package and of related packages."""
    found: list[LaunchedNode] = []
    for file, source in model.related_files.items():
        if file.endswith(LAUNCH):
            found += _in_python(source) if file.endswith(".py") else _in_elements(source)
    moved = {name for file in launch_files(model) for name in included_in_namespace(file)}
    return [replace(node, namespace=None) if Path(node.source.file).name in moved else node for node in found]


def parameter_files(model: Model) -> dict[tuple[str, str], Source]:
    """Return the YAML files of the model's package and of related packages, by package and path in it."""
    if model.package is None:
        return {}
    folders = {str(folder.absolute()): name for name, folder in neighbours(model.package).items()}
    found = {}
    for file, source in model.related_files.items():
        if file.endswith((".yaml", ".yml")):
            path = Path(file).absolute()
            folder = next((str(each) for each in path.parents if str(each) in folders), None)
            if folder is not None:
                found[folders[folder], path.relative_to(folder).as_posix()] = source
    return found


def _in_elements(source: Source) -> Iterator[LaunchedNode]:
    defaults: dict[str, str] = {}
    waiting = [(element, LaunchPlace()) for element in reversed(roots_of(source))]
    while waiting:
        element, place = waiting.pop()
        at = element.attributes
        if element.tag == "arg" and "name" in at and (default := at.get("default") or at.get("value")) is not None:
            defaults.setdefault(at["name"].name, default.name)
        place = inside(place, element)
        if element.tag in ("node", "lifecycle_node"):
            yield _node(source, element, defaults, place)
        waiting += [(child, place) for child in reversed(element.children)]


def _node(source: Source, element: LaunchAction, defaults: dict[str, str], place: LaunchPlace) -> LaunchedNode:
    at = element.attributes
    program = at.get("exec") or at.get("type")
    name = at.get("name")
    files, remappings = [], []
    inner = [child.attributes["name"].name for child in element.children if "name" in child.attributes]
    for child in element.children:
        parts = child.attributes
        file = parts.get("from" if child.tag == "param" else "file")
        is_loaded = "ns" not in parts and ("command" not in parts or parts["command"].name == "load")
        if file is not None and (child.tag == "param" or (child.tag == "rosparam" and is_loaded)):
            text = re.sub(rf"^\s*{_ARGUMENT}\s*$", lambda use: defaults.get(use[1], use[0]), file.name)
            text = resolved_text(source, text)
            files.append((share_of(text), (file.start, file.end)))
        elif child.tag == "remap" and "from" in parts and "to" in parts:
            remappings.append((parts["from"], parts["to"]))
    return LaunchedNode(
        source,
        at["pkg"].name if "pkg" in at and "$" not in at["pkg"].name else "",
        program.name if program is not None and "$" not in program.name else "",
        name if name is not None and name.name and "$" not in name.name else None,
        name is not None,
        tuple(file for file, _ in files if file[0]),
        tuple(remappings),
        (program.start, program.end) if program is not None else None,
        frozenset((*inner, *_passed(" ".join(at[key].name for key in ("args", "ros_args") if key in at))))
        if all(file[0] for file, _ in files)
        else None,
        False,
        place.namespace,
        place.spaced_by,
        place.is_conditional,
        tuple(at for file, at in files if file[0]),
    )


def _in_python(source: Source) -> Iterator[LaunchedNode]:
    tree = parsed(source) if "Node" in source.text else None
    if tree is None:
        return
    reader = launch_reader(tree)
    defaults = dict(_defaults(tree, reader))
    branches = {inner for node in ast.walk(tree) if isinstance(node, _BRANCHES) for inner in ast.walk(node)}
    moved = None if re.search(PUSHED, source.text) else ""
    for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call)):
        if name_of(call.func) not in ("Node", "LifecycleNode"):
            continue
        words = {word.arg: word.value for word in call.keywords if word.arg is not None}
        space = reader.text(words["namespace"]) if "namespace" in words else moved
        for binding in bindings(tree, call):
            values = {key: resolved(value, binding) for key, value in words.items()}
            texts = {key: reader.text(value) if value is not None else None for key, value in values.items()}
            name = values.get("name")
            items = reader.items(values.get("parameters"))
            moved_names = values.get("remappings")
            remappings = tuple(_remappings(source, moved_names, reader, binding))
            is_open = any(word.arg is None for word in call.keywords)
            files = [_file(resolved(item, binding), reader, defaults) for item in items]
            yield LaunchedNode(
                source,
                texts.get("package") or "",
                texts.get("executable") or "",
                _literal(source, name, reader) if name is not None else None,
                "name" in words,
                tuple(file for file in files if file is not None),
                remappings,
                place(source, words["executable"]) if "executable" in words else None,
                _inline(source, call, items, binding, reader, files),
                is_open or _has_more(moved_names, reader, len(remappings)),
                space.strip("/") if space is not None else None,
                None,
                "condition" in words or call in branches,
                tuple(place(source, item) for item, file in zip(items, files, strict=True) if file is not None),
            )


_BUILDER, _MOST_CALLS = "MoveItConfigsBuilder", 40
_CHANGED = r"\.update\(|\[\s*[\"']use_sim_time[\"']\s*\]\s*="
"""Matches a launch file that adds parameters to a dictionary."""


MOVEIT_PARTS = (
    *("robot_description", "robot_description_semantic", "robot_description_kinematics", "planning_pipelines"),
    *("trajectory_execution", "planning_scene_monitor", "sensors_3d", "move_group_capabilities", "joint_limits"),
    *("moveit_cpp", "pilz_cartesian_limits"),
)
"""Attributes of a MoveIt configuration, which ``to_dict`` returns together, in most releases without capabilities.

Source: moveit_configs_utils, moveit_configs_builder.py (Humble to Rolling).
"""


def part_of_moveit(node: ast.expr | None, reader: LaunchReader, source: Source) -> str | None:
    """Return the part of a MoveIt configuration that an expression names: an attribute, or ``to_dict``; else None."""
    if isinstance(node, ast.Name):
        node = reader.assigned.get(node.id)
    part = node.func if isinstance(node, ast.Call) and not node.args else node
    if not isinstance(part, ast.Attribute) or part.attr not in (*MOVEIT_PARTS, "to_dict"):
        return None
    return part.attr if _is_of_moveit(part, reader, source) else None


def _is_of_moveit(node: ast.expr | None, reader: LaunchReader, source: Source) -> bool:
    """Return whether an expression is a part of a MoveIt configuration, which has no parameters of other nodes."""
    if _BUILDER not in source.text or re.search(_CHANGED, source.text):
        return False
    for _ in range(_MOST_CALLS):
        if isinstance(node, ast.Call):
            if name_of(node.func) == _BUILDER:
                return True
            node = node.func
        elif isinstance(node, ast.Attribute):
            node = node.value
        elif isinstance(node, ast.Name):
            node = reader.assigned.get(node.id)
    return False


def _inline(
    source: Source,
    call: ast.Call,
    items: list[ast.expr],
    binding: Binding,
    reader: LaunchReader,
    files: list[tuple[str, str] | None],
) -> frozenset[str] | None:
    """Return the names of parameters in dictionaries; None if there can be others that are not in the files."""
    found, words = set[str | None](), {word.arg for word in call.keywords}
    for item, file in zip(items, files, strict=True):
        value = resolved(item, binding)
        value = reader.assigned.get(value.id) if isinstance(value, ast.Name) else value
        if isinstance(value, ast.Dict):
            found |= {reader.text(key) if key is not None else None for key in value.keys}
        elif file is None and _is_of_moveit(value, reader, source):
            found.add("robot_description")
        elif file is None:
            return None
    passed = [word.value for word in call.keywords if word.arg in ("arguments", "ros_arguments")]
    texts = [_constants(resolved(item, binding)) for each in passed for item in reader.items(resolved(each, binding))]
    found |= _passed(" ".join(texts))
    is_open = None in found or None in words or (not items and "parameters" in words)
    return None if is_open else frozenset(name for name in found if name is not None)


def _passed(arguments: str) -> set[str]:
    """Return the names of the parameters that arguments of the command line set."""
    return set(re.findall(r"(?<!\S)(?:-p|--param)\s+(?:[^\s:]+:)?([\w.]+):=", arguments))


def _constants(node: ast.expr | None) -> str:
    """Return the constant texts of an expression, joined."""
    parts = ast.walk(node) if node is not None else ()
    return "".join(each.value for each in parts if isinstance(each, ast.Constant) and isinstance(each.value, str))


def _defaults(tree: ast.Module, reader: LaunchReader) -> Iterator[tuple[str, ast.expr]]:
    """Yield name and default of the declared launch arguments."""
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and name_of(call.func) in _DECLARATIONS:
            words = {word.arg: word.value for word in call.keywords}
            first = call.args[0] if call.args else words.get("name")
            name = reader.text(first) if first is not None else None
            if name is not None and "default_value" in words:
                yield name, words["default_value"]


def _file(
    node: ast.expr | None, reader: LaunchReader, defaults: dict[str, ast.expr], depth: int = 0
) -> tuple[str, str] | None:
    """Return package and path of a parameter file; None for dictionaries and computed paths."""
    if isinstance(node, ast.Name):
        node = reader.assigned.get(node.id)
    if node is None or depth > 6:
        return None
    if isinstance(node, ast.Call) and name_of(node.func) in _WRAPPERS:
        words = {word.arg: word.value for word in node.keywords}
        inner = words.get("param_file") or words.get("source_file") or next(iter(node.args), None)
        return _file(inner, reader, defaults, depth + 1)
    if isinstance(node, ast.Call) and name_of(node.func) == "LaunchConfiguration" and node.args:
        name = reader.text(node.args[0])
        return _file(defaults.get(name or ""), reader, defaults, depth + 1)
    found = reader.path(node)
    return (found[0], found[1].strip("/")) if found is not None and found[1].strip("/") else None


def _literal(source: Source, node: ast.expr, reader: LaunchReader) -> Named | None:
    """Return a constant text with the offset of its first character."""
    for _ in range(4):
        if isinstance(node, ast.Name):
            node = reader.assigned.get(node.id) or node
    if isinstance(node, (ast.BinOp, ast.JoinedStr)) and (text := reader.text(node)):
        return Named(text, *place(source, node))
    if not isinstance(node, ast.Constant) or not isinstance(node.value, str) or not node.value:
        return None
    start, end = place(source, node)
    offset = source.text[start:end].find(node.value)
    return Named(node.value, start + offset) if offset >= 0 else None


def _has_more(node: ast.expr | None, reader: LaunchReader, count: int) -> bool:
    """Return whether a value of ``remappings`` can have more pairs than those with constant names."""
    return node is not None and (not isinstance(node, (ast.List, ast.Tuple)) or len(reader.items(node)) != count)


def _remappings(
    source: Source, node: ast.expr | None, reader: LaunchReader, binding: Binding
) -> Iterator[tuple[Named, Named]]:
    for item in reader.items(node):
        pair = reader.assigned.get(item.id) if isinstance(item, ast.Name) else item
        if isinstance(pair, ast.Tuple) and len(pair.elts) == 2:
            parts = [resolved(part, binding) for part in pair.elts]
            names = [_literal(source, part, reader) if part is not None else None for part in parts]
            if names[0] is not None and names[1] is not None:
                yield names[0], names[1]
