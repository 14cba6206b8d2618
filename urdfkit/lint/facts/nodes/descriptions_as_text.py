"""Descriptions in xacro that Python launch files load as text."""

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.xml.source import Span
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.python.names import python_files
from urdfkit.lint.model.model import Model

_SUFFIX = ".xacro"


def descriptions_as_text(model: Model) -> Iterator[tuple[Span, str]]:
    """Yield the place and the file name of each xacro file that a launch file loads without expanding it."""
    for source, tree in python_files(model):
        if _SUFFIX not in source.text or re.search(r"\b(?:import xacro|from xacro)\b", source.text):
            continue
        reader = launch_reader(tree)
        for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
            path = _opened(call, reader)
            if path.endswith(_SUFFIX):
                yield source.span(*place(source, call)), path.rpartition("/")[2]


def _opened(call: ast.Call, reader: LaunchReader) -> str:
    """Return the path that a call opens, or prints with ``cat``; empty for other calls."""
    first = call.args[0] if call.args else None
    if name_of(call.func) == "open" and isinstance(call.func, ast.Name) and first is not None:
        modes = [part.value for part in call.args[1:] if isinstance(part, ast.Constant)]
        found = reader.path(first)
        return found[1] if found is not None and not any("w" in str(mode) for mode in modes) else ""
    if name_of(call.func) == "Command" and isinstance(first, (ast.List, ast.Tuple)) and len(first.elts) > 1:
        found = reader.path(first.elts[1])
        is_print = (reader.text(first.elts[0]) or "").strip() == "cat"
        return found[1] if found is not None and is_print else ""
    return ""
