"""Lists of the wrong depth in Python launch files: lists of actions, of parameters and of arguments.

Sources: ros2/launch (launch_description.py, launch_service.py, event_handlers/on_action_event_base.py), ros2/launch_ros
(actions/node.py, utilities/normalize_parameters.py), Humble to Rolling.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from urdfkit.description.launch.python_constants import LaunchReader, name_of
from urdfkit.lint.facts.launch.python.names import called, value_of

ACTIONS = (
    *("DeclareLaunchArgument", "ExecuteProcess", "GroupAction", "IncludeLaunchDescription", "LifecycleNode", "Node"),
    *("RegisterEventHandler", "SetEnvironmentVariable", "SetParameter", "TimerAction", "ComposableNodeContainer"),
)
"""Common actions."""

_OF_ACTIONS = {
    "GroupAction": "actions",
    "LaunchDescription": "initial_entities",
    "OnExecutionComplete": "on_completion",
    "OnProcessExit": "on_exit",
    "OnProcessStart": "on_start",
    "TimerAction": "actions",
}
"""Class → its argument that is a list of actions."""


_LISTS = ("arguments", "parameters", "remappings")
"""Arguments of actions that are lists."""


def wrong_lists(
    call: ast.Call, kind: str, words: Mapping[str, ast.expr], reader: LaunchReader
) -> Iterator[tuple[ast.expr, str]]:
    """Yield the place and message of each list of a launch class that lacks its brackets, or has too many."""
    if (word := _OF_ACTIONS.get(kind)) is not None:
        is_first = kind in ("GroupAction", "LaunchDescription") and call.args
        listed = words.get(word) or (call.args[0] if is_first else None)
        if kind == "LaunchDescription" and len(call.args) > 1:
            yield call.args[1], "`LaunchDescription` accepts one list of actions; join the lists with `+`"
        elif listed is not None and word in ("actions", "initial_entities") and _is_action(listed, reader):
            what = "the argument of `LaunchDescription`" if kind == "LaunchDescription" else f"`{word}` of `{kind}`"
            yield listed, f"{what} is not a list; write it in brackets"
        items = reader.items(listed)
        inner = next((item for item in items if isinstance(value_of(item, reader), (ast.List, ast.ListComp))), None)
        if inner is not None:
            yield inner, "this list of actions is inside another list; write `*` before it"
    for item in reader.items(words.get("parameters")):
        value = value_of(item, reader)
        if isinstance(value, (ast.List, ast.BinOp)) and any(
            isinstance(value_of(each, reader), ast.Dict) for each in reader.items(value)
        ):
            yield item, "this list of parameters is inside another list; write `*` before it"
    for each in (node for word in _LISTS if word in words for node in ast.walk(words[word])):
        if isinstance(each, ast.Call) and name_of(each.func) in ("list", "tuple") and len(each.args) == 1:
            text = each.args[0]
            if isinstance(text, ast.Constant) and isinstance(text.value, str):
                yield text, "this creates a list of single letters; write the string in brackets"
    for item in reader.items(words.get("arguments")):
        items = item.elts if isinstance(item, ast.List) else []
        texts = [
            str(each.value) if isinstance(each, ast.Constant) and _is_written_in(item, each) else "" for each in items
        ]
        if len(texts) > 1 and all(text.strip(" /:=,") == text and text for text in texts):
            yield item, f"the strings of this inner list become one word, `{''.join(texts)}`; write `*` before it"


def _is_written_in(outer: ast.expr, node: ast.expr) -> bool:
    """Return whether an item is written in a list, and is not the value that a parameter of a function has there."""
    start, end = (outer.lineno, outer.col_offset), (outer.end_lineno or 0, outer.end_col_offset or 0)
    return start < (node.lineno, node.col_offset) < end


def _is_action(node: ast.expr, reader: LaunchReader) -> bool:
    return called(node, reader) in ACTIONS
