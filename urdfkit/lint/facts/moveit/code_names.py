"""Names of the robot's MoveIt configuration in the code of the packages: groups, states, joints and end effectors.

Sources: moveit_commander (move_group.py), moveit_py (planning_component) and move_group_interface.h, Noetic to Rolling.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.launch.python_constants import LaunchReader, name_of
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.description.xml.source import Source
from urdfkit.errors import ResourceError
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.moveit.srdf import groups, semantics_of, virtual_joints
from urdfkit.lint.fix_builders import meant
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts, python_tree

_CODE = r"\bmoveit_commander\b|\bmoveit\.planning\b|MoveGroupCommander|MoveGroupInterface|\bmoveit_cpp\b"
_OTHER_ROBOTS = r"<\w*depend>\s*(\w+_moveit_config)\s*<"

_GROUP, _STATE, _JOINT, _LINK = "group", "state", "joint", "link"
_FIRST = {
    **dict.fromkeys(("MoveGroupCommander", "get_planning_component"), _GROUP),
    **dict.fromkeys(("set_named_target", "get_named_target_values"), _STATE),
    **dict.fromkeys(("set_end_effector_link",), _LINK),
}
"""Python function → kind of the name that is its first argument."""

_JOINTS = ("go", "set_joint_value_target", "plan")
"""Python functions that accept a dictionary with names of joints; the second one also the name of a joint."""

_WORDS = {"configuration_name": _STATE, "group_name": _GROUP}
_REMEMBERED = r"remember_?[jJ]oint_?[vV]alues\s*\(\s*[\"']([^\"'\n]+)[\"']"
_NOT_IN_CODE = r"(?s)\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'|(//[^\n]*|/\*.*?(?:\*/|\Z))"
"""Matches a string, a character or, as its group, a comment of C++."""

_IN_CPP = {
    r"\bMoveGroupInterface(?:::Options)?\s*>?\s*\w*\s*[({]\s*\"([^\"]+)\"\s*[,)}]": _GROUP,
    r"\bMoveGroupInterface\s*>?\s*\w*\s*[({][^,;\"(){}]+(?:\(\s*\))?\s*,\s*\"([^\"]+)\"\s*[,)}]": _GROUP,
    r"\bgetJointModelGroup\s*\(\s*\"([^\"]+)\"\s*\)": _GROUP,
    r"\b(?:setNamedTarget|getNamedTargetValues)\s*\(\s*\"([^\"]+)\"\s*\)": _STATE,
    r"\bsetEndEffectorLink\s*\(\s*\"([^\"]+)\"\s*\)": _LINK,
    r"\bsetJointValueTarget\s*\(\s*\"([^\"]+)\"\s*,": _JOINT,
}
"""Pattern of a call in C++ → kind of the name in it.

A group is the first argument, or the second after the node.
"""


def undefined_in_code(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the file, the name and the message of each name in code that the SRDF or the robot does not have.

    A workspace with several SRDFs, or with the configuration of a robot elsewhere, has code for other robots.
    """
    roots = list(semantics_of(model))
    packages = neighbours(model.package) if model.package is not None and roots else {}
    if len(roots) != 1 or len(model.semantic_roots) != 1 or not packages or model.is_incomplete:
        return
    manifests = [source.text for file, source in model.related_files.items() if file.endswith("package.xml")]
    if any(set(re.findall(_OTHER_ROBOTS, text)) - {*packages} for text in manifests):
        return
    for folder in packages.values():
        model.expanded.packages.watch(folder)
        for path, text in node_texts(folder):
            source = _source(path, model) if re.search(_CODE, text) else None
            if source is not None:
                names = _in_python(source) if path.suffix == ".py" else _in_cpp(source)
                yield from ((source, *each) for each in _undefined(names, source, roots[0], model))


def _source(path: Path, model: Model) -> Source | None:
    try:
        return read_source(path, shown_as=shown_path(path), texts=model.texts)
    except ResourceError:
        return None


def _undefined(
    names: Iterator[tuple[str, Named]], source: Source, root: Element, model: Model
) -> Iterator[tuple[Named, str]]:
    states = {each.get("name") or "" for each in root.find_all("group_state")}
    defined = {
        _GROUP: {*groups(root)},
        _STATE: {*states, *re.findall(_REMEMBERED, source.text), "random", "random valid", "current"},
        _JOINT: {*model.robot.joint_by_name, *virtual_joints(root)},
        _LINK: {*model.robot.link_by_name},
    }
    for kind, name in names:
        if name.name in defined[kind] or not name.name or model.neighbouring_descriptions.define(kind, name.name):
            continue
        what = "state of a group" if kind == _STATE else kind
        where = "the SRDF" if kind in (_GROUP, _STATE) else f"robot `{model.robot.name}`"
        existing = states if kind == _STATE else defined[kind]
        hint = meant(name.name, existing)[1] or (f"; it has {_listed(existing)}" if 0 < len(existing) < 6 else "")
        yield name, f"{what} `{name.name}` does not exist in {where}" + hint


def _listed(names: set[str]) -> str:
    return ", ".join(f"`{name}`" for name in sorted(names))


def _in_python(source: Source) -> Iterator[tuple[str, Named]]:
    """Yield kind and name of the constants that a module passes to MoveIt."""
    tree = python_tree(source.text)
    reader = LaunchReader(tree) if tree is not None else None
    for call in ast.walk(tree) if tree is not None else ():
        if not isinstance(call, ast.Call) or reader is None:
            continue
        function, first = name_of(call.func), call.args[0] if call.args else None
        found = [(_WORDS[word.arg], word.value) for word in call.keywords if word.arg in _WORDS]
        if function in _FIRST:
            found += [(_FIRST[function], first)] if first is not None else []
        elif function in _JOINTS and isinstance(call.func, ast.Attribute) and first is not None:
            value = reader.assigned.get(first.id) if isinstance(first, ast.Name) else first
            if isinstance(value, ast.Dict):
                found += [(_JOINT, key) for key in value.keys if key is not None]
            elif isinstance(value, ast.Constant) and len(call.args) > 1 and function == "set_joint_value_target":
                found.append((_JOINT, value))
        for kind, node in found:
            value = (reader.assigned.get(node.id) or node) if isinstance(node, ast.Name) else node
            if isinstance(value, ast.Constant) and isinstance(value.value, str):
                yield kind, Named(value.value, place(source, value)[0] + 1)


def _in_cpp(source: Source) -> Iterator[tuple[str, Named]]:
    text = re.sub(_NOT_IN_CODE, lambda at: " " * len(at[0]) if at[1] else at[0], source.text)
    for pattern, kind in _IN_CPP.items():
        for at in re.finditer(pattern, text):
            yield kind, Named(at[1], at.start(1))
