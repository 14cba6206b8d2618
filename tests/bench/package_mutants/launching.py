"""Mistakes in launch files: XML of ROS 1, XML and Python of ROS 2."""

from __future__ import annotations

import ast
import random
import re
from collections.abc import Iterator

from tests.bench.package_mutants.mutant import (
    Mutant,
    Workspace,
    attribute,
    element,
    kind,
    literal,
    match,
    renamed_tag,
    typo,
    value,
    wrong_name,
)
from urdfkit.lint.model.tags import Tag

_LAUNCH = kind("launch")
_XML = r"/launch/[\w.]+\.(launch|launch\.xml)$"
PYTHON = r"/launch/[\w.]+\.launch\.py$"
_ANY = r"/launch/"
Mutants = Iterator[Mutant]


def call_at(text: str, at: int) -> tuple[int, int]:
    """Return the offsets of the smallest call of a Python file that holds an offset."""
    lines = [0]
    for line in text.splitlines(keepends=True):
        lines.append(lines[-1] + len(line))
    best = (0, len(text))
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call | ast.Assign | ast.Import | ast.ImportFrom | ast.Return):
            start = lines[node.lineno - 1] + node.col_offset
            end = lines[(node.end_lineno or node.lineno) - 1] + (node.end_col_offset or 0)
            if start <= at <= end and end - start < best[1] - best[0] and end - start > 40:
                best = start, end
    return best


def python(ws: Workspace, pattern: str) -> Iterator[tuple[str, re.Match[str]]]:
    for file, text in ws.of(PYTHON):
        for found in re.finditer(pattern, text):
            yield file, found


def edited(ws: Workspace, file: str, found: re.Match[str], new: str, group: int = 0, **more: object) -> Mutant:
    return match(file, found, new, group, around=call_at(ws.files[file], found.start(group)), **more)


def _attributes(ws: Workspace, pattern: str) -> Iterator[tuple[str, Tag, str, re.Match[str]]]:
    """Yield the places of attributes of XML launch files that a pattern finds."""
    for file, tag in ws.tags(_XML):
        for name, written in tag.attributes.items():
            for found in re.finditer(pattern, written.value):
                yield file, tag, name, found


def _part(file: str, tag: Tag, name: str, found: re.Match[str], new: str, group: int = 1, **more: object) -> Mutant:
    start = tag.attributes[name].value_start
    whole = (tag.start, tag.end)
    return Mutant(file, start + found.start(group), start + found.end(group), new, None, whole, **more)  # type: ignore[arg-type]


@_LAUNCH
def node_package_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The package of the node is not found."""
    for file, tag in ws.tags(_XML, "node"):
        if literal(tag, "pkg"):
            yield wrong_name(file, tag, "pkg", typo(literal(tag, "pkg"), lot))
    for file, found in python(ws, r'package="(\w+)"'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,))


@_LAUNCH
def executable_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The package has no such executable."""
    for file, tag in ws.tags(_XML, "node"):
        for name in ("type", "exec"):
            if literal(tag, name):
                yield wrong_name(file, tag, name, typo(literal(tag, name), lot))
    for file, found in python(ws, r'executable="([\w.]+)"'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,))


@_LAUNCH
def found_package_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The package of the file is not found."""
    for file, tag, name, found in _attributes(ws, r"\$\(find(?:-pkg-share)? (\w+)\)"):
        wrong = typo(found[1], lot)
        yield _part(file, tag, name, found, wrong, names=(wrong,))
    for file, found in python(ws, r'(?:FindPackageShare|get_package_share_directory)\("(\w+)"\)'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,))


@_LAUNCH
def file_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The file is not found."""
    for file, tag, name, found in _attributes(ws, r"/([\w.]+)\.(?:launch|xml|yaml|xacro|rviz|world|srdf)\b"):
        wrong = typo(found[1], lot)
        yield _part(file, tag, name, found, wrong, names=(f"{wrong}{found[0][len(found[1]) + 1 :]}",))
    for file, found in python(ws, r'"(?:[\w/]+/)?(\w+)(?:\.\w+)?\.(?:py|yaml|xacro|rviz|world|srdf|sdf)"'):
        if "/" not in found[0] or "config/" in found[0]:
            wrong = typo(found[1], lot)
            yield edited(ws, file, found, wrong, 1, names=(found[0].strip('"').replace(found[1], wrong), wrong))


