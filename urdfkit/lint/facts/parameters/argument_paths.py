"""Paths in packages that contain launch arguments, with the values that defaults and including files give these."""

import ast
import re
from collections.abc import Iterator
from functools import partial

from urdfkit.description.launch.python_constants import LaunchReader, name_of, parsed
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import PackagePath, paths_in_python, place
from urdfkit.lint.facts.launch.actions import all_elements, launch_files
from urdfkit.lint.facts.launch.receivers import receiver
from urdfkit.lint.facts.launch.records import Call
from urdfkit.lint.facts.parameters.launch_arguments import ARGUMENT_USE, expected_values, passed_values
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_PATH = rf"\$\(find(?:-pkg-share)?\s+([\w-]+)\)/((?:[^\s\"'<>$(){{}}:;,|&*]|{ARGUMENT_USE})+)"
_EXISTENCE_TESTS = r"\b(?:exists|isfile|is_file|isdir|is_dir)\b"
_NO_FILE = ("", "none", "false", "true")
_MAX_DEPTH = 4

_WORLDS = {
    ("gazebo_ros", "gazebo.launch.py"): "world",
    ("gazebo_ros", "gzserver.launch.py"): "world",
    ("gazebo_ros", "empty_world.launch"): "world_name",
}
"""Launch file of Gazebo Classic → its argument for the path of the world."""

Value = tuple[str, Source, Named | None]
"""A value, the launch file with it, and its place if it is not a choice."""


@record(eq=False)
class ArgumentPath:
    """A path with a value for each of its launch arguments.

    Attributes:
        source: the launch file that contains the path.
        path: the path, with values for the arguments.
        value: launch file and place of the value; None if the default of the launch file or a choice gives it.
    """

    source: Source
    path: PackagePath
    value: tuple[Source, Named] | None


def argument_paths(model: Model) -> Iterator[list[ArgumentPath]]:
    """Yield for each path with launch arguments the paths that their values give."""
    arguments = _Arguments(model)
    for file in launch_files(model):
        for path in _with_arguments(file.source):
            names = list(dict.fromkeys(re.findall(ARGUMENT_USE, path.path)))
            values = [arguments.values(file.source, name) for name in names]
            if len(names) > 1:  # only the defaults, as values belong together
                values = [each[:1] for each in values]
            found = []
            for value in values[0] if all(values) else ():
                texts = [value[0], *(each[0][0] for each in values[1:])]
                if any(text.strip().lower() in _NO_FILE or text[0] in "/~." or "$" in text for text in texts):
                    continue
                replaced = dict(zip(names, texts, strict=True))
                full = re.sub(ARGUMENT_USE, partial(_value_of, replaced), path.path)
                is_own = value[1] is file.source or value[2] is None
                origin = None if is_own or value[2] is None else (value[1], value[2])
                one = PackagePath(path.package, full, path.start, path.end)
                found.append(ArgumentPath(file.source, one, origin))
            if found:
                yield found


def _value_of(values: dict[str, str], use: re.Match[str]) -> str:
    return values[use[1]]


def worlds_without_path(model: Model) -> Iterator[tuple[Source, int, int, str]]:
    """Yield launch file, place and value of each world that an include of Gazebo Classic gets as a bare name."""
    arguments = _Arguments(model)
    for file in launch_files(model):
        for call in file.includes:
            argument = _WORLDS.get((call.package, call.path.rpartition("/")[2]))
            if argument is None:
                continue
            for start, end, text in _values_of(file.source, call, argument):
                use = re.fullmatch(ARGUMENT_USE, text.strip())
                texts = [each[0] for each in arguments.values(file.source, use[1])[:1]] if use else [text]
                for name in texts:
                    if re.fullmatch(r"\w+", name):
                        yield file.source, start, end, name


def _values_of(source: Source, call: Call, argument: str) -> Iterator[tuple[int, int, str]]:
    """Yield place and text of the value of an argument that an include passes."""
    if not source.file.endswith(".py"):
        for name, value in passed_values(source, call, True):
            if name == argument:
                yield value.start, value.end, value.name
        return
    starts = {name.start for name in call.passed if name.name == argument}
    tree = parsed(source) if starts else None
    reader = ArgumentReader(tree) if tree is not None else None
    for node in ast.walk(tree) if tree is not None else ():
        for key, each in zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ():
            is_meant = isinstance(key, ast.Constant) and key.value == argument
            text = reader.text(each) if reader is not None and is_meant else None
            if key is not None and text is not None and place(source, key)[0] <= min(starts) <= place(source, key)[1]:
                yield *place(source, each), text


