"""Nodes: the tree that is expanded in place. An element carries its place and the macro calls that produced it.

The links between siblings are those of the DOM, so that directives can be replaced while their siblings are visited.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import partial
from xml.parsers import expat

from urdfkit.description.xml.element import MAX_DEPTH, Element
from urdfkit.description.xml.reader import (
    MAX_VALUE,
    check_depth,
    check_doctype,
    parse_with,
    refuse_entity,
    refuse_excess,
    too_deep,
)
from urdfkit.description.xml.source import Expansion, Origin, Position, Source

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

Chain = tuple[Expansion, ...]

TEXT, CDATA, COMMENT, INSTRUCTION, DOCTYPE, ELEMENT = "text", "cdata", "comment", "instruction", "doctype", "element"


_SUBSET = re.compile(r"<!DOCTYPE[^\[>]*\[(.*?)\]\s*>", re.DOTALL).search


class Node:
    """A node of the tree.

    Attributes:
        kind: of the node.
        data: text of a text or comment; of an instruction or document type, its printed content.
        parent: the element around it.
        before: the sibling before it.
        after: the sibling after it.
    """

    __slots__ = ("after", "before", "data", "kind", "parent")

    def __init__(self, kind: str, data: str = "") -> None:
        self.kind, self.data = kind, data
        self.parent: Tag | None = None
        self.before: Node | None = None
        self.after: Node | None = None

    def remove(self) -> None:
        """Take it out of its parent."""
        parent = self.parent
        if parent is None:
            return
        if self.before is not None:
            self.before.after = self.after
        else:
            parent.first = self.after
        if self.after is not None:
            self.after.before = self.before
        else:
            parent.last = self.before
        self.parent = self.before = self.after = None

    def insert_before(self, node: Node) -> None:
        """Put it before another node, in the parent of that node."""
        self.remove()
        self.parent, self.after, self.before = node.parent, node, node.before
        if node.before is not None:
            node.before.after = self
        elif node.parent is not None:
            node.parent.first = self
        node.before = self


class Tag(Node):
    """An element.

    Attributes:
        tag: its qualified name.
        name: the name that stock xacro's messages show: not changed by ``xacro:call``.
        attributes: name → value; ``xacro:attribute`` may leave a number.
        file: where its start tag is.
        line: where its start tag is.
        column: where its start tag is.
        chain: the macro calls that produced it, innermost first.
        first: its first child.
        last: its last child.
    """

    __slots__ = ("attributes", "chain", "column", "file", "first", "last", "line", "name", "tag")

    def __init__(self, tag: str, attributes: dict[str, Any], file: str, line: int, column: int, chain: Chain) -> None:
        self.kind, self.data = ELEMENT, ""
        self.parent = self.before = self.after = None
        self.first: Node | None = None
        self.last: Node | None = None
        self.tag = self.name = tag
        self.attributes, self.file, self.line, self.column, self.chain = attributes, file, line, column, chain

    @property
    def position(self) -> Position:
        """The place of the start tag."""
        return Position(self.file, self.line, self.column)

    def append(self, node: Node) -> None:
        """Add a child that has no parent."""
        node.parent, node.before = self, self.last
        if self.last is not None:
            self.last.after = node
        else:
            self.first = node
        self.last = node

    def children(self) -> Iterator[Node]:
        """Yield the children."""
        child = self.first
        while child is not None:
            yield child
            child = child.after

    def tags(self) -> Iterator[Tag]:
        """Yield the child elements."""
        for child in self.children():
            if isinstance(child, Tag):
                yield child

    def copy(self, chain: Chain | None, count: Callable[[int], None]) -> Tag:
        """Return a copy with all below it.

        Args:
            chain: the macro calls of the copy; None keeps those of each element.
            count: called with the number of elements and attributes of each element.
        """
        top = Tag(
            self.tag, dict(self.attributes), self.file, self.line, self.column, self.chain if chain is None else chain
        )
        open_tags = [(self, top)]
        while open_tags:
            source, made = open_tags.pop()
            count(1 + len(made.attributes))
            child = source.first
            while child is not None:
                if isinstance(child, Tag):
                    kept = child.chain if chain is None else chain
                    new: Node = Tag(child.tag, dict(child.attributes), child.file, child.line, child.column, kept)
                    open_tags.append((child, new))  # type: ignore[arg-type]
                else:
                    new = Node(child.kind, child.data)
                made.append(new)
                child = child.after
        return top

    def replace(self, sources: list[Tag]) -> None:
        """Put the children of other elements in the place of this one."""
        for source in sources:
            child = source.first
            while child is not None:
                following = child.after
                child.insert_before(self)
                child = following
        self.remove()


def read_tree(source: Source, *, namespaces: bool = True) -> Tag:
    """Read a file; its document element is the only element of the returned element, which has no name.

    Args:
        source: the text.
        namespaces: refuse prefixes that are not declared.

    Raises:
        XmlError: it is not well-formed, or hostile.
    """
    parser = expat.ParserCreate(namespace_separator=" ") if namespaces else expat.ParserCreate()
    return _Reader(source, parser).read(namespaces)


class _Reader:
    """Builds the tree of one file from the events of a parser."""

    def __init__(self, source: Source, parser: Any) -> None:
        self._source, self._parser = source, parser
        self._check = partial(refuse_excess, source) if len(source.text) > MAX_VALUE else None
        self._document = self._at = Tag("", {}, source.file, 1, 1, ())
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
        parser.CommentHandler = lambda data: self._add(Node(COMMENT, data))
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
        element = Tag(tag, attributes, self._source.file, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1, ())
        self._at.append(element)
        self._at = element
        self._depth += 1
        if self._depth > MAX_DEPTH:
            too_deep(self._source, parser)

    def _end(self, _: str) -> None:
        self._depth -= 1
        assert self._at.parent is not None
        self._at = self._at.parent

    def _text(self, data: str) -> None:
        kind, last = (CDATA if self._is_cdata else TEXT), self._at.last
        if last is not None and last.kind == kind and (kind == TEXT or self._cdata_continues):
            last.data += data
        else:
            self._add(Node(kind, data))
        self._cdata_continues = self._is_cdata

    def _cdata(self, *, is_open: bool) -> None:
        self._is_cdata, self._cdata_continues = is_open, False

    def _add(self, node: Node) -> None:
        if not self._subset:
            self._at.append(node)

    def _doctype(self, name: str, system: str | None, public: str | None, has_subset: bool) -> None:
        check_doctype(self._source, self._parser, system, public)
        subset = _SUBSET(self._source.text) if has_subset else None
        self._add(Node(DOCTYPE, f"{name} [{subset[1]}]" if subset else name))
        self._subset = True

    def _end_doctype(self) -> None:
        self._subset = False

    def _open_tags(self) -> list[tuple[str, int]]:
        found: list[tuple[str, int]] = []
        at: Tag | None = self._at
        while at is not None and at.parent is not None:
            found.append((at.tag, at.line))
            at = at.parent
        return found[::-1]


def _qualified(name: str) -> str:
    """Return the name with its prefix, from a parser's `uri local prefix`."""
    parts = name.split(" ")
    return f"{parts[2]}:{parts[1]}" if len(parts) == 3 else parts[-1]


def element_of(tag: Tag, depth: int = 0) -> Element:
    """Return an expanded element with all below it.

    Raises:
        XmlError: macros have made elements that are nested too deep.
    """
    check_depth(depth, tag.position)
    children: list[Element] = []
    text = ""
    for child in tag.children():
        if isinstance(child, Tag):
            children.append(element_of(child, depth + 1))
        elif child.kind in (TEXT, CDATA):
            text += child.data
    attributes = {name: str(value) for name, value in tag.attributes.items()}
    return Element(tag.tag, attributes, children, text.strip(), Origin(tag.position, tag.chain))
