from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.dom import minidom

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description.xacro.evaluation.element_conversion import element_of
from urdfkit.description.xacro.evaluation.tree_reader import read_tree
from urdfkit.description.xacro.expand import expand, expand_leniently
from urdfkit.description.xml.element import MAX_DEPTH, Element
from urdfkit.description.xml.reader import MAX_ATTRIBUTES, MAX_BYTES, MAX_VALUE, document_of, read_source
from urdfkit.description.xml.source import Source
from urdfkit.description.xml.start_tag import element_span, start_tag
from urdfkit.errors import ResourceError, UrdfkitError, XmlError

Write = Callable[[str, str], Path]

HOSTILE = {
    "bomb": '<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><robot name="&b;"/>',
    "parameter entity": '<!DOCTYPE r [<!ENTITY % a "b"> %a;]><robot name="r"/>',
    "external entity": '<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot name="r">&x;</robot>',
    "external parameter entity": '<!DOCTYPE r [<!ENTITY % x SYSTEM "http://127.0.0.1/x"> %x;]><robot name="r"/>',
    "external subset": '<!DOCTYPE robot SYSTEM "file:///etc/passwd"><robot name="r"/>',
    "public subset": '<!DOCTYPE robot PUBLIC "-//x" "http://127.0.0.1/x"><robot name="r"/>',
    "depth": "<robot>" + "<a>" * 100_000 + "</a>" * 100_000 + "</robot>",
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE.keys())
@pytest.mark.parametrize("suffix", ["urdf", "xacro"])
def test_hostile_xml_is_refused_with_its_place(write: Write, text: str, suffix: str) -> None:
    with pytest.raises(XmlError, match=r"rejected|nested deeper|exceed the limit") as caught:
        expand(write(f"a.{suffix}", text))
    assert str(caught.value).startswith(f"a.{suffix}:1:")


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE.keys())
def test_hostile_xml_is_refused_where_it_is_included(write: Write, text: str) -> None:
    write("inner.xacro", text)
    main = write("m.xacro", 'HEAD<xacro:include filename="inner.xacro"/><link name="a"/></robot>')
    with pytest.raises(XmlError) as caught:
        expand(main)
    assert str(caught.value).startswith("inner.xacro:1:")
    lenient = expand_leniently(main)
    assert [fault.kind for fault in lenient.faults] == ["xml"]
    assert lenient.root is not None
    assert [child.tag for child in lenient.root.children] == ["link"]


def test_a_document_type_that_only_names_the_root_is_harmless(write: Write) -> None:
    root = expand(write("a.xacro", '<!DOCTYPE robot><robot name="r"/>')).root
    assert root is not None
    assert root.tag == "robot"


