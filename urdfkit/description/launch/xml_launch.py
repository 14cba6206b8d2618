"""ROS 1 launch files and ROS 2 XML and YAML launch files."""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.control.settings import Settings
from urdfkit.description.launch.launch_scope import (
    MAX_TEXT,
    UNKNOWN,
    LaunchNode,
    LaunchScope,
    PlacedText,
    is_false,
    is_true,
)
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Origin

_SUBSTITUTION = re.compile(r"\$\(\s*([\w-]+)([^$()]*)\)")
_COMMAND = re.compile(r"\$\(\s*command\s+(?:'([^']*)'|\"([^\"]*)\"|([^'\"].*)\))", re.DOTALL)
_MAX_SUBSTITUTIONS = 100
_NODES = ("node", "lifecycle_node", "node_container")


def read_elements(elements: list[Element], scope: LaunchScope) -> None:
    """Read the actions of a launch file in order.

    Args:
        elements: the actions.
        scope: its arguments, and the record of its contents.
    """
    outer = scope.namespace, scope.is_skipped, scope.spaced_at
    for element in elements:
        scope.is_skipped = outer[1] or is_false(_text(element, "if", scope)) or is_true(_text(element, "unless", scope))
        tag, name = element.tag, element.get("name") or ""
        if tag in ("push_ros_namespace", "push-ros-namespace"):
            if not scope.is_skipped:
                scope.namespace, scope.spaced_at = scope.below(_text(element, "namespace", scope)), _at(element, scope)
            continue
        namespace = scope.namespace, scope.spaced_at
        if space := _text(element, "ns", scope) or (_text(element, "namespace", scope) if tag in _NODES else ""):
            scope.namespace, scope.spaced_at = scope.below(space), _at(element, scope)
        _read_element(element, tag, name, scope)
        scope.namespace, scope.spaced_at = namespace
    scope.namespace, scope.is_skipped, scope.spaced_at = outer


def _at(element: Element, scope: LaunchScope) -> tuple[Path, int, int]:
    position = element.origin.position
    return scope.path, position.line, position.column


def _read_element(element: Element, tag: str, name: str, scope: LaunchScope) -> None:
    """Read an action whose namespace is that of the scope."""
    if tag in ("arg", "let") and "value" in element.attributes:
        if not scope.is_skipped:
            scope.arguments[name] = _text(element, "value", scope)
    elif tag == "arg":
        default = _text(element, "default", scope) if "default" in element.attributes else UNKNOWN
        scope.declare(name, default, element.get("description") or element.get("doc") or "")
    elif tag == "include":
        scope.include(_text(element, "file", scope), dict(_included_arguments(element, scope)))
    elif tag == "param":
        if "command" in element.attributes:
            scope.command(_text(element, "command", scope))
        for found in _COMMAND.finditer(element.get("value") or ""):
            scope.command(_substituted(next(text for text in found.groups() if text is not None), scope))
    elif tag == "executable":
        for program in _text(element, "cmd", scope).split()[:1]:
            scope.start(program)
    elif tag in (*_NODES, "group", "launch", "composable_node"):
        scope.start(_text(element, "pkg", scope))
        if tag in _NODES:
            scope.found.nodes.append(_node(element, scope))
        read_elements(element.children, scope)


def _node(element: Element, scope: LaunchScope) -> LaunchNode:
    position = element.origin.position
    words = (_text(element, "args", scope) or _text(element, "ros_args", scope)).split()
    children = [child for child in element.children if child.tag in ("remap", "param", "rosparam")]
    paths = [_text(child, "from", scope) for child in children if child.tag == "param" and "from" in child.attributes]
    files = [scope.file(path) for path in paths]
    return LaunchNode(
        scope.path,
        position.line,
        position.column,
        _text(element, "pkg", scope),
        _text(element, "exec" if "exec" in element.attributes else "type", scope),
        _text(element, "name", scope),
        scope.namespace,
        tuple(PlacedText(word, position.line, position.column) for word in words),
        {_text(child, "from", scope): _text(child, "to", scope) for child in children if child.tag == "remap"},
        tuple((file, "") for file in files if file is not None),
        None in files,
        scope.is_skipped,
        scope.spaced_at,
    )


def _included_arguments(element: Element, scope: LaunchScope) -> Iterator[tuple[str, str]]:
    is_ros2 = "$(find-pkg-share" in (element.get("file") or "")  # its included files see all launch configurations
    if is_ros2 or is_true(element.get("pass_all_args") or ""):
        yield from scope.arguments.items()
    for child in element.children:
        if child.tag in ("arg", "let") and "value" in child.attributes:
            yield child.get("name") or "", _text(child, "value", scope)


def _text(element: Element, attribute: str, scope: LaunchScope) -> str:
    return _substituted(element.get(attribute) or "", scope)


def _substituted(text: str, scope: LaunchScope) -> str:
    """Return a text with its substitutions, innermost first; a computed part becomes `UNKNOWN`."""
    for _ in range(_MAX_SUBSTITUTIONS):
        if len(text) > MAX_TEXT or (found := _SUBSTITUTION.search(text)) is None:
            break
        name, words = found[1], found[2].strip()
        if name in ("find", "find-pkg-share"):
            value = scope.share(words)
        elif name in ("arg", "var"):
            value = scope.value(words)
        elif name in ("dirname", "dir-name"):
            value = str(scope.path.parent)
        else:
            value = UNKNOWN
        text = text[: found.start()] + value + text[found.end() :]
    return UNKNOWN if "$(" in text or len(text) > MAX_TEXT else text


def elements_of(settings: Settings, tag: str = "launch") -> Iterator[Element]:
    """Yield the actions of a YAML launch file as the elements of the same file in XML.

    Args:
        settings: the value of a key of the file.
        tag: the key.
    """
    for item in settings.items if settings.items is not None else (settings,):
        if tag in ("launch", "group") and settings.items is not None:
            children = [child for key, value in item.children.items() for child in elements_of(value, key)]
            if tag == "launch":
                yield from children
            else:
                yield Element(tag, {}, children, "", Origin(item.position))
            continue
        attributes = {key: value.value or "" for key, value in item.children.items() if _is_scalar(value)}
        children = [
            child for key, value in item.children.items() if not _is_scalar(value) for child in elements_of(value, key)
        ]
        yield Element(tag, attributes, children, "", Origin(item.position))


def _is_scalar(settings: Settings) -> bool:
    return settings.items is None and not settings.children
