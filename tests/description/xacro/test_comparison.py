"""Comparison with the xacro package: its process has limits and its own errors."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.comparison import LineDifference, first_difference, text_of_xacro
from urdfkit.description.xacro.expand import expand
from urdfkit.errors import XacroError

Write = Callable[[str, str], Path]


@pytest.mark.parametrize(
    ("first", "second", "difference"),
    [
        ("a\nb\n", "a\nb\n", None),
        ("a\nbcd\n", "a\nbxd\n", LineDifference(2, 2, "bcd", "bxd")),
        ("a\n", "a\nb\n", LineDifference(2, 1, "", "b")),
        ("a\nb", "a", LineDifference(2, 1, "b", None)),
    ],
)
def test_the_first_difference(first: str, second: str, difference: LineDifference | None) -> None:
    assert first_difference(first, second) == difference


def test_arguments_and_packages_reach_the_xacro_package(write: Write) -> None:
    write("elsewhere/p/package.xml", "<package><name>p</name></package>")
    path = write("m.xacro", 'HEAD<xacro:arg name="n" default="1"/><link name="$(arg n)é" path="$(find p)"/></robot>')
    packages = Packages(["elsewhere"], path)
    text = text_of_xacro(path, {"n": "two"}, packages)
    assert f'name="twoé" path="{Path("elsewhere/p").absolute()}"' in text
    assert text == expand(path, arguments={"n": "two"}, packages=packages, run_xacro=True).xml


def test_the_xacro_package_finds_the_package_of_the_file(write: Write) -> None:
    own = write("src/own/package.xml", "<package><name>own</name></package>").parent.absolute()
    path = write("src/own/urdf/m.xacro", 'HEAD<link name="a" path="$(find own)"/></robot>')
    assert f'path="{own}"' in text_of_xacro(path, {}, Packages([], path))


def test_the_working_folder_cannot_replace_modules(write: Write) -> None:
    write("xacro.py", "raise SystemExit(7)")
    assert "<link" in text_of_xacro(write("m.xacro", 'HEAD<link name="a"/></robot>'), {}, Packages())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("${9**9**9}", "no result within 2 s"),
        ("${len([0] * 10**10)}", "MemoryError"),
        ("${x}", "NameError: name 'x' is not defined"),
        ("<a>", "ExpatError: mismatched tag"),
    ],
)
def test_the_xacro_package_is_stopped_at_its_limits(write: Write, body: str, message: str) -> None:
    path = write("m.xacro", f"HEAD<link>{body}</link></robot>")
    with pytest.raises(XacroError, match=message):
        text_of_xacro(path, {}, Packages(), time_limit=2.0 if "9**9" in body else 60.0)
