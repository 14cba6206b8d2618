"""Messages with values of joints, and callbacks of action servers, in the Python code of a workspace.

Sources: trajectory_msgs, sensor_msgs (JointState.msg), and rclpy (action/server.py, _execute_goal): a callback that
leaves its goal executing aborts it.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from urdfkit.description.launch.python_constants import launch_reader, name_of
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import yamls
from urdfkit.lint.facts.topics.own_ends import attributes
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts, python_tree

Defects = Iterator[tuple[Source, tuple[int, int], str]]

_NAMES = {"JointTrajectory": "joint_names", "JointState": "name"}
"""Message → its field with the names of joints."""

_VALUES = {
    "JointTrajectoryPoint": ("positions", "velocities", "accelerations", "effort"),
    "JointState": ("position", "velocity", "effort"),
}
"""Message → its fields with one value for each joint."""

_NO_NAMES = frozenset(("joint", "position", "target", "goal", "value", "self", "command", "desired"))
_GROUP = r"/JointGroup\w+Controller$|/ForwardCommandController$"
_GROWING = ("append", "extend", "insert")
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)


def _modules(model: Model, pattern: str) -> Iterator[tuple[Source, ast.Module]]:
    """Yield the Python files of the packages whose text matches a pattern."""
    for folder in (neighbours(model.package) if model.package is not None else {}).values():
        model.expanded.packages.watch(folder)
        for path, text in node_texts(folder):
            tree = python_tree(text) if path.suffix == ".py" and re.search(pattern, text) else None
            if tree is not None:
                yield Source(shown_path(path), text), tree


def unequal_joints(model: Model) -> Defects:
    """Yield the values of joints in messages that differ in number or in order from the names of the joints."""
    for source, tree in _modules(model, r"\bJointTrajectory\b|\bJointState\b"):
        assigned, of_self = launch_reader(tree).assigned, attributes(tree)
        for function in (each for each in ast.walk(tree) if isinstance(each, _FUNCTIONS)):
            fields = list(_fields(function, assigned, of_self))
            for kind, key in _NAMES.items():
                names = [each for message, field, each in fields if (message, field) == (kind, key)]
                values_kind = "JointTrajectoryPoint" if kind == "JointTrajectory" else kind
                values = [each for each in fields if each[0] == values_kind and each[1] in _VALUES[values_kind]]
                if len(names) == 1:
                    yield from _compared(source, names[0], values)


def unequal_commands(model: Model) -> Defects:
    """Yield the lists in ``Float64MultiArray`` messages for a controller that differ in number from its joints."""
    counts: dict[str, set[int]] = {}
    for each in yamls(model):
        for one in settings(each):
            joints = one.group.find("joints")
            is_group = re.search(_GROUP, one.kind) is not None and joints is not None and bool(joints.items)
            counts.setdefault(one.name, set()).add(len(joints.items) if joints is not None and is_group else 0)
    for source, tree in _modules(model, r"\bFloat64MultiArray\b") if counts else ():
        publishers: dict[str, str] = {}
        for node in ast.walk(tree):
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call):
                topics = [each.value for each in node.value.args if isinstance(each, ast.Constant)]
                found = [re.search(r"(\w+)/commands?$", topic) for topic in topics if isinstance(topic, str)]
                if name_of(node.value.func) in ("create_publisher", "Publisher") and found and found[0] is not None:
                    publishers[name_of(node.targets[0])] = found[0][1]
        for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call) and each.args and publishers):
            sender = name_of(call.func.value) if isinstance(call.func, ast.Attribute) else ""
            controller, message = publishers.get(sender, ""), call.args[0]
            if name_of(call.func) != "publish" or not isinstance(message, ast.Call):
                continue
            data = next((word.value for word in message.keywords if word.arg == "data"), None)
            if not isinstance(data, ast.List) or any(isinstance(each, ast.Starred) for each in data.elts):
                continue
            number = counts.get(controller, {0})
            if 0 not in number and len(data.elts) not in number:
                text = f"the length of `data` is {len(data.elts)}; controller `{controller}` needs {min(number)}"
                yield source, place(source, data), text


def _fields(
    function: ast.AST, assigned: Mapping[str, ast.expr | None], of_self: Mapping[str, ast.expr]
) -> Iterator[tuple[str, str, ast.List | ast.Tuple]]:
    """Yield message, field and list of the fields of messages of joints that a function sets to a literal list.

    Args:
        function: a function.
        assigned: the variables of the module that are assigned once.
        of_self: the attributes that are assigned once.
    """
    kinds: dict[str, str] = {}
    found: list[tuple[str, str, ast.expr]] = []
    nodes = list(ast.walk(function))
    for node in nodes:
        if isinstance(node, ast.Call) and name_of(node.func) in (*_NAMES, *_VALUES):
            found += [(name_of(node.func), word.arg, word.value) for word in node.keywords if word.arg is not None]
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call):
            for name in (each.id for each in node.targets if isinstance(each, ast.Name)):
                kind = name_of(node.value.func)
                kinds[name] = kind if kinds.get(name, kind) == kind else ""
    for node in nodes:
        target = node.targets[0] if isinstance(node, ast.Assign) else None
        if isinstance(node, ast.Assign) and isinstance(target, ast.Attribute) and isinstance(target.value, ast.Name):
            found.append((kinds.get(target.value.id, ""), target.attr, node.value))
    grown = [node.value for node in nodes if isinstance(node, ast.Attribute) and node.attr in _GROWING]
    grown += [node.target for node in nodes if isinstance(node, ast.AugAssign)]
    changed = {each.attr for each in grown if isinstance(each, ast.Attribute)}
    for kind, field, written in found:
        name = name_of(written) if isinstance(written, (ast.Name, ast.Attribute)) else ""
        kept = assigned.get(name) if isinstance(written, ast.Name) else of_self.get(name)
        value = kept or written
        if {field, name} & changed:
            continue
        if isinstance(value, (ast.List, ast.Tuple)) and not any(isinstance(each, ast.Starred) for each in value.elts):
            yield kind, field, value


def _compared(
    source: Source, names: ast.List | ast.Tuple, fields: list[tuple[str, str, ast.List | ast.Tuple]]
) -> Defects:
    for _, field, values in fields:
        if values.elts and len(values.elts) != len(names.elts):
            message = f"the length of `{field}` is {len(values.elts)}, but that of the joint names is {len(names.elts)}"
            yield source, place(source, values), message
            return
        joints = [each.value if isinstance(each, ast.Constant) else None for each in names.elts]
        texts = [joint for joint in joints if isinstance(joint, str)]
        swapped = _swapped(texts, values.elts) if len(texts) == len(values.elts) > 1 else None
        if swapped is not None:
            value, joint, right = swapped
            message = f"joint `{joint}` gets `{ast.unparse(value)}`, which is named after `{right}`; check the order"
            yield source, place(source, names), message
            return


def _swapped(joints: list[str], values: list[ast.expr]) -> tuple[ast.expr, str, str] | None:
    """Return a value named after a joint with another value: the value, its own joint, and the one in its name."""
    parts = [{*joint.lower().split("_")} - _NO_NAMES for joint in joints]
    words = [_words(value) for value in values]
    for at, own in enumerate(words):
        shared = {word for word in own if any(word in each for each in parts)}
        others = [i for i in range(len(joints)) if shared & parts[i] and not shared & words[i]]
        if shared and not shared & parts[at] and others:
            return values[at], joints[at], joints[others[0]]
    return None


def _words(value: ast.expr) -> set[str]:
    """Return the words in the names of variables and attributes in an expression."""
    names = [each.id if isinstance(each, ast.Name) else "" for each in ast.walk(value)]
    names += [each.attr if isinstance(each, ast.Attribute) else "" for each in ast.walk(value)]
    return {word for name in names for word in name.lower().split("_") if len(word) > 2} - _NO_NAMES


def unfinished_goals(model: Model) -> Defects:
    """Yield the place in each callback of an action server in Python that never lets a goal succeed."""
    for source, tree in _modules(model, r"\bActionServer\b(?s:.*)\brclpy\b|\brclpy\b(?s:.*)\bActionServer\b"):
        functions: dict[str, list[ast.FunctionDef | ast.AsyncFunctionDef]] = {}
        for node in ast.walk(tree):
            if isinstance(node, _FUNCTIONS):
                functions.setdefault(node.name, []).append(node)
        for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call)):
            if name_of(call.func) != "ActionServer":
                continue
            words = {word.arg: word.value for word in call.keywords}
            callback = words.get("execute_callback", call.args[3] if len(call.args) > 3 else None)
            named = name_of(callback) if isinstance(callback, (ast.Name, ast.Attribute)) else ""
            found = functions.get(named, [])
            last = found[0].body[-1] if len(found) == 1 else None
            if isinstance(last, ast.Return) and last.value is not None and not _may_succeed(found[0]):
                at = place(source, _before_return(found[0].body))
                end = source.text.find("\n", at[0])
                message = f"`{named}` does not call succeed() of its goal, so the goal is aborted"
                yield source, (at[0], min(at[1], end) if end > 0 else at[1]), message


def _may_succeed(function: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    """Return whether a callback calls ``succeed()`` of its goal, or passes the goal on."""
    if not function.args.args:
        return True
    goal = function.args.args[-1].arg
    nodes = list(ast.walk(function))
    calls = {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    read = [node.value for node in nodes if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)]
    uses = [node for node in nodes if isinstance(node, ast.Name) and node.id == goal]
    return "succeed" in calls or len(uses) != sum(node.id == goal for node in read)


def _before_return(body: list[ast.stmt]) -> ast.stmt:
    """Return the first of the assignments to fields of the result at the end of a function, or its return."""
    at = len(body) - 1
    for before in reversed(body[:-1]):
        if not isinstance(before, ast.Assign) or not isinstance(before.targets[0], ast.Attribute):
            break
        at -= 1
    return body[at]
