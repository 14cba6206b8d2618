"""L106 python-launch-api-misused."""

import ast

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule


class PythonLaunchApiMisused(RobotRule):
    """A Python launch file imports an unknown name from a launch package, or calls a class with wrong arguments.

    ## What it does
    Checks the names that are imported from ``launch``, ``launch_ros``, ``ament_index_python`` and
    ``moveit_configs_utils`` against all releases from Foxy to Rolling. Checks the keyword arguments of common actions
    against all releases from Galactic to Rolling. Imports inside ``try`` are not checked. Reports:

    - misspelt names, and names that another module defines
    - attributes of XML launch files such as ``pkg``, and keyword arguments of Foxy such as ``node_executable``
    - calls of launch classes that lack an argument, or pass one without its keyword
    - substitutions that Python code, an f-string or xacro uses as strings
    - lists without brackets or inside other lists, unknown values of ``output``, and ``items`` without a call
    - strings that equal the name of an unused variable
    - calls of the file's own functions that lack an argument
    - the string value of a launch argument that is used as a Boolean, or compared with a Boolean
    - launch files whose format does not match the class that loads them
    - event handlers of processes whose target is not a process

    ## Why is this bad?
    The launch file stops with an ImportError or a TypeError before it starts a node.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch_ros.actions import Node


     def generate_launch_description():
    -    return LaunchDescription([Node(pkg="rviz2", executable="rviz2")])
    +    return LaunchDescription([Node(package="rviz2", executable="rviz2")])
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L106"
    name = "python-launch-api-misused"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each wrong import, keyword and list."""
        from urdfkit.lint.facts.launch.python.names import class_called, launch_classes, python_files
        from urdfkit.lint.facts.launch.python.values import wrong_values
        from urdfkit.lint.facts.nodes.python_bindings import miscalled

        for source, tree in python_files(model):
            classes, reader = launch_classes(tree), launch_reader(tree)
            guarded = {inner for node in ast.walk(tree) if isinstance(node, ast.Try) for inner in ast.walk(node)}
            for node in ast.walk(tree):
                if isinstance(node, ast.ImportFrom) and not node.level and node not in guarded:
                    yield from self._import(source, node)
                elif isinstance(node, ast.Call) and (kind := class_called(node, classes)):
                    yield from self._call(source, node, kind, reader)
            for call, message in miscalled(tree):
                yield self._at(source, place(source, call), message)
            for span, message in wrong_values(source, tree):
                yield self._at(source, span, message)

    def _import(self, source: Source, node: ast.ImportFrom) -> Findings:
        from urdfkit.lint.facts.launch.python.api import wrong_import, wrong_module

        module = node.module or ""
        near = wrong_module(module)
        start, end = place(source, node)
        if near is not None:
            at = source.text.find(module, start, end)
            message = f"unknown module `{module}`" + Suggestion(near, module)
            yield self._at(source, (at, at + len(module)) if at >= 0 else (start, end), message)
            return
        for word in node.names:
            if (message := wrong_import(module, word.name) or "") and word.name != "*":
                yield self._at(source, place(source, word), message)

    def _call(self, source: Source, node: ast.Call, kind: str, reader: LaunchReader) -> Findings:
        from urdfkit.errors import did_you_mean
        from urdfkit.lint.facts.launch.python.api import LISTS, OF_FOXY, wrong_keyword
        from urdfkit.lint.facts.launch.xml_elements import OUTPUTS, is_output

        for word in node.keywords:
            if word.arg is None:
                continue
            start, end = place(source, word.value)
            before = max(source.text.rfind(word.arg, 0, start), 0)
            near = wrong_keyword(kind, word.arg)
            if word.arg == "launch_arguments" and name_of(word.value) == "items":
                yield self._at(source, (start, end), "`items` is not called; write `items()`")
            elif word.arg == "launch_arguments" and isinstance(word.value, ast.Dict) and word.value.keys:
                named = getattr(word.value, "named_at", None)  # the parameter of a function that the file calls
                span = place(source, named) if named is not None else (end - 1, end)
                yield self._at(source, span, "`launch_arguments` is a dictionary; write `.items()` after it")
            if word.arg == "launch_arguments":
                for value in _not_text(word.value):
                    message = "a value of `launch_arguments` is not a string; write it in quotes"
                    yield self._at(source, place(source, value), message)
            elif word.arg == "default_value" and kind == "DeclareLaunchArgument" and _is_number(word.value):
                yield self._at(source, (start, end), "`default_value` is not a string; write it in quotes")
            elif word.arg == "choices" and (others := [each for each in reader.items(word.value) if _is_number(each)]):
                yield self._at(source, place(source, others[0]), "a choice is not a string; write it in quotes")
            elif word.arg == "condition" and (other := _no_condition(word.value, reader)):
                message = f"`condition` is a {other}; write `IfCondition(...)` around it"
                yield self._at(source, (start, end), message)
            elif word.arg == "output" and _has_lists(kind) and not is_output(reader.text(word.value) or "$", 2):
                text = reader.text(word.value) or ""
                yield self._at(source, (start, end), f"unknown output `{text}`" + did_you_mean(text, OUTPUTS[2]))
            if near is not None:
                since = " since ROS 2 Galactic" if word.arg in OF_FOXY else ""
                message = f"`{kind}` has no argument `{word.arg}`{since}" + Suggestion(near, word.arg)
                yield self._at(source, (before, before + len(word.arg)), message)
            elif word.arg in LISTS and _has_lists(kind) and _is_no_list(word.value, reader):
                yield self._at(source, (start, end), f"`{word.arg}` of `{kind}` is not a list; write it in brackets")

    def _at(self, source: Source, place: tuple[int, int], message: str) -> Finding:
        return self.at_span(source.span(*place), message)


def _not_text(node: ast.expr) -> list[ast.expr]:
    """Return the numbers and truth values among the arguments of an include."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "items":
        node = node.func.value
    values = node.values if isinstance(node, ast.Dict) else []
    return [each for each in values if isinstance(each, ast.Constant) and isinstance(each.value, (bool, int, float))]


def _no_condition(node: ast.expr, reader: LaunchReader) -> str:
    """Return the class or type of an expression that is no condition; empty for others."""
    node = reader.assigned.get(node.id) or node if isinstance(node, ast.Name) else node
    if isinstance(node, ast.Call):
        kind = name_of(node.func)
        return kind if kind in ("LaunchConfiguration", "PythonExpression", "EqualsSubstitution") else ""
    return "text" if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def _has_lists(kind: str) -> bool:
    return kind.endswith(("Node", "Container", "Process"))


def _is_no_list(node: ast.expr, reader: LaunchReader) -> bool:
    """Return whether an expression is a dictionary or a text."""
    if isinstance(node, ast.Name):
        node = reader.assigned.get(node.id) or node
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        return node.func.attr == "to_dict"
    return isinstance(node, (ast.Dict, ast.JoinedStr)) or (isinstance(node, ast.Constant) and node.value is not None)


def _is_number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, (bool, int, float))
