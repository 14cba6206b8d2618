"""Lines that are inserted before the end of a robot: indentation, line ends, place; and the prefix of xacro."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.errors import ResourceError
from urdfkit.scaffold.additions.xml_insertion import insert_before_end, xacro_prefix

PATH = Path("r.urdf")
LINES = "<a>\n  <b/>\n\n</a>\n"


@pytest.mark.parametrize(
    ("unit", "used"),
    [
        ("  ", "  "),
        ("    ", "    "),
        ("\t", "\t"),
        (" " * 8, " " * 8),
        (" " * 9, "  "),  # aligned with something, no indentation
        ("", "  "),
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_lines_have_the_indentation_and_the_ends_of_the_file(unit: str, used: str, end: str) -> None:
    text = f'<robot name="r">\n<!--\n   <c/>\n-->\n{unit}<link name="a"/>\n</robot>\n'.replace("\n", end)
    inserted = f"{used}<a>\n{used}{used}<b/>\n\n{used}</a>\n".replace("\n", end)
    expected = text.replace("</robot>", f"{inserted}</robot>")
    assert insert_before_end(text.encode(), LINES, path=PATH) == expected.encode()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<robot></robot>", "<robot>\n  <a/>\n</robot>"),
        ("<robot>\n  </robot>", "<robot>\n  <a/>\n  </robot>"),
        ("<robot>\n</robot ><!-- </robot> -->", "<robot>\n  <a/>\n</robot ><!-- </robot> -->"),
        ("<robot><![CDATA[</robot>]]>\n</robot>", "<robot><![CDATA[</robot>]]>\n  <a/>\n</robot>"),
    ],
)
def test_lines_stand_before_the_last_end_of_a_robot(text: str, expected: str) -> None:
    assert insert_before_end(text.encode(), "<a/>\n", path=PATH) == expected.encode()


def test_a_file_without_an_end_is_an_error() -> None:
    with pytest.raises(ResourceError, match=r"^r\.urdf has no </robot>, before which elements could be inserted$"):
        insert_before_end(b"<robot/><!-- </robot> -->", LINES, path=PATH)


@pytest.mark.parametrize(
    ("declaration", "prefix"),
    [
        ('xmlns:xacro="http://www.ros.org/wiki/xacro"', "xacro"),
        ("xmlns:x='https://ros.org/wiki/xacro/'", "x"),
        ('xmlns:x = "http://wiki.ros.org/xacro"', "x"),
        ('xmlns:x="http://example.org/xacro"', None),
        ('><!-- xmlns:x="http://wiki.ros.org/xacro" --', None),
        ("", None),
    ],
)
def test_the_prefix_of_xacro_is_the_declared_one(declaration: str, prefix: str | None) -> None:
    assert xacro_prefix(f"<robot {declaration}></robot>".encode()) == prefix