def test_a_file_of_any_size_is_not_read_whole() -> None:
    with pytest.raises(ResourceError, match="larger than"):
        read_source(Path("/dev/zero"))
    assert MAX_BYTES <= 2**27


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("", "1:1", "the file is empty"),
        ("  \n", "1:1", "the file is empty"),
        ("hello", "1:1", "this is not XML"),
        ("<robot>\n <link>\n</robot>", "2:2", "mismatched tag: `<link>` is not closed before `</robot>` on line 3"),
        ("<robot>\n <link>\n</lnik></robot>", "3:3", "`<link>` on line 2 is not closed before `</lnik>`"),
        ('<robot>\n <a b="1\n c="2"/>\n</robot>', "3:5", "not well-formed near '2"),
        ('<robot>\n <a b="1/>\n <c/>\n</robot>', "2:7", "the quote \" is not closed before the `<` on line 3"),
        ("<robot>\n <a b='1' c=\"2\"\n\n <c/>\n</robot>", "2:15", "`>` is missing before the `<` on line 4"),
        ("<robot>\n <link>\n", "3:1", "the file ends too early: `<link>` on line 2 is not closed"),
        ("<robot>\n<link name=a/></robot>", "2:12", "not well-formed near 'a/>"),
        ('<robot>\n<link name="a/></robot>', "2:16", "a quote or `>` is missing before it"),
        ("<robot>\n<a b='<'/></robot>", "2:7", "unexpected `<`"),
        ("<robot>\na & b</robot>", "2:4", "not well-formed"),
        ("<robot/>\n<robot/>", "2:1", "content after the end of the root element"),
        ("\n<?xml version='1.0'?><robot/>", "2:1", "very start of the file"),
        ("<robot>&nbsp;</robot>", "1:8", "undefined entity"),
        ('<robot a="1" a="2"/>', "1:14", "duplicate attribute"),
        ("<robot>\n<xacro:a/></robot>", "2:1", 'unbound prefix: `xacro:` needs xmlns:xacro="http://www.ros.org/wiki/xacro"'),
    ],
)  # fmt: skip
def test_what_is_not_well_formed(write: Write, text: str, place: str, message: str) -> None:
    with pytest.raises(XmlError) as caught:
        expand(write("a.xacro", text))
    assert str(caught.value).startswith(f"a.xacro:{place}: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_other_encodings(write: Write) -> None:
    Path("utf16.urdf").write_bytes('<?xml version="1.0" encoding="UTF-16"?><robot name="ö"/>'.encode("utf-16"))
    Path("latin.urdf").write_bytes('<?xml version="1.0" encoding="ISO-8859-1"?><robot name="ö"/>'.encode("latin-1"))
    utf16, latin = expand("utf16.urdf").root, expand("latin.urdf").root
    assert utf16 is not None
    assert utf16.get("name") == "ö"
    assert latin is not None
    assert latin.get("name") == "\ufffd"


names = st.text("abcxyz_", min_size=1, max_size=6)
blanks = st.sampled_from([" ", "\t", "\n", "\r\n", "  \n\t "])
texts = st.text(
    st.characters(codec="utf-8", exclude_characters="<&>\r\"'", exclude_categories=("Cc", "Cs")), max_size=12
)


@st.composite
def documents(draw: st.DrawFn, depth: int = 3) -> str:
    """XML text with white space, comments and characters of every width where they are allowed."""
    tag = draw(names)
    attributes = "".join(
        f'{draw(blanks)}{name}{draw(st.sampled_from(["", " "]))}={draw(st.sampled_from(["", chr(10)]))}"{draw(texts)}"'
        for name in draw(st.lists(names, max_size=3, unique=True))
    )
    if depth == 0 or draw(st.booleans()):
        return f"<{tag}{attributes}/>"
    inside = draw(st.lists(st.one_of(documents(depth=depth - 1), texts, st.just("<!-- ü<b/> -->")), max_size=4))
    return f"<{tag}{attributes}>{''.join(inside)}</{tag}>"


@pytest.mark.slow
@given(documents())
def test_every_element_is_where_its_origin_says(text: str) -> None:
    source = Source("a", text)
    root = document_of(source)
    for element in root.walk():
        position = element.origin.position
        tag = start_tag(source, position)
        assert tag is not None
        assert source.text.startswith(f"<{element.tag}", source.offset(position.line, position.column))
        assert list(tag.attributes) == list(element.attributes)
        assert tag.span.start == position
        span = element_span(source, position)
        assert span is not None
        inside = source.text[source.offset(span.line, span.column) : source.offset(span.end_line, span.end_column)]
        alone = document_of(Source("b", inside))
        assert shape(alone) == shape(element)


@pytest.mark.slow
@given(documents())
def test_both_readers_agree_with_minidom(text: str) -> None:
    source = Source("a", text)
    root, element = minidom.parseString(text).documentElement, document_of(source)
    of_tree = element_of(next(read_tree(source).tags()))
    assert root is not None
    assert shape(element) == shape(of_tree) == shape_of_node(root)
    assert [e.origin for e in element.walk()] == [e.origin for e in of_tree.walk()]


def shape_of_node(node: Any) -> tuple[object, ...]:
    text = "".join(child.data for child in node.childNodes if child.nodeType in (3, 4)).strip()
    children = [shape_of_node(child) for child in node.childNodes if child.nodeType == 1]
    return node.tagName, dict(node.attributes.items()), text, children


def shape(element: Element) -> tuple[object, ...]:
    return element.tag, element.attributes, element.text, [shape(child) for child in element.children]


@given(st.one_of(st.text(max_size=60), st.text("<>/ab='\" &;!-[]\n", max_size=40)))
def test_any_text_is_read_or_refused(text: str) -> None:
    refused: UrdfkitError | None = None
    try:
        document_of(Source("a", text))
    except UrdfkitError as error:
        refused = error
    if refused is not None:
        assert refused.position is not None
        assert "\n" not in str(refused)


@pytest.mark.parametrize("name", ["r.urdf", "r.xacro"])
@pytest.mark.parametrize(
    ("text", "most"),
    [
        (lambda n: f"<robot name='r'>{'<a>' * (n - 1)}{'</a>' * (n - 1)}</robot>", MAX_DEPTH),
        (lambda n: f"<robot name='{'x' * n}'/>", MAX_VALUE),
        (
            lambda n: f"<robot {' '.join(f'a{i}={chr(34) * 2}' for i in range(n))}/><!--{'x' * MAX_VALUE}-->",
            MAX_ATTRIBUTES,
        ),
    ],
    ids=["depth", "value", "attributes"],
)
def test_the_largest_file_is_read_and_a_larger_one_refused(
    text: Callable[[int], str], most: int, name: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_text(text(most))
    expand(path)
    path.write_text(text(most + 1))
    with pytest.raises(XmlError, match=str(most)):
        expand(path)


def test_a_mesh_in_place_of_a_robot_is_named(write: Write) -> None:
    with pytest.raises(XmlError, match="this is a mesh: use the URDF that names it"):
        expand(write("part.stl", "solid part\nendsolid part\n"))
