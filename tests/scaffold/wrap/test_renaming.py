"""Names that not every tool takes: replaced wherever they stand, each by one of its own; nothing else is touched."""

import re
from xml.sax.saxutils import quoteattr

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.scaffold.templates.names import portable_name
from urdfkit.scaffold.wrap.renaming import in_utf8, renamed, renaming_note


def test_what_is_fine_stays_as_it_is():
    text = '<robot name="a-1">\r\n<link  name = "b.c/d-2"/><!-- <link name="a b"/> --></robot>'
    assert renamed(text, "other") == (text, {})
    assert renaming_note({}) == []


def test_every_place_that_refers_to_it():
    text = (
        '<robot name="My Bot"><link name="a b"/><link\n name=\'a_b\'/><material name="a b"/>'
        '<joint type="fixed" name="a b"><parent link="a b"/><child link="a_b"/>'
        '<mimic multiplier="1" joint="a b"/></joint>'
        '<gazebo reference="a b"><p>a b</p><q> a b , a_b,c d</q><r>not a b</r></gazebo>'
        '<!-- <link name="a b"/> --><transmission name="a b"><joint name="a b"/></transmission></robot>'
    )
    after, new = renamed(text, "my_bot")
    assert new == {"My Bot": "my_bot", "a b": "a_b_2"}
    assert after == (
        '<robot name="my_bot"><link name="a_b_2"/><link\n name=\'a_b\'/><material name="a b"/>'
        '<joint type="fixed" name="a_b_2"><parent link="a_b_2"/><child link="a_b"/>'
        '<mimic multiplier="1" joint="a_b_2"/></joint>'
        '<gazebo reference="a_b_2"><p>a_b_2</p><q> a_b_2 , a_b,c d</q><r>not a b</r></gazebo>'
        '<!-- <link name="a b"/> --><transmission name="a b"><joint name="a_b_2"/></transmission></robot>'
    )


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("base link", "base_link"),
        ("Grün", "Grun"),
        ("part_1 <1>", "part_1_1"),
        ("/map", "map"),
        ("a:b", "a_b"),
        ("日本", ""),
        ("left/wheel", "left/wheel"),
        ("1st.link-2", "1st.link-2"),
    ],
)
def test_the_nearest_name(name, near):
    assert portable_name(name) == near


def test_names_without_any_letter_that_stays():
    assert renamed('<robot name="r"><link name="日本"/><link name="中国"/></robot>', "r")[1] == {
        "日本": "part",
        "中国": "part_2",
    }


@given(
    st.lists(
        st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs")), min_size=1), unique=True, max_size=6
    )
)
def test_no_two_become_one(names):
    text = "<robot name='r'>" + "".join(f"<link name={quoteattr(name)}/>" for name in names) + "</robot>"
    after, new = renamed(text, "r")
    found = re.findall(r'name="([^"]*)"', after.replace("'", '"'))[1:]
    assert len(set(found)) == len(names)
    assert all(portable_name(name) == name for name in found)
    assert renamed(after, "r") == (after, {})
    assert len(renaming_note(new)) == bool(new)


@pytest.mark.parametrize("encoding", ["utf-16", "iso-8859-1", "windows-1252"])
def test_in_utf8(encoding):
    text = '<?xml version="1.0" encoding="{}"?>\r\n<robot name="ü"/>'
    assert in_utf8(text.format(encoding).encode(encoding)) == text.format("utf-8").encode()


@pytest.mark.parametrize(
    "content", [b"<robot/>", b"\xef\xbb\xbf<?xml encoding='UTF-8'?><a/>", b"<?xml encoding='nobody'?>\xfc", b""]
)
def test_what_is_in_utf8_or_what_nobody_knows_stays(content):
    assert in_utf8(content) == content
