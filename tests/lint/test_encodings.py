"""Bytes that are no UTF-8: what xacro and urdfdom refuse is an error, whatever the file states of itself."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

PLAIN = '<robot name="r">\n<!-- {} --><link name="a"/>\n</robot>\n'
XACRO = PLAIN.replace(">", ' xmlns:xacro="http://www.ros.org/wiki/xacro">', 1)
LATIN = '<?xml version="1.0" encoding="ISO-8859-1"?>'


@pytest.mark.parametrize(
    ("name", "content", "severity", "place", "message"),
    [
        ("r.urdf.xacro", PLAIN.format("é").encode("latin-1"), "error", (2, 6), "byte 0xE9 is not UTF-8: xacro rejects"),
        ("r.urdf", XACRO.format("é").encode("latin-1"), "error", (2, 6), "byte 0xE9 is not UTF-8: xacro rejects"),
        ("r.xacro", (LATIN + XACRO.format("ö")).encode("latin-1"), "error", (2, 6), "byte 0xF6 is not UTF-8: xacro"),
        (
            "r.urdf",
            PLAIN.format("éé").encode("latin-1"),
            "warning",
            (2, 6),
            "byte 0xE9 is not UTF-8: programs that read it as",
        ),
        ("r.urdf", PLAIN.format("é").encode("utf-16"), "error", (1, 1), "the file is in UTF-16: urdfdom rejects"),
        ("r.xacro", PLAIN.format("é").encode("utf-16"), "error", (1, 1), "the file is in UTF-16: xacro rejects"),
        ("r.xacro", b"\xef\xbb\xbf" + PLAIN.format("é\xe9").encode("latin-1"), "error", (2, 6), "byte 0xE9"),
    ],
)
def test_what_is_no_utf8_is_found_at_its_place(write, name, content, severity, place, message):
    (finding,) = lint(write(name, content))
    assert (finding.code, finding.severity, (finding.line, finding.column)) == ("E001", severity, place)
    assert finding.message.startswith(message)
    assert finding.help == "save the file as UTF-8"


@pytest.mark.parametrize("name", ["r.urdf", "r.urdf.xacro"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_utf8_is_silent_and_so_is_the_character_that_stands_for_others(write, name, encoding):
    assert lint(write(name, PLAIN.format("é \ufffd").encode(encoding))) == []


def test_a_byte_in_a_name_is_one_finding(write):
    (finding,) = lint(write("r.xacro", PLAIN.replace('"a"', '"ä"').encode("latin-1")))
    assert (finding.code, finding.line, finding.column) == ("E001", 2, 24)


def test_an_included_file_is_found_too(write):
    write("part.xacro", PLAIN.format("é").encode("latin-1"))
    (finding,) = lint(write("r.xacro", '<xacro:include filename="part.xacro"/>'))
    assert (finding.code, finding.file, finding.line) == ("E001", "part.xacro", 2)
