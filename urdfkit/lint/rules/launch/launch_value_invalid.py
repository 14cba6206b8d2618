"""L110 launch-value-invalid."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.related_files import neighbours
from urdfkit.errors import did_you_mean, nearest
from urdfkit.lint.facts.launch.actions import actions_of, share_of
from urdfkit.lint.model.tags import Attribute, Document, Tag
from urdfkit.lint.rule import Findings, Model, RobotRule

_BOOLEANS = {
    1: ("respawn", "required", "clear_params", "pass_all_args", "subst_value"),
    2: ("respawn", "shell", "scoped", "forwarding", "emulate_tty", "allow_substs"),
}
_WHEN = ("if", "unless")
_TRUTH = ("true", "false", "1", "0")
_XACRO = r"\s*(?:\$\(find xacro\)/)?xacro(?:\.py)?\s"
_FILE = r"\s*'?\$\(find [^()]*\)/[^\s']*\.(?:urdf|srdf|xacro|yaml|xml)'?\s*"


_AROUND = (
    r"^\s*(?:\$\((?:arg|var) [^()]*\)\s*(?:[!=<>]=|[<>]|\b(?:and|or)\b)|not\s+\$\((?:arg|var) |[\w'\"]+\s*[!=]=\s*\$\()"
)
"""Matches a condition that compares an argument outside of ``$(eval …)``; both versions of ROS read it as a text."""


class LaunchValueInvalid(RobotRule):
    """An attribute of an XML launch file has an invalid value.

    ## What it does
    Checks the XML launch files of ROS for:

    - conditions, defaults of arguments that serve as conditions, and other Boolean values that are neither true nor
      false; values with substitutions are not checked
    - values that equal the name of a launch argument that the file does not use
    - conditions with an operator outside ``$(eval …)``
    - unknown values of ``output``, and ``<rosparam>`` commands that overwrite a file
    - invalid parameters of amcl, gmapping and other ROS 1 nodes
    - unknown plugins of MoveIt and of navigation, and plugins of the other version of ROS
    - parameter files with substitutions but without ``subst_value``, files that are loaded into the wrong namespace or
      parameter, and MoveIt files that no launch file loads
    - parameters inside a node that reads them from another namespace in Python, and private parameters outside it
    - a default planning pipeline that is not loaded, and a pipeline of OMPL without time parameterization
    - planning pipelines outside the namespace of the node ``move_group``
    - ``spawn_model`` without ``-unpause`` in a Gazebo that starts paused, if controllers are spawned
    - a robot description in the wrong attribute: ``textfile`` is for a file without xacro, ``command`` for a program,
      and ``value`` for the text itself

    ## Why is this bad?
    The launch stops with "invalid bool value" or a similar error, or the nodes read a wrong description. A
    ``<rosparam>`` dump overwrites the file that the package should load.

    ## Example
    ```diff
     <launch>
    -  <node name="rviz" pkg="rviz" type="rviz" if="yes"/>
    +  <node name="rviz" pkg="rviz" type="rviz" if="true"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L110"
    name = "launch-value-invalid"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unusable value."""
        from urdfkit.lint.facts.launch.quoted_names import quoted_arguments
        from urdfkit.lint.facts.launch.ros_version import reads_ros1, ros_version
        from urdfkit.lint.facts.moveit.planning import meant_plugin
        from urdfkit.lint.facts.moveit.planning_pipelines import pipelines_elsewhere, unloaded_pipelines
        from urdfkit.lint.facts.moveit.plugin_names import wrong_plugins_in_launch
        from urdfkit.lint.facts.parameters.launch_parameters import launch_parameter_defects
        from urdfkit.lint.facts.parameters.loaded_files import (
            controllers_without_manager,
            loaded_file_defects,
            spawned_while_paused,
            unloaded_moveit_files,
            unread_semantics,
            untimed_pipelines,
        )
        from urdfkit.lint.facts.parameters.private_parameters import parameters_out_of_reach

        for name, source in model.related_files.items():
            if not name.endswith((".launch", ".launch.xml", "_launch.xml")):
                continue
            roots = [tag for tag in Document(source).roots if tag.name == "launch"]
            version = ros_version(source) or (1 if reads_ros1(source) else 2)
            tags = [tag for root in roots for tag in root.walk()]
            defaults = actions_of(source).defaults
            found = (each for tag in tags for each in _invalid(tag, version, model, defaults))
            for attribute, message in (*found, *_conditions(tags), *quoted_arguments(source)):
                yield self.at_span(source.span(attribute.value_start, attribute.value_end), message)
            for attribute in _untyped(tags) if version == 2 else ():
                message = "the launch reads the output of the command as YAML, and stops at text that is not YAML"
                span = source.span(attribute.value_start, attribute.value_end)
                yield self.at_span(span, message, severity="warning", help='add `type="str"`')
            found_in_files = (
                *loaded_file_defects(source, model),
                *unloaded_pipelines(source, model),
                *controllers_without_manager(source, model),
                *unloaded_moveit_files(source, model),
                *spawned_while_paused(source, model),
                *unread_semantics(source, model),
                *untimed_pipelines(source),
                *pipelines_elsewhere(source, model),
                *(parameters_out_of_reach(source, model) if version == 1 else ()),
            )
            for attribute, message in found_in_files if version == 1 else ():
                span = source.span(attribute.value_start, attribute.value_end)
                yield self.at_span(span, message, severity="warning")
            plugins = (each for each in wrong_plugins_in_launch(source) if meant_plugin(each[0].name) is None)
            for word, message in (*launch_parameter_defects(source), *plugins):  # L104 reports misspelt plugins
                yield self.at_span(source.span(word.start, word.end), message, severity="warning")


_TYPES = {
    1: ("str", "int", "double", "bool", "yaml", "auto", "string", "boolean"),
    2: tuple(f"{before}{name}" for before in ("", "list_of_") for name in ("str", "int", "float", "bool")),
}
"""Version of ROS → types of parameters (roslaunch 1.17, launch_frontend of Humble to Rolling)."""

_SYNONYMS = {"string": "str", "double": "float", "integer": "int", "boolean": "bool"}


def _invalid(tag: Tag, version: int, model: Model, defaults: dict[str, str]) -> Iterator[tuple[Attribute, str]]:
    from urdfkit.lint.facts.launch.xml_elements import OUTPUTS, is_output

    attributes = tag.attributes
    for name in (*_WHEN, *_BOOLEANS[version]):
        attribute = attributes.get(name)
        is_condition = name in _WHEN
        if attribute is not None and is_condition and re.search(_AROUND, attribute.value):
            what = "`$(eval …)`" if version == 1 else '`"$(eval …)"`'
            message = f"condition `{attribute.value}` is not evaluated, because other text surrounds it; write {what}"
            yield attribute, message
        if attribute is None or "$(" in attribute.value:
            continue
        words = _TRUTH if is_condition or version == 2 else ("true", "false")
        if attribute.value.strip().lower() not in words:
            what = "condition" if is_condition else f"`{name}`"
            yield attribute, f"{what} `{attribute.value}` is neither true nor false"
    both = [attributes.get(name) for name in ("required", "respawn")] if version == 1 and tag.name == "node" else []
    if both and all(each is not None and each.value.lower() in ("true", "1") for each in both):
        respawn = attributes["respawn"]
        yield respawn, "`respawn` and `required` are both true, which roslaunch rejects; remove one"
    output = attributes.get("output") if tag.name in ("node", "test", "executable") else None
    if output is not None and not is_output(output.value, version):
        yield output, f"unknown output `{output.value}`" + did_you_mean(output.value, OUTPUTS[version])
    if version == 1 and tag.name == "rosparam" and "command" in attributes:
        yield from _parameter_command(attributes, model)
    elif version == 1 and tag.name == "param":
        yield from _parameter(attributes, model, defaults)
    type = attributes.get("type") if tag.name == "param" else None
    written = type.value.strip().lower() if type is not None and version == 1 else type.value if type else ""
    if type is not None and "$(" not in type.value and written not in _TYPES[version]:
        near = _SYNONYMS.get(type.value) or nearest(type.value, _TYPES[version])
        yield (
            type,
            f"unknown type `{type.value}` of a parameter"
            + Suggestion(near if near in _TYPES[version] else None, type.value),
        )


def _untyped(tags: list[Tag]) -> Iterator[Attribute]:
    """Yield the values of descriptions from a command that are read as YAML (launch_ros, parameter_descriptions.py)."""
    for tag in tags:
        value = tag.attributes.get("value") if tag.name == "param" and "type" not in tag.attributes else None
        if value is not None and value.value.strip().startswith("$(command ") and _is_description(tag.attributes):
            yield value


def _conditions(tags: list[Tag]) -> Iterator[tuple[Attribute, str]]:
    """Yield the defaults of arguments that are conditions and neither true nor false."""
    used = {attribute.value.strip() for tag in tags for name, attribute in tag.attributes.items() if name in _WHEN}
    conditions = {match[1] for value in used if (match := re.fullmatch(r"\$\((?:arg|var)\s+([\w-]+)\s*\)", value))}
    for tag in tags:
        if tag.name != "arg" or "name" not in tag.attributes or tag.attributes["name"].value not in conditions:
            continue
        for name in ("default", "value"):
            value = tag.attributes.get(name)
            if value is not None and "$" not in value.value and value.value.strip().lower() not in _TRUTH:
                argument = tag.attributes["name"].value
                yield value, f"`{value.value}` is neither true nor false, but `{argument}` is a condition in this file"


def _parameter_command(attributes: dict[str, Attribute], model: Model) -> Iterator[tuple[Attribute, str]]:
    command = attributes["command"]
    if "$(" not in command.value and command.value not in ("load", "dump", "delete"):
        hint = did_you_mean(command.value, ("load", "dump", "delete"))
        yield command, f"unknown command `{command.value}` of <rosparam>" + hint
    elif command.value == "dump" and "file" in attributes and model.package is not None:
        package, path = share_of(attributes["file"].value)
        folder = neighbours(model.package).get(package)
        if folder is not None and is_file(folder / path):
            yield command, f"`dump` overwrites `{path}` of package `{package}`; use `load` to read it"


def _parameter(
    attributes: dict[str, Attribute], model: Model, defaults: dict[str, str]
) -> Iterator[tuple[Attribute, str]]:
    value, kind = attributes.get("value"), attributes["type"].value.strip().lower() if "type" in attributes else "auto"
    if value is not None and "$(" not in value.value and not _is_of_type(value.value, kind):
        yield value, f"`{value.value}` is not a value of type `{kind}`, so roslaunch stops"
    for name in ("value", "textfile", "command"):
        attribute = attributes.get(name)
        if attribute is None:
            continue
        if name != "command" and re.match(_XACRO, attribute.value):
            yield attribute, f"`{name}` is a command; use the attribute `command`"
        elif name == "command" and re.fullmatch(_FILE, attribute.value):
            yield attribute, "`command` is a file, not a program; use the attribute `textfile`, or run xacro"
        elif name == "value" and re.fullmatch(_FILE, attribute.value) and _is_description(attributes):
            yield attribute, "`value` is the path of the file, not its content; use the attribute `textfile`"
        elif name == "textfile" and _is_xacro(_default(attribute.value, defaults), model):
            yield attribute, '`textfile` loads xacro without expanding it; use `command="xacro …"`'


def _is_of_type(text: str, kind: str) -> bool:
    """Return whether roslaunch converts a text to a type (roslaunch, loader.py: ``int(value)``, ``float(value)``)."""
    if kind in ("bool", "boolean"):
        return text.strip().lower() in _TRUTH
    try:
        {"int": int, "double": float}.get(kind, str)(text)
    except ValueError:
        return False
    return True


def _default(text: str, defaults: dict[str, str]) -> str:
    """Return the default of an argument; other texts as they are."""
    use = re.fullmatch(r"\s*\$\(arg\s+([\w-]+)\s*\)\s*", text)
    return defaults.get(use[1], text) if use is not None else text


def _is_xacro(text: str, model: Model) -> bool:
    """Return whether a path names a file of this workspace that uses xacro."""
    from urdfkit.lint.project.description_files import SUFFIXES, text_of

    model.watch(*SUFFIXES)
    package, path = share_of(text)
    folder = neighbours(model.package).get(package) if model.package is not None else None
    return folder is not None and is_file(folder / path) and "<xacro:" in text_of(folder / path)


def _is_description(attributes: dict[str, Attribute]) -> bool:
    name = attributes["name"].value if "name" in attributes else ""
    return name.endswith(("robot_description", "robot_description_semantic", "_semantic"))
