"""Actions of a launch file: declared and used arguments, includes, xacro commands and nodes, with their positions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.yaml_tree import Node, documents, start_of
from urdfkit.lint.facts.launch.records import WITHOUT_COLON, Call, Declared, Executable, LaunchActions
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record

_FIND = r"\$\(find(?:-pkg-share)?\s+([^\s()]+)\s*\)"
_USED = r"\$\((?:arg|var)\s+([\w.-]+)(?:\s+[\w.-]+)?\s*\)|\$\(eval\b[^()]*\barg\(\s*['\"]([\w.-]+)['\"]\s*\)"
_XACRO = r"(?<![\w.])xacro(?:\.py)?['\"]?(?![\w/])(.*)"
_ARGUMENT = r"\s*['\"]?\$\((?:arg|var)\s+([\w.-]+)\s*\)['\"]?\s*"
_PASSED = r"([\w.-]+):="


@record(eq=False)
class LaunchAction:
    """An element of an XML launch file, or the same action in YAML."""

    tag: str
    start: int
    end: int
    attributes: dict[str, Named]
    children: tuple[LaunchAction, ...]


def launch_files(model: Model) -> Iterator[LaunchActions]:
    """Yield the launch files of the robot's package and of related packages."""
    for name, source in model.related_files.items():
        if name.endswith(LAUNCH):
            yield actions_of(source)


def actions_of(source: Source) -> LaunchActions:
    """Return the actions of a launch file; empty if it cannot be parsed, or is nested too deeply."""
    is_xml = source.file.endswith((".launch", ".xml"))
    return _actions(source, is_xml and reads_ros1(source))


@lru_cache(maxsize=400)
def _actions(source: Source, is_ros1: bool) -> LaunchActions:
    try:
        return _actions_of(source, is_ros1)
    except RecursionError:
        return LaunchActions(source, is_ros1)


def _actions_of(source: Source, is_ros1: bool) -> LaunchActions:
    if source.file.endswith(".py"):
        from urdfkit.lint.facts.launch.python.actions import read_python

        return read_python(source)
    text = uncommented(source)
    found = LaunchActions(source, is_ros1)
    roots = _elements(source)
    for use in re.finditer(_USED, text):
        group = 1 if use[1] is not None else 2
        found.used.append((Named(use[group], use.start(group)), False))
    for root in roots:
        _read(root, found, False)
    return found


@lru_cache(maxsize=400)
def roots_of(source: Source) -> tuple[LaunchAction, ...]:
    """Return the outermost elements of an XML or YAML launch file; empty if they are nested too deeply."""
    try:
        return _elements(source)
    except RecursionError:
        return ()


def all_elements(source: Source) -> Iterator[LaunchAction]:
    """Yield the elements of an XML or YAML launch file with those inside them, in document order."""
    waiting = list(reversed(roots_of(source)))
    while waiting:
        element = waiting.pop()
        yield element
        waiting += reversed(element.children)


def launch_elements(model: Model, words: Iterable[str] = ("",)) -> Iterator[tuple[Source, LaunchAction]]:
    """Yield the elements of the launch files in XML and YAML that contain one of some words."""
    for source in model.related_files.values():
        is_launch = source.file.endswith(LAUNCH) and not source.file.endswith(".py")
        if is_launch and any(word in source.text for word in words):
            yield from ((source, element) for element in all_elements(source))


def _elements(source: Source) -> tuple[LaunchAction, ...]:
    if source.file.endswith((".yaml", ".yml")):
        return tuple(_from_yaml(source))
    return tuple(_from_tag(tag) for tag in Document(source).roots)


@lru_cache(maxsize=400)
def _values(source: Source) -> dict[str, str]:
    """Return the values of the arguments of a launch file that are paths in packages and that no file can change.

    These are those of ``<let>``, and in ROS 1 the ``value`` of ``<arg>``.
    """
    found: dict[str, str] = {}
    for element in all_elements(source):
        name, value = (element.attributes.get(key) for key in ("name", "value"))
        if element.tag in ("let", "arg") and name is not None and value is not None and re.match(_FIND, value.name):
            found[name.name] = value.name if name.name not in found else ""
    return {name: value for name, value in found.items() if value}


def resolved_text(source: Source, text: str) -> str:
    """Return a text of a launch file with the constant paths in packages that its arguments have."""
    if "$(" not in text:
        return text
    values = _values(source)
    return re.sub(r"\$\((?:arg|var)\s+([\w.-]+)\s*\)", lambda use: values.get(use[1], use[0]), text) if values else text


