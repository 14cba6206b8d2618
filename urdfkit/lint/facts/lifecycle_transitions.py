"""Transitions and states of lifecycle nodes in Python launch files.

Sources: rcl_lifecycle (src/default_state_machine.c), lifecycle_msgs (msg/Transition.msg), ros2/launch_ros
(event_handlers/on_state_transition.py), Humble to Rolling.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import LaunchReader, name_of
from urdfkit.errors import did_you_mean

Defects = Iterator[tuple[ast.expr, str]]

_CALLBACKS = (
    *("CONFIGURE", "CLEANUP", "ACTIVATE", "DEACTIVATE"),
    *("UNCONFIGURED_SHUTDOWN", "INACTIVE_SHUTDOWN", "ACTIVE_SHUTDOWN"),
)
_OTHER_CONSTANTS = r"TRANSITION_(?:CREATE|DESTROY|(?:ON_\w+|CALLBACK)_(?:SUCCESS|FAILURE|ERROR))"


def unknown_constant(node: ast.Attribute) -> Defects:
    """Yield a constant of lifecycle_msgs/msg/Transition that does not exist."""
    names = [f"TRANSITION_{each}" for each in _CALLBACKS]
    is_constant = node.attr.startswith("TRANSITION_") and name_of(node.value) == "Transition"
    if is_constant and node.attr not in names and not re.fullmatch(_OTHER_CONSTANTS, node.attr):
        yield node, f"`Transition` has no `{node.attr}`" + did_you_mean(node.attr, names)


_TRANSITIONS = {
    **{"unconfigured": "configuring shuttingdown", "configuring": "inactive unconfigured errorprocessing"},
    **{"inactive": "activating cleaningup shuttingdown", "cleaningup": "unconfigured inactive errorprocessing"},
    **{"activating": "active inactive errorprocessing", "active": "deactivating shuttingdown errorprocessing"},
    **{"deactivating": "inactive active errorprocessing", "shuttingdown": "finalized errorprocessing"},
    **{"errorprocessing": "unconfigured finalized", "finalized": ""},
}
"""State of a lifecycle node → the states that follow (rcl_lifecycle/src/default_state_machine.c)."""


def wrong_transition(words: dict[str, ast.expr], reader: LaunchReader) -> Defects:
    """Yield the states of an event handler that do not exist, or that do not follow each other."""
    texts = {key: reader.text(words[key]) for key in ("start_state", "goal_state") if key in words}
    for key, text in texts.items():
        if text is not None and text not in _TRANSITIONS:
            yield words[key], f"unknown state `{text}` of a lifecycle node" + did_you_mean(text, _TRANSITIONS)
            return
    target = words.get("target_lifecycle_node")
    node = reader.assigned.get(target.id) if isinstance(target, ast.Name) else target
    if target is not None and isinstance(node, ast.Call) and name_of(node.func) == "Node":
        others = [each for each in reader.assigned.values() if isinstance(each, ast.Call)]
        has_other = any(name_of(each.func) == "LifecycleNode" for each in others)
        message = "the target of an `OnStateTransition` is a `Node`; write "
        right = "the variable of a `LifecycleNode`" if has_other else "`LifecycleNode`"
        yield target if has_other else node, f"{message}{right}"
    yield from _next_transition(texts.get("goal_state") or "", words, reader)
    start, goal = texts.get("start_state"), texts.get("goal_state")
    if start and goal and goal not in _TRANSITIONS[start].split():
        following = " or ".join(f"`{each}`" for each in _TRANSITIONS[start].split()[:2]) or "no state"
        yield words["goal_state"], f"`{goal}` never follows the state `{start}`; {following} follows it"


_TRANSITIONS_FROM = {
    "unconfigured": "CONFIGURE UNCONFIGURED_SHUTDOWN",
    "inactive": "ACTIVATE CLEANUP INACTIVE_SHUTDOWN",
    "active": "DEACTIVATE ACTIVE_SHUTDOWN",
}
"""State of a lifecycle node → the transitions that it accepts there."""


def _next_transition(state: str, words: dict[str, ast.expr], reader: LaunchReader) -> Defects:
    """Yield the transition of a node that a handler requests although the state just reached does not accept it."""
    accepted, target = _TRANSITIONS_FROM.get(state, "").split(), words.get("target_lifecycle_node")
    items = [_value(item, reader) for item in reader.items(words.get("entities"))]
    emitted = [_of_event(item) for item in items if isinstance(item, ast.Call) and name_of(item.func) == "EmitEvent"]
    calls = [_value(event, reader) for event in emitted if event is not None]
    if len(calls) != 1:
        return  # a second event reaches the node in another state
    for call in (each for each in calls if isinstance(each, ast.Call) and name_of(each.func) == "ChangeState"):
        parts = {word.arg: word.value for word in call.keywords}
        chosen, matched = parts.get("transition_id"), parts.get("lifecycle_node_matcher")
        name = name_of(chosen).removeprefix("TRANSITION_") if chosen is not None else ""
        nodes = [each.id for each in ast.walk(matched) if isinstance(each, ast.Name)] if matched is not None else []
        is_same = isinstance(target, ast.Name) and target.id in nodes
        if chosen is not None and accepted and is_same and name in _CALLBACKS and name not in accepted:
            yield chosen, f"a node in the state `{state}` does not accept `{name}`; write `TRANSITION_{accepted[0]}`"


def _value(node: ast.expr, reader: LaunchReader) -> ast.expr:
    return (reader.assigned.get(node.id) or node) if isinstance(node, ast.Name) else node


def _of_event(call: ast.Call) -> ast.expr | None:
    """Return the event of an EmitEvent; None without one, for example after ``**``."""
    return next((word.value for word in call.keywords if word.arg == "event"), None)
