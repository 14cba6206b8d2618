"""Mistakes that only launch files in Python have."""

from __future__ import annotations

import ast
import random
import re
from collections.abc import Iterator

from tests.bench.package_mutants.launching import PYTHON, call_at, edited, python
from tests.bench.package_mutants.mutant import Mutant, Workspace, kind, match, typo

_LAUNCH = kind("launch")
Mutants = Iterator[Mutant]


@_LAUNCH
def import_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """Python stops: the module or the name does not exist."""
    for file, found in python(ws, r"(?m)^from (launch[\w.]*|ament[\w.]*|moveit\w*) import ([\w, ]+)$"):
        text = ws.files[file]
        module, first = found[1], lot.choice(found[2].split(", "))
        wrong = [
            module.replace("actions", "action"),
            module.replace("launch_ros", "launch"),
            typo(module, lot).replace("-", ""),
        ]
        wrong = [each for each in wrong if each != module]
        new = lot.choice(wrong)
        yield match(file, found, new, 1, names=(new, new.split(".")[-1]))
        at = text.index(first, found.start(2))
        misspelt = typo(first, lot).replace("-", "")
        yield Mutant(
            file, at, at + len(first), misspelt, None, (found.start(), found.end()), (misspelt, first), uses=True
        )


@_LAUNCH
def import_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """Python stops: the name is not defined."""
    for file, found in python(ws, r"(?m)^from [\w.]+ import (\w+)\n"):
        yield match(file, found, "", names=(found[1],), uses=True)


@_LAUNCH
def name_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """Python stops: the name is not defined."""
    for file, text in ws.of(PYTHON):
        tree = ast.parse(text)
        assigned = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
        for found in re.finditer(r"\b\w{4,}\b", text):
            if found[0] in assigned and text[found.end() : found.end() + 3] != " = ":
                wrong = typo(found[0], lot, assigned).replace("-", "")
                if wrong not in assigned and '"' not in (text[found.start() - 1], text[found.end() : found.end() + 1]):
                    yield edited(ws, file, found, wrong, names=(wrong,))


@_LAUNCH
def keyword_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """Python stops: the argument of the call is unknown."""
    words = (
        "package|executable|arguments|parameters|remappings|condition|launch_arguments|default_value|output|target_action|"
        "on_exit"
    )
    for file, found in python(ws, rf"\b({words})="):
        wrong = {"package": "pkg", "executable": "exec", "arguments": "args", "remappings": "remapping"}.get(
            found[1], ""
        )
        wrong = lot.choice([each for each in (wrong, typo(found[1], lot).replace("-", "")) if each])
        yield edited(ws, file, found, wrong, 1, names=(wrong,))


@_LAUNCH
def python_syntax(ws: Workspace, lot: random.Random) -> Mutants:
    """Python stops: a comma, a bracket, a quote or a colon is missing."""
    for file, found in python(ws, r'(?m)(",|\),|\],)$'):
        text = ws.files[file]
        at = found.end() - 1
        around = (max(0, found.start() - 200), min(len(text), found.end() + 300))
        if found[1] != '",' or text[found.end() :].lstrip().startswith(('"', "[")) is False:
            yield Mutant(file, at, at + 1, "", (at, found.end() + 1), around)
            if found[1] != '",':
                yield Mutant(file, at - 1, at, "", (at, at + 1), around)
    for file, found in python(ws, r"generate_launch_description\(\)(:)"):
        text = ws.files[file]
        yield match(file, found, "", 1, around=(found.start(), len(text)))


@_LAUNCH
def comma_missing_in_arguments(ws: Workspace, lot: random.Random) -> Mutants:
    """Two arguments become one word."""
    for file, found in python(ws, r'arguments=\[[^\]]*?"(,)\s*"'):
        yield edited(ws, file, found, "", 1)


@_LAUNCH
def no_list(ws: Workspace, lot: random.Random) -> Mutants:
    """launch stops: arguments and parameters are lists."""
    for file, found in python(ws, r"(?:parameters|arguments)=(\[[^\[\]\n]*\])"):
        yield edited(ws, file, found, found[1][1:-1], 1)


@_LAUNCH
def not_started(ws: Workspace, lot: random.Random) -> Mutants:
    """The node or the argument is made and not returned, so it is not started."""
    for file, found in python(ws, r"(?m)^ {8}(?:    )?(\w+_node|\w+_spawner|delayed_\w+|\w+_launch),\n"):
        yield edited(ws, file, found, "", names=(found[1],), uses=True)
    for file, found in python(ws, r"LaunchDescription\(\[(gui_arg|.*?), (rviz|state_publisher|joint_sliders)[,\]]"):
        last = found[2]
        at = ws.files[file].rfind(last, found.start(), found.end())
        yield Mutant(file, at - 2, at + len(last), "", None, call_at(ws.files[file], at), (last,), uses=True)


@_LAUNCH
def no_description_returned(ws: Workspace, lot: random.Random) -> Mutants:
    """launch stops: the function does not return a description, or has another name."""
    for file, found in python(ws, r"(?m)^    return (?=LaunchDescription)"):
        text = ws.files[file]
        first = text.index("def generate")
        yield match(file, found, "    ", also=(first, first + 10), around=(first, len(text)))
    for file, found in python(ws, r"def (generate_launch_description)\("):
        wrong = typo(found[1], lot).replace("-", "")
        yield match(file, found, wrong, 1, names=(wrong, found[1]), anywhere=True)


@_LAUNCH
def space_missing_in_command(ws: Workspace, lot: random.Random) -> Mutants:
    """The command and its file become one word."""
    for file, found in python(ws, r'"xacro( )"|" (\w+:=)"|" "()'):
        if found[1]:
            yield edited(ws, file, found, "", 1)
        elif found[2]:
            yield edited(ws, file, found, f'"{found[2]}"')
        else:
            yield edited(ws, file, found, '""')
