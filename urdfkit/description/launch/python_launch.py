"""ROS 2 Python launch files, read as syntax trees; computed values are unknown."""

import ast
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfkit.description.launch.launch_scope import (
    MAX_TEXT,
    UNKNOWN,
    LaunchNode,
    LaunchScope,
    PlacedText,
    is_false,
    is_true,
)
from urdfkit.description.launch.python_constants import JOINS, SHARE, inserts_text, launch_reader, name_of

_MAX_STEPS = 50_000
_NODES = frozenset(("Node", "LifecycleNode", "ComposableNode", "ComposableNodeContainer"))
_PUSHES = frozenset(("PushRosNamespace", "PushROSNamespace"))
_WRAPPERS = frozenset(("ParameterFile", "RewrittenYaml", "ReplaceString"))
"""Classes that return a changed copy of a parameter file (launch_ros, nav2_common)."""
_SAME = frozenset(("TextSubstitution", "str", "Path", "FindExecutable", "ParameterValue"))
"""Calls whose value is that of their only argument, or of their `text` or `name`."""
_OF_OBJECT = frozenset(("perform", "as_posix", "resolve"))
"""Methods whose value is that of their object."""


def read_tree(tree: ast.Module, scope: LaunchScope) -> None:
    """Read the actions of a launch file.

    Args:
        tree: its syntax tree.
        scope: its arguments, and the record of its contents.
    """
    _PythonLaunch(tree, scope).read()


