"""Outline of a file: its named elements, and the ranges that an editor can fold."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record

KINDS = ("robot", "link", "joint", "material", "macro", "property", "argument", "call", "include", "plugin", "sensor")
"""Kinds of the elements of an outline; ``call`` is a macro call."""

_NAMED = {
    "xacro:macro": "macro",
    "xacro:property": "property",
    "xacro:arg": "argument",
    "robot": "robot",
    "link": "link",
    "joint": "joint",
    "material": "material",
    "plugin": "plugin",
    "sensor": "sensor",
}
_DIRECTIVES = frozenset(("if", "unless", "insert_block", "call", "element", "attribute"))
_DETAILS = {"joint": ("type",), "macro": ("params",), "property": ("value",), "argument": ("default",)}
_WITHOUT_OUTLINE = frozenset(("parent", "child", "mimic", "origin", "inertial", "geometry"))


@record(eq=False)
class Symbol:
    """One element of an outline.

    Attributes:
        kind: one of `KINDS`.
        name: the name as written, with its expressions.
        detail: type of a joint, parameters of a macro, value of a property.
        start: offset of the element.
        end: offset after the element.
        name_start: offset of the name.
        name_end: offset after the name.
        children: the named elements in the element.
    """

    kind: str
    name: str
    detail: str
    start: int
    end: int
    name_start: int
    name_end: int
    children: Sequence[Symbol]


def outline(document: Document) -> list[Symbol]:
    """Return the named elements of a file, as a tree; works on files that are not well-formed."""
    return [symbol for root in document.roots for symbol in _symbols(root)]


def _symbols(tag: Tag) -> Iterator[Symbol]:
    """Yield the symbol of an element, or those of its children if it has none."""
    if tag.name in _WITHOUT_OUTLINE:
        return
    below = [symbol for child in tag.children for symbol in _symbols(child)]
    own = _own(tag, below)
    if own is not None:
        yield own
    else:
        yield from below


def _own(tag: Tag, below: list[Symbol]) -> Symbol | None:
    attributes = tag.attributes
    kind = _NAMED.get(tag.name)
    named = attributes.get("filename" if tag.name == "xacro:include" else "name")
    if tag.name == "xacro:include":
        kind = "include"
    elif kind is None and tag.name.startswith("xacro:") and tag.name[6:] not in _DIRECTIVES:
        detail = " ".join(f'{each.name}="{each.value}"' for each in attributes.values())
        start = tag.start + 1
        return Symbol("call", tag.name, detail, tag.start, tag.close_end, start, start + len(tag.name), below)
    if kind is None or named is None or not named.value.strip():
        return None
    if kind in ("joint", "material") and tag.parent is not None and tag.parent.name not in _TOP:
        return None  # a reference
    detail = next((attributes[name].value for name in _DETAILS.get(kind, ()) if name in attributes), "")
    detail = " ".join(detail.split())
    return Symbol(kind, named.value, detail, tag.start, tag.close_end, named.value_start, named.value_end, below)


_TOP = frozenset(("robot", "xacro:macro", "xacro:if", "xacro:unless", "macro", "if", "unless"))
"""Elements in which a joint or a material is defined."""


def folds(document: Document) -> Iterator[tuple[int, int, str]]:
    """Yield the first and the last line of each range that can be folded, from 1, and ``comment`` or ``region``."""
    source = document.source
    for tag in document.walk():
        first, last = source.position(tag.start).line, source.position(tag.close_end).line
        if tag.close is not None and last > first + 1:
            yield first, last - 1, "region"
    for start, end, _ in document.comments:
        first, last = source.position(start).line, source.position(end).line
        if last > first:
            yield first, last, "comment"


def matches(name: str, query: str) -> bool:
    """Return whether the letters of a query occur in a name in their order, without regard to case."""
    pattern = ".*".join(map(re.escape, query.lower()))
    return re.search(pattern, name.lower()) is not None
