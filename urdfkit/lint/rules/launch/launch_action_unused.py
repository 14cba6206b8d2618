"""L107 launch-action-unused."""

from __future__ import annotations

import ast
from collections.abc import Mapping

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

_ACTIONS = """
AppendEnvironmentVariable ComposableNodeContainer DeclareLaunchArgument EmitEvent ExecuteProcess GroupAction
IncludeLaunchDescription LifecycleNode LoadComposableNodes LogInfo Node OpaqueFunction PushRosNamespace
RegisterEventHandler SetEnvironmentVariable SetLaunchConfiguration SetParameter SetParametersFromFile SetRemap
TimerAction
"""
_TARGETS = frozenset(("target_action", "target_lifecycle_node"))
_SCOPES = frozenset(("eval", "exec", "globals", "locals", "vars"))


class LaunchActionUnused(RobotRule):
    """A Python launch file creates an action that it does not add to the launch description.

    ## What it does
    Checks the variables of Python launch files that hold a node, an argument, an include or another action, or a list
    of these. An action that is only the target of an event handler is also reported, because the handler does not start
    its target. A variable that a comment mentions is not checked, because its action is probably disabled on purpose.
    Attributes of classes are not checked, because code can collect the actions stored in them.

    In files without includes, a variable with the value of a declared argument is reported as well, if nothing uses it.

    ## Why is this bad?
    The node does not start, or the argument is not declared, and launch prints no error message.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch_ros.actions import Node


     def generate_launch_description():
         rviz = Node(package="rviz2", executable="rviz2")
    -    return LaunchDescription([])
    +    return LaunchDescription([rviz])
    ```
    """

    code = "L107"
    name = "launch-action-unused"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each action that is not used."""
        import re

        from urdfkit.lint.facts.launch.python.api import first_slip
        from urdfkit.lint.facts.launch.python.names import python_files, undefined
        from urdfkit.lint.facts.launch.python.unused_arguments import unused_arguments

        for source, tree in python_files(model):
            for argument, node in unused_arguments(tree):
                message = f"argument `{argument}` is declared, but nothing in this file uses its value"
                yield self.at_span(source.span(*place(source, node)), message, kind="argument")
            created, used, targets = _names(tree)
            unknown: dict[str, ast.Name] | None = None
            own = _in_place_of(tree) if len(created.keys() - used) == 1 else None
            for name, (node, kind) in created.items():
                if not _returns(tree, node):  # python-launch-name-undefined reports the function
                    continue
                if name in used or used & _SCOPES or re.search(rf"#.*\b{re.escape(name)}\b", source.text):
                    continue
                unknown = undefined(tree) if unknown is None else unknown
                if first_slip(name, unknown) is None:
                    at = _missing_from(tree, node) or node
                    found = self._finding(source, node, kind, name in targets, at)
                    again = _started_again(tree, created) if name in targets else None
                    if own is not None:
                        found = self._finding(source, node, kind, False, own)
                        help = f"`{own.id}` waits for its own exit; `{name}` is probably intended"
                        found = Finding(**{**found.__dict__, "severity": "error", "help": help, "kind": "replaced"})
                    if again is not None:
                        other = source.span(*place(source, again))
                        help = f"`{again.id}` is started twice"
                        details = {"other": other, "is_other_wrong": True, "cause": name, "help": help}
                        found = Finding(**{**found.__dict__, **details})
                    yield found

    def _finding(self, source: Source, node: ast.Name, kind: str, is_target: bool, at: ast.expr) -> Finding:
        only = "is only the target of an event handler and " if is_target else ""
        effect = {
            "DeclareLaunchArgument": "the argument is not declared",
            "list of arguments": "the arguments are not declared",
        }.get(kind, "it has no effect")
        message = f"{kind} `{node.id}` {only}is not added to the launch description: {effect}"
        return self.at_span(source.span(*place(source, at)), message)


def _returns(tree: ast.Module, node: ast.Name) -> bool:
    """Return whether the outermost function around a node has a ``return``; also true without a function."""
    around = (each for each in tree.body if isinstance(each, ast.FunctionDef) and each.lineno < node.lineno)
    inside = [each for each in around if node.lineno <= (each.end_lineno or 0)]
    return not inside or any(isinstance(part, ast.Return) for part in ast.walk(inside[0]))


def _missing_from(tree: ast.Module, node: ast.Name) -> ast.expr | None:
    """Return the item of the only list of actions after which an action is to be added; None with several lists."""
    from urdfkit.description.launch.python_constants import launch_reader, name_of

    functions = [each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef)]
    inside = [each for each in functions if each.lineno < node.lineno <= (each.end_lineno or 0)]
    if not inside:
        return None
    parts = list(ast.walk(max(inside, key=lambda each: each.lineno)))
    returned = [each.value for each in parts if isinstance(each, ast.Return) and each.value is not None]
    calls = [each for each in ast.walk(tree) if isinstance(each, ast.Call)]
    is_elsewhere = any(name_of(call.func) in ("GroupAction", "add_action") for call in calls)
    listed = returned[0] if len(returned) == 1 and not is_elsewhere else None
    if isinstance(listed, ast.Call) and name_of(listed.func) == "LaunchDescription" and len(listed.args) == 1:
        listed = listed.args[0]
    if isinstance(listed, ast.Name):
        listed = launch_reader(tree).assigned.get(listed.id)
    if isinstance(listed, ast.BinOp):  # `arguments + [first, second]`: the only list that is written out
        written = [each for each in (listed.left, listed.right) if isinstance(each, ast.List)]
        listed = written[0] if len(written) == 1 else None
    if not isinstance(listed, ast.List) or not listed.elts or listed.lineno < node.lineno:
        return None
    names = [each for each in ast.walk(tree) if isinstance(each, ast.Name)]
    created = {each.id: each.lineno for each in names if isinstance(each.ctx, ast.Store) and each.lineno < node.lineno}
    before = [item for item in listed.elts if isinstance(item, ast.Name) and item.id in created]
    return max(before, key=lambda item: created[item.id], default=listed.elts[0])


def _in_place_of(tree: ast.Module) -> ast.Name | None:
    """Return the one action that its own event handler starts again, in the place of another one."""
    found: list[ast.Name] = []
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        words = {word.arg: word.value for word in call.keywords}
        target, started = words.get("target_action"), words.get("on_exit")
        items = started.elts if isinstance(started, ast.List) else [started]
        if isinstance(target, ast.Name):
            found += [item for item in items if isinstance(item, ast.Name) and item.id == target.id]
    return found[0] if len(found) == 1 else None


def _started_again(tree: ast.Module, created: Mapping[str, object]) -> ast.Name | None:
    """Return the one action in the list of an event handler that is in the launch description too."""
    lists = [node for node in ast.walk(tree) if isinstance(node, ast.List)]
    words = [word.value for node in ast.walk(tree) if isinstance(node, ast.Call) for word in node.keywords]
    handled = [each for each in words if isinstance(each, ast.List)]
    inside = [item for each in handled for item in each.elts if isinstance(item, ast.Name)]
    outside = {item.id for each in lists if each not in handled for item in each.elts if isinstance(item, ast.Name)}
    again = [item for item in inside if item.id in outside and item.id in created]
    return again[0] if len(again) == 1 else None


def _names(tree: ast.Module) -> tuple[dict[str, tuple[ast.Name, str]], set[str], set[str]]:
    """Return the variables that only hold actions, the names that are used, and those used as targets of handlers."""
    from urdfkit.description.launch.python_constants import assignments
    from urdfkit.lint.facts.launch.python.names import class_called, launch_classes

    classes, actions = launch_classes(tree), set(_ACTIONS.split())
    created: dict[str, tuple[ast.Name, str]] = {}
    targets: set[ast.AST] = set()
    attributes = {part for node in ast.walk(tree) if isinstance(node, ast.ClassDef) for part in node.body}
    for node in ast.walk(tree):
        if isinstance(node, (ast.Assign, ast.AnnAssign)) and node.value is not None and node not in attributes:
            left = node.targets[0] if isinstance(node, ast.Assign) else node.target
            is_one = isinstance(node, ast.AnnAssign) or len(node.targets) == 1
            for name, value in assignments(left, node.value) if is_one else ():
                items = value.elts if isinstance(value, ast.List) else [value]
                kinds = {class_called(item, classes) for item in items}
                if kinds and kinds <= actions:
                    what = "arguments" if kinds == {"DeclareLaunchArgument"} else "actions"
                    kind = f"list of {what}" if isinstance(value, ast.List) else kinds.pop()
                    created.setdefault(name.id, (name, kind))
        elif isinstance(node, ast.Call):
            targets.update(word.value for word in node.keywords if word.arg in _TARGETS)
            if class_called(node, classes) == "matches_action":
                targets.update(node.args)
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
    firsts = {node for node, _ in created.values()}
    # A name with other values too is more than an action.
    stored = {node.id for node in names if not isinstance(node.ctx, ast.Load) and node not in firsts}
    loaded = [node for node in names if isinstance(node.ctx, ast.Load)]
    used = {node.id for node in loaded if node not in targets} | stored
    return created, used, {node.id for node in loaded if node in targets}