class _PythonLaunch:
    def __init__(self, tree: ast.Module, scope: LaunchScope) -> None:
        self._tree, self._scope, self._steps = tree, scope, 0
        self._assigned: Mapping[str, ast.expr | None] = launch_reader(tree).assigned
        self._groups, self._is_moved = self._grouped()

    def read(self) -> None:
        """Read the declared arguments, then the actions that use them."""
        for node in ast.walk(self._tree):
            if isinstance(node, ast.Call) and name_of(node.func) == "DeclareLaunchArgument":
                keywords = _keywords(node, "name")
                default = self._text(keywords["default_value"]) if "default_value" in keywords else UNKNOWN
                self._scope.declare(
                    self._text(keywords.get("name")), default, self._text(keywords.get("description"), "")
                )
        self._visit(self._tree)

    def _visit(self, node: ast.AST) -> None:
        outer = self._scope.namespace, self._scope.is_skipped, self._scope.spaced_at
        if isinstance(node, ast.Call):
            keywords = _keywords(node)
            self._scope.is_skipped |= self._holds(keywords.get("condition")) is False
            name = name_of(node.func)
            if name in _NODES or name == "IncludeLaunchDescription":
                self._enter(node)
            if name == "Command":
                self._scope.command(self._text(_first(node)))
            elif name in ("process_file", "process", "process_doc"):
                self._scope.expansion(self._opened(_first(node)), self._mapping(keywords.get("mappings")))
            elif name == "IncludeLaunchDescription":
                file = self._text(_first(node) or keywords.get("launch_description_source"))
                passed = self._mapping(keywords.get("launch_arguments"))
                self._scope.include(file, {**self._scope.arguments, **passed})
            elif name in _NODES:
                self._scope.start(self._text(keywords.get("package")))
                if name != "ComposableNode":
                    self._scope.found.nodes.append(self._node(node, keywords))
            elif name == "ExecuteProcess":
                for program in self._text(keywords.get("cmd"), separator=" ").split()[:1]:
                    self._scope.start(program)
        for child in ast.iter_child_nodes(node):
            self._visit(child)
        self._scope.namespace, self._scope.is_skipped, self._scope.spaced_at = outer

    def _grouped(self) -> tuple[dict[int, list[ast.Call]], bool]:
        """Return the actions that push a namespace around each action of a group, and whether others push one too."""
        pushed: dict[int, list[ast.Call]] = {}
        pushes = [each for each in ast.walk(self._tree) if isinstance(each, ast.Call) and name_of(each.func) in _PUSHES]
        if not pushes:
            return pushed, False
        seen: set[int] = set()
        for group in ast.walk(self._tree):  # outer groups first
            if not isinstance(group, ast.Call) or name_of(group.func) != "GroupAction":
                continue
            around = list(pushed.get(id(group), ()))
            for action in self._items(_first(group) or _keywords(group).get("actions")):
                if isinstance(action, ast.Call) and name_of(action.func) in _PUSHES:
                    around.append(action)
                    seen.add(id(action))
                elif action is not None:
                    pushed |= {id(inner): list(around) for inner in ast.walk(action) if isinstance(inner, ast.Call)}
        return pushed, any(id(push) not in seen for push in pushes)

    def _items(self, node: ast.expr | None) -> Iterator[ast.expr | None]:
        """Yield the expressions in a list, without names that are assigned once."""
        node = self._assigned.get(node.id) if isinstance(node, ast.Name) else node
        for item in node.elts if isinstance(node, (ast.List, ast.Tuple)) else ():
            yield self._assigned.get(item.id) if isinstance(item, ast.Name) else item

    def _enter(self, action: ast.Call) -> None:
        """Set the namespace that the groups around a node or an include give it."""
        if self._is_moved:
            self._scope.namespace = UNKNOWN
        for push in self._groups.get(id(action), ()):
            keywords = _keywords(push, "namespace")
            holds = self._holds(keywords["condition"]) if "condition" in keywords else True
            if holds:
                self._scope.namespace = self._scope.below(self._text(keywords.get("namespace")))
                self._scope.spaced_at = (self._scope.path, *_start(keywords.get("namespace"), push))
            elif holds is None:
                self._scope.namespace = UNKNOWN

    def _node(self, call: ast.Call, keywords: dict[str, ast.expr]) -> LaunchNode:
        scope, listed = self._scope, keywords.get("parameters")
        space = self._text(keywords["namespace"]) if "namespace" in keywords else ""
        parameters, arguments = list(self._items(listed)), list(self._items(keywords.get("arguments")))
        files = [self._parameter_file(item) for item in parameters if not isinstance(item, ast.Dict)]
        pairs = [item.elts for item in self._items(keywords.get("remappings")) if isinstance(item, ast.Tuple)]
        lists = ((listed, parameters), (keywords.get("arguments"), arguments), (keywords.get("remappings"), pairs))
        is_open = any(written is not None and not items for written, items in lists) or None in files
        return LaunchNode(
            scope.path,
            call.lineno,
            call.col_offset + 1,
            self._text(keywords.get("package")),
            self._text(keywords.get("executable")),
            self._text(keywords["name"]) if "name" in keywords else "",
            scope.below(space) if space else scope.namespace,
            tuple(PlacedText(self._text(item), *_start(item, call)) for item in arguments),
            {self._text(pair[0]): self._text(pair[1]) for pair in pairs if len(pair) == 2},
            tuple(file for file in files if file is not None),
            is_open or any(word.arg is None for word in call.keywords),
            scope.is_skipped,
            (scope.path, *_start(keywords["namespace"], call)) if "namespace" in keywords else scope.spaced_at,
        )

    def _parameter_file(self, node: ast.expr | None, namespace: str = "") -> tuple[Path, str] | None:
        """Return a parameter file, and the namespace that its reader puts around it; None if it is not found."""
        node = self._assigned.get(node.id) if isinstance(node, ast.Name) else node
        if isinstance(node, ast.Call) and name_of(node.func) in _WRAPPERS:
            words = _keywords(node)
            inner = words.get("param_file") or words.get("source_file") or _first(node)
            return self._parameter_file(inner, self._text(words.get("root_key"), namespace))
        file = self._scope.file(self._text(node))
        return (file, namespace.strip("/")) if file is not None else None

    def _holds(self, condition: ast.expr | None) -> bool | None:
        """Return whether a condition of an action holds; None if it is computed."""
        kind = name_of(condition.func) if isinstance(condition, ast.Call) else ""
        text = self._text(_first(condition)) if isinstance(condition, ast.Call) else UNKNOWN
        if kind not in ("IfCondition", "UnlessCondition") or not (is_true(text) or is_false(text)):
            return None
        return is_true(text) == (kind == "IfCondition")

    def _text(self, node: ast.expr | None, default: str = UNKNOWN, separator: str = "") -> str:
        """Return the text of an expression, with `UNKNOWN` for each computed part."""
        self._steps += 1
        if node is None or self._steps > _MAX_STEPS:
            return default
        text = self._value(node, separator)
        return text if len(text) <= MAX_TEXT else UNKNOWN

    def _value(self, node: ast.expr, separator: str) -> str:
        if isinstance(node, ast.Constant):
            return UNKNOWN if node.value is None else str(node.value)
        if isinstance(node, ast.Name):
            return self._text(self._assigned.get(node.id))
        if isinstance(node, (ast.List, ast.Tuple)):
            return separator.join(self._text(item) for item in node.elts)
        if isinstance(node, ast.JoinedStr):
            return "".join(self._text(part) for part in node.values)
        if isinstance(node, ast.FormattedValue):
            return self._text(node.value) if inserts_text(node) else UNKNOWN
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            return self._text(node.left) + self._text(node.right)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
            return _joined([self._text(node.left), self._text(node.right)])
        return self._call(node) if isinstance(node, ast.Call) else UNKNOWN

    def _call(self, call: ast.Call) -> str:
        name, keywords = name_of(call.func), _keywords(call)
        first = _first(call)
        if name == "LaunchConfiguration":
            written = first or keywords.get("variable_name")
            value = self._scope.value(self._text(written))
            return self._text(keywords["default"]) if value == UNKNOWN and "default" in keywords else value
        if name in SHARE or (name == "find" and isinstance(call.func, ast.Attribute)):
            return self._scope.share(self._text(first or keywords.get("package") or keywords.get("package_name")))
        if name == "ThisLaunchFileDir":
            return str(self._scope.path.parent)
        if name in JOINS:
            parts = call.args
            if len(parts) == 1 and isinstance(parts[0], (ast.List, ast.Tuple)):
                parts = parts[0].elts
            return _joined([self._text(part) for part in parts])
        if name == "joinpath" and isinstance(call.func, ast.Attribute):
            return _joined([self._text(part) for part in (call.func.value, *call.args)])
        if name in _OF_OBJECT and isinstance(call.func, ast.Attribute):
            return self._text(call.func.value)
        if name in _SAME or name.endswith("LaunchDescriptionSource"):
            return self._text(first or keywords.get("text") or keywords.get("name"))
        return UNKNOWN

    def _opened(self, node: ast.expr | None) -> str:
        """Return the path of a file that an expression names, opens (``open``) or parses (``xacro.parse``)."""
        for _ in range(8):
            if isinstance(node, ast.Name) and isinstance(value := self._assigned.get(node.id), ast.expr):
                node = value
            elif isinstance(node, ast.Call) and name_of(node.func) in ("parse", "open"):
                node = _first(node)
            else:
                break
        return self._text(node)

    def _mapping(self, node: ast.expr | None) -> dict[str, str]:
        """Return the constant keys and the values of a dictionary, its items or a list of pairs."""
        for _ in range(8):
            if isinstance(node, ast.Name):
                node = self._assigned.get(node.id)
            elif isinstance(node, ast.Call) and name_of(node.func) == "items" and isinstance(node.func, ast.Attribute):
                node = node.func.value
            elif isinstance(node, ast.Call) and name_of(node.func) == "dict":
                return {word.arg: self._text(word.value) for word in node.keywords if word.arg is not None}
            else:
                break
        pairs: list[tuple[ast.expr | None, ast.expr]] = []
        if isinstance(node, ast.Dict):
            pairs = list(zip(node.keys, node.values, strict=True))
        elif isinstance(node, (ast.List, ast.Tuple)):
            items = [item.elts for item in node.elts if isinstance(item, (ast.List, ast.Tuple))]
            pairs = [(item[0], item[1]) for item in items if len(item) == 2]
        return {name: self._text(value) for key, value in pairs if UNKNOWN not in (name := self._text(key))}


def _keywords(call: ast.Call, first: str = "") -> dict[str, ast.expr]:
    """Return the keyword arguments of a call; the first positional argument by the name `first`."""
    keywords = {word.arg: word.value for word in call.keywords if word.arg is not None}
    if first and call.args:
        keywords.setdefault(first, call.args[0])
    return keywords


def _start(node: ast.expr | None, call: ast.Call) -> tuple[int, int]:
    """Return the line and column of an expression, or of the call around it."""
    at = call if node is None else node
    return at.lineno, at.col_offset + 1


def _first(call: ast.Call) -> ast.expr | None:
    return call.args[0] if call.args else None


def _joined(parts: list[str]) -> str:
    return os.path.join(*parts) if parts else UNKNOWN  # noqa: PTH118 - parts may hold unknown characters
