"""ROS 1 launch files and ROS 2 XML and YAML launch files."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.control.settings import Settings
from urdfkit.description.launch.launch_scope import MAX_TEXT, UNKNOWN, LaunchScope, is_false, is_true
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Origin

_SUBSTITUTION = re.compile(r"\$\(\s*([\w-]+)([^$()]*)\)")
_COMMAND = re.compile(r"\$\(\s*command\s+(?:'([^']*)'|\"([^\"]*)\"|([^'\"].*)\))", re.DOTALL)
_MAX_SUBSTITUTIONS = 100


def read_elements(elements: list[Element], scope: LaunchScope) -> None:
    """Read the actions of a launch file in order.

    Args:
        elements: the actions.
        scope: its arguments, and the record of its contents.
    """
    for element in elements:
        if is_false(_text(element, "if", scope)) or is_true(_text(element, "unless", scope)):
            continue
        tag, name = element.tag, element.get("name") or ""
        if tag in ("arg", "let") and "value" in element.attributes:
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
        elif tag in ("node", "group", "launch", "node_container", "composable_node"):
            scope.start(_text(element, "pkg", scope))
            read_elements(element.children, scope)


def _included_arguments(element: Element, scope: LaunchScope) -> Iterator[tuple[str, str]]:
    if is_true(element.get("pass_all_args") or ""):
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
