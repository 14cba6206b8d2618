"""Types of the parameters that the nodes of a workspace declare in Python or C++, compared with YAML files.

Sources: rclpy (node.py, declare_parameter) and rclcpp (node_parameters.cpp): a value of another type than the default
raises an exception, unless the descriptor allows ``dynamic_typing``; integers are not converted.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.launch.python_constants import name_of
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, yamls
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.parameters.node_parameters import kind_of, parameters
from urdfkit.lint.facts.parameters.schemas import schemas
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts, python_tree

OPEN = r"dynamic_typing|allow_undeclared_parameters|automatically_declare_parameters_from_overrides"
"""Matches code that accepts parameters of other types."""

_NAMED = r"(?:__init__|create_node|Node|make_shared<[^<>]{1,80}>)\s*\(\s*[\"']([\w.-]+)[\"']"
_IN_CPP = r"declare_parameter\s*(?:<\s*([\w:<>\s]{1,60}?)\s*>)?\s*\(\s*\"([\w./-]+)\"\s*(?:,\s*([^,()]{1,60}?)\s*[,)])?"
_CPP_TYPES = (
    (r"double|float|[-+]?\d*\.\d*f?", "double"),
    (r"(?:u?int(?:\d+_t)?|long|unsigned|[-+]?\d+)", "int"),
    (r"bool|true|false", "bool"),
    (r"std::string|\".*\"", "text"),
)
_PYTHON_TYPES = {bool: "bool", int: "int", float: "double", str: "text"}
SHOWN = {
    **{"bool": "true or false", "int": "an integer", "double": "a number with a decimal point", "text": "a string"},
    **{"list of bool": "a list of Boolean values", "list of int": "a list of integers"},
    **{"list of double": "a list of numbers with decimal points", "list of text": "a list of strings"},
}


def wrong_types_of_own_nodes(model: Model) -> Iterator[tuple[Source, Node, str, Span | None]]:
    """Yield the parameters of another type than a node of the workspace declares.

    Yields:
        File, value and message; the declaration in C++ if the variable that keeps the value has the type of the value.
    """
    found = [
        (source, key.text.strip("/").rpartition("/")[2], group)
        for source in yamls(model)
        if PARAMETERS in source.text
        for key, group in sections(source)
        if kind_of(key, group) not in schemas() and "*" not in key.text
    ]
    declared = _declared(model, {name for _, name, _ in found}) if found else {}
    for source, name, group in found:
        types = declared.get(name, {})
        for parameter, _, value in parameters(group) if types else ():
            expected, written = types.get(parameter, ""), _type_of(value)
            if expected and written and expected != written:
                right = f"; write {value.text}.0" if (expected, written) == ("double", "int") else ""
                shown = f"`{value.text}`" if value.text else SHOWN[written]
                message = f"`{parameter}` is {shown}, but node `{name}` declares {SHOWN[expected]}"
                place = _contradicted(parameter, written, model)
                yield source, value, message + (right if place is None else ""), place


def _contradicted(parameter: str, type: str, model: Model) -> Span | None:
    """Return the declaration in C++ of a parameter that is kept in a variable of a type; None without one."""
    for folder in neighbours(model.package).values() if model.package is not None else ():
        for path, text in node_texts(folder):
            pattern = rf"\b(\w+)\s*=\s*(?:this->)?(declare_parameter\s*(?:<[^<>]*>)?\s*\(\s*\"{re.escape(parameter)}\")"
            for at in re.finditer(pattern, text) if parameter in text else ():
                kept = re.search(rf"\b([\w:]+)\s+{at[1]}\s*[;={{]", text)
                if kept is not None and any(re.fullmatch(each, kept[1]) and kind == type for each, kind in _CPP_TYPES):
                    return Source(shown_path(path), text).span(*at.span(2))
    return None


def _declared(model: Model, names: set[str]) -> dict[str, dict[str, str]]:
    """Return name of a node → the types of the parameters that it declares; without those of several types."""
    if model.package is None:
        return {}
    started: dict[tuple[str, str], set[str]] = {}
    for node in launched_nodes(model):
        if node.name is not None and node.name.name in names:
            program = node.program.removesuffix(".py")
            started.setdefault((node.package, program), set()).add(node.name.name)
    found: dict[str, dict[str, str]] = {}
    for package, folder in neighbours(model.package).items():
        model.expanded.packages.watch(folder)
        for path, text in node_texts(folder):
            if "declare_parameter" not in text or re.search(OPEN, text):
                continue
            own = {name for name in re.findall(_NAMED, text) if name in names}
            for name in own | started.get((package, path.stem), set()):
                types = found.setdefault(name, {})
                for parameter, kind in declared_in(path, text):
                    types[parameter] = kind if types.get(parameter, kind) == kind else ""
    return found


def declared_in(path: Path, text: str) -> Iterator[tuple[str, str]]:
    """Yield name and type, empty if it is unknown, of each parameter that a file in Python or C++ declares."""
    yield from _in_python(text) if path.suffix == ".py" else _in_cpp(text)


def _in_python(text: str) -> Iterator[tuple[str, str]]:
    tree = python_tree(text)
    if tree is None:
        return
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        pairs: list[list[ast.expr]] = []
        if name_of(call.func) == "declare_parameter":
            pairs.append(call.args)
        elif name_of(call.func) == "declare_parameters":
            values = (*call.args, *(word.value for word in call.keywords))
            items = [item for each in values if isinstance(each, ast.List) for item in each.elts]
            pairs += [item.elts for item in items if isinstance(item, ast.Tuple)]
        for pair in pairs:
            if len(pair) >= 2 and isinstance(pair[0], ast.Constant) and isinstance(pair[0].value, str):
                yield pair[0].value, type_of_python(pair[1])


def type_of_python(node: ast.expr) -> str:
    """Return the type of a constant; empty for other expressions."""
    try:
        value = ast.literal_eval(node)
        if isinstance(value, (list, tuple)):
            return _of_list({_PYTHON_TYPES.get(type(each), "") for each in value})
        return _PYTHON_TYPES.get(type(value), "")
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return ""


def _of_list(types: set[str]) -> str:
    """Return the type of a list with elements of these types; empty if it is unknown."""
    return f"list of {types.pop()}" if len(types) == 1 and "" not in types else ""


def _in_cpp(text: str) -> Iterator[tuple[str, str]]:
    for at in re.finditer(_IN_CPP, text):
        written = (at[1] or at[3] or "").strip()
        yield at[2], next((kind for pattern, kind in _CPP_TYPES if re.fullmatch(pattern, written)), "")


def _type_of(value: Node) -> str:
    """Return the type that rcl gives a value; empty if it is unknown."""
    if value.kind == "list":
        return _of_list({_type_of(item) if item.kind == "text" else "" for item in value.items})
    if value.kind != "text" or not value.text:
        return ""
    return type_of_text(value.text) if value.is_plain or "$" in value.text else "text"


def type_of_text(text: str) -> str:
    """Return the type that YAML gives a text without quotes; empty if it is unknown."""
    if "$" in text:
        return ""
    if re.fullmatch(r"[-+]?\d+", text):
        return "int"
    if re.fullmatch(r"[-+]?(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][-+]?\d+)?", text):
        return "double"
    if re.fullmatch(r"(?i:true|false|yes|no|on|off|y|n)", text):
        return "bool"
    return "" if re.fullmatch(r"(?i)[-+]?\.(?:inf|nan)|null|~|0x[\da-f]+", text) else "text"
