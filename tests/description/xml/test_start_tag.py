from __future__ import annotations

from urdfkit.description.xml.source import Position, Source
from urdfkit.description.xml.start_tag import element_span, start_tag

TEXT = """<robot name='r'>
  <link
     name = "a>b" kind='"q"'/>
  <!-- </joint> --><joint name="j"><joint/><!-- <joint> --><![CDATA[</joint>]]></joint >
</robot>
"""
SOURCE = Source("f", TEXT)


def slice_of(span: object) -> str:
    at = SOURCE.offset(span.line, span.column)  # type: ignore[attr-defined]
    return TEXT[at : SOURCE.offset(span.end_line, span.end_column)]  # type: ignore[attr-defined]


def test_the_parts_of_a_start_tag() -> None:
    tag = start_tag(SOURCE, Position("f", 2, 3))
    assert tag is not None
    assert slice_of(tag.span) == '<link\n     name = "a>b" kind=\'"q"\'/>'
    assert slice_of(tag.name) == "link"
    assert slice_of(tag.attributes["name"].name) == "name"
    assert slice_of(tag.attributes["name"].value) == "a>b"
    assert slice_of(tag.attributes["name"].whole) == '\n     name = "a>b"'
    assert (tag.attributes["kind"].quote, tag.attributes["kind"].raw) == ("'", '"q"')
    assert tag.is_empty


def test_a_whole_element() -> None:
    span = element_span(SOURCE, Position("f", 4, 20))
    assert span is not None
    assert slice_of(span) == '<joint name="j"><joint/><!-- <joint> --><![CDATA[</joint>]]></joint >'
    whole = element_span(SOURCE, Position("f", 1, 1))
    assert whole is not None
    assert slice_of(whole) == TEXT.rstrip()


def test_where_no_tag_is() -> None:
    assert start_tag(SOURCE, Position("f", 1, 2)) is None
    assert start_tag(SOURCE, Position("f", 99, 1)) is None
    assert start_tag(SOURCE, Position("f", 5, 1)) is None
    assert element_span(SOURCE, Position("f", 99, 1)) is None


def test_offsets_and_positions_are_inverse() -> None:
    for offset in range(len(TEXT) + 1):
        position = SOURCE.position(offset)
        assert SOURCE.offset(position.line, position.column) == offset
    assert SOURCE.line(1) == "<robot name='r'>"
    assert SOURCE.line(0) == SOURCE.line(77) == ""
