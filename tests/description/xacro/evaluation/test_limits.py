"""Hostile files are refused within 10 s of CPU, each with an error that names the cause and its place."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.description.xacro.evaluation.test_expression_limits import GROWING
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.evaluation.evaluator import Evaluator
from urdfkit.description.xacro.evaluation.texts import unreadable
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.errors import UrdfkitError

Write = Callable[[str, str], Path]


def evaluated(path: Path) -> Expanded:
    """Expand a file with the evaluator."""
    return Evaluator(str(path), {}, Packages(near=path)).expand()


@pytest.mark.parametrize("expression", GROWING)
def test_an_expression_that_grows_is_refused(write: Write, expression: str) -> None:
    path = write("m.xacro", f'HEAD\n  <link name="${{{expression}}}"/></robot>')
    start = time.process_time()
    with pytest.raises(UrdfkitError) as caught:
        evaluated(path)
    assert time.process_time() - start < FINITE
    assert str(caught.value).startswith("m.xacro:2:3: ")
    assert "\n" not in str(caught.value)


def _macros(count: int, body: str) -> str:
    return "".join(f'<xacro:macro name="m{i + 1}">{body.format(i)}</xacro:macro>' for i in range(count))


KEYS = ", ".join(f"k{key}: 1" for key in range(700))
MERGES = f"base: &base {{{KEYS}}}\n" + "".join(f"a{number}: {{<<: *base}}\n" for number in range(700))
FINITE = 60.0
"""CPU seconds that no refusal needs, on any machine. Without its limits, a hostile file takes hours."""

HOSTILE = {
    "recursion": (
        '<xacro:macro name="m" params="a"><xacro:m a="1"/></xacro:macro><xacro:m a="1"/>',
        "infinite recursion",
    ),
    "parameter": ('<xacro:macro name="m" params="a"><xacro:m/></xacro:macro><xacro:m a="1"/>', "needs `a`"),
    "macros": (f'<xacro:macro name="m0"><l/></xacro:macro>{_macros(8, "<xacro:m{0}/>" * 30)}<xacro:m8/>', "nested"),
    "merges": ("<l a=\"${len(xacro.load_yaml('merges.yaml'))}\"/>", "merge keys"),
    "depth": ("<l a=\"${len(xacro.load_yaml('deep.yaml'))}\"/>", "nested"),
    "values": ("<l a=\"${xacro.load_yaml('values.yaml')[0]}\"/>" * 20, "exceed 1,000,000 steps"),
    "comments": (
        "<l a=\"${[xacro.load_yaml('comments.yaml') for i in python.range(1000)]}\"/>",
        "exceed 1,000,000 steps",
    ),
    "attribute": (f'<l a="{"x" * 10**7}"/>', "characters"),
    "params": (
        f'<xacro:macro name="m" params="a:={"b" * 60}&apos;{"&apos;" * 61}"/><xacro:m2/>',
        "`m2` is not defined",
    ),
    "includes": ('<xacro:include filename="double*.xacro"/>', "cycle"),
    "properties": (
        "".join(f'<xacro:property name="property{i}" value="{i}"/>' for i in range(90_000)) + '<l a="${propertyx}"/>',
        "property `propertyx` is not defined",
    ),
    "definitions": (
        "".join(f'<xacro:macro name="macro{i}"/>' for i in range(90_000)) + "<xacro:macrox/>",
        "macro `macrox` is not defined",
    ),
    "patterns": ('<xacro:include filename="/*/*/*/*/*/*/none*.xacro"/>' * 20, "cannot include .* 1,000,000 steps"),
    "device": ('<xacro:include filename="/dev/zero"/>', "cannot include `/dev/zero`: /dev/zero is not a regular file"),
    "text": ("${'x' * 99999}" * 9, "is too large: it creates a string of more than 100,000 characters"),
    "chain": (
        '<xacro:property name="p0" value="1"/>'
        + "".join(f'<xacro:property name="p{i + 1}" value="${{p{i} + 1}}"/>' for i in range(3000))
        + '<l a="${p3000}"/>',
        "properties use each other",
    ),
}


def hostile_file(write: Write, text: str) -> Path:
    """Write a file, and those that hostile files read; return its path."""
    write("merges.yaml", MERGES)
    write("deep.yaml", "[" * 5000 + "]" * 5000)
    write("values.yaml", f"[{'1,' * 60_000}]")
    write("comments.yaml", "# comment\n" * 40_000 + "a: 1\n")
    for number in range(2):
        write(f"double{number}.xacro", 'HEAD<xacro:include filename="double*.xacro"/></robot>')
    return write("m.xacro", f"HEAD{text}</robot>")


@pytest.mark.slow
@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_refused(write: Write, name: str) -> None:
    text, cause = HOSTILE[name]
    path = hostile_file(write, text)
    start = time.process_time()
    with pytest.raises(UrdfkitError, match=cause):
        evaluated(path)
    assert time.process_time() - start < FINITE


@pytest.mark.slow
def test_recovery_spends_no_more_on_files_that_are_refused(write: Write) -> None:
    write("deep.yaml", "[" * 2_000 + "]" * 2_000)
    path = write("m.xacro", "HEAD" + "<l a=\"${xacro.load_yaml('deep.yaml')}\"/>" * 1000 + "</robot>")
    start = time.process_time()
    assert "nested too deep" in expand_leniently(path).faults[0].message
    assert time.process_time() - start < FINITE


def test_a_file_in_a_folder_without_permission_cannot_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path) -> bool:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "is_dir", refuse)
    missing = OSError("cannot open")
    missing.filename = "private/part.xacro"
    assert str(unreadable(missing, is_include=True)) == "included file private/part.xacro cannot be read"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("definition", "use"),
    [
        ('<xacro:property name="part_{}" value="1"/>', '<link name="${{part_{}x}}"/>'),
        ('<xacro:macro name="part_{}"><a/></xacro:macro>', "<xacro:part_{}x/>"),
    ],
    ids=["properties", "macros"],
)
def test_many_undefined_names_take_linear_time(definition: str, use: str, write: Write) -> None:
    names = range(5_000)
    text = "\n".join([*(definition.format(k) for k in names), *(use.format(k) for k in names)])
    start = time.process_time()
    found = expand_leniently(write("m.xacro", f"HEAD\n{text}</robot>"))
    assert time.process_time() - start < FINITE
    assert len(found.faults) >= len(names)
