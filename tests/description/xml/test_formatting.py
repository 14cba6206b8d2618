"""Formatting: the expanded robot stays, comments and attribute order stay, formatting twice is formatting once."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
import xacro
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expand import expand
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.formatting import formatted
from urdfkit.description.xml.source import Source
from urdfkit.errors import UrdfkitError
from urdfkit.lint.project.description_files import walk

ROOT = Path(__file__).parents[3]
CORPUS = ROOT.parent / "shared" / "corpus"


def form(text: str, **options: int) -> str:
    result = formatted(Source("robot.urdf", text), **options)
    assert formatted(Source("robot.urdf", result), **options) == result
    return result


@pytest.mark.parametrize(
    ("written", "wanted"),
    [
        ("<a  b = \"1\"\tc='2' ></a >", "<a b=\"1\" c='2'></a>\n"),
        ("<a><b/> <c />\n</a>", "<a>\n  <b/>\n  <c/>\n</a>\n"),
        ("<a><b><c>\n<d/></c></b></a>", "<a>\n  <b>\n    <c>\n      <d/>\n    </c>\n  </b>\n</a>\n"),
        ("<a><b/><c/></a>", "<a><b/><c/></a>\n"),
        ("<a>\n\n\n\n<b/>\n\n\n</a>", "<a>\n\n  <b/>\n</a>\n"),
        ("<a>\n<b>  two\n  words </b>\n</a>", "<a>\n  <b>  two\n  words </b>\n</a>\n"),
        ("<a>\n<b>one <c  d='1' />two\n   <e/></b>\n</a>", "<a>\n  <b>one <c  d='1' />two\n   <e/></b>\n</a>\n"),
        ("<a>\n<b>\n</b><c> </c>\n</a>", "<a>\n  <b>\n  </b>\n  <c> </c>\n</a>\n"),
        (
            "<a>\n<b/><!-- of b -->\n<!-- of c -->\n<c/>\n</a>",
            "<a>\n  <b/> <!-- of b -->\n  <!-- of c -->\n  <c/>\n</a>\n",
        ),
        ("<a>\n\t<!-- one\n\t     two -->\n</a>", "<a>\n  <!-- one\n       two -->\n</a>\n"),
        ('<a>\n<b c="1"\nd="2"\n/>\n</a>', '<a>\n  <b c="1"\n     d="2"/>\n</a>\n'),
        ('<a>\n<b\nc="1"\nd="2">\n<e/></b>\n</a>', '<a>\n  <b\n      c="1"\n      d="2">\n    <e/>\n  </b>\n</a>\n'),
        ('<a>\n<b c="1"   d="2"/>\n<b c="10"  d="2"/></a>', '<a>\n  <b c="1"   d="2"/>\n  <b c="10"  d="2"/>\n</a>\n'),
        ("<a>\r\n<b/>\r\n</a>", "<a>\r\n  <b/>\r\n</a>\r\n"),
        ('<a xml:space="preserve">\n<b/> </a>', '<a xml:space="preserve">\n<b/> </a>\n'),
        ("<a>\n<b><![CDATA[ <x> ]]></b></a>", "<a>\n  <b><![CDATA[ <x> ]]></b>\n</a>\n"),
        ("<?xml version='1.0'?><!DOCTYPE a><!--x--><a/>", "<?xml version='1.0'?>\n<!DOCTYPE a> <!--x--> <a/>\n"),
        (
            "<a>\n<!-- urdfkit: format off --><b   />\n   <c />\n<!-- urdfkit: format on -->\n<d   />\n</a>",
            "<a>\n  <!-- urdfkit: format off --><b   />\n   <c />\n<!-- urdfkit: format on -->\n  <d/>\n</a>\n",
        ),
        (
            '<robot>\n\t<xacro:macro name="m" params="one\n\t\ttwo">\n\t</xacro:macro>\n</robot>',
            '<robot>\n  <xacro:macro name="m" params="one\n    two">\n  </xacro:macro>\n</robot>\n',
        ),
    ],
)
def test_layout(written: str, wanted: str) -> None:
    assert form(written) == wanted


def test_indent_and_long_attributes() -> None:
    assert form("<a>\n<b/>\n</a>", indent=4) == "<a>\n    <b/>\n</a>\n"
    value = "x" * 110
    assert form(f'<a>\n<long c="1"\nd="{value}"/></a>') == f'<a>\n  <long c="1"\n      d="{value}"/>\n</a>\n'


@pytest.mark.parametrize("written", ["<a>", "", '<!DOCTYPE a [<!ENTITY b "c">]><a/>', "<a b='<'/>"])
def test_a_file_that_is_not_well_formed_is_refused(written: str) -> None:
    with pytest.raises(UrdfkitError, match=r"robot.urdf:1:"):
        form(written)


def test_white_space_is_not_added_around_an_inserted_text() -> None:
    """``<p><xacro:if>`` may expand to a text, which must stay the only content of the element."""
    text = '<robot xmlns:xacro="http://ros.org/xacro">\n<p><xacro:if value="1">a<q>\n<r/></q></xacro:if></p>\n</robot>'
    assert '<p><xacro:if value="1">a<q>\n<r/></q></xacro:if></p>' in form(text)


def test_a_tab_in_kept_text_counts_as_the_columns_it_fills() -> None:
    form('<a><a> <e\tn="1"/><![CDATA[x]]></a><!-- one\n  two -->\n</a>')


_NAMES = st.sampled_from(["a", "b", "xacro:if", "xacro:macro", "xacro:m"])
_GAPS = st.sampled_from(
    ["", " ", "\n", "\n\n\n", "\t\n  ", " text ", "<!-- c -->", "<!-- one\n  two -->\n", "<![CDATA[x]]>"]
)
_ATTRIBUTES = st.lists(st.sampled_from([' {}="1"', '\n{} = "a\n b"', "   {}='>'", '\t{}="/>"']), max_size=3)


def _element(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    def build(name: str, attributes: list[str], parts: list[tuple[str, str]], last: str) -> str:
        written = "".join(one.format(f"n{number}") for number, one in enumerate(attributes))
        return f"<{name}{written}>{''.join(gap + child for gap, child in parts)}{last}</{name} >"

    return st.builds(build, _NAMES, _ATTRIBUTES, st.lists(st.tuples(_GAPS, children), max_size=4), _GAPS)


@given(st.recursive(st.sampled_from(["<e/>", '<e f="1"  />', "<e></e>"]), _element, max_leaves=12))
def test_any_document_keeps_its_content_and_is_stable(text: str) -> None:
    result = form(text)  # compares the content of the file before and after
    assert not re.search(r"(?m)^<!--.*[ \t]$", result)


def descriptions() -> list[Path]:
    folders = [ROOT / "robots", ROOT / "templates", CORPUS, ROOT.parent / "shared" / "seeds"]
    return [path for folder in folders if folder.is_dir() for path in walk(folder)]


@pytest.mark.slow
def test_every_description_is_stable_and_ours_are_formatted() -> None:
    refused = []
    for path in descriptions():
        source = Source.read(path)
        try:
            result = formatted(source)
        except UrdfkitError as error:
            refused.append(str(error))
            continue
        assert formatted(Source(source.file, result)) == result, path
        if path.is_relative_to(ROOT):
            assert result == source.text, path
    assert len(refused) < 5
    assert "internal" not in "".join(refused)


@pytest.mark.slow
@pytest.mark.skipif(not CORPUS.is_dir(), reason="no corpus next to the checkout")
def test_the_expanded_robot_of_every_file_of_the_corpus_is_unchanged() -> None:
    texts: dict[str, str] = {}
    for path in walk(CORPUS):
        try:
            texts[str(path)] = formatted(Source.read(path))
        except UrdfkitError:
            continue
    expected = json.loads((CORPUS / "expected.json").read_text())
    compared, changed = 0, []
    for entry in [*expected["models"], *expected["others"]]:
        path = CORPUS / entry["entry"]
        roots, errors = [], []
        for used in ({}, texts):
            try:
                found = expand(
                    path, arguments=entry.get("args"), packages=Packages(near=path), run_xacro=True, texts=used
                )
                roots.append(found.root)
            except UrdfkitError as error:
                errors.append(type(error))
        compared += len(roots) == 2
        if len(errors) == 1 or (len(roots) == 2 and content(roots[0]) != content(roots[1])):
            changed.append(entry["entry"])
    assert changed == []
    assert compared > 280


def test_stock_xacro_prints_the_same_robot(tmp_path: Path) -> None:
    path = tmp_path / "robot.xacro"
    text = """<robot   name = "r" xmlns:xacro="http://ros.org/xacro">
<!-- of the macro: not printed -->
<xacro:macro name="m" params="a
      b:=2 *block">
<link name="${a}"><visual>
<xacro:insert_block name="block"/></visual></link>
</xacro:macro>

<!-- kept -->

<xacro:property name="t"   value="some text"/>
<xacro:m a="x" ><origin xyz="0 0 1" /></xacro:m><gazebo><p>${t}</p></gazebo>
</robot>"""
    printed = []
    for version in (text, form(text)):
        path.write_text(version)
        printed.append(xacro.process_file(str(path)).toprettyxml(indent="  "))
    assert form(text) != text
    assert printed[0] == printed[1]


def content(element: Element | None) -> list[tuple[str, list[tuple[str, str]], str]]:
    return [(e.tag, list(e.attributes.items()), e.text) for e in element.walk()] if element is not None else []
