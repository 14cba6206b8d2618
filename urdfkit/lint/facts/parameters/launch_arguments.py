"""Values of launch arguments that the launch refuses: not one of the choices, or neither true nor false.

Sources: ros2/launch (declare_launch_argument.py, evaluate_condition_expression_impl.py), ros/ros_comm (roslaunch,
substitution_args.py).
"""

import ast
import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of, parsed
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.actions import all_elements, launch_files
from urdfkit.lint.facts.launch.receivers import actions_at, receiver
from urdfkit.lint.facts.launch.records import Call, LaunchActions
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model
from urdfkit.record import field, record

_TRUTHS = ("true", "false", "1", "0")
ARGUMENT_USE = r"\$\((?:var|arg)\s+([\w-]+)\s*\)"
"""Matches the use of a launch argument in XML or YAML, or as `ArgumentReader` writes it."""

_COMPARISON = (
    r"(?:\barg\([\"'](?=[\w.-]+[\"']\)\s*==)|'\$\((?:var|arg)\s+|(?<=\$\(eval )(?=\w+\s*==))"
    r"([\w.-]+)(?:[\"']\)|\)')?\s*==\s*[\"'&;quot]*?[\"']?([\w.-]*)[\"'&]"
)
"""Matches a comparison of a launch argument with a constant in XML: argument and constant."""


@record(eq=False)
class Expected:
    """Values that the arguments of a launch file accept.

    Attributes:
        choices: argument → its choices.
        conditions: arguments that are conditions.
        values: argument and value of each default and each comparison, with whether it is a default.
        compared: argument → the values that the file compares it with.
    """

    choices: dict[str, tuple[str, ...]] = field(default_factory=dict)
    conditions: set[str] = field(default_factory=set)
    values: list[tuple[str, Named, bool]] = field(default_factory=list)
    compared: dict[str, set[str]] = field(default_factory=dict)


def refused_values(model: Model) -> Iterator[tuple[Span, str]]:
    """Yield the place and the message of each value that an argument cannot have."""
    for file in launch_files(model):
        own = expected_values(file.source)
        for name, value, is_default in own.values:
            message = _refused(name, value.name, own, is_default and file.source.file.endswith(".py"))
            if message is not None:
                yield _span(file.source, value), message
        for call in file.includes:
            path = receiver(call, model)
            actions = actions_at(path, model) if path is not None else None
            expected = expected_values(actions.source) if actions is not None else None
            for name, value in passed_values(file.source, call) if expected is not None else ():
                message = _refused(name, value.name, expected, True) if expected is not None else None
                if message is not None:
                    yield _span(file.source, value), message
            for name, value in passed_values(file.source, call, True) if expected is not None else ():
                message = _truth_for_a_path(name, value.name, file, actions) if actions is not None else None
                if message is not None and (expected is None or name not in expected.conditions):
                    yield _span(file.source, value), message


def _truth_for_a_path(name: str, value: str, file: LaunchActions, actions: LaunchActions) -> str | None:
    """Return the message for a truth value that an include passes to an argument whose default is a path."""
    use = re.fullmatch(ARGUMENT_USE, value.strip())
    written = file.defaults.get(use[1], "") if use is not None else value
    default = actions.defaults.get(name, "")
    if written.strip().lower() not in ("true", "false") or not re.search(r"/[\w.-]+\.\w+\s*$", default):
        return None
    passed = f"`{use[1]}`, which is `{written}`" if use is not None else f"`{written}`"
    return f"launch argument `{name}` is the path of a file, but this include passes {passed}"


def _refused(name: str, value: str, expected: Expected, is_passed: bool) -> str | None:
    choices = expected.choices.get(name)
    if choices is not None and value not in choices:
        listed = ", ".join(f"`{choice}`" for choice in choices[:5])
        near = nearest(value, choices, cutoff=0.7)
        hint = Suggestion(near, value) if near is not None else f"; its choices are {listed}"
        return f"`{value}` is not a choice of launch argument `{name}`" + hint
    if choices is None and is_passed and name in expected.conditions and value.strip().lower() not in _TRUTHS:
        return f"launch argument `{name}` is a condition, and `{value}` is neither true nor false"
    compared = expected.compared.get(name, set())
    is_listed = any(name == argument and default.name in compared for argument, default, is_default in expected.values)
    if choices is None and is_passed and is_listed and len(compared) > 1 and value and value not in compared:
        listed = ", ".join(f"`{each}`" for each in sorted(compared)[:5])
        return f"no condition is true for the value `{value}` of launch argument `{name}`; the conditions name {listed}"
    return None


def _span(source: Source, value: Named) -> Span:
    return source.span(value.start, value.end)


