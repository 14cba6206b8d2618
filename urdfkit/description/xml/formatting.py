"""Format URDF and xacro files: indentation, white space in tags, line breaks; the expanded robot is unchanged.

Line breaks and columns are the author's: an element on one line stays on one line, attributes on several lines stay on
several lines, and spaces between attributes that align them are kept. Texts, attribute values, comments and the order
of attributes are kept. The content of an element with text in it, with ``xml:space="preserve"`` or between
``<!-- urdfkit: format off -->`` and ``<!-- urdfkit: format on -->`` is kept as written.
"""

from __future__ import annotations

import re
from xml.parsers import expat

from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import ResourceError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

INDENT = 2
"""Default number of spaces for each level, as in the files of `urdfkit new` and of most ROS packages."""

MAX_INDENT = 8
"""Maximum number of spaces for each level."""

_WIDTH = 120
"""Columns in which attributes on further lines stand below the first one; wider ones are indented by two levels."""

_TOKEN = re.compile(
    r"(?P<comment><!--.*?-->)|(?P<cdata><!\[CDATA\[.*?\]\]>)|(?P<verbatim><\?.*?\?>|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>)"
    r"|</(?P<close>[^\s>]+)\s*>|<(?P<name>[^\s/>]+)(?P<attributes>(?:[^\"'/>]|/(?!>)|\"[^\"]*\"|'[^']*')*)(?P<empty>/?)>"
    r"|(?P<text>[^<]+)",
    re.DOTALL,
)
_ATTRIBUTE = re.compile(r"(\s*)([^\s=]+)\s*=\s*(\"[^\"]*\"|'[^']*')")
_OFF, _ON = r"<!--\s*urdfkit:\s*format\s+off\s*-->", r"<!--\s*urdfkit:\s*format\s+on\s*-->"
_MACROS = ("macro", "xacro:macro")


class _Node:
    """One element, comment, text or instruction: its offsets, and the children of an element."""

    __slots__ = ("attributes", "children", "content_end", "content_start", "end", "is_empty", "kind", "name", "start")

    def __init__(self, kind: str, start: int, end: int) -> None:
        self.kind, self.start, self.end = kind, start, end
        self.name = self.attributes = ""
        self.children: list[_Node] = []
        self.is_empty = False
        self.content_start = self.content_end = end


def formatted(source: Source, *, indent: int = INDENT) -> str:
    """Return the formatted text of a file.

    Args:
        source: the file.
        indent: number of spaces for each level.

    Returns:
        The text, with the line ending of the first line and a line ending at the end. Formatting it again returns it.

    Raises:
        XmlError: the file is not well-formed XML, or exceeds a limit.
        ResourceError: the file is not UTF-8.
    """
    if source.flaw is not None:
        where = source.position(source.flaw[0])
        raise ResourceError(f"{where}: {source.flaw[1]} is not UTF-8; save the file as UTF-8 and format it again")
    document_of(source)
    text = re.sub("\r\n?", "\n", source.text) if "\r" in source.text else source.text
    result = _Writer(text, indent).document(_read(text))
    if _events(result) != _events(source.text):
        raise ResourceError(f"{source.file}: internal error: formatting would change the content; nothing was changed")
    end = source.line_end
    return result if end == "\n" else result.replace("\n", end)


def _read(text: str) -> _Node:
    """Return the tree of a well-formed text."""
    root = _Node("element", 0, len(text))
    root.content_start, root.content_end = 0, len(text)
    opened = [root]
    for token in _TOKEN.finditer(text):
        kind = token.lastgroup or ""
        if token["close"] is not None:
            done = opened.pop()
            done.content_end, done.end = token.start(), token.end()
            continue
        node = _Node("element" if token["name"] is not None else kind, token.start(), token.end())
        opened[-1].children.append(node)
        if node.kind == "element":
            node.name, node.attributes, node.is_empty = token["name"], token["attributes"], bool(token["empty"])
            if not node.is_empty:
                opened.append(node)
    return root


