"""What says the same, in the same place, as what was there before: the objects of before take its place."""

from __future__ import annotations

from urdfkit.description.xacro.fast.nodes import Node
from urdfkit.description.xacro.fast.templates import Pattern
from urdfkit.description.xml.element import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


def are_alike(one: Element, other: Element, above: Element | None = None, beside: Element | None = None) -> bool:
    """Whether two elements say the same, and were written in the same place.

    Args:
        one: an element.
        other: another.
        above: what the first is in, where that is known to be alike.
        beside: what the other is in.
    """
    if one is other:
        return True
    if one.tag != other.tag or one.attributes != other.attributes or one.text != other.text:
        return False
    here, there = one.origin.position, other.origin.position
    if here.line != there.line or here.column != there.column or here.file != there.file:
        return False
    calls, others = one.origin.expansions, other.origin.expansions
    is_as_above = above is not None and calls is above.origin.expansions
    is_as_beside = beside is not None and others is beside.origin.expansions
    if calls is not others and not (is_as_above and is_as_beside) and calls != others:
        return False
    below, these = one.children, other.children
    return len(below) == len(these) and all(are_alike(a, b, one, other) for a, b in zip(below, these, strict=True))


def adopt(new: Any, old: Any) -> None:
    """Put what an old node has, and says the same, in the place of what a new one has, and those below likewise.

    Args:
        new: an element that was read; is changed.
        old: the one in its place before.
    """
    if not (isinstance(new, Node) and isinstance(old, Node)):
        return
    if new.pattern is not None and old.pattern is not None:
        new.pattern = _adopted(new.pattern, old.pattern)
    elif new.finished is not None and old.finished is not None:
        new.finished = [_adopted(new.finished[0], old.finished[0])]
    for child, before in zip(new.childNodes, old.childNodes, strict=False):
        adopt(child, before)


def _adopted(new: Any, old: Any) -> Any:
    """Return the old one where it says the same; else the new one, with what is old below."""
    if type(new) is not type(old):
        return new
    if isinstance(new, Element):
        return old if are_alike(new, old) else new
    children = [_adopted(*pair) for pair in zip(new.children, old.children, strict=False)]
    new.children[: len(children)] = children
    is_same = len(children) == len(new.children) == len(old.children) and all(map(_is, children, old.children))
    return old if is_same and _written(new) == _written(old) else new


def _is(one: object, other: object) -> bool:
    return one is other


def _written(pattern: Pattern) -> tuple[Any, ...]:
    return pattern.tag, pattern.attributes, pattern.texts, pattern.position
