"""Positions, lines and encodings of source files."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.errors import ResourceError

ENDS = pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["LF", "CRLF", "CR"])


@ENDS
def test_offsets_and_positions_correspond(end: str) -> None:
    source = Source("f", end.join(("<a>", "", "  <b/>", "")))
    for line, column, character in ((1, 1, "<"), (1, 3, ">"), (3, 3, "<"), (3, 6, ">")):
        offset = source.offset(line, column)
        assert source.text[offset] == character
        assert (source.position(offset).line, source.position(offset).column) == (line, column)
    assert source.line_starts == [0, 3 + len(end), 3 + 2 * len(end), 9 + 3 * len(end)]
    assert [source.line(number) for number in range(6)] == ["", "<a>", "", "  <b/>", "", ""]
    assert source.line_end == end
    assert source.line_before(source.offset(3, 3)) == "  "


@ENDS
def test_positions_outside_the_text_are_clamped(end: str) -> None:
    source = Source("f", f"<a>{end}<b>")
    assert source.offset(0, 0) == source.offset(1, 0) == source.offset(1, 1) == 0
    assert source.offset(2, 0) == source.offset(2, 1) == 3 + len(end)
    assert source.offset(2, 9) == source.offset(3, 1) == source.offset(9, 9) == len(source.text)


def test_spans_end_after_their_last_character() -> None:
    span = Source("f", "<a>\n <b/>\n</a>").span(5, 14)
    assert (span.file, span.line, span.column, span.end_line, span.end_column) == ("f", 2, 2, 3, 5)


def test_of_a_long_line_the_part_around_a_column_is_shown() -> None:
    source = Source("r.urdf", f"short\r\n{'a' * 1000}b{'c' * 1000}\n")
    assert source.excerpt(1, 3) == "short"
    assert source.part_of_line(1, 3, 10) == ("short", 1)
    assert source.excerpt(2, 1001) == f"…{'a' * 400}b{'c' * 399}…"
    assert source.part_of_line(2, 1001, 2) == ("aabc", 999)
    assert source.excerpt(2, 1) == f"{'a' * 400}…"
    assert source.excerpt(2, 2001) == f"…{'c' * 401}"
    assert source.excerpt(9, 1) == ""


def test_a_text_of_one_line_gets_line_feeds() -> None:
    assert Source("f", "<a/>").line_end == "\n"


@pytest.mark.parametrize(
    ("content", "text", "flaw"),
    [
        ("<ä/>".encode(), "<ä/>", None),
        ("<ä/>".encode("utf-8-sig"), "<ä/>", None),
        ("<ä/>".encode("utf-16"), "<ä/>", (0, "UTF-16")),
        (b"\xfe\xff" + "<ä/>".encode("utf-16-be"), "<ä/>", (0, "UTF-16")),
        (b"<\xc3\xa4>\xe4<b\xe5>", "<ä>\ufffd<b\ufffd>", (3, "byte 0xE4")),
    ],
)
def test_encodings(content: bytes, text: str, flaw: tuple[int, str] | None) -> None:
    source = Source.decode("f", content)
    assert (source.text, source.flaw) == (text, flaw)


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(ResourceError, match=r"^cannot read robot\.urdf: No such file or directory$"):
        Source.read(tmp_path / "none.urdf", shown_as="robot.urdf")
    with pytest.raises(ResourceError, match=r"^cannot read .*/none\.urdf: No such file or directory$"):
        Source.read(tmp_path / "none.urdf")