@_LAUNCH
def folder_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The file is in another folder."""
    for file, tag, name, found in _attributes(ws, r"\)/(config|launch|urdf|rviz|worlds)/([\w.]+)"):
        wrong = lot.choice([typo(found[1], lot), "params", "cfg"])
        yield _part(file, tag, name, found, wrong, names=(f"{wrong}/{found[2]}", wrong, found[2]))
    for file, found in python(ws, r'"(config|launch|urdf|rviz|worlds)", "?([\w.]+)"?'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong, found[2]))


@_LAUNCH
def undeclared_argument(ws: Workspace, lot: random.Random) -> Mutants:
    """The argument is not declared: launch stops."""
    for file, tag, name, found in _attributes(ws, r"\$\((?:arg|var) (\w+)\)"):
        wrong = typo(found[1], lot).replace("-", "")
        yield _part(file, tag, name, found, wrong, names=(wrong,))
    for file, found in python(ws, r'LaunchConfiguration\("(\w+)"\)'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong, found[1]), uses=True)


@_LAUNCH
def renamed_argument(ws: Workspace, lot: random.Random) -> Mutants:
    """An argument is declared under another name than it is used."""
    for file, tag in ws.tags(_XML, "arg"):
        name = literal(tag, "name")
        if tag.parent is not None and tag.parent.name == "launch" and re.search(rf"(arg|var) {name}\)", ws.files[file]):
            yield wrong_name(file, tag, "name", typo(name, lot).replace("-", ""), uses=True)
    for file, found in python(ws, r'DeclareLaunchArgument\("(\w+)"'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong, found[1]), uses=True)


@_LAUNCH
def argument_declaration_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The argument that is used is not declared."""
    for file, tag in ws.tags(_XML, "arg"):
        name = literal(tag, "name")
        if tag.parent is not None and tag.parent.name == "launch" and re.search(rf"(arg|var) {name}\)", ws.files[file]):
            yield element(file, tag, names=(name,), uses=True)
    for file, found in python(ws, r' *DeclareLaunchArgument\("(\w+)"[^\n]*\),\n'):
        yield edited(ws, file, found, "", names=(found[1],), uses=True)


@_LAUNCH
def argument_the_receiver_lacks(ws: Workspace, lot: random.Random) -> Mutants:
    """The included file does not declare the argument."""
    for file, tag in ws.tags(_XML, "arg"):
        if tag.parent is not None and tag.parent.name == "include":
            yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot))
    for file, found in python(ws, r'launch_arguments=\{"(\w+)":'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,))


@_LAUNCH
def required_argument_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The included file needs the argument."""
    for file, tag in ws.tags(_XML, "arg"):
        if (
            tag.parent is not None
            and tag.parent.name == "include"
            and "upload.launch" in literal_of(tag.parent, "file")
        ):
            yield element(file, tag, names=(literal(tag, "name"),))
    for file, tag in ws.tags(_XML, "arg"):
        if tag.parent is not None and tag.parent.name == "launch" and literal(tag, "default"):
            others = _includers(ws, file)
            if others and not any(f'"{literal(tag, "name")}"' in text for text in others):
                yield Mutant(
                    file, tag.start, tag.close_end, f'<arg name="{literal(tag, "name")}"/>', None,
                    (tag.start, tag.end), (literal(tag, "name"), file.rpartition("/")[2]), uses=True,
                )  # fmt: skip


def _includers(ws: Workspace, file: str) -> list[str]:
    """Return the texts of the launch files that include a file."""
    package, _, path = file.partition("/")
    return [text for _, text in ws.of(_XML) if re.search(rf"{package}\)/{re.escape(path)}\"", text)]


def literal_of(tag: Tag, name: str) -> str:
    """Return the source text of an attribute."""
    written = tag.attributes.get(name)
    return written.value if written is not None else ""


@_LAUNCH
def xacro_argument_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The description does not declare the argument, so the value has no effect."""
    for file, tag, name, found in _attributes(ws, r"(\w+):="):
        wrong = typo(found[1], lot)
        yield _part(file, tag, name, found, wrong, names=(wrong,))
    for file, found in python(ws, r'" ?(\w+):="'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,))


@_LAUNCH
def unknown_controller(ws: Workspace, lot: random.Random) -> Mutants:
    """The spawner waits for a controller that is not configured."""
    for file, tag, name, found in _attributes(ws, r"\b(\w+_(?:controller|broadcaster))\b"):
        if name == "args":
            wrong = typo(found[1], lot)
            yield _part(file, tag, name, found, wrong, names=(wrong,))
    for file, found in python(ws, r'"(\w+_(?:controller|broadcaster))"'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,))


