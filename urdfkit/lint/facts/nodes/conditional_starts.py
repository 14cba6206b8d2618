"""Nodes and includes of launch files with the launch arguments that decide whether they start."""

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of, parsed
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.actions import LaunchAction, all_elements, roots_of, share_of
from urdfkit.record import record

_USE = r"\s*\$\((?:arg|var)\s+([\w.-]+)\s*\)\s*"
_OPAQUE = (
    r"OpaqueFunction\(|namespace(?!\w*\s*[=:]\s*(?:''|\"\"))|PushR\w*\(|<push"
    r"|<(?:group|node|include)\b[^<>]*\bns\s*="
)
"""Matches launch files whose conditions are outside of the actions, or that start several robots."""

_ACTIONS = ("GroupAction", "IncludeLaunchDescription", "LifecycleNode", "Node")
_BRANCHES = (ast.If, ast.IfExp, ast.For, ast.While, ast.Try)


@record(eq=False)
class Start:
    """A node or an include.

    Attributes:
        place: first and last offset of the action, or of its start tag.
        conditions: launch argument → the value that it must have.
        package: package of the node or file.
        program: executable of the node, or path of the included file in its package.
        is_include: whether it is an include.
        name: name of the node; empty without a constant one.
        passed: launch arguments that an include passes: ``true``, ``false``, a name after ``$``, or empty if computed.
        group: first and last offset of the innermost group around it with a condition, or of its start tag.
    """

    place: tuple[int, int]
    conditions: dict[str, bool]
    package: str
    program: str
    is_include: bool
    name: str
    passed: dict[str, str]
    group: tuple[int, int] | None = None


@record(eq=False)
class ConditionalAction:
    """A node, an include or a group that starts if a launch argument is true, or if it is false.

    Attributes:
        place: first and last offset of the action, or of its start tag.
        argument: the launch argument.
        value: the value of the argument that starts the action.
        subjects: package and program, or package and path of the included file, of each node and include in it.
    """

    place: tuple[int, int]
    argument: str
    value: bool
    subjects: tuple[tuple[str, str], ...]


def conditional_actions(source: Source) -> Iterator[ConditionalAction]:
    """Yield the actions of a launch file with a condition of their own that one launch argument decides."""
    if not source.file.endswith(".py"):
        for element in all_elements(source):
            at = element.attributes
            uses = [(re.fullmatch(_USE, at[key].name), key == "if") for key in ("if", "unless") if key in at]
            if element.tag in ("node", "include", "group") and len(uses) == 1 and uses[0][0] is not None:
                subjects = [found for each in (element, *_below(element)) if any(found := _subject(each))]
                yield ConditionalAction((element.start, element.end), uses[0][0][1], uses[0][1], tuple(subjects))
        return
    tree = parsed(source) if "Condition" in source.text else None
    reader = launch_reader(tree) if tree is not None else None
    for call in ast.walk(tree) if tree is not None else ():
        if not isinstance(call, ast.Call) or name_of(call.func) not in _ACTIONS or reader is None:
            continue
        condition = next((word.value for word in call.keywords if word.arg == "condition"), None)
        needed = _condition(condition, reader) or {}
        inner = [_assigned(each, reader) or each for each in ast.walk(call) if isinstance(each, ast.expr)]
        subjects = [found for each in inner if isinstance(each, ast.Call) and any(found := _called(each, reader))]
        for argument, value in needed.items():
            yield ConditionalAction(place(source, call), argument, value, tuple(subjects))


def _subject(element: LaunchAction) -> tuple[str, str]:
    """Return package and program of a node, or package and path of an include; empty for others."""
    at = element.attributes
    if element.tag == "include" and "file" in at:
        return share_of(at["file"].name)
    program = at.get("type") or at.get("exec")
    return (at["pkg"].name, program.name) if element.tag == "node" and "pkg" in at and program else ("", "")


def _called(call: ast.Call, reader: LaunchReader) -> tuple[str, str]:
    """Return package and program of a node, or package and path of an include; empty for other calls."""
    words = {word.arg: word.value for word in call.keywords if word.arg is not None}
    if name_of(call.func) == "IncludeLaunchDescription":
        file = _assigned(call.args[0] if call.args else words.get("launch_description_source"), reader)
        inner = file.args[0] if isinstance(file, ast.Call) and file.args else file
        found = (reader.path(each) for each in (file, inner) if each is not None)
        path = next((each for each in found if each is not None), None)
        return (path[0], path[1].strip("/")) if path is not None else ("", "")
    if name_of(call.func) not in ("Node", "LifecycleNode"):
        return "", ""
    package, program = ((reader.text(words[key]) or "") if key in words else "" for key in ("package", "executable"))
    return package, program


def starts(source: Source) -> tuple[list[Start], dict[str, str]]:
    """Return the nodes and includes of a launch file whose conditions are known, and the defaults of its arguments."""
    if re.search(_OPAQUE, source.text):
        return [], {}
    if not source.file.endswith(".py"):
        defaults = {
            at["name"].name: at["default"].name
            for element in all_elements(source)
            if element.tag == "arg" and {"name", "default"} <= (at := element.attributes).keys()
        }
        return list(_in_elements(source)), defaults
    tree = parsed(source)
    return ([], {}) if tree is None else (list(_in_python(source, tree)), _defaults(tree))


