"""Edits shared by the rules: replace a value or name, add or remove an attribute or element.

Each function returns None if the source text differs from the expanded text, because an expression cannot be edited by
its value. Functions that write a new value or name return None without one, and name it in the title by default.
"""

import re
from collections.abc import Iterable

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.errors import nearest as nearest
from urdfkit.lint.finding import Edit, Finding, Fix, Safety
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag

_WORD = r"\d+|[A-Z]?[a-z]+|[A-Z]+(?![a-z])|[^\W\d_]"
_SIMILAR_WORDS, _SIMILAR_NAMES = 0.6, 0.75
"""Least similarities (`difflib.SequenceMatcher.ratio`) of the one word that differs, and of names with another word."""


def new_value(
    model: Model, element: Element, attribute: str, value: str | None, safety: Safety, title: str = ""
) -> Fix | None:
    """Return the fix that replaces the value of an attribute."""
    written = model.literal(element, attribute) if value else None
    if written is None or not value or written.value == value:
        return None
    span = model.document(element.origin.position.file).source.span(written.value_start, written.value_end)
    return Fix(safety, title or f"Replace with `{value}`", (Edit(span, value),))


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


def new_name(model: Model, element: Element, attribute: str, name: str, safety: Safety) -> Fix | None:
    """Return the fix that renames an attribute."""
    tag = model.tag(element.origin.position)
    written = tag.attributes.get(attribute) if tag is not None else None
    if written is None or attribute not in element.attributes:
        return None
    source = model.document(element.origin.position.file).source
    edit = Edit(source.span(written.start, written.start + len(attribute)), name)
    return Fix(safety, f"Rename to `{name}`", (edit,))


def new_tag(model: Model, element: Element, name: str | None, safety: Safety) -> Fix | None:
    """Return the fix that renames an element."""
    tag = model.tag(element.origin.position) if name else None
    if tag is None or not name or tag.name != element.tag:
        return None
    edits = renamed(model.document(element.origin.position.file), tag, name)
    return Fix(safety, f"Rename to <{name}>", edits)


def renamed(document: Document, tag: Tag, name: str) -> tuple[Edit, ...]:
    """Return the edits that rename a tag, and its end tag."""
    starts = [tag.start + 1, *([tag.close + 2] if tag.close is not None else [])]
    return tuple(Edit(document.source.span(start, start + len(tag.name)), name) for start in starts)


def new_text(model: Model, element: Element, text: str | None, safety: Safety, title: str = "") -> Fix | None:
    """Return the fix that replaces the text of an element."""
    tag = model.tag(element.origin.position) if text else None
    if tag is None or not text or tag.close is None or tag.children:
        return None
    source = model.document(element.origin.position.file).source
    written = source.text[tag.end : tag.close]
    if written.strip() != element.text or "&" in written or written == text:
        return None
    return Fix(safety, title or f"Replace with `{text}`", (Edit(source.span(tag.end, tag.close), text),))


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
    return near, Suggestion(near, name)


def nearest_name(finding: Finding, document: Document) -> Fix | None:
    """Return the fix that writes the name that a finding suggests in place of the misspelt one; none for notes.

    Only the name is replaced, so that quotes, comments and line ends stay. There is no fix if the place of the name is
    not certain, or if the two names are names of siblings, such as ``left_wheel`` and ``right_wheel``.

    Args:
        finding: a finding without fix, in the file of the document.
        document: a launch, YAML, SRDF or package file.
    """
    suggestion = finding.suggestion
    if suggestion is None or finding.severity == "note":
        return None
    source, span = document.source, finding.span
    start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
    meant, title = suggestion.meant, f"Replace with `{suggestion.meant}`"
    if meant.startswith("<"):
        tag = document.tag_at(span.line, span.column) or document.tag_at(span.line, span.column - 1)
        return Fix("unsafe", title, renamed(document, tag, meant[1:-1])) if tag is not None else None
    text = source.text[start:end]
    for name in (suggestion.written, text):
        places = [at.start() for at in re.finditer(rf"(?<!\w){re.escape(name)}(?!\w)", text)]
        if "/" in name and "/" not in meant:
            before, name = name[: name.rindex("/") + 1], name.rpartition("/")[2]
            places = [place + len(before) for place in places]
        elif "." in name and not {".", "/"} & set(meant):
            name = name.partition(".")[0]
        if len(places) == 1 and name != meant and is_misspelling(name, meant):
            place = start + places[0]
            return Fix("unsafe", title, (Edit(source.span(place, place + len(name)), meant),))
    return None


def is_misspelling(name: str, near: str) -> bool:
    """Return whether one word of a name is misspelt, missing or superfluous; numbers are never misspelt."""
    from difflib import SequenceMatcher

    words, others = (re.findall(_WORD, text) for text in (name, near))
    if re.findall(r"\d+", name) != re.findall(r"\d+", near):
        return False
    if len(words) != len(others):
        return SequenceMatcher(None, name, near).ratio() >= _SIMILAR_NAMES
    pairs = [(a, b) for a, b in zip(words, others, strict=True) if a != b]
    return len(pairs) < 2 and all(
        sorted(a) == sorted(b) or SequenceMatcher(None, a, b).ratio() >= _SIMILAR_WORDS for a, b in pairs
    )
