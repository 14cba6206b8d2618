"""The tags of a file as written."""

from __future__ import annotations

import re
import time

from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.model.tags import Document

names = st.sampled_from(["link", "xacro:macro", "a", "joint-1", "_x.y"])
values = st.text(st.characters(exclude_characters='<&"\r\n\t', exclude_categories=("Cs", "Cc")), max_size=8)
spaces = st.sampled_from([" ", "\n  ", "\t"])


@st.composite
def elements(draw, depth: int = 0) -> str:
    name = draw(names)
    attributes = draw(st.dictionaries(st.sampled_from(["x", "y:z", "name"]), values, max_size=3))
    written = "".join(f'{draw(spaces)}{key} = "{value}"' for key, value in attributes.items())
    if depth > 2 or draw(st.booleans()):
        return f"<{name}{written}/>"
    parts = st.one_of(
        elements(depth=depth + 1),
        st.sampled_from(["<!-- <a> -->", "<![CDATA[ </a> ]]>", "<?pi <a> ?>", "text > more", "\r\n", ""]),
    )
    inside = "".join(draw(st.lists(parts, max_size=4)))
    return f"<{name}{written}>{inside}</{name}{draw(st.sampled_from(['', ' ']))}>"


@given(elements())
def test_it_sees_what_expat_sees(text):
    source = Source("f", text)
    tree = document_of(source)
    document = Document(source)
    expected = [(element.tag, list(element.attributes), element.origin.position) for element in tree.walk()]
    tags = list(document.walk())
    assert [(tag.name, list(tag.attributes), source.position(tag.start)) for tag in tags] == expected
    for tag in tags:
        assert text[tag.start : tag.end].endswith("/>" if tag.empty else ">")
        if tag.close is not None:
            assert re.fullmatch(rf"</{re.escape(tag.name)}\s*>", text[tag.close : tag.close_end])
        for attribute in tag.attributes.values():
            assert text[attribute.value_start : attribute.value_end] == attribute.value
            assert text[attribute.start :].startswith(attribute.name)


@given(st.text(st.sampled_from("<>/ab='\" !-[]?\n"), max_size=60))
def test_any_text_can_be_read(text):
    document = Document(Source("f", text))
    for tag in document.walk():
        assert text[tag.start] == "<"
        assert tag.start < tag.end <= tag.close_end <= len(text)


def test_hostile_text_takes_no_time():
    began = time.process_time()
    for part in ("<a '", '<a b="', "<!--", "<![CDATA[", "<a ", "<a/", "<!DOCTYPE ["):
        list(Document(Source("f", part * 20_000)).walk())
    assert time.process_time() - began < 60  # seconds; quadratic behaviour would take hours