def _with_arguments(source: Source) -> Iterator[PackagePath]:
    """Yield the paths with launch arguments that a launch file uses without a condition."""
    if source.file.endswith(".py"):
        tree = parsed(source) if re.search(_EXISTENCE_TESTS, source.text) is None else None
        paths = paths_in_python(source, tree, ArgumentReader(tree)) if tree is not None else ()
        yield from (path for path in paths if re.search(ARGUMENT_USE, path.path))
        return
    conditional: set[int] = set()
    for element in all_elements(source):
        at = element.attributes
        if id(element) in conditional or "if" in at or "unless" in at:
            conditional.update(map(id, element.children))
            continue
        for one in at.values():
            match = re.fullmatch(_PATH, one.name.strip())
            if match is not None and match[3] is not None:
                yield PackagePath(match[1], match[2], one.start, one.end)


class _Arguments:
    """Values of the launch arguments of all launch files."""

    def __init__(self, model: Model) -> None:
        self._passed: dict[tuple[str, str], list[tuple[Source, Named]]] = {}
        for file in launch_files(model):
            for call in file.includes:
                path = receiver(call, model)
                for name, value in passed_values(file.source, call, True) if path is not None else ():
                    self._passed.setdefault((shown_path(path or ""), name), []).append((file.source, value))

    def values(
        self, source: Source, name: str, depth: int = 0, seen: set[tuple[str, str]] | None = None
    ) -> list[Value]:
        """Return the values of an argument of a launch file, its own default first."""
        seen = set() if seen is None else seen
        if (source.file, name) in seen:  # files that include each other would have values without end
            return []
        seen.add((source.file, name))
        own = expected_values(source)
        defaults = [value for each, value, is_default in own.values if is_default and each == name]
        found: list[Value] = [(value.name, source, value) for value in defaults]
        found += [(choice, source, None) for choice in own.choices.get(name, ())]
        for file, value in self._passed.get((source.file, name), ()):
            use = re.fullmatch(ARGUMENT_USE, value.name.strip())
            if use is None:
                found.append((value.name, file, value))
            elif depth < _MAX_DEPTH:
                found += self.values(file, use[1], depth + 1, seen)
        first: dict[str, Value] = {}
        for each in found:
            first.setdefault(each[0], each)
        return list(first.values())


class ArgumentReader(LaunchReader):
    """Evaluate constants in which launch arguments have the form ``$(var name)``."""

    def text(self, node: ast.expr, depth: int = 0) -> str | None:
        """Return the text of an expression of constants and launch arguments; None for other expressions."""
        if depth > 12:
            return None
        if isinstance(node, ast.Name):
            value = self.assigned.get(node.id)
            return self.text(value, depth + 1) if value is not None else None
        if isinstance(node, ast.Subscript) and name_of(node.value) == "launch_configurations":
            name = super().text(node.slice)
            return f"$(var {name})" if name is not None else None
        parts: list[ast.expr] = []
        if isinstance(node, ast.Call):
            if name_of(node.func) == "LaunchConfiguration" and len(node.args) == 1 and not node.keywords:
                name = super().text(node.args[0])
                return f"$(var {name})" if name is not None else None
            if name_of(node.func) == "perform" and isinstance(node.func, ast.Attribute):
                parts = [node.func.value]
            elif name_of(node.func) == "TextSubstitution" and len(node.keywords) == 1:
                parts = [node.keywords[0].value]
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            parts = [node.left, node.right]
        elif isinstance(node, (ast.List, ast.Tuple)):
            parts = node.elts
        elif isinstance(node, ast.JoinedStr):
            parts = [each.value if isinstance(each, ast.FormattedValue) else each for each in node.values]
        texts = [self.text(part, depth + 1) for part in parts]
        if not texts:
            return super().text(node, depth)
        return None if None in texts else "".join(text for text in texts if text is not None)
