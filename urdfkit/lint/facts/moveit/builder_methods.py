"""Methods of ``MoveItConfigsBuilder`` that launch files call: misspelt methods, and missing or exchanged files.

Source: moveit_configs_utils, moveit_configs_builder.py (Humble to Rolling): a file is relative to the MoveIt package; a
planning pipeline has the file ``config/<pipeline>_planning.yaml``, or one of moveit_configs_utils.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.packages.similar_names import near_path
from urdfkit.description.xml.source import Source, Span
from urdfkit.errors import did_you_mean
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.model.model import Model

_FILES = frozenset(
    (
        *("robot_description", "robot_description_semantic", "robot_description_kinematics", "joint_limits"),
        *("trajectory_execution", "moveit_cpp", "pilz_cartesian_limits", "cartesian_limits", "sensors_3d"),
    )
)
"""Methods whose first argument, or ``file_path``, is a file."""

_METHODS = _FILES | {"planning_pipelines", "planning_scene_monitor", "to_dict", "to_moveit_configs"}
_KEYWORDS = {
    "MoveItConfigsBuilder": "robot_name robot_description package_name",
    "robot_description": "file_path mappings",
    "robot_description_semantic": "file_path mappings",
    "trajectory_execution": "file_path moveit_manage_controllers",
    "planning_pipelines": "default_planning_pipeline pipelines load_all",
    **dict.fromkeys(
        ("robot_description_kinematics", "joint_limits", "pilz_cartesian_limits", "sensors_3d"), "file_path"
    ),
}
_CONTENTS = {"robot_description_kinematics": "kinematics_solver", "joint_limits": "joint_limits"}
"""Method → key that its file must have (moveit_configs_utils, moveit_configs_builder.py)."""
_PIPELINES = ("chomp", "ompl", "pilz_industrial_motion_planner", "stomp")
"""Pipelines with a file in moveit_configs_utils."""


def wrong_methods(
    source: Source, tree: ast.Module, builder: ast.Call, folder: Path | None, model: Model
) -> Iterator[tuple[Span, str]]:
    """Yield place and message of each wrong method, keyword, file and pipeline of a builder.

    Args:
        source: the launch file.
        tree: its syntax tree.
        builder: the call of ``MoveItConfigsBuilder``.
        folder: the MoveIt package; None if it is not in the workspace.
        model: the linted model.
    """
    reader = launch_reader(tree)
    yield from _keywords(source, builder, "MoveItConfigsBuilder")
    called = {node.func for node in ast.walk(tree) if isinstance(node, ast.Call)}
    read = [node for node in ast.walk(tree) if isinstance(node, ast.Attribute) and node not in called]
    for part in (each for each in read if each.attr in _METHODS and _builder_of(each.value, reader) is builder):
        end = place(source, part)[1]
        message = f"`{part.attr}` is a method here: the builder does not end with `.to_moveit_configs()`"
        yield source.span(end - len(part.attr), end), message
        break
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
            continue
        if _builder_of(node.func.value, reader) is not builder:
            continue
        method = node.func.attr
        if method not in _METHODS:
            if hint := did_you_mean(method, _METHODS):
                end = place(source, node.func)[1]
                yield source.span(end - len(method), end), f"`MoveItConfigsBuilder` has no method `{method}`" + hint
            continue
        words = {word.arg: word.value for word in node.keywords if word.arg is not None}
        yield from _keywords(source, node, method)
        if folder is None:
            continue
        file = words.get("file_path", node.args[0] if node.args else None)
        if method in _FILES and file is not None:
            yield from _file(source, file, folder, reader, model)
            yield from _content(source, file, method, folder, reader, model)
        elif method == "planning_pipelines":
            default, names = (words.get(each) for each in ("default_planning_pipeline", "pipelines"))
            positional = [*node.args, None, None]
            default, names = default or positional[0], names or positional[1]
            yield from _pipelines(source, default, names, folder, reader, model)


def _keywords(source: Source, call: ast.Call, method: str) -> Iterator[tuple[Span, str]]:
    valid = _KEYWORDS.get(method, "").split()
    for word in call.keywords:
        name = word.arg or ""
        if valid and name not in valid and (hint := did_you_mean(name, valid)):
            start = source.text.rfind(name, 0, place(source, word.value)[0])
            yield source.span(start, start + len(name)), f"`{method}` has no argument `{name}`" + hint


def _builder_of(start: ast.expr, reader: LaunchReader) -> ast.expr | None:
    """Return the call of ``MoveItConfigsBuilder`` at the start of a chain of methods."""
    node: ast.expr | None = start
    for _ in range(40):
        if isinstance(node, ast.Name):
            node = reader.assigned.get(node.id)
        elif isinstance(node, ast.Call) and name_of(node.func) == "MoveItConfigsBuilder":
            return node
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr != "to_moveit_configs"
        ):
            node = node.func.value
        else:
            return None
    return None


def _file(
    source: Source, node: ast.expr, folder: Path, reader: LaunchReader, model: Model
) -> Iterator[tuple[Span, str]]:
    path = _relative(node, reader)
    if path and not path.startswith(("/", "~")) and not model.expanded.packages.whereabouts(folder / path):
        message = f"`{path}` does not exist in package `{folder.name}`" + near_path(folder / path)
        yield source.span(*place(source, node)), message


def _content(
    source: Source, node: ast.expr, method: str, folder: Path, reader: LaunchReader, model: Model
) -> Iterator[tuple[Span, str]]:
    """Yield the path of a file without the key that the method reads, such as that of another method."""
    path, key = _relative(node, reader), _CONTENTS.get(method)
    if not path or path.startswith(("/", "~")) or key is None:
        return
    wanted = str((folder / path).resolve())
    texts = [file.text for name, file in model.related_files.items() if str(Path(name).resolve()) == wanted]
    if texts and not any(re.search(rf"\b{key}\b", text) for text in texts):
        yield source.span(*place(source, node)), f"`{path}` has no `{key}`, which `{method}` reads"


def _relative(node: ast.expr, reader: LaunchReader) -> str:
    """Return the path that a text, ``Path("…")`` or a quotient of these stands for; empty if it is computed."""
    if isinstance(node, ast.Name):
        node = reader.assigned.get(node.id) or node
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
        left, right = _relative(node.left, reader), reader.text(node.right)
        return f"{left}/{right}" if left and right else ""
    if isinstance(node, ast.Call) and name_of(node.func) == "Path" and not node.keywords:
        parts = [reader.text(part) for part in node.args]
        return "" if None in parts else "/".join(part for part in parts if part)
    return reader.text(node) or ""


def _pipelines(
    source: Source, default: ast.expr | None, names: ast.expr | None, folder: Path, reader: LaunchReader, model: Model
) -> Iterator[tuple[Span, str]]:
    """Yield the pipelines without a file, and a default pipeline that is not one of the list."""
    if isinstance(names, ast.Name):
        names = reader.assigned.get(names.id)
    if not isinstance(names, (ast.List, ast.Tuple)):
        return
    written = [reader.text(name) for name in names.elts]
    model.expanded.packages.watch(folder, ".yaml")
    existing = {
        *_PIPELINES,
        *(file.name.removesuffix("_planning.yaml") for file in folder.glob("config/*_planning.yaml")),
    }
    for node, name in zip(names.elts, written, strict=True):
        if name and name not in existing:
            message = f"planning pipeline `{name}` has no file `config/{name}_planning.yaml` in package `{folder.name}`"
            yield source.span(*place(source, node)), message + did_you_mean(name, existing)
    name = reader.text(default) if default is not None else None
    if default is not None and name and written and None not in written and name not in written:
        hint = did_you_mean(name, [each for each in written if each])
        message = f"the default planning pipeline `{name}` is not in `pipelines`" + hint
        yield source.span(*place(source, default)), message
