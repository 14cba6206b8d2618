"""Facts about the language of xacro 2.1: a file and its expansion."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import xacro

from tests.description.xacro.evaluation.stock import by_stock_xacro
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.evaluation.directives import is_identifier
from urdfkit.description.xacro.evaluation.evaluator import Evaluator
from urdfkit.description.xacro.evaluation.parameters import MacroParameter, parameters

Write = Callable[[str, str], Path]

FACTS = [
    ('<xacro:property name="x" value="1"/>${x}', "1"),
    ('<xacro:property name="x" value="${y}"/><xacro:property name="y" value="2"/>${x}', "2"),
    ('<xacro:property name="x" value="1"/><xacro:property name="x" default="2"/>${x}', "1"),
    ('<xacro:property name="x" default="2"/>${x}', "2"),
    ("<xacro:property name=\"x\" value=\"'a b'\"/>${x * 2}", "a ba b"),
    ('<xacro:property name="x" value="1_000"/>${x}', "1_000"),
    ('<xacro:property name="x" value="true"/>${x}', "True"),
    ("$${x} $$(y) $$$${z}", "${x} $(y) $$${z}"),
    ('<xacro:arg name="a" default="3"/>$(arg a)', "3"),
    ('<xacro:arg name="a" default="3"/>$(eval a * 2)', "6"),
    ("$(optenv NO_SUCH_VARIABLE a b)", "a b"),
    ('<xacro:if value="${1 == 1.0}">yes</xacro:if>', "yes"),
    ('<xacro:unless value="0">yes</xacro:unless>', "yes"),
    ('<xacro:macro name="m" params="a b:=2 c:=^|3">${a}${b}${c}</xacro:macro><xacro:m a="1"/>', "123"),
    ('<xacro:property name="c" value="9"/><xacro:macro name="m" params="c:=^">${c}</xacro:macro><xacro:m/>', "9"),
    ('<xacro:macro name="m" params="*b"><xacro:insert_block name="b"/></xacro:macro><xacro:m><q/></xacro:m>', "<q/>"),
    ('<xacro:macro name="m" params="**b"><xacro:insert_block name="b"/></xacro:macro><xacro:m><q>1</q></xacro:m>', "1"),
    ('<xacro:macro name="m"><q/></xacro:macro><xacro:call macro="${\'m\'}"/>', "<q/>"),
    ('<xacro:element xacro:name="${\'q\'}" a="1"/>', '<q a="1"/>'),
    ('<q><xacro:attribute name="a" value="b"/></q>', '<q a="b"/>'),
    ('<xacro:macro name="m"><xacro:property name="x" value="5" scope="parent"/></xacro:macro><xacro:m/>${x}', "5"),
    ("${xacro.load_yaml('f.yaml').a[1].b}", "7"),
    ("${xacro.load_yaml('f.yaml')['angle']}", "3.141592653589793"),
    ("${[x.b for x in xacro.load_yaml('f.yaml').a[1:]]}", "[7]"),
    ("${dict(a=1)} ${[1.0, 'x']} ${None}", "{'a': 1} [1.0, 'x'] None"),
    ("<!-- xacro:eval-comments --><!-- ${1 + 1} -->", "<!-- 2 -->"),
    ("${list(map(lambda x: x * 2, [1, 2]))}", "[2, 4]"),
    ("${python.type(1) == int}", "True"),
    ("${str} ${len}", "&lt;class 'str'&gt; &lt;built-in function len&gt;"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "expected"), FACTS)
def test_a_file_expands(write: Write, text: str, expected: str) -> None:
    write("f.yaml", "a: [1, {b: 7}]\nangle: !degrees 180\n")
    path = write("m.xacro", f"HEAD{text}</robot>")
    packages = Packages(near=path)
    expanded = Evaluator(str(path), {}, packages).expand()
    assert expected in expanded.xml
    assert expanded.xml == by_stock_xacro(path, {}, packages).text


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a b", [MacroParameter("a"), MacroParameter("b")]),
        ("a:=1 *b", [MacroParameter("a", True, False, "1"), MacroParameter("*b")]),
        ("a := 1", [MacroParameter("a", True, False, "1")]),
        ("a:=^", [MacroParameter("a", True, True, None)]),
        ("a:=^|${x + 1} b", [MacroParameter("a", True, True, "${x + 1}"), MacroParameter("b")]),
        ("a:='x y' b", [MacroParameter("a", True, False, "'x y'"), MacroParameter("b")]),
        ("a:=", [MacroParameter("a", True, False, None)]),
    ],
)
def test_parameters_are_read(text: str, expected: list[MacroParameter]) -> None:
    assert list(parameters(text)) == expected


@pytest.mark.parametrize(
    "name", ["a", "a_1", "if", "True", "None", "match", "_", "1a", "a b", "é", "ﬁ", "", " a", "a.b", "print"]
)
def test_names_of_properties_are_those_of_stock_xacro(name: str) -> None:
    assert is_identifier(name) == xacro.is_valid_name(name)