@_LAUNCH
def wrong_namespace(ws: Workspace, lot: random.Random) -> Mutants:
    """The node expects its controllers or its description in another namespace."""
    for file, tag in ws.tags(_XML, "node"):
        if "ns" in tag.attributes:
            yield wrong_name(file, tag, "ns", typo(literal(tag, "ns"), lot))
            yield attribute(file, tag, "ns", "")
    for file, found in python(ws, r'"/(controller_manager)"'):
        for _ in range(2):
            wrong = typo(found[1], lot)
            yield edited(ws, file, found, wrong, 1, names=(f"/{wrong}",))


@_LAUNCH
def description_parameter_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The nodes read robot_description, which is not set."""
    for file, tag in ws.tags(_XML, "param"):
        if literal(tag, "name") == "robot_description":
            yield wrong_name(file, tag, "name", typo("robot_description", lot), uses=True)
    for file, found in python(ws, r'"(robot_description)":'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,), uses=True)


@_LAUNCH
def description_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The parameter robot_description is not set."""
    for file, tag in ws.tags(_XML, "param"):
        if (
            "robot_description" in literal_of(tag, "name")
            and "command" in tag.attributes
            and "if" not in tag.attributes
        ) or literal(tag, "name") == "robot_description":
            yield element(file, tag, anywhere=True, names=("robot_description",), uses=True)
    for file, found in python(
        ws, r" *\{\"robot_description\": ParameterValue[^\n]*\n|parameters=\[\{?\"?robot_description[^\n]*\n"
    ):
        yield edited(
            ws, file, found, "\n" if "parameters" in found[0] else "", names=("robot_description",), anywhere=True
        )


@_LAUNCH
def spawner_reads_other_source(ws: Workspace, lot: random.Random) -> Mutants:
    """The spawner reads a parameter or a topic that does not exist, or nothing."""
    for file, tag, name, found in _attributes(ws, r"-param (robot_description)"):
        wrong = typo(found[1], lot)
        yield _part(file, tag, name, found, wrong, names=(wrong,))
    for file, tag, name, found in _attributes(ws, r"(-param) robot_description"):
        yield _part(file, tag, name, found, lot.choice(["-params", "-parameter"]))
    for file, found in python(ws, r'"-topic", "(robot_description)"'):
        wrong = typo(found[1], lot)
        yield edited(ws, file, found, wrong, 1, names=(wrong,))
    for file, found in python(ws, r' *"-topic", "robot_description",\n'):
        yield edited(ws, file, found, "")


@_LAUNCH
def unknown_initial_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """The spawner sets a joint that the robot does not have."""
    for file, tag, name, found in _attributes(ws, r"-J (\w+)"):
        wrong = typo(found[1], lot, ws.joints)
        yield _part(file, tag, name, found, wrong, names=(wrong,))


@_LAUNCH
def parameters_not_loaded(ws: Workspace, lot: random.Random) -> Mutants:
    """The controllers have no parameters."""
    for file, tag in ws.tags(_XML, "rosparam", "param"):
        if "controllers.yaml" in literal_of(tag, "file") + literal_of(tag, "from"):
            yield element(
                file, tag, anywhere=True, names=("arm_controller", "controllers.yaml", "controller_spawner"), uses=True
            )
    for file, found in python(ws, r" *parameters=\[robot_controllers\],\n"):
        yield edited(ws, file, found, "", anywhere=True)


@_LAUNCH
def attribute_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """launch stops: the attribute is unknown."""
    for file, tag in ws.tags(_XML):
        for name in tag.attributes:
            if tag.name in ("node", "include", "param", "rosparam", "arg", "remap", "group"):
                yield attribute(file, tag, name, typo(name, lot))


@_LAUNCH
def required_attribute_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """launch stops: the element needs the attribute."""
    needed = {"node": ("pkg", "type", "exec"), "include": ("file",), "arg": ("name",), "remap": ("from", "to")}
    for file, tag in ws.tags(_XML, *needed):
        for name in needed[tag.name]:
            if name in tag.attributes:
                yield attribute(file, tag, name, "")
        if ws.ros == 1 and tag.name == "node":
            yield attribute(file, tag, "name", "")


