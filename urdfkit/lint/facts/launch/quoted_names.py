"""Names in quotes: texts in launch files that equal a variable or launch argument, which nothing else uses."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.launch.python_constants import assignments, name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.launch.actions import actions_of, is_used
from urdfkit.lint.model.tags import Attribute, Document

_VALUES = ("LaunchConfiguration", "PathJoinSubstitution", "join", "get_package_share_directory", "FindPackageShare")
_LISTS = ("arguments", "cmd", "parameters")
_NAMES_OF_OTHERS = re.compile(r"frame|link|topic")
"""Parts of the names of parameters whose values can equal the name of a launch argument by chance."""


def quoted_names(source: Source) -> Iterator[tuple[ast.expr, str]]:
    """Yield the place and message of each text in a Python launch file that is the name of an unused variable.

    Such a text is a value in a dictionary, or an item of a list in it or of arguments. Variables are parameters of
    functions and names of launch arguments and paths; launch arguments that no code uses count too. The name of a
    parameter of a function is expected in lists, and in dictionaries as the value of the key with the same name.
    """
    tree = _parsed(source.text)
    nodes = list(ast.walk(tree)) if tree is not None else []
    assigned = {name for node in nodes for name in _bound(node)}
    names = assigned - _loaded(nodes)
    actions = actions_of(source)
    texts = list(_texts(nodes))
    unused = {*actions.declared} - {name.name for name, _ in actions.used} - _names_in_code(nodes, texts)
    if actions.includes or any(map(_reads_computed_name, nodes)):
        unused.clear()
    found = [
        text
        for text, key in texts
        if text.value in names or (text.value == key and key in assigned) or (key and text.value in unused)
    ]
    for function in (node for node in nodes if isinstance(node, ast.FunctionDef)):
        inner = list(ast.walk(function))
        parameters = {each.arg for each in (*function.args.args, *function.args.kwonlyargs)} - _loaded(inner)
        inner_texts = _texts(inner) if parameters else ()
        found += [text for text, key in inner_texts if text.value in parameters and key in ("", text.value)]
    variables = assigned | {node.arg for node in nodes if isinstance(node, ast.arg)}
    for text in found:
        name = str(text.value)
        if name in variables:
            yield text, f"`{name}` in quotes is a string, not the variable `{name}`; write it without quotes"
        else:
            right = f'write `LaunchConfiguration("{name}")`'
            yield text, f"`{name}` in quotes is a string, not the value of the launch argument `{name}`; {right}"


def _loaded(nodes: list[ast.AST]) -> set[str]:
    return {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}


def _names_in_code(nodes: list[ast.AST], texts: list[tuple[ast.Constant, str]]) -> set[object]:
    """Return the texts in a file that can name a launch argument that code reads, such as indices and items."""
    other = [text for text, _ in texts]
    for node in nodes:
        if isinstance(node, ast.Dict):
            other += [key for key in node.keys if isinstance(key, ast.Constant)]
        elif isinstance(node, ast.Call) and name_of(node.func) == "DeclareLaunchArgument":
            first = node.args[:1] + [word.value for word in node.keywords if word.arg == "name"]
            other += [each for each in first if isinstance(each, ast.Constant)]
    places = {id(each) for each in other}
    return {node.value for node in nodes if isinstance(node, ast.Constant) and id(node) not in places}


def _reads_computed_name(node: ast.AST) -> bool:
    """Return whether code reads a launch argument whose name is not written there."""
    if not isinstance(node, ast.Call) or name_of(node.func) != "LaunchConfiguration":
        return False
    return any(not isinstance(each, ast.Constant) for each in node.args[:1])


@lru_cache(maxsize=100)
def _parsed(text: str) -> ast.Module | None:
    """Return the syntax tree of a file, in which calls of its functions are not written out."""
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _bound(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.Assign) and len(node.targets) == 1:
        for name, value in assignments(node.targets[0], node.value):
            if isinstance(value, ast.Call) and name_of(value.func) in _VALUES:
                yield name.id


def _texts(nodes: list[ast.AST]) -> Iterator[tuple[ast.Constant, str]]:
    """Yield the texts that are values, each with the key of the dictionary that it is in."""
    for node in nodes:
        values: list[tuple[ast.expr, str]] = []
        lists: list[ast.expr] = []
        if isinstance(node, ast.Dict):
            keys = [each.value if isinstance(each, ast.Constant) else "" for each in node.keys]
            values = [(value, str(key)) for key, value in zip(keys, node.values, strict=True)]
            values = [(value, key) for value, key in values if not _NAMES_OF_OTHERS.search(key)]
            lists = [value for value, _ in values]
        elif isinstance(node, ast.keyword) and node.arg in _LISTS:
            lists = [node.value.left, node.value.right] if isinstance(node.value, ast.BinOp) else [node.value]
        for items in (each.elts for each in lists if isinstance(each, ast.List)):
            options = ["", *(str(each.value) if isinstance(each, ast.Constant) else "" for each in items)]
            pairs = zip(items, options, strict=False)
            values += [(item, "") for item, option in pairs if not _NAMES_OF_OTHERS.search(option)]
        for value, key in values:
            if isinstance(value, ast.Constant) and isinstance(value.value, str):
                yield value, key


def quoted_arguments(source: Source) -> Iterator[tuple[Attribute, str]]:
    """Yield the values in an XML launch file that equal the name of a launch argument, which the file does not use."""
    actions = actions_of(source)
    unused = {name for name, each in actions.declared.items() if not (each.is_fixed or is_used(name, actions))}
    spaces = {"ns", "namespace"} & {*actions.declared}
    if actions.includes:
        unused.clear()
    word = "arg" if actions.is_ros1 else "var"
    for root in Document(source).roots:
        for tag in root.walk():
            for name in ("value", "args", "ns", "namespace", "if", "unless") if tag.name != "arg" else ():
                attribute = tag.attributes.get(name)
                if attribute is not None and re.fullmatch(r"[A-Za-z]\w+", attribute.value.strip()):
                    text = attribute.value.strip()
                    own = tag.attributes.get("name") if name == "value" else None
                    is_of_other = own is not None and _NAMES_OF_OTHERS.search(own.value) is not None
                    if text in (spaces if name in ("ns", "namespace") else ()) or (text in unused and not is_of_other):
                        hint = f"write `$({word} {text})`"
                        yield attribute, f"`{text}` is a string here, not the value of the launch argument; {hint}"
