"""Reading a file into the `nodes` that xacro works on where nobody prints them."""

from __future__ import annotations

from functools import partial
from xml.parsers import expat

from urdfkit.description.xacro.fast.nodes import Attributes, Document, Node, with_texts
from urdfkit.description.xacro.fast.templates import Pattern
from urdfkit.description.xml.element import MAX_DEPTH, Element
from urdfkit.description.xml.reader import MAX_VALUE, parse_with, refuse_excess, too_deep
from urdfkit.description.xml.source import Origin, Position, Source
from urdfkit.description.xml.vocabulary import TAGS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xacro.expansion import Run

_PLAIN = TAGS - {"macro", "property", "include", "arg", "if", "unless", "insert_block"}
"""Elements in which xacro has nothing to do, and which nobody means as its directives."""

_MORE, _VALUES, _NOTHING = range(3)
"""What xacro has to do in an element: more, to put values in, nothing."""

_ODD = ("<![CDATA[", "<!DOCTYPE", "xacro:eval-comments", "\0")
"""What has to be read by minidom's own builder; expat takes a text with zeros for UTF-16, in which we see no markup."""


class _Open:
    """An element that is not closed yet.

    Attributes:
        work: what xacro has to do in it, as far as has been read.
        holds: what is plain in it stays where it is: it is no block that macros take apart.
    """

    __slots__ = ("attributes", "children", "column", "holds", "line", "size", "tag", "texts", "work")

    def __init__(self, tag: str, attributes: Any, line: int, column: int, work: int, holds: bool) -> None:
        self.tag, self.attributes, self.line, self.column = tag, attributes, line, column
        self.work, self.holds = work, holds
        self.size = 1 + len(attributes)
        self.children: list[Any] = []
        self.texts: list[tuple[int, str]] = []


def can_plant(source: Source) -> bool:
    """Return whether a file has nothing that minidom's own builder has to read."""
    return not any(odd in source.text for odd in _ODD)


def planted(source: Source, run: Run) -> Document:
    """Read a file.

    Args:
        source: the text; `can_plant` it.
        run: takes note of clones.

    Raises:
        XmlError: it is not well-formed, or hostile.
    """
    planter = _Planter(source, run)
    parse_with(planter.parser, source, planter.open_tags)
    return Document(planter.root)


class _Planter:
    """What expat tells, made into nodes."""

    def __init__(self, source: Source, run: Run) -> None:
        self._source, self._file, self._run = source, source.file, run
        self._stack: list[_Open] = []
        self._declared: dict[str, Any] = {}
        self._check = partial(refuse_excess, source) if len(source.text) > MAX_VALUE else None
        self.root: Any = None
        self.parser = parser = expat.ParserCreate(namespace_separator=" ")
        parser.namespace_prefixes = True
        parser.buffer_text = True
        parser.StartNamespaceDeclHandler = self._declare
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        # Text before a comment and after it are two: minidom has them so.
        parser.CommentHandler = lambda _: None
        parser.ProcessingInstructionHandler = lambda *_: None

    def open_tags(self) -> list[tuple[str, int]]:
        """Return tag and line of the elements that are open, outermost first."""
        return [(one.tag, one.line) for one in self._stack]

    def _declare(self, prefix: str | None, uri: Any) -> None:
        self._declared[f"xmlns:{prefix}" if prefix else "xmlns"] = uri  # None for xmlns="", as in minidom

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        parser, stack = self.parser, self._stack
        if self._check is not None:
            self._check(parser, tag.rpartition(" ")[2], attributes.values())
        line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
        above = stack[-1] if stack else None
        holds = tag in _PLAIN and above is not None and above.holds
        if holds and not self._declared and (not attributes or " " not in "".join(attributes)):
            work = _VALUES if attributes and "$" in "".join(attributes.values()) else _NOTHING
        else:
            tag, attributes = _qualified(tag), Attributes({_qualified(name): attributes[name] for name in attributes})
            if self._declared:
                attributes = Attributes({**self._declared, **attributes})
                self._declared.clear()
            holds = tag in TAGS or tag == "xacro:macro"
            if tag in ("xacro:if", "xacro:unless") and above is not None:
                holds = above.holds
            work = _MORE
        self._spoil(work)
        stack.append(_Open(tag, attributes, line, column, work, holds))
        if len(stack) > MAX_DEPTH:
            too_deep(self._source, parser)

    def _spoil(self, work: int) -> None:
        """Note that there is so much to do for xacro in all that is open."""
        for one in reversed(self._stack):
            if one.work <= work:
                break
            one.work = work

    def _text(self, data: str) -> None:
        top = self._stack[-1]
        if "$" in data:
            self._spoil(_VALUES)
        top.texts.append((len(top.children), data))

    def _end(self, _: str) -> None:
        one = self._stack.pop()
        done = self._node(one) if one.work == _MORE else self._content(one)
        if self._stack:
            above = self._stack[-1]
            above.children.append(done)
            above.size += one.size
        else:
            self.root = done

    def _content(self, one: _Open) -> Element | Pattern:
        position = Position(self._file, one.line, one.column)
        if one.work == _VALUES:
            return Pattern(one.tag, one.attributes, one.children, one.texts, position, one.size)
        text = "".join([data for _, data in one.texts]).strip() if one.texts else ""
        return Element(one.tag, one.attributes, one.children, text, Origin(position))

    def _node(self, one: _Open) -> Node:
        node = Node(one.tag, Attributes(one.attributes), (self._file, one.line, one.column, ()), self._run)
        below: list[Any] = []
        for child in one.children:
            if isinstance(child, Node):
                below.append(child)
            else:
                at = child.position if isinstance(child, Pattern) else child.origin.position
                below.append(Node.of(child, (at.file, at.line, at.column, ()), self._run))
        for child in with_texts(below, one.texts):
            node.appendChild(child)
        return node


def _qualified(name: str) -> str:
    """Return a name as written, from what expat makes of it: URI, name and prefix."""
    if " " not in name:
        return name
    parts = name.split(" ")
    return f"{parts[2]}:{parts[1]}" if len(parts) == 3 else parts[1]
