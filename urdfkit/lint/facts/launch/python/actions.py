"""Actions of Python launch files, from their syntax tree; computed values are unknown."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import assignments, launch_reader, name_of, parsed, unparsed
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.records import (
    COMPUTED,
    IMPORTED,
    WITHOUT_COLON,
    Call,
    Declared,
    Executable,
    LaunchActions,
)
from urdfkit.lint.facts.nodes.python_bindings import bindings, resolved

_NODES = ("Node", "LifecycleNode", "ComposableNodeContainer")
_DECLARATIONS = ("DeclareLaunchArgument", "DeclareBooleanLaunchArg")
"""Classes that declare an argument (launch, moveit_configs_utils)."""

_LIBRARIES = """
ament_index_python launch launch_param_builder launch_ros launch_testing launch_testing_ros launch_xml launch_yaml
lifecycle_msgs nav2_common rclpy ros_gz_bridge ros_gz_sim xacro yaml
"""
"""Packages whose modules declare no arguments."""


def read_python(source: Source) -> LaunchActions:
    """Return the actions of a Python launch file; empty if it cannot be parsed."""
    found = LaunchActions(source)
    if (tree := parsed(source)) is not None:
        _PythonActions(source, tree, found).read()
    return found


class _PythonActions:
    def __init__(self, source: Source, tree: ast.Module, found: LaunchActions) -> None:
        self._source, self._tree, self._found, self._constants = source, tree, found, launch_reader(tree)
        self._conditional = set[ast.AST]()
        self._replaced = set(_replaced_values(tree))

    def read(self) -> None:
        for node in ast.walk(self._tree):
            is_conditional = isinstance(node, (ast.If, ast.IfExp, ast.Try, ast.While, ast.For)) or (
                isinstance(node, ast.Call) and any(word.arg == "condition" for word in node.keywords)
            )
            self._conditional.update(ast.walk(node) if is_conditional else ())
            if isinstance(node, ast.Call):
                self._call(node)
            elif isinstance(node, ast.Subscript) and name_of(node.value) == "launch_configurations":
                name = self._named(node.slice)
                if name is not None and isinstance(node.ctx, ast.Load):
                    self._found.used.append((name, False))
                elif name is not None:
                    self._found.assigned.add(name.name)
            elif isinstance(node, ast.Compare) and name_of(node.comparators[0]) == "launch_configurations":
                if (name := self._named(node.left)) is not None:  # code that runs only if the argument exists
                    self._found.assigned.add(name.name)
            elif isinstance(node, ast.AnnAssign) and name_of(node.annotation) in _DECLARATIONS:
                # A field of a class of arguments; its base classes can have more.
                self._found.assigned.add(COMPUTED)
            elif isinstance(node, ast.ImportFrom):
                top = (node.module or "").partition(".")[0]
                if node.level > 0 or top not in {*_LIBRARIES.split(), *sys.stdlib_module_names}:
                    self._found.assigned.add(IMPORTED)

    def _call(self, node: ast.Call) -> None:
        found, kind = self._found, name_of(node.func)
        keywords = {word.arg: word.value for word in node.keywords if word.arg is not None}
        first = node.args[0] if node.args else None
        if kind in (*_DECLARATIONS, "LaunchConfiguration", "SetLaunchConfiguration"):
            argument = first or keywords.get("name") or keywords.get("variable_name")
            name = self._named(argument) if argument is not None else None
            if kind in _DECLARATIONS:
                if name is None:
                    found.assigned.add(COMPUTED)
                else:
                    has_default = "default_value" in keywords or len(node.args) > 1
                    found.declared.setdefault(name.name, Declared(name, not has_default))
            elif name is not None and kind == "LaunchConfiguration" and node in self._replaced:
                pass
            elif name is not None and kind == "LaunchConfiguration":
                found.used.append((name, "default" in keywords or len(node.args) > 1))
            elif name is not None:
                found.assigned.add(name.name)
        elif kind in ("setdefault", "update") and name_of(getattr(node.func, "value", node)) == "launch_configurations":
            keys = first.keys if isinstance(first, ast.Dict) else [first]
            names = [self._named(key) if key is not None else None for key in keys]
            found.assigned.update(COMPUTED if name is None else name.name for name in names)
        elif kind == "IncludeLaunchDescription":
            file = first or keywords.get("launch_description_source")
            passed, is_all = self._pairs(keywords.get("launch_arguments"))
            self._add(found.includes, self._file(file), node, passed, is_all, is_conditional=node in self._conditional)
        elif kind in ("process_file", "process") or (kind == "robot_description" and "mappings" in keywords):
            passed, is_all = self._pairs(keywords.get("mappings"))
            self._add(found.xacro, self._path(first or keywords.get("file_path")), node, passed, is_all)
        elif kind == "Command" and first is not None:
            self._command(first, node)
        elif kind in _NODES:
            for binding in bindings(self._tree, node):
                parts = [resolved(keywords.get(key), binding) for key in ("package", "executable")]
                found.nodes.append(Executable(*(self._named(part) if part is not None else None for part in parts)))

    def _add(
        self,
        calls: list[Call],
        file: tuple[str, str],
        node: ast.expr,
        passed: list[Named],
        passes_all: bool,
        without_colon: tuple[Named, ...] = (),
        is_conditional: bool = False,
    ) -> None:
        start, end = place(self._source, node)
        first_line = self._source.text.find("\n", start)
        end = min(end, first_line if first_line > 0 else end)
        calls.append(Call(*file, start, end, tuple(passed), passes_all, without_colon, is_conditional))

    def _named(self, node: ast.expr) -> Named | None:
        """Return a literal text with the offset of its first character."""
        if isinstance(node, ast.Name) and (value := self._constants.assigned.get(node.id)) is not None:
            node = value
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            return None
        start, end = place(self._source, node)
        offset = self._source.text[start:end].find(node.value)
        return Named(node.value, start + offset) if offset >= 0 else None

    def _file(self, node: ast.expr | None) -> tuple[str, str]:
        """Return package and path of a launch description source."""
        for _ in range(4):
            if isinstance(node, ast.Name):
                node = self._constants.assigned.get(node.id)
            elif isinstance(node, ast.Call) and name_of(node.func).endswith("LaunchDescriptionSource") and node.args:
                node = node.args[0]
        return self._path(node)

    def _path(self, node: ast.expr | None) -> tuple[str, str]:
        found = self._constants.path(node) if node is not None else None
        return (found[0], found[1].strip("/")) if found is not None else ("", "")

    def _pairs(self, node: ast.expr | None) -> tuple[list[Named], bool]:
        """Return the literal keys of a dictionary, its items or a list of pairs, and whether it may have more."""
        if node is None:
            return [], False
        if isinstance(node, ast.Call) and name_of(node.func) in ("items", "list") and not node.args:
            node = node.func.value if isinstance(node.func, ast.Attribute) else node
        if isinstance(node, ast.Name):
            return self._pairs(self._constants.assigned.get(node.id)) if self._is_final(node) else ([], True)
        if isinstance(node, ast.Call) and name_of(node.func) == "dict" and not node.args:
            return [], True
        keys: list[ast.expr | None]
        if isinstance(node, ast.Dict):
            keys = list(node.keys)
        elif isinstance(node, (ast.List, ast.Tuple)):
            keys = [item.elts[0] if isinstance(item, ast.Tuple) and item.elts else None for item in node.elts]
        else:
            return [], True
        names = [self._named(key) if key is not None else None for key in keys]
        return [name for name in names if name is not None], None in names

    def _is_final(self, name: ast.Name) -> bool:
        """Return whether a dictionary is assigned once and not changed by a subscript or ``update``."""
        changed = rf"\b{re.escape(name.id)}\s*(?:\[[^\]]*\]\s*=(?!=)|\.update\b|\.append\b|\.extend\b|\s*\+=)"
        return name.id in self._constants.assigned and re.search(changed, self._source.text) is None

    def _command(self, first: ast.expr, node: ast.Call) -> None:
        """Read ``Command(["xacro ", path, " name:=", value])``."""
        if isinstance(first, ast.Name):
            first = self._constants.assigned.get(first.id) or first
        parts = first.elts if isinstance(first, (ast.List, ast.Tuple)) else [first]
        texts = [self._named(part) for part in parts]
        if not any("xacro" in text.name for text in texts if text is not None) and "xacro" not in unparsed(first):
            return
        passed = [
            Named(word[1], text.start + word.start(1))
            for text in texts
            if text is not None
            for word in re.finditer(r"([\w.-]+):=", text.name)
        ]
        paths = [found for part in parts if (found := self._path(part))[0]]
        defaults = [] if paths else [found for part in parts if (found := self._default(part))[0]]
        paths += defaults
        is_computed = bool(defaults) or any(isinstance(part, (ast.Starred, ast.BinOp, ast.JoinedStr)) for part in parts)
        malformed = tuple(
            Named(word[1], text.start + word.start(1))
            for text in texts
            if text is not None
            for word in re.finditer(WITHOUT_COLON, text.name)
        )
        self._add(self._found.xacro, paths[0] if paths else ("", ""), node, passed, is_computed, malformed)

    def _default(self, node: ast.expr) -> tuple[str, str]:
        """Return package and path of the default of the launch argument in ``LaunchConfiguration("name")``."""
        if isinstance(node, ast.Name):
            node = self._constants.assigned.get(node.id) or node
        if not isinstance(node, ast.Call) or name_of(node.func) != "LaunchConfiguration" or not node.args:
            return "", ""
        name = self._constants.text(node.args[0])
        for call in ast.walk(self._tree):
            if isinstance(call, ast.Call) and name_of(call.func) in _DECLARATIONS and call.args:
                default = next((word.value for word in call.keywords if word.arg == "default_value"), None)
                if default is not None and name is not None and self._constants.text(call.args[0]) == name:
                    return self._path(default)
        return "", ""


def _replaced_values(tree: ast.Module) -> Iterator[ast.expr]:
    """Yield the values of variables that the same block assigns again before their use."""
    for block in (node.body for node in ast.walk(tree) if isinstance(node, (ast.Module, ast.FunctionDef))):
        last: dict[str, ast.expr] = {}
        for statement in block:
            for part in ast.walk(statement):
                if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load):
                    last.pop(part.id, None)
            for name, value in _assigned(statement):
                if name in last:
                    yield last[name]
                last[name] = value


def _assigned(statement: ast.stmt) -> list[tuple[str, ast.expr]]:
    is_plain = isinstance(statement, ast.Assign) and len(statement.targets) == 1
    found = assignments(statement.targets[0], statement.value) if isinstance(statement, ast.Assign) and is_plain else ()
    return [(name.id, value) for name, value in found]
