"""Substitutions in Python launch files whose text is needed before the launch evaluates them.

Sources: ros2/launch (launch/substitution.py), ros/xacro (xacro/substitution_args.py, which inserts strings only).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import LaunchReader, name_of
from urdfkit.lint.facts.launch.python.names import called, value_of

Defects = Iterator[tuple[ast.expr, str]]

SUBSTITUTIONS = (
    *("Command", "EnvironmentVariable", "FindExecutable", "FindPackageShare", "LaunchConfiguration"),
    *("PathJoinSubstitution", "PythonExpression", "TextSubstitution", "ThisLaunchFileDir"),
)
_OF_STRINGS = ("endswith", "format", "lower", "replace", "split", "startswith", "strip", "upper")
_OF_XACRO = ("process_doc", "process_file")
_CONVERSIONS = ("float", "int", "str")
_WITH_STRINGS = (*_CONVERSIONS, "exists", "isdir", "isfile", "open", "process_file")
"""Functions whose first argument is a string or a path."""


def unevaluated_in_call(call: ast.Call, reader: LaunchReader) -> Defects:
    """Yield the substitutions that a method or a function uses as a string, with the message."""
    function = name_of(call.func)
    if isinstance(call.func, ast.Attribute) and (kind := called(call.func.value, reader)) in SUBSTITUTIONS:
        if function in _OF_STRINGS:
            yield call.func, f"a `{kind}` has no method `{function}`; write `.perform(context)` before it"
        elif function == "perform" and not (call.args or call.keywords):
            yield call.func, "`perform` needs the launch context; write `perform(context)`"
    owner = call.func.value if isinstance(call.func, ast.Attribute) else None
    is_join = function == "join" and (owner is None or name_of(owner) == "path")
    for each in call.args if is_join else call.args[:1] if function in _WITH_STRINGS else ():
        if (kind := called(each, reader)) in SUBSTITUTIONS:
            right = "join the parts with `PathJoinSubstitution`" if is_join else "write `.perform(context)` after it"
            what = "has no access to the value of" if function in _CONVERSIONS else "needs a string, not"
            yield each, f"`{function}` {what} a `{kind}`; {right}"
    mappings = next((each.value for each in call.keywords if each.arg == "mappings"), None)
    for each in _values(mappings, reader) if mappings is not None and function in _OF_XACRO else ():
        yield from _mapping(each, reader)


def mappings_of_xacro(tree: ast.Module) -> set[str]:
    """Return the names of the variables that a launch file passes to xacro as mappings."""
    calls = (each for each in ast.walk(tree) if isinstance(each, ast.Call) and name_of(each.func) in _OF_XACRO)
    words = (word.value for each in calls for word in each.keywords if word.arg == "mappings")
    return {word.id for word in words if isinstance(word, ast.Name)}


def unevaluated_in_assignment(node: ast.Assign, mappings: set[str], reader: LaunchReader) -> Defects:
    """Yield the value that is assigned to an item of the mappings of xacro, if xacro cannot use it."""
    target = node.targets[0]
    if isinstance(target, ast.Subscript) and isinstance(target.value, ast.Name) and target.value.id in mappings:
        yield from _mapping(node.value, reader)


def _values(mappings: ast.expr, reader: LaunchReader) -> list[ast.expr]:
    value = value_of(mappings, reader)
    if isinstance(value, ast.Call) and name_of(value.func) == "dict":
        return [word.value for word in value.keywords if word.arg is not None]
    return value.values if isinstance(value, ast.Dict) else []


def _mapping(value: ast.expr, reader: LaunchReader) -> Defects:
    if (kind := called(value, reader)) in SUBSTITUTIONS:
        yield value, f"xacro needs a string, not a `{kind}`; write `.perform(context)` after it"
    elif isinstance(value, ast.Constant) and isinstance(value.value, (bool, int, float)):
        yield value, f"xacro needs a string, not `{value.value}`; write it in quotes"


def unevaluated_in_text(node: ast.BinOp | ast.JoinedStr, reader: LaunchReader) -> Defects:
    """Yield the substitutions that are added to a text or inserted into one, which has not got their value yet."""
    if isinstance(node, ast.JoinedStr):
        for part in (each.value for each in node.values if isinstance(each, ast.FormattedValue)):
            if (kind := called(part, reader)) in SUBSTITUTIONS:
                yield part, f"an f-string has no access to the value of a `{kind}`; write the parts in a list"
    elif isinstance(node.op, ast.Add):
        for text, part in ((node.left, node.right), (node.right, node.left)):
            is_text = isinstance(text, (ast.Constant, ast.JoinedStr)) and (_is_text(text) or not _is_text(part))
            if is_text and (kind := called(part, reader)) in SUBSTITUTIONS:
                yield part, f"a string and a `{kind}` cannot be added; write both in a list"


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)