class _Writer:
    """Writes the formatted text of a tree.

    Args:
        text: the text before formatting, with line feeds only.
        indent: number of spaces for each level.
    """

    def __init__(self, text: str, indent: int) -> None:
        self._text, self._indent = text, indent
        self._parts: list[str] = []
        self._column = 0

    def document(self, root: _Node) -> str:
        """Return the text of a whole file."""
        self._children(root, 0)
        return "".join(self._parts).strip("\n") + "\n"

    def _write(self, text: str) -> None:
        self._parts.append(text)
        line_start = text.rfind("\n")
        line = " " * self._column + text if line_start < 0 else text[line_start + 1 :]
        self._column = len(line.expandtabs(self._indent))

    def _element(self, node: _Node, level: int) -> None:
        self._start_tag(node, level)
        if node.is_empty:
            return
        content = self._text[node.content_start : node.content_end]
        if self._is_kept(node) or not node.children or (content.isspace() and "\n" not in content):
            self._write(content)
        elif content.isspace():
            self._new_line(level)
        elif self._is_broken(node):
            self._children(node, level + 1)
            self._new_line(level)
        else:
            for child in node.children:
                self._inline(child, level)
        self._write(f"</{node.name}>")

    def _inline(self, node: _Node, level: int) -> None:
        if node.kind == "text":
            self._write(" ")
        elif node.kind == "element":
            self._element(node, level)
        else:
            self._write(self._text[node.start : node.end])

    def _children(self, node: _Node, level: int) -> None:
        """Write the content of an element, each child on a line, and comments next to what they are next to."""
        previous: _Node | None = None
        gap = ""
        kept_until = -1
        for child in node.children:
            if child.kind == "text":
                gap = self._text[child.start : child.end]
                continue
            if child.start >= kept_until:
                is_comment = child.kind == "comment"
                after_comment = previous is not None and previous.kind == "comment"
                is_first = previous is None and not self._parts
                if "\n" not in gap and (is_comment or after_comment) and (previous is not None or self._parts):
                    self._write(_space(gap))
                elif not is_first:
                    self._new_line(level, blank=gap.count("\n") > 1)
                if is_comment and re.fullmatch(_OFF, self._text[child.start : child.end]):
                    kept_until = self._kept(node, child)
                elif child.kind == "element":
                    self._element(child, level)
                elif is_comment:
                    self._comment(child)
                else:
                    self._write(self._text[child.start : child.end])
            previous, gap = child, ""

    def _kept(self, parent: _Node, start: _Node) -> int:
        """Write the children of an element as they are, up to the comment that ends the range; return its end."""
        children = [child for child in parent.children if child.start > start.start and child.kind != "text"]
        ends = (c for c in children if c.kind == "comment" and re.fullmatch(_ON, self._text[c.start : c.end]))
        last = next(ends, children[-1] if children else start)
        self._write(self._text[start.start : last.end])
        return last.end

    def _new_line(self, level: int, *, blank: bool = False) -> None:
        self._write(("\n\n" if blank else "\n") + " " * (self._indent * level))

    def _is_kept(self, node: _Node) -> bool:
        """Return whether white space in the content of an element may matter."""
        if "xml:space" in node.attributes:
            return True
        return any(
            child.kind == "cdata" or (child.kind == "text" and not self._text[child.start : child.end].isspace())
            for child in node.children
        )

    def _is_broken(self, node: _Node) -> bool:
        """Return whether an element has its children on lines of their own."""
        if node.kind != "element" or self._is_kept(node):
            return False
        gaps = [child for child in node.children if child.kind == "text"]
        if any("\n" in self._text[gap.start : gap.end] for gap in gaps):
            return len(gaps) < len(node.children)
        # A text that a directive inserts may be the only content here: no white space is added around it.
        if not gaps and any(":" in child.name for child in node.children):
            return False
        return any(self._is_broken(child) for child in node.children)

    def _start_tag(self, node: _Node, level: int) -> None:
        begin = self._column
        old = self._source_column(node.start)
        self._write(f"<{node.name}")
        break_column = begin + 2 * self._indent
        at = node.start + 1 + len(node.name)
        attributes = list(_ATTRIBUTE.finditer(node.attributes))
        widest = max((len(found[2]) + 1 + len(found[3]) for found in attributes if "\n" in found[1]), default=0)
        for number, found in enumerate(attributes):
            gap, name, value = found.groups()
            if "\n" in gap:
                self._write("\n" + " " * break_column)
            elif number == 0:
                self._write(" ")
                if self._column + widest <= _WIDTH:
                    break_column = self._column
            else:
                self._write(_space(gap))
            if "\n" in value and name == "params" and node.name in _MACROS:
                moved = self._column - self._source_column(at + found.start(2)) if number == 0 else begin - old
                value = self._moved(value, moved)
            self._write(f"{name}={value}")
        self._write("/>" if node.is_empty else ">")

    def _comment(self, node: _Node) -> None:
        moved = self._column - self._source_column(node.start)
        self._write(self._moved(self._text[node.start : node.end], moved))

    def _source_column(self, offset: int) -> int:
        start = self._text.rfind("\n", 0, offset) + 1
        return len(self._text[start:offset].expandtabs(self._indent))

    def _moved(self, text: str, columns: int) -> str:
        """Return a text whose lines after the first are indented by more or fewer columns, without trailing spaces."""
        first, *rest = text.split("\n")
        lines = [first.rstrip() if rest else first]
        for number, line in enumerate(rest):
            body = line.lstrip(" \t")
            width = len(line[: len(line) - len(body)].expandtabs(self._indent))
            lead = " " * max(0, width + columns)
            is_last = number == len(rest) - 1
            lines.append(lead + body if is_last else (lead + body).rstrip())
        return "\n".join(lines)


def _space(gap: str) -> str:
    """Return the white space between two parts of a line: spaces as written, because they may align columns."""
    return gap if gap.strip(" ") == "" and gap else " "


def _events(text: str) -> list[Any]:
    """Return what formatting must not change: tags, attributes in order, texts, and comments without indentation."""
    parser = expat.ParserCreate()
    parser.buffer_text = parser.ordered_attributes = parser.specified_attributes = True
    found: list[Any] = []

    def start(tag: str, values: list[str]) -> None:
        pairs = [
            (name, value.split() if name == "params" and tag in _MACROS else value)
            for name, value in zip(values[::2], values[1::2], strict=True)
        ]
        found.append((tag, pairs))

    def data(text: str) -> None:
        if not text.isspace():
            found.append(text)

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: found.append(f"</{tag}>")
    parser.CharacterDataHandler = data
    parser.CommentHandler = lambda text: found.append([line.strip() for line in text.split("\n")])
    parser.ProcessingInstructionHandler = lambda target, text: found.append((target, text))
    parser.Parse(text, True)
    return found