@_LAUNCH
def element_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The element is unknown: its node, file or parameter is lost, or launch stops."""
    for file, tag in ws.tags(_XML):
        if tag.name not in ("launch", "group"):
            yield renamed_tag(file, tag, typo(tag.name, lot))


@_LAUNCH
def no_xml(ws: Workspace, lot: random.Random) -> Mutants:
    """The file is no XML."""
    for file, tag in ws.tags(_XML):
        text = ws.files[file]
        whole = (tag.start, len(text))
        if tag.empty:
            yield Mutant(file, tag.end - 2, tag.end, ">", (tag.start, tag.end), whole)
        elif tag.close is not None and tag.name != "launch":
            yield Mutant(file, tag.close, tag.close_end, "", (tag.start, tag.end), whole)


@_LAUNCH
def value_and_default(ws: Workspace, lot: random.Random) -> Mutants:
    """An argument with a value cannot be set from outside; an include does not take a default."""
    for file, tag in ws.tags(_XML, "arg"):
        if tag.parent is not None and tag.parent.name == "launch" and "default" in tag.attributes and ws.ros == 1:
            name = literal(tag, "name")
            others = _includers(ws, file)
            if any(f'<arg name="{name}" value' in text for text in others):
                whole = tag.attributes["default"]
                yield Mutant(
                    file, whole.start, whole.start + 7, "value", None, (tag.start, tag.end), (name,), uses=True
                )
        if tag.parent is not None and tag.parent.name == "include" and "value" in tag.attributes:
            yield element(file, tag, f'<arg name="{literal(tag, "name")}"/>')


@_LAUNCH
def two_nodes_of_one_name(ws: Workspace, lot: random.Random) -> Mutants:
    """Of two nodes of one name in one namespace the first is shut down."""
    for file, tag in ws.tags(_XML, "node"):
        names = [
            literal(o, "name")
            for _, o in ws.tags(re.escape(file), "node")
            if o is not tag and not o.attributes.get("if") and literal(o, "ns") == literal(tag, "ns")
        ]
        mine = literal(tag, "name")
        names = [name for name in names if name and name != mine]
        if names and mine and "if" not in tag.attributes and "unless" not in tag.attributes:
            yield wrong_name(file, tag, "name", lot.choice(names), uses=True)


@_LAUNCH
def condition_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The condition is neither true nor false."""
    for file, tag in ws.tags(_XML):
        for name in ("if", "unless"):
            if name in tag.attributes:
                yield value(file, tag, name, lot.choice(["yes", "$arg gui", "ture"]))
    for file, found in python(ws, r"condition=(IfCondition)\("):
        yield edited(ws, file, found, lot.choice(["IfCondtion", "LaunchCondition", "Condition"]), 1)


@_LAUNCH
def words_of_other_ros(ws: Workspace, lot: random.Random) -> Mutants:
    """The words of ROS 1 in ROS 2, or the reverse: launch stops."""
    for file, tag in ws.tags(_XML, "node"):
        old, new = ("type", "exec") if ws.ros == 1 else ("exec", "type")
        yield attribute(file, tag, old, new)
    for file, tag, name, found in _attributes(ws, r"\$\((find-pkg-share|find|var|arg) \w+\)"):
        other = {"find-pkg-share": "find", "find": "find-pkg-share", "var": "arg", "arg": "var"}[found[1]]
        yield _part(file, tag, name, found, other, names=(other,))


@_LAUNCH
def remap_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The node subscribes to a topic that is not published."""
    for file, tag in ws.tags(_XML, "remap"):
        for name in ("from", "to"):
            written = literal_of(tag, name)
            word = next((each for each in ("joint_states", "robot_description") if each in written), "")
            if word:
                yield wrong_name(file, tag, name, written.replace(word, typo(word, lot)))


@_LAUNCH
def rosparam_misused(ws: Workspace, lot: random.Random) -> Mutants:
    """The parameters are not loaded, or into another namespace."""
    for file, tag in ws.tags(_XML, "rosparam"):
        if "command" in tag.attributes:
            yield value(file, tag, "command", lot.choice(["laod", "dump", "read"]))
    for file, tag in ws.tags(_XML, "param"):
        if "textfile" in tag.attributes:
            yield attribute(file, tag, "textfile", "value")
        elif "command" in tag.attributes and ws.ros == 1:
            yield attribute(file, tag, "command", lot.choice(["textfile", "value"]))