def _in_elements(source: Source) -> Iterator[Start]:
    waiting: list[tuple[LaunchAction, dict[str, bool], tuple[int, int] | None]]
    waiting = [(each, {}, None) for each in reversed(roots_of(source))]
    while waiting:
        element, outer, group = waiting.pop()
        at = element.attributes
        uses = [(re.fullmatch(_USE, at[key].name), key == "if") for key in ("if", "unless") if key in at]
        conditions = {use[1]: value for use, value in uses if use is not None}
        if len(conditions) < len(uses) or any(outer.get(name, value) != value for name, value in conditions.items()):
            continue  # computed, or never true
        conditions = {**outer, **conditions}
        if element.tag in ("launch", "group"):
            inner = (element.start, element.end) if uses else group
            waiting += [(child, conditions, inner) for child in reversed(element.children)]
        if element.tag not in ("node", "include"):
            continue
        package, program = _subject(element)
        passed = {
            child.attributes["name"].name: _value(child.attributes["value"].name)
            for child in element.children
            if {"name", "value"} <= child.attributes.keys()
        }
        name = at["name"].name if "name" in at else ""
        if element.tag == "include":
            yield Start((element.start, element.end), conditions, package, program, True, "", passed, group)
        elif package or program:
            yield Start((element.start, element.end), conditions, package, program, False, name, {}, group)


def _below(element: LaunchAction) -> Iterator[LaunchAction]:
    for child in element.children:
        yield child
        yield from _below(child)


def _value(text: str) -> str:
    use = re.fullmatch(_USE, text)
    if use is not None:
        return f"${use[1]}"
    return text.lower() if text.lower() in ("true", "false") else ""


def _in_python(source: Source, tree: ast.Module) -> Iterator[Start]:
    reader = launch_reader(tree)
    conditional = {inner for node in ast.walk(tree) if isinstance(node, _BRANCHES) for inner in ast.walk(node)}
    groups = _groups(tree, reader)
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call) and node not in conditional):
        kind = name_of(call.func)
        if kind not in ("Node", "LifecycleNode", "IncludeLaunchDescription"):
            continue
        words = {word.arg: word.value for word in call.keywords if word.arg is not None}
        conditions, (outer, around) = _condition(words.get("condition"), reader), groups.get(call, ({}, None))
        group = place(source, around) if around is not None else None
        if conditions is None or outer is None:
            continue
        if any(outer.get(name, value) != value for name, value in conditions.items()):
            continue
        conditions = {**outer, **conditions}
        package, program = _called(call, reader)
        if kind == "IncludeLaunchDescription":
            passed = _passed(words.get("launch_arguments"), reader)
            yield Start(place(source, call), conditions, package, program, True, "", passed, group)
        else:
            name = (reader.text(words["name"]) or "") if "name" in words else ""
            yield Start(place(source, call), conditions, package, program, False, name, {}, group)


Group = tuple[dict[str, bool] | None, ast.Call | None]


def _groups(tree: ast.Module, reader: LaunchReader) -> dict[ast.expr, Group]:
    """Return the actions in groups with the conditions and the innermost of these; None for computed conditions."""
    found: dict[ast.expr, Group] = {}
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and name_of(node.func) == "GroupAction"]
    for call in calls:  # from the outermost one
        words = {word.arg: word.value for word in call.keywords if word.arg is not None}
        (outer, around), own = found.get(call, ({}, None)), _condition(words.get("condition"), reader)
        listed = reader.items(words.get("actions") or (call.args[0] if call.args else None))
        for action in [_assigned(item, reader) for item in listed]:
            if action is not None:
                both = None if outer is None or own is None else {**outer, **own}
                found[action] = both, call if "condition" in words else around
    return found


def _condition(node: ast.expr | None, reader: LaunchReader) -> dict[str, bool] | None:
    """Return the argument that a condition reads, and its value; None if it is another expression."""
    if node is None:
        return {}
    value = _assigned(node, reader)
    kind = name_of(value.func) if isinstance(value, ast.Call) else ""
    if kind not in ("IfCondition", "UnlessCondition") or not isinstance(value, ast.Call) or len(value.args) != 1:
        return None
    name = _configuration(value.args[0], reader)
    return {name: kind == "IfCondition"} if name else None


def _configuration(node: ast.expr, reader: LaunchReader) -> str:
    """Return the name of a ``LaunchConfiguration``; empty for other expressions."""
    value = _assigned(node, reader)
    is_use = isinstance(value, ast.Call) and name_of(value.func) == "LaunchConfiguration"
    return (reader.text(value.args[0]) or "") if is_use and isinstance(value, ast.Call) and value.args else ""


def _assigned(node: ast.expr | None, reader: LaunchReader) -> ast.expr | None:
    return reader.assigned.get(node.id) if isinstance(node, ast.Name) else node


def _passed(node: ast.expr | None, reader: LaunchReader) -> dict[str, str]:
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "items":
        node = node.func.value
    node = _assigned(node, reader)
    found: dict[str, str] = {}
    for key, value in zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ():
        name = reader.text(key) if key is not None else None
        use = _configuration(value, reader)
        if name is not None:
            found[name] = f"${use}" if use else _value(reader.text(value) or "")
    return found


def _defaults(tree: ast.Module) -> dict[str, str]:
    reader, found = launch_reader(tree), dict[str, str]()
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        words = {word.arg: word.value for word in call.keywords}
        if name_of(call.func) == "DeclareLaunchArgument" and call.args:
            name = reader.text(call.args[0])
            default = reader.text(words["default_value"]) if "default_value" in words else None
            found.setdefault(name or "", default or "")
    return found
