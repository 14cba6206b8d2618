"""Source tags of a file: exact offsets of each name, attribute and comment.

Works on any text; files that are not well-formed yield the tags that can be recognised.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from functools import cached_property
from itertools import islice

from urdfkit.description.xml.reader import MAX_TAGS
from urdfkit.description.xml.source import Source, Span

# Unclosed comments and sections extend to the end of the file, so they are scanned once. XML forbids `<` in attribute
# values: every alternative stops there, so a stray quote cannot consume the file.
_TOKEN = (
    r"<!--(?P<comment>.*?)(?:-->|\Z)|<!\[CDATA\[.*?(?:\]\]>|\Z)|<\?.*?(?:\?>|\Z)"
    r"|<!DOCTYPE[^<>\[]*(?:\[.*?(?:\]|\Z)\s*)?>?"
    r"|<(?P<close>/?)(?P<name>[^\s/>=<!?\"']+)(?P<attributes>(?:[^<>\"'/]|/(?!>)|\"[^\"<]*\"|'[^'<]*'){0,200000})(?P<empty>/?)>"
)
_ATTRIBUTE = r"([^\s=/\"'<>]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')"


class Attribute:
    """Source text of an attribute; `start` is the offset of its name, `value_end` that of the closing quote."""

    __slots__ = ("end", "name", "start", "value", "value_end", "value_start")

    def __init__(self, name: str, value: str, start: int, value_start: int, value_end: int, end: int) -> None:
        self.name, self.value = name, value
        self.start, self.value_start, self.value_end, self.end = start, value_start, value_end, end


class Tag:
    """Source text of an element.

    Attributes:
        name: the name with its prefix.
        start: offset of ``<``.
        end: offset after ``>`` of the start tag.
        close: offset of ``</``; None for an empty or unclosed element.
        close_end: offset after the whole element.
    """

    __slots__ = ("_text", "children", "close", "close_end", "empty", "end", "name", "parent", "start")

    def __init__(self, text: str, name: str, start: int, end: int, empty: bool, parent: Tag | None) -> None:
        self._text = text
        self.name, self.start, self.end, self.empty, self.parent = name, start, end, empty, parent
        self.children: list[Tag] = []
        self.close: int | None = None
        self.close_end = end

    @property
    def attributes(self) -> dict[str, Attribute]:
        """Name → attribute; values are source text, with unresolved entities and expressions."""
        found: dict[str, Attribute] = {}
        for at in re.compile(_ATTRIBUTE).finditer(self._text, self.start + 1 + len(self.name), self.end):
            group = 2 if at[2] is not None else 3
            found[at[1]] = Attribute(at[1], at[group], at.start(), at.start(group), at.end(group), at.end())
        return found

    def walk(self) -> Iterator[Tag]:
        """Yield this tag and all below it, in document order."""
        pending = [self]
        while pending:
            tag = pending.pop()
            yield tag
            pending.extend(reversed(tag.children))

    def ancestors(self) -> Iterator[Tag]:
        """Yield the enclosing tags, nearest first."""
        above = self.parent
        while above is not None:
            yield above
            above = above.parent


class Document:
    """The tags and comments of one file, at most `MAX_TAGS`; parsed on first access.

    Attributes:
        source: the text of the file.
    """

    def __init__(self, source: Source) -> None:
        self.source = source

    @property
    def roots(self) -> list[Tag]:
        """The top-level tags; one in a well-formed file."""
        return self._read[0]

    @property
    def root(self) -> Tag | None:
        """The first tag; without its children unless all tags have been parsed."""
        if "_read" in self.__dict__:
            return self.roots[0] if self.roots else None
        text = self.source.text
        for token in islice(re.finditer(_TOKEN, text, re.DOTALL), MAX_TAGS):
            if token["name"] is not None and not token["close"]:
                return Tag(text, token["name"], token.start(), token.end(), bool(token["empty"]), None)
        return None

    @property
    def comments(self) -> list[tuple[int, int, str]]:
        """Start, end and text of each comment."""
        return self._read[1]

    @cached_property
    def _read(self) -> tuple[list[Tag], list[tuple[int, int, str]], dict[int, Tag]]:
        text = self.source.text
        roots: list[Tag] = []
        comments: list[tuple[int, int, str]] = []
        by_start: dict[int, Tag] = {}
        open_tags: list[Tag] = []
        opened: Counter[str] = Counter()
        for token in islice(re.finditer(_TOKEN, text, re.DOTALL), MAX_TAGS):
            name = token["name"]
            if name is None:
                if token["comment"] is not None:
                    comments.append((token.start(), token.end(), token["comment"]))
            elif token["close"]:
                if opened[name]:
                    _close(name, token.start(), token.end(), open_tags, opened)
            else:
                parent = open_tags[-1] if open_tags else None
                tag = Tag(text, name, token.start(), token.end(), bool(token["empty"]), parent)
                (parent.children if parent else roots).append(tag)
                by_start[tag.start] = tag
                if not tag.empty:
                    open_tags.append(tag)
                    opened[name] += 1
        for tag in open_tags:
            tag.close_end = len(text)
        return roots, comments, by_start

    def walk(self) -> Iterator[Tag]:
        """Yield every tag in document order."""
        for root in self.roots:
            yield from root.walk()

    def tag_from(self, offset: int) -> Tag | None:
        """Return the first tag that starts at an offset or after it."""
        from bisect import bisect_left

        at = bisect_left(self._starts, offset)
        return self._read[2][self._starts[at]] if at < len(self._starts) else None

    @cached_property
    def _starts(self) -> list[int]:
        return list(self._read[2])

    def tag_at(self, line: int, column: int) -> Tag | None:
        """Return the tag whose ``<`` is at that line and column."""
        return self._read[2].get(self.source.offset(line, column))

    def start_tag_at(self, line: int, column: int) -> Tag | None:
        """Return the tag at the place of an element, without its children unless all tags have been parsed."""
        if "_read" in self.__dict__:
            return self.tag_at(line, column)
        text = self.source.text
        token = re.compile(_TOKEN, re.DOTALL).match(text, self.source.offset(line, column))
        if token is None or token["name"] is None or token["close"]:
            return None
        return Tag(text, token["name"], token.start(), token.end(), bool(token["empty"]), None)

    def span_of(self, tag: Tag, attribute: str | None = None) -> Span:
        """Return the span of an attribute with its value, or of the start tag if it has no such attribute."""
        written = tag.attributes.get(attribute) if attribute is not None else None
        if written is not None:
            return self.source.span(written.start, written.end)
        return self.source.span(tag.start, tag.end)


def _close(name: str, start: int, end: int, open_tags: list[Tag], opened: Counter[str]) -> None:
    """Close the innermost open tag of that name, and those inside it that were never closed."""
    while (tag := open_tags.pop()).name != name:
        tag.close_end = start
        opened[tag.name] -= 1
    opened[name] -= 1
    tag.close, tag.close_end = start, end
