"""Words of commands in Python launch files that lack a blank or a comma between them."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import pairwise

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place

_LISTS = frozenset(("arguments", "cmd", "ros_arguments"))
_COMMANDS = ("gz_args", "ign_args", "extra_gazebo_args")
"""Launch arguments that are words of a command."""

_OPTION = r"--?[A-Za-z][\w-]*"
_SEVERAL = r"^--?[A-Za-z][\w-]*\s+\S|\s--?[A-Za-z][\w-]*(?:\s|$)"
"""Matches an option and its value in one text."""

_LITERAL = r"[rRbBuU]?(\"[^\"\n]*\"|'[^'\n]*')"


def joined_words(source: Source, tree: ast.Module) -> Iterator[tuple[tuple[int, int], str]]:
    """Yield start and end offset and the message for each word that runs into the one before."""
    reader = launch_reader(tree)
    for node in ast.walk(tree):
        if isinstance(node, (ast.Dict, ast.Tuple)):
            yield from _in_arguments(source, node, reader)
        if not isinstance(node, ast.Call):
            continue
        if name_of(node.func) == "Command" and node.args and isinstance(node.args[0], (ast.List, ast.Tuple)):
            yield from _in_command(source, node.args[0].elts, reader)
        for word in node.keywords:
            is_node = name_of(node.func) in ("Node", "LifecycleNode") and word.arg == "arguments"
            for item in reader.items(word.value) if is_node else ():
                if isinstance(item, ast.Constant) and isinstance(item.value, str) and re.search(_SEVERAL, item.value):
                    yield place(source, item), f"`{item.value}` is one word; write each word as a separate string"
                elif isinstance(item, ast.Constant) and re.fullmatch(rf"{_OPTION}\s+", str(item.value)):
                    yield place(source, item), f"`{item.value!s}` ends with a blank, so it is an unknown option"
                elif isinstance(item, ast.BinOp) and isinstance(item.op, ast.Add) and _is_option(item.right):
                    yield (
                        place(source, item.right),
                        "no comma before this option: it becomes part of the word before it",
                    )
            if word.arg in _LISTS and isinstance(word.value, ast.List):
                yield from _in_list(source, word.value.elts)


def _is_option(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and re.fullmatch(r"--[A-Za-z][\w-]*", str(node.value)) is not None


def _in_arguments(
    source: Source, node: ast.Dict | ast.Tuple, reader: LaunchReader
) -> Iterator[tuple[tuple[int, int], str]]:
    """Yield the words that run into an option before them in a launch argument such as ``gz_args``."""
    keys, values = (node.keys, node.values) if isinstance(node, ast.Dict) else (node.elts[:1], node.elts[1:])
    for key, value in zip(keys, values, strict=False):
        if (
            not isinstance(key, ast.Constant)
            or key.value not in _COMMANDS
            or not isinstance(value, (ast.List, ast.BinOp))
        ):
            continue
        parts = value.elts if isinstance(value, ast.List) else [value.left, value.right]
        for before, after in pairwise(parts):
            first, second = reader.text(before), reader.text(after)
            word = first.rpartition(" ")[2] if first else ""
            if word and second is None and _is_word(after, reader) and re.fullmatch(rf"{_OPTION}|\d+", word):
                yield place(source, after), f"no space between `{word}` and the next part of `{key.value}`"


def _in_command(source: Source, parts: list[ast.expr], reader: LaunchReader) -> Iterator[tuple[tuple[int, int], str]]:
    parts = [part for part in parts if not (isinstance(part, ast.Constant) and part.value == "")]
    for before, after in pairwise(parts):
        texts = [reader.text(part) for part in (before, after)]
        if (texts[0] or "").endswith(tuple(" \t\n")) or (texts[1] or "").startswith(tuple(" \t\n")):
            continue
        if _is_xacro(before, texts[0]) and (texts[1] is not None or _is_word(after, reader)):
            yield place(source, after), "no space between `xacro` and its file: the command is not found"
            continue
        argument = re.match(r"[\w.-]+:=", texts[1] or "")
        if argument is not None and (texts[0] is not None or _is_word(before, reader)):
            yield place(source, after), f"no space before `{argument[0]}`: it becomes part of the word before it"


def _is_xacro(node: ast.expr, text: str | None) -> bool:
    """Return whether an expression is the xacro program, without a file or arguments."""
    if text is not None:
        return re.fullmatch(r"\s*(?:\S*/)?xacro(?:\.py)?", text) is not None
    calls = [inner for inner in ast.walk(node) if isinstance(inner, ast.Call)]
    return any(name_of(call.func) == "FindExecutable" and _names_xacro(call) for call in calls)


def _names_xacro(call: ast.Call) -> bool:
    words = [*call.args, *(word.value for word in call.keywords)]
    return any(getattr(word, "value", None) == "xacro" for word in words)


def _is_word(node: ast.expr, reader: LaunchReader) -> bool:
    """Return whether an expression is a path or a launch argument, so that it has no blanks at its ends."""
    for _ in range(4):
        if isinstance(node, ast.Name) and (value := reader.assigned.get(node.id)) is not None:
            node = value
    names = ("PathJoinSubstitution", "LaunchConfiguration", "join", "get_package_share_directory", "FindExecutable")
    return (isinstance(node, ast.Call) and name_of(node.func) in names) or reader.path(node) is not None


def _in_list(source: Source, words: list[ast.expr]) -> Iterator[tuple[tuple[int, int], str]]:
    for word in words:
        if not isinstance(word, ast.Constant) or not isinstance(word.value, str):
            continue
        start, end = place(source, word)
        pieces = [piece[1][1:-1] for piece in re.finditer(_LITERAL, source.text[start:end])]
        if len(pieces) < 2 or "".join(pieces) != word.value:
            continue
        for first, second in pairwise(pieces):
            # An option that ends a literal, or begins the next one, is a word.
            if re.fullmatch(_OPTION, first) or re.fullmatch(_OPTION, second):
                yield (start, end), f"no comma between `{first}` and `{second}`: they become one word"
                break
