"""The parts of a start tag in the source text, for fixes and for the caret of a message."""

import re
from pathlib import Path

from urdfkit.description.xml.reader import read_source
from urdfkit.description.xml.source import Source, Span
from urdfkit.errors import ResourceError
from urdfkit.position import Position
from urdfkit.record import record

_NAME = re.compile(r"<([^\s/>=\"'<]+)")
_ATTRIBUTE = re.compile(r"(\s*)([^\s/>=\"'<]+)(\s*=\s*)(\"[^\"]*\"|'[^']*')")
_CLOSE = re.compile(r"\s*(/?)>")
_MARKUP = re.compile(
    r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|<(/?)([^\s/>=\"'<]+)(?:[^>\"']|\"[^\"]*\"|'[^']*')*?(/?)>", re.S
)


@record
class AttributeText:
    """Source text of one attribute.

    Attributes:
        name: span of the name.
        value: span between the quotes.
        whole: span from the white space before the name to the closing quote; delete it to remove the attribute.
        quote: ``"`` or ``'``.
        raw: source text of the value, entities unresolved.
    """

    name: Span
    value: Span
    whole: Span
    quote: str
    raw: str


@record
class StartTag:
    """Source text of a start tag.

    Attributes:
        span: from ``<`` to after ``>``.
        name: span of the tag's name.
        attributes: name → attribute, in order.
        is_empty: whether the tag ends with ``/>``.
    """

    span: Span
    name: Span
    attributes: dict[str, AttributeText]
    is_empty: bool


def start_tag(source: Source, position: Position) -> StartTag | None:
    """Return the parts of the start tag at `position`, or None if no tag starts there."""
    text = source.text
    start = source.offset(position.line, position.column)
    named = _NAME.match(text, start)
    if named is None:
        return None
    attributes: dict[str, AttributeText] = {}
    at = named.end()
    while found := _ATTRIBUTE.match(text, at):
        attributes[found[2]] = AttributeText(
            source.span(*found.span(2)),
            source.span(found.start(4) + 1, found.end(4) - 1),
            source.span(*found.span()),
            found[4][0],
            found[4][1:-1],
        )
        at = found.end()
    close = _CLOSE.match(text, at)
    if close is None:
        return None
    return StartTag(source.span(start, close.end()), source.span(*named.span(1)), attributes, close[1] == "/")


def element_span(source: Source, position: Position) -> Span | None:
    """Return the span of the whole element whose start tag is at `position`, end tag included."""
    start = source.offset(position.line, position.column)
    depth = 0
    for found in _MARKUP.finditer(source.text, start):
        if found[2] is None or found[2].startswith("!"):
            continue
        depth += -1 if found[1] else 0 if found[3] else 1
        if depth <= 0:
            return source.span(start, found.end())
    return None


class WrittenAttributes:
    """Reads attributes at positions of tags, as the source files have them; each file is read once."""

    def __init__(self) -> None:
        self._sources: dict[str, Source | None] = {}

    def at(self, position: Position, attribute: str) -> AttributeText | None:
        """Return an attribute of the tag at a position; None if the file cannot be read or has no such attribute."""
        if position.file not in self._sources:
            try:
                self._sources[position.file] = read_source(Path(position.file), shown_as=position.file)
            except ResourceError:
                self._sources[position.file] = None
        source = self._sources[position.file]
        tag = start_tag(source, position) if source is not None else None
        return tag.attributes.get(attribute) if tag is not None else None
