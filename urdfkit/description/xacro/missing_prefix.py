"""xacro written without its prefix: which elements are meant as directives and macro calls."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from urdfkit.description.xml.vocabulary import TAGS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any
    from xml.dom import minidom

_DIRECTIVES: dict[str, tuple[str, ...]] = {
    "macro": ("name",),
    "property": ("name",),
    "include": ("filename",),
    "arg": ("name", "default"),
    "if": ("value",),
    "unless": ("value",),
    "insert_block": ("name",),
}
"""Directive → the attributes without which an element of that name is something else."""

_PROPERTY_VALUES = ("value", "default", "remove", "scope")

FOREIGN = frozenset(("gazebo", "plugin", "sensor", "ros2_control", "transmission", "mujoco", "world", "model"))
"""Elements inside which other formats than URDF rule; some have ``<include>`` or ``<property>`` of their own."""


def is_directive(tag: str, attributes: Any) -> bool:
    """Whether an element without prefix is meant as a directive of xacro.

    Args:
        tag: its name.
        attributes: the names of its attributes, or a mapping from them.
    """
    needed = _DIRECTIVES.get(tag)
    if needed is None or not all(name in attributes for name in needed):
        return False
    return tag != "property" or any(name in attributes for name in _PROPERTY_VALUES)


def may_be_directive_inside(above: Iterable[str], tag: str, value: str) -> bool:
    """Whether a directive without prefix can be meant as xacro's where it stands.

    Inside formats with elements of the same names, only blocks and conditions with an expression are.

    Args:
        above: the names of the elements around it.
        tag: its name.
        value: its attribute ``value``, or an empty string.
    """
    if tag == "insert_block" or FOREIGN.isdisjoint(above):
        return True
    return tag in ("if", "unless") and ("${" in value or "$(" in value)


def mend_directives(document: minidom.Document) -> Iterator[tuple[minidom.Element, str]]:
    """Give the directives in a document their prefix; yield each with the tag as it was written.

    Args:
        document: changed in place.
    """
    for element in list(elements(document)):
        tag = element.tagName
        if (
            tag in _DIRECTIVES
            and is_directive(tag, element.attributes)
            and may_be_directive_inside(names_above(element), tag, element.getAttribute("value"))
        ):
            rename(element)
            yield element, tag


def looks_like_a_call(node: minidom.Element, macro: Any) -> bool:
    """Whether an element without prefix is meant as a call of the macro of its name.

    Elements of URDF and SDF are not, whatever macros are called. Inside ``<gazebo>``, where plugins name their
    parameters as they like, only what has attributes and fits the macro's parameters is.

    Args:
        node: the element.
        macro: xacro's macro of that name, None when there is none.
    """
    if macro is None or node.tagName in TAGS:
        return False
    above = node.parentNode
    while above is not None and above.nodeType == above.ELEMENT_NODE:
        if above.tagName in ("gazebo", "ros2_control"):
            given = node.attributes.keys()
            return bool(given) and all(name in macro.params for name in given)
        above = above.parentNode
    return True


def rename(node: minidom.Element, name: str | None = None) -> str:
    """Give an element the prefix ``xacro:``, and another name if one is given; return its new tag."""
    renamed: Any = node
    renamed.tagName = renamed.nodeName = f"xacro:{name or node.tagName}"
    return str(node.tagName)


def names_above(node: Any) -> Iterator[str]:
    """Yield the names of the elements around one, nearest first."""
    above = node.parentNode
    while above is not None and above.nodeType == above.ELEMENT_NODE:
        yield above.tagName
        above = above.parentNode


def elements(node: Any) -> Iterator[minidom.Element]:
    """Yield the elements below a node, in document order; children that are added meanwhile are not looked for."""
    pending = [child for child in reversed(node.childNodes) if child.nodeType == child.ELEMENT_NODE]
    while pending:
        element = pending.pop()
        yield element
        pending += [child for child in reversed(element.childNodes) if child.nodeType == child.ELEMENT_NODE]
