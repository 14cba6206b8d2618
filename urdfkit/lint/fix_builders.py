"""Edits shared by the rules: replace a value or name, add or remove an attribute or element.

Each function returns None if the source text differs from the expanded text, because an expression cannot be edited by
its value.
"""

from __future__ import annotations

import re

from urdfkit.errors import nearest as nearest
from urdfkit.lint.finding import Edit, Fix

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from urdfkit.description.xml.element import Element
    from urdfkit.lint.finding import Safety
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Document, Tag


def new_value(model: Model, element: Element, attribute: str, value: str, safety: Safety, title: str) -> Fix | None:
    """Return the fix that replaces the value of an attribute."""
    written = model.literal(element, attribute)
    if written is None or written.value == value:
        return None
    span = model.document(element.origin.position.file).source.span(written.value_start, written.value_end)
    return Fix(safety, title, (Edit(span, value),))


def new_values(model: Model, element: Element, values: dict[str, str], safety: Safety, title: str) -> Fix | None:
    """Return the fix that replaces the values of several attributes; None unless all of them are literals."""
    edits: list[Edit] = []
    source = model.document(element.origin.position.file).source
    for attribute, value in values.items():
        written = model.literal(element, attribute)
        if written is None:
            return None
        if written.value != value:
            edits.append(Edit(source.span(written.value_start, written.value_end), value))
    return Fix(safety, title, tuple(edits)) if edits else None


def new_name(model: Model, element: Element, attribute: str, name: str, safety: Safety, title: str) -> Fix | None:
    """Return the fix that renames an attribute."""
    tag = model.tag(element.origin.position)
    written = tag.attributes.get(attribute) if tag is not None else None
    if written is None or attribute not in element.attributes:
        return None
    source = model.document(element.origin.position.file).source
    return Fix(safety, title, (Edit(source.span(written.start, written.start + len(attribute)), name),))


def new_tag(model: Model, element: Element, name: str, safety: Safety, title: str) -> Fix | None:
    """Return the fix that renames an element."""
    tag = model.tag(element.origin.position)
    if tag is None or tag.name != element.tag:
        return None
    source = model.document(element.origin.position.file).source
    edits = [Edit(source.span(tag.start + 1, tag.start + 1 + len(tag.name)), name)]
    if tag.close is not None:
        edits.append(Edit(source.span(tag.close + 2, tag.close + 2 + len(tag.name)), name))
    return Fix(safety, title, tuple(edits))


def new_text(model: Model, element: Element, text: str, safety: Safety, title: str) -> Fix | None:
    """Return the fix that replaces the text of an element."""
    tag = model.tag(element.origin.position)
    if tag is None or tag.close is None or tag.children:
        return None
    source = model.document(element.origin.position.file).source
    written = source.text[tag.end : tag.close]
    if written.strip() != element.text or "&" in written or written == text:
        return None
    return Fix(safety, title, (Edit(source.span(tag.end, tag.close), text),))


def without_attribute(model: Model, element: Element, attribute: str, safety: Safety, title: str) -> Fix | None:
    """Return the fix that removes an attribute and the white space before it."""
    tag = model.tag(element.origin.position)
    written = tag.attributes.get(attribute) if tag is not None else None
    if written is None:
        return None
    source = model.document(element.origin.position.file).source
    start = _without_blanks(source.text, written.start, " \t\r\n")
    return Fix(safety, title, (Edit(source.span(start, written.end), ""),))


def without_element(model: Model, element: Element, safety: Safety, title: str) -> Fix | None:
    """Return the fix that removes an element, and its lines if they contain nothing else."""
    tag = model.tag(element.origin.position)
    if tag is None or tag.name != element.tag:
        return None
    return Fix(safety, title, (removal(model.document(element.origin.position.file), tag),))


def removal(document: Document, tag: Tag) -> Edit:
    """Return the edit that removes a tag, and its lines if they contain nothing else."""
    text, start, end = document.source.text, tag.start, tag.close_end
    line = _without_blanks(text, start, " \t")
    if line == 0 or text[line - 1] in "\r\n":
        after = re.compile(r"[ \t]*(?:\r\n?|\n)").match(text, end)
        if after:
            start, end = line, after.end()
    return Edit(document.source.span(start, end), "")


def _without_blanks(text: str, end: int, blanks: str) -> int:
    """Return the offset of the end of `text[:end]` without its last blanks."""
    while end > 0 and text[end - 1] in blanks:
        end -= 1
    return end


def more_attributes(model: Model, element: Element, written: str, safety: Safety, title: str) -> Fix | None:
    """Return the fix that adds attributes; `written` is their source text."""
    tag = model.tag(element.origin.position)
    if tag is None or tag.name != element.tag:
        return None
    end = max((attribute.end for attribute in tag.attributes.values()), default=tag.start + 1 + len(tag.name))
    source = model.document(element.origin.position.file).source
    return Fix(safety, title, (Edit(source.span(end, end), f" {written}"),))


def more_children(model: Model, element: Element, written: str, safety: Safety, title: str) -> Fix | None:
    """Return the fix that adds a child on a new line before the end tag, indented like the last child."""
    tag = model.tag(element.origin.position)
    if tag is None or tag.name != element.tag or tag.close is None or not tag.children:
        return None
    source = model.document(element.origin.position.file).source
    last = tag.children[-1]
    indent = source.line_before(last.start)
    text = f"{source.line_end}{indent}{written}" if not indent.strip() else written
    return Fix(safety, title, (Edit(source.span(last.close_end, last.close_end), text),))


def meant(name: str, candidates: Iterable[str]) -> tuple[str | None, str]:
    """Return the candidate most similar to a misspelt name (or None), and ``; did you mean …`` (or an empty string)."""
    near = nearest(name, candidates, cutoff=0.7)
    return near, f"; did you mean `{near}`?" if near else ""
