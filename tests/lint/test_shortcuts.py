"""Where a plain look at a text spares a pattern, it states nothing else than the pattern does."""

from __future__ import annotations

import re

from hypothesis import example, given, settings
from hypothesis import strategies as st

from urdfkit.lint.facts import malformed_expressions
from urdfkit.lint.model.xacro_prefix import signatures
from urdfkit.lint.project import robot_text
from urdfkit.lint.rules.document import stray_quote, unbound_namespace_prefix
from urdfkit.lint.rules.xacro import inertia_arguments, unprefixed_macro_call

PIECES = [
    *"$${}()\"'<>\\ \n:=/|-.é",
    *("${a}", "$(arg b)", "a", "xacro:", "xmlns:", "<robot ", ' name="x"', "macro ", "m=", "<inertial>", "</inertial>"),
    *("<?xml ?>", "</", "params=", "<macro name='k' params='m'>", "<k m='1'/>"),
]
TEXTS = st.lists(st.sampled_from(PIECES), max_size=14).map("".join)


@settings(max_examples=300, deadline=None)
@given(TEXTS)
@example("${a")
@example("$${a")
@example("{$a}")
@example("$ {a}")
@example("${a{b}")
def test_unexpanded_expressions(text: str) -> None:
    found = re.search(malformed_expressions._BROKEN, text) or re.search(malformed_expressions._INSIDE_OUT, text)
    assert malformed_expressions.is_unexpanded(text) == (found is not None)


@settings(max_examples=300, deadline=None)
@given(TEXTS)
@example('"> "')
@example("\"'\n</")
def test_quotes_outside_of_tags(text: str) -> None:
    found = any(re.search(pattern, text) for pattern in (r">\s*[\"']", r"\"\s*</", r"'\s*</"))
    assert stray_quote._has_quotes_outside(text) == found


@settings(max_examples=300, deadline=None)
@given(TEXTS)
@example(" a:b=")
def test_prefixes_are_not_overlooked(text: str) -> None:
    found = set(re.findall(unbound_namespace_prefix._PREFIXED, text)) - {"xml", "xmlns"}
    assert found <= unbound_namespace_prefix._before_colons(text)


@settings(max_examples=300, deadline=None)
@given(TEXTS)
@example('<xacro:macro params="a b" name="xacro:m">')
def test_names_of_macros_are_not_overlooked(text: str) -> None:
    assert {name for name, _ in signatures(text)} <= unprefixed_macro_call._near_definitions(text)


@settings(max_examples=300, deadline=None)
@given(TEXTS)
@example('<inertial>\n<k\tm = "1"/></inertial>')
def test_masses_that_are_given_are_not_overlooked(text: str) -> None:
    inside = re.findall(r"<inertial(.*?)(?:</inertial|\Z)", text, re.DOTALL)
    if any(re.search(r"\sm(?:ass)?\s*=", piece) for piece in inside):
        assert any(inertia_arguments._may_name_mass(piece) for piece in text.split("<inertial")[1:])


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(["<robot ", "<?xml ?><robot ", " <robot ", "<!-- -->"]), TEXTS)
@example("<robot ", 'a="x> name="b" c="">')
def test_what_begins_with_a_robot_is_found_to_be_one(begin: str, text: str) -> None:
    if robot_text.begins_with_robot(begin + text):
        root = re.search(robot_text.ROOT, begin + text)
        assert root is not None
        assert root[1] == "robot"
        assert re.search(robot_text.NAMED, root[2])