def expected_values(source: Source) -> Expected:
    """Return the values that the arguments of a launch file accept, with its defaults."""
    found = Expected()
    for at in re.finditer(_COMPARISON, source.text):
        if at[2] is not None and not re.fullmatch(r"[Tt]rue|[Ff]alse|", at[2]):
            found.compared.setdefault(at[1], set()).add(at[2])
    if not source.file.endswith(".py"):
        for element in all_elements(source):
            for key in ("if", "unless"):
                use = (
                    re.fullmatch(ARGUMENT_USE, element.attributes[key].name.strip())
                    if key in element.attributes
                    else None
                )
                if use is not None:
                    found.conditions.add(use[1])
            choices = [each.attributes.get("value") for each in element.children if each.tag == "choice"]
            name, default = element.attributes.get("name"), element.attributes.get("default")
            if element.tag == "arg" and name is not None:
                texts = [each.name for each in choices if each is not None]
                if texts and len(texts) == len(choices):
                    found.choices[name.name] = tuple(texts)
                if default is not None and "$" not in default.name:
                    found.values.append((name.name, default, True))
        return found
    tree = parsed(source)
    reader = launch_reader(tree) if tree is not None else None
    for call in ast.walk(tree) if tree is not None else ():
        if isinstance(call, ast.Call) and reader is not None:
            _read(source, call, reader, found)
    return found


def _read(source: Source, call: ast.Call, reader: LaunchReader, found: Expected) -> None:
    kind, words = name_of(call.func), {word.arg: word.value for word in call.keywords}
    first = call.args[0] if call.args else words.get("name")
    if kind == "DeclareLaunchArgument" and first is not None and (name := reader.text(first)) is not None:
        choices, default = words.get("choices"), words.get("default_value")
        if isinstance(choices, ast.Name):
            choices = reader.assigned.get(choices.id)
        if isinstance(choices, (ast.List, ast.Tuple)):
            texts = [each.value if isinstance(each, ast.Constant) else None for each in choices.elts]
            if texts and all(isinstance(text, str) for text in texts):
                found.choices[name] = tuple(str(text) for text in texts)
        if default is not None and (value := _named(source, default)) is not None:
            found.values.append((name, value, True))
    elif kind in ("IfCondition", "UnlessCondition") and first is not None:
        argument = _argument(first, reader)
        found.conditions.update(() if argument is None else (argument,))
    elif kind in ("LaunchConfigurationEquals", "LaunchConfigurationNotEquals") and len(call.args) > 1:
        name, value = reader.text(call.args[0]), _named(source, call.args[1])
        if name is not None and value is not None:
            found.values.append((name, value, False))
    elif kind in ("EqualsSubstitution", "NotEqualsSubstitution") and len(call.args) == 2:
        for one, other in (call.args, call.args[::-1]):
            argument, value = _argument(one, reader), _named(source, other)
            if argument is not None and value is not None:
                found.values.append((argument, value, False))


def _argument(node: ast.expr, reader: LaunchReader) -> str | None:
    """Return the name in ``LaunchConfiguration("name")``, also of a variable with this value."""
    if isinstance(node, ast.Name):
        node = reader.assigned.get(node.id) or node
    is_use = isinstance(node, ast.Call) and name_of(node.func) == "LaunchConfiguration" and len(node.args) == 1
    return reader.text(node.args[0]) if is_use and isinstance(node, ast.Call) else None


def _named(source: Source, node: ast.expr) -> Named | None:
    if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
        return None
    start, end = place(source, node)
    offset = source.text[start:end].find(node.value)
    return Named(node.value, start + offset) if offset >= 0 else None


def passed_values(source: Source, call: Call, with_arguments: bool = False) -> Iterator[tuple[str, Named]]:
    """Yield name and constant value of the arguments of an include, in XML and YAML also those with arguments."""
    if not source.file.endswith(".py"):
        for element in (each for each in all_elements(source) if each.tag == "include" and each.start == call.start):
            for child in element.children:
                name, value = child.attributes.get("name"), child.attributes.get("value")
                if name is not None and value is not None and (with_arguments or "$" not in value.name):
                    yield name.name, value
        return
    names = {name.start: name.name for name in call.passed}
    tree = parsed(source)
    for node in ast.walk(tree) if tree is not None and names else ():
        pairs: list[tuple[ast.expr | None, ast.expr]] = []
        if isinstance(node, ast.Dict):
            pairs += zip(node.keys, node.values, strict=True)
        elif isinstance(node, ast.Tuple) and len(node.elts) == 2:
            pairs.append((node.elts[0], node.elts[1]))
        for key, constant in pairs:
            argument = _named(source, key) if key is not None else None
            written = _named(source, constant)
            if argument is not None and written is not None and names.get(argument.start) == argument.name:
                yield argument.name, written
