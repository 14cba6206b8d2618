"""Publishers and subscribers in the code of a workspace, with the topics that parameters and remappings set.

The calls are those of rclpy, rospy, rclcpp and roscpp.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import start_of, yamls
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes
from urdfkit.lint.facts.topics.own_nodes import CLIENTS
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts, python_tree
from urdfkit.record import record

_OTHER = (
    r"image_transport|point_cloud_transport|generic_publisher|generic_subscription|AdvertiseOptions|rosbag|topic_tools"
)
"""Matches code with publishers that this module does not read."""

_CALLS = {
    **dict.fromkeys(("create_publisher", "create_lifecycle_publisher"), ("msg_type", "topic", True)),
    "create_subscription": ("msg_type", "topic", False),
    "Publisher": ("data_class", "name", True),
    "Subscriber": ("data_class", "name", False),
}
"""Function or class → keyword of the type and of the topic, and whether it publishes."""

_IN_CPP = (
    r"\b(create_publisher|create_lifecycle_publisher|create_subscription|advertise|subscribe)\b\s{0,40}"
    r"(?:<([\w:\s]{1,200})>)?\s{0,40}\(\s{0,40}(?:\"([\w/~]+)\"\s{0,40}[,)])?"
)
_VALUES = ("get_parameter_value", "as_string", "str")
_NAMED = (
    r"(?:super\(\)\.__init__|super\(\w+, self\)\.__init__|create_node|init_node|:\s{0,20}(?:rclcpp::)?Node)"
    r"\s{0,9}\(\s{0,9}[\"'](\w+)[\"']"
)
"""Matches the name that the code gives its node."""

_PRIVATE = (
    r"\b(\w+)\s{0,9}[({]\s{0,9}\"~\"\s{0,9}[)}]|\b(\w+)\s{0,9}=\s{0,9}(?:\w+(?:\.|->))?getPrivateNodeHandle\("
    r"|\b(\w+)\s{0,9}=\s{0,9}ros::NodeHandle\s{0,9}\(\s{0,9}\"~\""
)
"""Matches a node handle of roscpp for private names."""

_MAX_FILES = 60


@record(eq=False)
class End:
    """A publisher or subscriber in the code of a node.

    Attributes:
        path: the file of the code.
        type: type of the messages without its package; empty if it is unknown.
        topic: the topic without slashes at its ends; empty if it is computed.
        source: the file that names the topic: the code, or the parameter or launch file that sets it.
        start: offset of the topic in it.
        end: offset after the topic.
        publishes: whether it publishes.
        is_launched: whether a launch file starts a node of the package.
        is_private: whether its topic is in the namespace of its own node.
    """

    path: Path
    type: str
    topic: str
    source: Source
    start: int
    end: int
    publishes: bool
    is_launched: bool
    is_private: bool = False


def own_ends(model: Model) -> list[End] | None:
    """Return the publishers and subscribers in the code of the workspace; None if its code has others."""
    found: list[End] = []
    nodes = launched_nodes(model)
    folders = neighbours(model.package) if model.package is not None else {}
    related = {str(Path(file).absolute().parent) for file in model.related_files if file.endswith("package.xml")}
    for package, folder in folders.items():
        if str(folder.absolute()) not in related:
            continue
        model.expanded.packages.watch(folder)
        own = [node for node in nodes if node.package == package]
        for count, (path, text) in enumerate(node_texts(folder)):
            if count > _MAX_FILES or re.search(_OTHER, text):
                return None
            if re.search(CLIENTS, text) and not {"test", "tests"} & {*path.relative_to(folder).parts}:
                source = Source(shown_path(path), text)
                ends = _in_python(path, source) if path.suffix == ".py" else _in_cpp(path, source)
                name = re.search(_NAMED, text)
                found += (each for end in ends for each in _placed(end, name, own, model))
    return found


def _placed(end: tuple[End, str], name: re.Match[str] | None, own: list[LaunchedNode], model: Model) -> Iterator[End]:
    """Yield an end for each topic that it has in the launched nodes of its package."""
    written, parameter = end
    names = [node.name.name for node in own if node.name is not None]
    if name is not None and (name[1] in names or len(names) < len(own) or not own):
        names = [name[1]]
    settings = list(_settings(parameter, names, model)) if parameter else []
    base = [_with(written, value.strip("/"), source, start, stop) for value, source, start, stop in settings]
    for one in base or [written]:
        moved = [
            _with(one, new.name.strip("/"), node.source, new.start, new.end)
            for node in own
            for old, new in node.remappings
            if one.topic and old.name.removeprefix("~").strip("/") == one.topic.removeprefix("~").strip("/")
        ]
        for each in moved or [one]:
            if each.topic.startswith("~"):
                topics = [f"{space}{each.topic[1:]}" for space in names]
                found = [_with(each, topic, each.source, each.start, each.end) for topic in topics or [""]]
                yield from (End(**{**one.__dict__, "is_private": True}) for one in found)
            else:
                yield _with(each, each.topic, each.source, each.start, each.end, bool(own))


def _with(end: End, topic: str, source: Source, start: int, stop: int, is_launched: bool = True) -> End:
    return End(end.path, end.type, topic, source, start, stop, end.publishes, is_launched)


def _settings(parameter: str, names: list[str], model: Model) -> Iterator[tuple[str, Source, int, int]]:
    """Yield the values of a parameter in the sections of nodes, with their places."""
    for source in yamls(model) if names else ():
        for key, group in sections(source) if parameter in source.text else ():
            value = group.find(parameter) if key.last_name in names else None
            if value is not None and value.text:
                start = start_of(source, value)
                yield value.text, source, start, start + len(value.text)


def _in_python(path: Path, source: Source) -> Iterator[tuple[End, str]]:
    """Yield each end with its topic by default, and the parameter that sets it."""
    tree = python_tree(source.text)
    if tree is None:
        return
    reader = launch_reader(tree)
    kept = attributes(tree)
    defaults = _defaults(tree, reader)
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call) and name_of(node.func) in _CALLS):
        kind_word, topic_word, publishes = _CALLS[name_of(call.func)]
        of_node = kind_word == "msg_type"
        owner = getattr(call.func, "value", None)
        if not of_node and owner is not None and getattr(owner, "id", "") != "rospy":
            continue
        words = {word.arg: word.value for word in call.keywords}
        first, second = [*call.args, None, None][:2]
        kind = words.get(kind_word, first if of_node else second)
        topic = words.get(topic_word, second if of_node else first)
        value, parameter = _value(topic, reader, kept)
        at = value
        text = reader.text(value) if value is not None else None
        if parameter and (default := defaults.get(parameter)) is not None:
            at, text = default, reader.text(default)
        start, end = place(source, at) if at is not None and text is not None else place(source, call)
        offset = max(source.text[start:end].find(text or ""), 0)
        name = name_of(kind) if kind is not None else ""
        yield (
            End(
                path,
                name,
                (text or "").strip("/"),
                source,
                start + offset,
                start + offset + len(text or ""),
                publishes,
                False,
            ),
            parameter,
        )


def attributes(tree: ast.Module) -> dict[str, ast.expr]:
    """Return attribute of ``self`` → its value, of the attributes that are assigned once."""
    found: dict[str, list[ast.expr]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and len(node.targets) == 1 and isinstance(node.targets[0], ast.Attribute):
            found.setdefault(node.targets[0].attr, []).append(node.value)
    return {name: values[0] for name, values in found.items() if len(values) == 1}


def _defaults(tree: ast.Module, reader: LaunchReader) -> dict[str, ast.expr]:
    """Return name → default of the parameters that a file declares."""
    found: dict[str, ast.expr] = {}
    for node in ast.walk(tree):
        pair = node.args if isinstance(node, ast.Call) and name_of(node.func) == "declare_parameter" else []
        pair = node.elts if isinstance(node, ast.Tuple) else pair
        name = reader.text(pair[0]) if len(pair) >= 2 else None
        if name is not None:
            found[name] = pair[1]
    return found


def _value(node: ast.expr | None, reader: LaunchReader, kept: dict[str, ast.expr]) -> tuple[ast.expr | None, str]:
    """Return the expression of a topic, and the parameter that has it; empty without one."""
    for _ in range(8):
        if isinstance(node, ast.Name) and node.id in reader.assigned:
            node = reader.assigned[node.id]
        elif isinstance(node, ast.Attribute) and node.attr in ("value", "string_value"):
            node = node.value
        elif isinstance(node, ast.Attribute) and node.attr in kept:
            node = kept[node.attr]
        elif isinstance(node, ast.Call) and name_of(node.func) in _VALUES:
            node = node.args[0] if node.args else getattr(node.func, "value", None)
        else:
            break
    if isinstance(node, ast.Call) and node.args and name_of(node.func) in ("get_parameter", "declare_parameter"):
        return node, reader.text(node.args[0]) or ""
    return node, ""


def _in_cpp(path: Path, source: Source) -> Iterator[tuple[End, str]]:
    private = {name for at in re.findall(_PRIVATE, source.text) for name in at if name}
    for at in re.finditer(_IN_CPP, source.text):
        kind = (at[2] or "").strip().rpartition("::")[2]
        publishes = at[1] in ("create_publisher", "create_lifecycle_publisher", "advertise")
        if at[2] is None and at[1] not in ("subscribe", "advertise"):
            continue
        start, end = at.span(3) if at[3] else at.span(1)
        topic = (at[3] or "").strip("/")
        handle = re.search(r"(\w+)\s*(?:\.|->)\s*\Z", source.text[max(at.start() - 60, 0) : at.start()])
        if topic and handle is not None and handle[1] in private and not at[3].startswith(("/", "~")):
            topic = f"~/{topic}"
        yield End(path, kind, topic, source, start, end, publishes, False), ""
