"""Actions and keys of YAML launch files, compared with those of launch_yaml (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import did_you_mean
from urdfkit.lint.facts.control.yaml_tree import Node, documents
from urdfkit.lint.facts.launch.python.api import first_slip
from urdfkit.lint.facts.launch.xml_elements import (
    ACTIONS,
    ANY,
    ELEMENTS,
    OTHER_ELEMENTS,
    OTHER_WORDS,
    OUTPUTS,
    is_output,
)

Defects = Iterator[tuple[Node, str]]

_OF_PYTHON = {
    "arguments": "args",
    "default_value": "default",
    "executable": "exec",
    "package": "pkg",
    "parameter": "param",
    "parameters": "param",
    "remappings": "remap",
}
"""Keyword of Python launch files → key in YAML."""

_ELEMENTS = ELEMENTS[2]


def yaml_launch_defects(source: Source) -> Defects:
    """Yield the unknown actions and keys in a YAML launch file, and the required keys that an action lacks."""
    for root in documents(source):
        launch = root.find("launch")
        for key, value in root.entries:
            near = first_slip(key.text, ("launch",)) if launch is None and value.kind == "list" else None
            if near is not None:
                yield key, f"unknown key `{key.text}`" + Suggestion(near, key.text)
        for item in launch.items if launch is not None else ():
            yield from _actions(item)


def _actions(item: Node) -> Defects:
    for key, value in item.entries:
        name = key.text.replace("-", "_") if key.text.replace("-", "_") in _ELEMENTS else key.text
        if name in ACTIONS[2]:
            yield from _action(key, name, value)
            continue
        near = first_slip(name, ACTIONS[2])
        other = OTHER_ELEMENTS[2].get(name)
        if near is not None:
            yield key, f"unknown action `{key.text}`" + Suggestion(near, key.text)
        elif other is not None:
            yield key, f"`{key.text}` is not an action in ROS 2" + (f"; use `{other}`" if other else "")


def _action(key: Node, name: str, value: Node) -> Defects:
    """Yield the defects of an action: a mapping of its attributes and children, or a list of actions."""
    element = _ELEMENTS[name]
    if value.kind == "list" and ANY in element.children:
        for item in value.items:
            yield from _actions(item)
    if value.kind != "group":
        return
    children = [each for each in element.children if each != ANY]
    valid = {*element.attributes, *children, "if", "unless"}
    written = {each.text for each, _ in value.entries}
    found = set(written)
    for each, inner in value.entries:
        if each.text in children:
            yield from _children(each, inner)
        elif each.text == "children" and ANY in element.children:
            for item in inner.items:
                yield from _actions(item)
        elif each.text not in valid and (ANY not in element.children or each.text not in ACTIONS[2]):
            near = _meant(each.text, valid - written)
            if near is not None:
                found.add(near)
                yield each, f"unknown key `{each.text}` of `{key.text}`" + Suggestion(near, each.text)
        elif name == "arg" and each.text == "value":
            right = None if "default" in written else "default"
            yield each, "`arg` has no key `value` in ROS 2" + Suggestion(right, each.text)
        elif each.text == "output" and inner.kind == "text" and not is_output(inner.text, 2):
            yield inner, f"unknown output `{inner.text}`" + did_you_mean(inner.text, OUTPUTS[2])
    for names in element.required:
        if found.isdisjoint(names.split("|")):
            required = " or ".join(f"`{each}`" for each in names.split("|"))
            yield key, f"`{key.text}` lacks the required key {required}"


def _children(key: Node, value: Node) -> Defects:
    """Yield the defects of the parameters, remappings, arguments and other parts of an action.

    Source: launch_yaml (entity.py), "expected to be a list of dictionaries".
    """
    if value.kind == "group" and value.entries:
        yield value.entries[0][0], f"`{key.text}` is not a list; write `- ` before `{value.entries[0][0].text}`"
    for item in value.items if value.kind == "list" else (value,):
        names = {each.text for each, _ in item.entries}
        if key.text == "param" and len(names) == 1 and names.isdisjoint({"name", "from"}):
            parameter = item.entries[0][0]
            if first_slip(parameter.text, ("from",)) is None:
                yield parameter, f"`param` lacks `name` and `value`; write `name: {parameter.text}` and `value: ...`"
                continue
        place = item.entries[0][0] if item.entries else key
        for at, message in _action(key, "let" if key.text == "arg" else key.text, item):
            yield (place if at is key else at), message


def _meant(name: str, valid: set[str]) -> str | None:
    """Return the key that an unknown one stands for; None if no key is similar."""
    other = OTHER_WORDS[2].get(name) or _OF_PYTHON.get(name)
    if other in valid:
        return other
    return first_slip(name.replace("_", "-"), valid) or first_slip(name, valid)
