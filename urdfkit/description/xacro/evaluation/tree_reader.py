"""Read a file into the tree that is expanded."""

from __future__ import annotations

import re
from functools import partial
from xml.parsers import expat

from urdfkit.description.xacro.evaluation.tree import (
    CDATA,
    COMMENT,
    DOCTYPE,
    INSTRUCTION,
    MORE,
    NOTHING,
    TEXT,
    VALUES,
    Node,
    Tag,
)
from urdfkit.description.xml.element import MAX_DEPTH
from urdfkit.description.xml.extended_text import ExtendedText
from urdfkit.description.xml.known_tags import TAGS
from urdfkit.description.xml.reader import MAX_VALUE, check_doctype, parse_with, refuse_entity, refuse_excess, too_deep
from urdfkit.description.xml.source import Position, Source

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_SUBSET = r"(?s)<!DOCTYPE[^\[>]*\[(.*?)\]\s*>"


def read_tree(source: Source, *, namespaces: bool = True) -> Tag:
    """Read a file; its document element is the only element of the returned element, which has no name.

    Args:
        source: the text.
        namespaces: refuse prefixes that are not declared.

    Raises:
        XmlError: it is not well-formed, or hostile.
    """
    parser = expat.ParserCreate(namespace_separator=" ") if namespaces else expat.ParserCreate()
    return _TreeReader(source, parser).read(namespaces)


class _TreeReader:
    """Builds the tree of one file from the events of a parser."""

    def __init__(self, source: Source, parser: Any) -> None:
        self._source, self._parser = source, parser
        self._check = partial(refuse_excess, source) if len(source.text) > MAX_VALUE else None
        self._written = source.text.written if isinstance(source.text, ExtendedText) else None
        self._document = self._at = Tag("", {}, Position(source.file, 1, 1), ())
        self._depth = 0
        self._is_cdata = self._cdata_continues = False
        self._declared: list[tuple[str, str]] = []
        self._subset = False

    def read(self, namespaces: bool) -> Tag:
        """Parse the text."""
        parser, source = self._parser, self._source
        parser.buffer_text = True
        parser.ordered_attributes = True
        parser.specified_attributes = True
        if namespaces:
            parser.namespace_prefixes = True
            parser.StartNamespaceDeclHandler = lambda prefix, uri: self._declared.append((prefix, uri or ""))
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.CommentHandler = self._comment
        parser.ProcessingInstructionHandler = lambda target, data: self._add(Node(INSTRUCTION, f"{target} {data}"))
        parser.StartCdataSectionHandler = partial(self._cdata, is_open=True)
        parser.EndCdataSectionHandler = partial(self._cdata, is_open=False)
        parser.EntityDeclHandler = lambda name, *_: refuse_entity(source, parser, name)
        parser.StartDoctypeDeclHandler = self._doctype
        parser.EndDoctypeDeclHandler = self._end_doctype
        parse_with(parser, source, self._open_tags)
        return self._document

    def _start(self, name: str, values: list[str]) -> None:
        tag = _qualified(name)
        if self._check is not None:
            self._check(self._parser, tag, values[1::2])
        attributes = {f"xmlns:{prefix}" if prefix else "xmlns": uri for prefix, uri in self._declared}
        self._declared.clear()
        for index in range(0, len(values), 2):
            attributes[_qualified(values[index])] = values[index + 1]
        parser = self._parser
        position = Position(self._source.file, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)
        if self._written is not None:
            position = self._written(position)
        element = Tag(tag, attributes, position, ())
        if tag in TAGS and "xmlns" not in attributes and ":" not in "".join(attributes):
            element.work = VALUES if "$" in "".join(attributes.values()) else NOTHING
        element.size = 1 + len(attributes)
        self._at.append(element)
        self._at = element
        self._depth += 1
        if self._depth > MAX_DEPTH:
            too_deep(self._source, parser)

    def _end(self, _: str) -> None:
        self._depth -= 1
        tag, above = self._at, self._at.parent
        assert above is not None
        above.size += tag.size
        above.work = max(above.work, tag.work)
        above.height = max(above.height, tag.height + 1)
        self._at = above

    def _text(self, data: str) -> None:
        kind, last = (CDATA if self._is_cdata else TEXT), self._at.last
        if last is not None and last.kind == kind and (kind == TEXT or self._cdata_continues):
            last.data += data
        else:
            self._add(Node(kind, data))
        if "$" in data:
            self._at.work = max(self._at.work, VALUES)
        self._cdata_continues = self._is_cdata

    def _cdata(self, *, is_open: bool) -> None:
        self._is_cdata, self._cdata_continues = is_open, False

    def _comment(self, data: str) -> None:
        self._add(Node(COMMENT, data))
        if "xacro:eval-comments" in data:
            self._at.work = MORE

    def _add(self, node: Node) -> None:
        if not self._subset:
            self._at.append(node)

    def _doctype(self, name: str, system: str | None, public: str | None, has_subset: bool) -> None:
        check_doctype(self._source, self._parser, system, public)
        subset = re.search(_SUBSET, self._source.text) if has_subset else None
        self._add(Node(DOCTYPE, f"{name} [{subset[1]}]" if subset else name))
        self._subset = True

    def _end_doctype(self) -> None:
        self._subset = False

    def _open_tags(self) -> list[tuple[str, Position]]:
        found: list[tuple[str, Position]] = []
        at: Tag | None = self._at
        while at is not None and at.parent is not None:
            found.append((at.tag, at.position))
            at = at.parent
        return found[::-1]


def _qualified(name: str) -> str:
    """Return the name with its prefix, from a parser's `uri local prefix`."""
    parts = name.split(" ")
    return f"{parts[2]}:{parts[1]}" if len(parts) == 3 else parts[-1]
