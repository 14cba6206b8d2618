"""xacro written without its prefix: which elements are meant as directives and macro calls."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from urdfkit.description.xacro.evaluation.tree import MORE, Tag
from urdfkit.description.xacro.faults import Unprefixed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

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


def add_missing_prefixes(document: Tag) -> Iterator[Unprefixed]:
    """Give the directives of a tree their prefix; yield what lacked it.

    Args:
        document: changed in place.
    """
    for element in list(tags_below(document)):
        tag = element.tag
        if (
            tag in _DIRECTIVES
            and is_directive(tag, element.attributes)
            and may_be_directive_inside(names_above(element), tag, element.attributes.get("value", ""))
        ):
            rename(element)
            yield Unprefixed("directive", tag, element.position, element.chain)


def looks_like_a_call(node: Tag, parameters: Collection[str]) -> bool:
    """Whether an element without prefix is meant as a call of the macro of its name.

    Inside ``<gazebo>``, where plugins name their parameters as they like, only an element is whose attributes all are
    parameters of the macro.

    Args:
        node: the element; its tag is not a tag of URDF or SDF.
        parameters: of the macro.
    """
    if "gazebo" in (above := set(names_above(node))) or "ros2_control" in above:
        return bool(node.attributes) and all(name in parameters for name in node.attributes)
    return True


def rename(node: Tag, name: str | None = None) -> None:
    """Give an element the prefix ``xacro:``, and another name if one is given."""
    node.tag = node.name = f"xacro:{name or node.tag}"
    above: Tag | None = node
    while above is not None:
        above.work = MORE
        above = above.parent


def names_above(node: Tag) -> Iterator[str]:
    """Yield the names of the elements around one, nearest first."""
    above = node.parent
    while above is not None and above.tag:
        yield above.tag
        above = above.parent


def tags_below(node: Tag) -> Iterator[Tag]:
    """Yield the elements below one, in document order; elements that are added meanwhile are ignored."""
    pending = list(node.tags())[::-1]
    while pending:
        tag = pending.pop()
        yield tag
        pending += list(tag.tags())[::-1]
