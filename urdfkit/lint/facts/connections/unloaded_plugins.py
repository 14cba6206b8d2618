"""Launches that spawn the robot in Gazebo and leave out the plugin with its controller manager by an argument.

The description is expanded with the arguments of the launch, and with each truth value among them inverted.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from urdfkit.description.launch.launch_scope import LaunchContents, LaunchNode, XacroCommand
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Span
from urdfkit.errors import UrdfkitError
from urdfkit.lint.facts.connections.controller_managers import WITHOUT_MANAGER
from urdfkit.lint.facts.connections.trees import launch_trees, place_of
from urdfkit.lint.facts.gazebo.spawned_models import SPAWNERS
from urdfkit.lint.facts.launch.actions import actions_of
from urdfkit.lint.facts.parameters.launch_arguments import expected_values, passed_values
from urdfkit.lint.model.model import Model

_PLUGIN = r"gazebo_ros_control|ros2_control"
_INVERTED = {"true": "false", "false": "true", "True": "False", "False": "True", "1": "0", "0": "1"}


def left_out_plugins(model: Model) -> Iterator[tuple[Span, str]]:
    """Yield the place and the message of each argument without whose value a spawner waits forever."""
    for tree in launch_trees(model):
        nodes = [node for node in tree.nodes if not node.is_skipped]
        spawner = next((node for node in nodes if node.package == "controller_manager" and node.arguments), None)
        is_spawned = any((node.package, node.program) in SPAWNERS for node in nodes)
        is_managed = any(re.search(r"control_node|controller_manager|_hw|hardware", node.program) for node in nodes)
        path = model.expanded.path.resolve()
        commands = [command for command in tree.commands if command.description.resolve() == path]
        is_open = any(package not in WITHOUT_MANAGER for package, _ in tree.outside)
        if spawner is None or not is_spawned or is_managed or is_open or len(commands) != 1:
            continue
        name = _deciding(commands[0], model)
        place = _place(tree, name, commands[0].arguments[name], spawner, model) if name else None
        if place is not None:
            message = f"`{name}:={commands[0].arguments[name]}` excludes the plugin that runs the controller manager"
            yield place, f"{message}, so `{spawner.program}` waits forever"


def _deciding(command: XacroCommand, model: Model) -> str:
    """Return the argument whose inverted value adds the plugin that the robot lacks; empty without one."""
    values = {name: value for name, value in command.arguments.items() if value in _INVERTED}
    if not values or _loads(command.arguments, command, model) is not False:
        return ""
    inverted = ({**command.arguments, name: _INVERTED[value]} for name, value in values.items())
    found = (name for name, each in zip(values, inverted, strict=True) if _loads(each, command, model))
    return next(found, "")


def _loads(arguments: Mapping[str, str], command: XacroCommand, model: Model) -> bool | None:
    """Return whether the expanded description has the plugin; None if it cannot be expanded."""
    try:
        packages, texts = model.expanded.packages, model.texts
        expanded = expand_leniently(command.description, arguments=arguments, packages=packages, texts=texts)
    except UrdfkitError:
        return None
    if expanded.root is None or expanded.faults:
        return None
    plugins = (element for element in expanded.root.walk() if element.tag == "plugin")
    return any(re.search(_PLUGIN, element.get("filename") or "") for element in plugins)


def _place(tree: LaunchContents, name: str, value: str, spawner: LaunchNode, model: Model) -> Span | None:
    """Return the place of the value in a launch file: where an include passes it, its default, or the spawner."""
    files = [model.related_files.get(shown_path(path)) for path in (tree.path, *tree.included)]
    sources = [source for source in files if source is not None]
    for source in sources:
        for call in actions_of(source).includes:
            for argument, passed in passed_values(source, call):
                if (argument, passed.name.strip()) == (name, value):
                    return source.span(passed.start, passed.end)
    for source in sources:
        if (at := source.text.find(f"{name}:={value}")) >= 0:
            return source.span(at, at + len(f"{name}:={value}"))
        for argument, default, is_default in expected_values(source).values:
            if is_default and (argument, default.name) == (name, value):
                return source.span(default.start, default.end)
    return place_of(spawner, model)
