"""Files come from strangers: what their expressions cannot reach."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.xacro.expand import expand
from urdfkit.errors import XacroError

Write = Callable[[str, str], Path]


@pytest.mark.parametrize(
    "expression",
    [
        "${__import__('os')}",
        "${().__class__}",
        "${[x.__class__ for x in [1]]}",
        "${(lambda: ().__class__.__bases__[0].__subclasses__())()}",
        "${python.vars(python.type)}",
        "${python.vars(xacro)}",
        "${[g.gi_frame.f_back for g in [(x for x in [1])]]}",
        "${(lambda: (x for x in [1]).gi_frame.f_globals)()}",
        "${open('/etc/passwd')}",
        "${eval('1')}",
        "$(eval open)",
        "$(eval __builtins__)",
        "$(eval [g.gi_frame for g in [(x for x in [])]])",
        "$(eval getattr)",
        "$(eval compile)",
        "$(eval vars)",
    ],
)
def test_out_of_reach(write: Write, expression: str) -> None:
    with pytest.raises(XacroError):
        expand(write("m.xacro", f'HEAD<link name="{expression}"/></robot>'))


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("${[x * 2 for x in [1, 2]][1]}", "4"),
        ("${max(1, python.abs(-3))}", "3"),
        ("${(lambda x: x + 1)(2)}", "3"),
        ("${sin(0) + math.cos(0)}", "1.0"),
        ("${'a' 'b'.upper()}", "AB"),
        ("${xacro.tokenize('a,b')[1]}", "b"),
        ("$(eval n * 2)", "6"),
        ("$(eval [n, 1][0] == 3)", "True"),
        ("$(optenv NOTHING_OF_THAT_NAME some words)", "some words"),
    ],
)
def test_what_is_meant_to_work(write: Write, expression: str, value: str) -> None:
    root = expand(write("m.xacro", f'HEAD<xacro:arg name="n" default="3"/><link name="{expression}"/></robot>')).root
    assert root is not None
    assert root.children[0].get("name") == value
