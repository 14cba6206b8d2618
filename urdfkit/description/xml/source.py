"""Source text of a file: positions, spans, and the macro calls that produced an element."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path

from urdfkit.position import Position as Position
from urdfkit.record import field, record


def absolute(path: str | Path) -> Path:
    """Return an absolute path without ``..``; symbolic links are not resolved."""
    return Path(os.path.normpath(Path(path).absolute()))


def content_of(path: Path, most: int = -1) -> bytes:
    """Return the bytes of a file, without waiting for files such as /proc/kmsg or named pipes that have no data yet.

    Args:
        path: a file, or a pipe of the shell such as /dev/stdin, whose data is awaited.
        most: maximum number of bytes; no limit when negative.

    Raises:
        OSError: the file cannot be read.
    """
    if path.is_fifo() and path.parts[1:2] not in (("dev",), ("proc",)):
        raise BlockingIOError(11, "not a regular file", str(path))
    without_waiting = getattr(os, "O_NONBLOCK", 0) if path.is_file() else 0
    with open(path, "rb", opener=lambda name, flags: os.open(name, flags | without_waiting)) as file:
        content: bytes | None = file.read(most)
    if content is None:
        raise BlockingIOError(11, "not a regular file", str(path))
    return content


_WIDE = {
    b"\xff\xfe\0\0": "utf-32",
    b"\0\0\xfe\xff": "utf-32",
    b"<\0\0\0": "utf-32-le",
    b"\0\0\0<": "utf-32-be",
    b"\xff\xfe": "utf-16",
    b"\xfe\xff": "utf-16",
    b"<\0": "utf-16-le",
    b"\0<": "utf-16-be",
}
"""First bytes of an XML file in UTF-32 or UTF-16 → its encoding."""


LONG = 400
"""Characters on each side of a column that `Source.excerpt` shows."""


@record(order=True)
class Span:
    """A range of one file, from `line`:`column` to `end_line`:`end_column` (exclusive)."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int

    @property
    def start(self) -> Position:
        """The first character."""
        return Position(self.file, self.line, self.column)


@record
class Expansion:
    """One macro call that produced an expanded element."""

    macro: str
    position: Position


@record
class Origin:
    """Source position of an expanded element, and the macro calls that produced it.

    Attributes:
        position: the start tag in the source file.
        expansions: the macro calls that produced it, innermost first (the call that directly produced the element);
            empty for elements written outside macros.
    """

    position: Position
    expansions: tuple[Expansion, ...] = ()

    def __init__(self, position: Position, expansions: tuple[Expansion, ...] = ()) -> None:  # faster than of records
        values = self.__dict__
        values["position"], values["expansions"] = position, expansions


@record
class Source:
    """The text of one file.

    Attributes:
        file: the path as shown to the user.
        text: the decoded content, with unchanged line endings.
        flaw: offset in the text and description of the first byte that is not UTF-8; None if all are.
    """

    file: str
    text: str = field(repr=False)
    flaw: tuple[int, str] | None = None

    @classmethod
    def read(cls, path: Path, *, shown_as: str | None = None, most: int = -1) -> Source:
        """Read a file; see `decode`.

        Args:
            path: the file.
            shown_as: its name in messages and findings.
            most: maximum number of bytes to read; no limit when negative.

        Raises:
            ResourceError: the file cannot be read.
        """
        from urdfkit.errors import ResourceError

        try:
            content = content_of(path, most)
        except OSError as error:
            raise ResourceError(f"cannot read {shown_as or path}: {error.strerror or error}") from error
        return cls.decode(shown_as or str(path), content)

    @classmethod
    def read_if_possible(cls, file: str) -> Source | None:
        """Read a file; return None if it cannot be read."""
        from urdfkit.errors import ResourceError

        try:
            return cls.read(Path(file), shown_as=file)
        except ResourceError:
            return None

    @classmethod
    def decode(cls, file: str, content: bytes) -> Source:
        """Decode UTF-8, UTF-16 or UTF-32, with or without byte order mark; undecodable bytes become U+FFFD."""
        if b"\0" in content[:4] or content[:2] in (b"\xff\xfe", b"\xfe\xff"):
            for start, codec in _WIDE.items():
                if content.startswith(start):
                    return cls(file, content.decode(codec, errors="replace"), (0, codec[:6].upper()))
        content = content.removeprefix(b"\xef\xbb\xbf")
        try:
            return cls(file, content.decode())
        except UnicodeDecodeError as error:
            before = error.object[: error.start].decode("utf-8", errors="replace")
            flaw = len(before), f"byte 0x{error.object[error.start]:02X}"
            return cls(file, content.decode(errors="replace"), flaw)

    @cached_property
    def line_starts(self) -> list[int]:
        """Offset of the first character of each line; line endings as in XML, including a single carriage return."""
        starts = [0]
        if "\r" in self.text:
            import re

            starts += [end.end() for end in re.finditer("\r\n?|\n", self.text)]
            return starts
        find = self.text.find
        at = find("\n")
        while at != -1:
            starts.append(at + 1)
            at = find("\n", at + 1)
        return starts

    def line(self, number: int) -> str:
        """Return line `number` (from 1) without its line ending; empty if the line does not exist."""
        return self.part_of_line(number, 1, len(self.text))[0]

    def part_of_line(self, number: int, column: int, reach: int) -> tuple[str, int]:
        """Return the part of line `number` within `reach` characters of a column, and the column where it begins.

        In a file written on one line, this takes no time that grows with the file.
        """
        if not 1 <= number <= len(self.line_starts):
            return "", 1
        start = self.line_starts[number - 1]
        end = self.line_starts[number] if number < len(self.line_starts) else len(self.text)
        while end > start and self.text[end - 1] in "\r\n":
            end -= 1
        at = start + column - 1
        first = max(start, at - reach)
        return self.text[first : min(end, at + reach)], first - start + 1

    def excerpt(self, number: int, column: int = 1) -> str:
        """Return line `number` for display; of a long line, the part around a column, with ``…`` for the rest."""
        text, first = self.part_of_line(number, column, LONG)
        end = self.offset(number, first + len(text))
        is_cut = bool(self.text[end : end + 1].strip("\r\n"))
        return f"{'…' * (first > 1)}{text}{'…' * is_cut}"

    @cached_property
    def line_end(self) -> str:
        """Line ending of the first line, used for inserted lines."""
        first = self.text[: self.line_starts[1]] if len(self.line_starts) > 1 else "\n"
        return "\r\n" if first.endswith("\r\n") else first[-1]

    def line_before(self, offset: int) -> str:
        """Return the text of the line before an offset."""
        return self.text[self.line_starts[self.position(offset).line - 1] : offset]

    def offset(self, line: int, column: int) -> int:
        """Return the offset of a position, clamped to the text."""
        if line > len(self.line_starts):
            return len(self.text)
        return min(self.line_starts[max(line, 1) - 1] + max(column, 1) - 1, len(self.text))

    def position(self, offset: int) -> Position:
        """Return the position of an offset."""
        from bisect import bisect_right

        line = bisect_right(self.line_starts, offset)
        return Position(self.file, line, offset - self.line_starts[line - 1] + 1)

    def span(self, start: int, end: int) -> Span:
        """Return the span between two offsets."""
        first, last = self.position(start), self.position(end)
        return Span(self.file, first.line, first.column, last.line, last.column)


class Overlay(str):
    """A text that replaces the file on disk and has the same `flaw`; see `Source`."""

    flaw: tuple[int, str] | None = None