def share_of(text: str) -> tuple[str, str]:
    """Return package and path of a text like ``$(find package)/launch/x.launch``; empty if they are computed."""
    match = re.fullmatch(rf"\s*['\"]?{_FIND}/([^$\"']+?)['\"]?\s*", text)
    return (match[1], match[2]) if match else ("", "")


def is_used(name: str, file: LaunchActions) -> bool:
    """Return whether a launch file uses an argument, also in a Python expression."""
    expression = rf"\$\(eval\b[^<]*(?<!\w){re.escape(name)}(?!\w)"
    return any(name == use.name for use, _ in file.used) or re.search(expression, file.source.text) is not None


def _read(action: LaunchAction, found: LaunchActions, is_conditional: bool) -> None:
    at, tag = action.attributes, action.tag
    is_conditional |= "if" in at or "unless" in at
    name = at.get("name")
    if tag == "arg" and name is not None:
        is_fixed = "value" in at
        declared = Declared(name, not is_fixed and "default" not in at, is_fixed)
        found.declared.setdefault(name.name, declared)
        default = at.get("value") or at.get("default")
        if default is not None:
            found.defaults.setdefault(name.name, default.name)
    elif tag in ("let", "set_launch_configuration", "set_var") and name is not None:
        found.assigned.add(name.name)
    elif tag == "include":
        package, path = share_of(resolved_text(found.source, at["file"].name) if "file" in at else "")
        passed = [child.attributes["name"] for child in action.children if _passes(child)]
        is_all = "pass_all_args" in at
        call = Call(package, path, action.start, action.end, tuple(passed), is_all, is_conditional=is_conditional)
        found.includes.append(call)
        return
    elif tag in ("node", "composable_node", "node_container") and "pkg" in at:
        program = at.get("type") or at.get("exec")
        literal = [one if one is not None and "$" not in one.name else None for one in (at["pkg"], program)]
        found.nodes.append(Executable(*literal))
    for one in at.values():
        if "xacro" in one.name and (command := re.search(_XACRO, one.name, re.DOTALL)) is not None:
            words = [word for word in _words(resolved_text(found.source, command[1])) if ":=" not in word]
            defaults = [found.defaults.get(use[1], "") for word in words if (use := re.fullmatch(_ARGUMENT, word))]
            package, path = next((share for word in (*words, *defaults) if (share := share_of(word))[0]), ("", ""))
            start = one.start + command.start(1)
            passed = [Named(word[1], start + word.start(1)) for word in re.finditer(_PASSED, command[1])]
            end = start + len(command[1])
            malformed = [Named(word[1], start + word.start(1)) for word in re.finditer(WITHOUT_COLON, command[1])]
            found.xacro.append(Call(package, path, start, end, tuple(passed), bool(defaults), tuple(malformed)))
    for child in action.children:
        _read(child, found, is_conditional)


def _passes(child: LaunchAction) -> bool:
    return child.tag in ("arg", "let") and "name" in child.attributes


def _words(text: str) -> list[str]:
    """Return the words of a command; substitutions may contain blanks."""
    return re.findall(r"(?:\$\([^()]*\)|[^\s$]|\$)+", text)


def _from_tag(tag: Tag) -> LaunchAction:
    attributes = {name: Named(each.value, each.value_start) for name, each in tag.attributes.items()}
    return LaunchAction(tag.name, tag.start, tag.end, attributes, tuple(_from_tag(child) for child in tag.children))


def _from_yaml(source: Source) -> Iterator[LaunchAction]:
    for document in documents(source):
        launch = document.find("launch")
        if launch is not None:
            for item in launch.items:
                yield from (_from_node(source, key, value) for key, value in item.entries)


def _from_node(source: Source, key: Node, value: Node) -> LaunchAction:
    start = start_of(source, key)
    attributes: dict[str, Named] = {}
    children: list[LaunchAction] = []
    for name, each in value.entries:
        if each.kind == "text":
            attributes[name.text] = Named(each.text, start_of(source, each))
        else:
            for item in each.items if each.kind == "list" else (each,):
                children.append(_from_node(source, name, item))
    if value.kind == "list":  # a group
        for item in value.items:
            children += [_from_node(source, inner, each) for inner, each in item.entries]
    return LaunchAction(key.text, start, start + len(key.text), attributes, tuple(children))
