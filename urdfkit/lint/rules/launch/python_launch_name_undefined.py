"""L105 python-launch-name-undefined."""

import ast

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.rule import Findings, Model, RobotRule

_FUNCTION = "generate_launch_description"


class PythonLaunchNameUndefined(RobotRule):
    """A Python launch file uses a name that it neither imports nor defines, or returns no description.

    ## What it does
    Compares the names that a launch file uses with the names that it imports or defines anywhere, and with the built-in
    names of Python. Files with ``from ... import *`` are not checked. A launch file must define a function with the
    exact name ``generate_launch_description``, which must return a value. The function of an OpaqueFunction must return
    the list of its actions.

    ## Why is this bad?
    The launch file stops with an error before it starts a node.

    ## Example
    ```diff title="robot.launch.py"
    +from launch import LaunchDescription
    +
    +
     def generate_launch_description():
         return LaunchDescription([])
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L105"
    name = "python-launch-name-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for the first use of each undefined name, and for a missing description."""
        from urdfkit.lint.facts.launch.python.api import first_slip
        from urdfkit.lint.facts.launch.python.names import defined, python_files, undefined

        for source, tree in python_files(model):
            names = defined(tree) or set()
            for name, node in undefined(tree).items():
                message = f"name `{name}` is not defined or imported" + Suggestion(first_slip(name, names), name)
                function = _without_context(tree, node) if name == "context" else None
                if function is not None:
                    message = f"the function `{function.name}` of an OpaqueFunction lacks the parameter `context`"
                start, end = place(source, function or node)
                end = min(end, start + len(source.text[start:end].partition("\n")[0]))
                yield self.at_span(source.span(start, end), message)
            yield from self._description(source, tree, _FUNCTION in names)

    def _description(self, source: Source, tree: ast.Module, is_defined: bool) -> Findings:
        from urdfkit.lint.facts.launch.python.api import differs_by_a_letter
        from urdfkit.lint.facts.launch.python.names import own_nodes

        for function in tree.body:
            if not isinstance(function, ast.FunctionDef):
                continue
            start = place(source, function)[0] + len("def ")
            span = source.span(start, start + len(function.name))
            if differs_by_a_letter(function.name, _FUNCTION) and not is_defined:
                message = (
                    f"no function `{_FUNCTION}`, which `ros2 launch` calls; did you misspell it as `{function.name}`?"
                )
                yield self.at_span(span, message)
            elif function.name == _FUNCTION and not any(_ends(node) for node in own_nodes(function)):
                message = f"`{_FUNCTION}` does not return a LaunchDescription"
                last = next((node for node in function.body if _is_description(node)), function.body[-1])
                start, end = place(source, last)
                end = min(end, start + len(source.text[start:end].partition("\n")[0]))
                yield self.at_span(source.span(start, end), message, help="write `return` and the LaunchDescription")
            elif not any(_ends(node) for node in own_nodes(function)) and function.name in _opaque(tree):
                lists = [node for node in own_nodes(function) if isinstance(node, ast.Expr) and _has_actions(node)]
                for node in lists[:1] or function.body[-1:] if lists or _drops_actions(function) else ():
                    start, end = place(source, node)
                    start = max(start, source.text.rfind("\n", start, end) + 1)  # its last line
                    message = f"the function `{function.name}` of an OpaqueFunction does not return its actions"
                    yield self.at_span(source.span(start, end), message, help="return the list of actions")


def _without_context(tree: ast.Module, name: ast.Name) -> ast.FunctionDef | None:
    """Return the function of an OpaqueFunction that has no parameters and in which a name is."""
    functions = [each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef) and each.name in _opaque(tree)]
    around = (each for each in functions if any(inner is name for inner in ast.walk(each)))
    return next((each for each in around if not each.args.args), None)


def _is_description(node: ast.AST) -> bool:
    """Return whether a statement creates a LaunchDescription without using it."""
    called = node.value if isinstance(node, ast.Expr) else None
    return isinstance(called, ast.Call) and name_of(called.func) == "LaunchDescription"


def _has_actions(node: ast.Expr) -> bool:
    """Return whether a statement is a list of actions or names, which no code uses."""
    items = node.value.elts if isinstance(node.value, (ast.List, ast.Tuple)) else []
    return bool(items) and all(isinstance(each, ast.Name) or _starts(each) for each in items)


def _drops_actions(function: ast.FunctionDef) -> bool:
    """Return whether a function creates an action that no code uses; not if a call or the caller can receive it."""
    from collections import Counter

    from urdfkit.lint.facts.launch.python.names import own_nodes

    inner = list(own_nodes(function))
    if any(isinstance(node, (ast.Yield, ast.YieldFrom, ast.Global, ast.Nonlocal)) for node in inner):
        return False
    names = [node for node in ast.walk(function) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)]
    reads = Counter(node.id for node in names)
    values = [node.value for node in inner if isinstance(node, ast.Expr)]
    for node in (each for each in inner if isinstance(each, ast.Assign)):
        if all(isinstance(target, ast.Name) and not reads[target.id] for target in node.targets):
            values.append(node.value)
    items = [each for value in values for each in (value.elts if isinstance(value, (ast.List, ast.Tuple)) else [value])]
    created = {
        target.id
        for node in inner
        if isinstance(node, ast.Assign) and _starts(node.value)
        for target in node.targets
        if isinstance(target, ast.Name) and reads[target.id] == 1
    }
    return any(_starts(each) or (isinstance(each, ast.Name) and each.id in created) for each in items)


def _starts(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and name_of(node.func) in _STARTING


def _opaque(tree: ast.Module) -> set[str]:
    """Return the names of the functions that an OpaqueFunction calls."""
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and name_of(node.func) == "OpaqueFunction"]
    values = [each for call in calls for each in (*call.args, *(word.value for word in call.keywords))]
    return {each.id for each in values if isinstance(each, ast.Name)}


_STARTING = ("ComposableNodeContainer", "ExecuteProcess", "IncludeLaunchDescription", "LifecycleNode", "Node")


def _ends(node: ast.AST) -> bool:
    """Return whether a statement returns a value or raises an error."""
    return isinstance(node, ast.Raise) or (isinstance(node, ast.Return) and node.value is not None)
