"""The text report: excerpt, caret, chain, widths, colours."""

from __future__ import annotations

import re

import pytest

from urdfkit.description.xml.source import Expansion, Position, Source, Span
from urdfkit.lint.engine.run import run
from urdfkit.lint.finding import Finding, Fix
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.lint.report.text import TextReport, statistics, summary

INERTIA = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3"/>'


def at(line: int, column: int, end: int, **options) -> Finding:
    span = Span("f.xacro", line, column, line, end)
    return Finding("T203", "multiple-roots", "error", "wrong", span, **options)


def test_a_whole_report(write):
    text = f"""<xacro:macro name="wheel" params="n">
  <link name="${{n}}"><inertial><mass value="1"/>
    {INERTIA}
  </inertial></link>
</xacro:macro>
<xacro:wheel n="a"/>
<xacro:wheel n="b"/>"""
    outcome = run([Entry(write("r.xacro", text))], Options(select=("I",)))
    (finding,) = outcome.findings
    assert TextReport(outcome.sources).finding(finding) == (
        "r.xacro:4:5: I503 inertia of link `a` is impossible: "
        "principal moments 1.00, 1.00, 3.00 kg·m²: 1.00 + 1.00 < 3.00\n"
        "  |\n"
        f"4 |     {INERTIA}\n"
        f"  |     {'^' * len(INERTIA)}\n"
        "  = in 2 expansions of macro `wheel` (r.xacro:7, :8)\n"
        "  = help: compute it from shape and mass; set placeholders for products of inertia to 0"
    )


def carets(report: TextReport, finding: Finding) -> tuple[str, str]:
    lines = report.finding(finding).splitlines()
    row = next(index for index, line in enumerate(lines) if "^" in line)
    return lines[row - 1], lines[row]


@pytest.mark.parametrize(
    ("line", "start", "end", "marked"),
    [
        ('\t\t<link name="a"/>', 3, 19, '<link name="a"/>'),
        ('<a b="ü"/><link/>', 11, 18, "<link/>"),
        ("<link/>", 1, 8, "<link/>"),
    ],
)
def test_the_caret_is_below_what_is_meant(line, start, end, marked):
    shown, caret = carets(TextReport({"f.xacro": Source("f.xacro", line + "\r\n")}), at(1, start, end))
    assert shown[caret.index("^") : caret.rindex("^") + 1] == marked


def test_wide_letters_take_two_columns():
    shown, caret = carets(TextReport({"f.xacro": Source("f.xacro", '<a b="轮子"/><c/>')}), at(1, 12, 16))
    assert caret.index("^") == shown.index("<c/>") + 2


@pytest.mark.parametrize("width", [30, 40, 80, 500])
@pytest.mark.parametrize("start", [1, 60, 200])
def test_long_lines_are_cut_around_the_place(width, start):
    text = "x" * (start - 1) + '<link name="a"/>' + "y" * 200
    shown, caret = carets(TextReport({"f.xacro": Source("f.xacro", text)}, width=width), at(1, start, start + 16))
    assert max(len(shown), len(caret)) <= width
    assert shown[caret.index("^") :].startswith("<link")


@pytest.mark.parametrize(
    ("line", "span", "caret"),
    [
        ("  <link/>  ", (1, 3, 1, 10), "  ^^^^^^^"),
        ("<link  ", (1, 1, 2, 3), "^^^^^"),
        ("<link/>", (1, 3, 1, 3), "  ^"),
        ("<link/>", (1, 8, 1, 8), "       ^"),
        ("\t<link/>", (1, 1, 1, 2), "^^^^"),
    ],
    ids=["whole", "first line of several", "empty", "after the end", "tab"],
)
def test_the_caret_has_the_length_of_the_marked_text(line, span, caret):
    finding = Finding("T203", "multiple-roots", "error", "wrong", Span("f.xacro", *span))
    assert carets(TextReport({"f.xacro": Source("f.xacro", f"{line}\n b/>")}), finding)[1] == f"  | {caret}"


@pytest.mark.parametrize(
    ("line", "start", "width", "shown", "caret"),
    [
        ("<link/>" + "y" * 18, 1, 29, "<link/>" + "y" * 18, "^^^^^^^"),
        ("y" * 18 + "<link/>", 19, 29, "y" * 18 + "<link/>", " " * 18 + "^^^^^^^"),
        ("<link/>" + "y" * 19, 1, 29, "<link/>" + "y" * 17 + "…", "^^^^^^^"),
        ("x" * 50 + "<link/>" + "y" * 50, 51, 29, "…xxxxx<link/>" + "y" * 11 + "…", "      ^^^^^^^"),
        ("x" * 50 + "<link/>", 51, 29, "…xxxxx<link/>", "      ^^^^^^^"),
        ("x" * 17 + "<link/>yy", 18, 29, "x" * 17 + "<link/>…", " " * 17 + "^^^^^^^"),
        ("<link/>" + "y" * 30, 1, 1, "<link/>" + "y" * 12 + "…", "^^^^^^^"),
    ],
    ids=["fits", "mark at its end", "end cut", "both cut", "beginning cut", "at the end", "at least 20 columns"],
)
def test_a_cut_line_shows_what_fits(line, start, width, shown, caret):
    finding = at(1, start, start + 7)
    lines = carets(TextReport({"f.xacro": Source("f.xacro", line)}, width=width), finding)
    assert lines == (f"1 | {shown}", f"  | {caret}")


def test_places_without_text_have_no_excerpt():
    assert TextReport({}).finding(at(3, 1, 2, help="h")) == "f.xacro:3:1: T203 wrong\n   = help: h"


def test_severity_and_fix_are_shown():
    finding = at(1, 1, 2, fix=Fix("safe", "Mend it", ()))
    assert TextReport({}).finding(finding) == "f.xacro:1:1: T203 [*] wrong\n   = fix (--fix): Mend it"
    mild = Finding(**{**finding.__dict__, "severity": "note", "fix": Fix("unsafe", "Mend it", ())})
    assert TextReport({}).finding(mild).splitlines()[0] == "f.xacro:1:1: T203 note: wrong"
    assert "(--fix --unsafe-fixes): Mend it" in TextReport({}).finding(mild)


def test_colours_add_nothing_but_colours():
    source = {"f.xacro": Source("f.xacro", "<link/>")}
    finding = at(1, 1, 8, help="h")
    coloured = TextReport(source, colour=True).finding(finding)
    assert coloured != TextReport(source).finding(finding)
    assert re.sub("\x1b\\[[0-9;]*m", "", coloured) == TextReport(source).finding(finding)


def test_chains_name_each_call_once_and_what_is_around():
    def call(macro: str, line: int, file: str = "f.xacro") -> Expansion:
        return Expansion(macro, Position(file, line, 1))

    one = at(9, 1, 2, chains=((call("a", 5), call("b", 7)),))
    assert "in the expansion of macro `a` (f.xacro:5), called from `b` (f.xacro:7)" in TextReport({}).finding(one)
    many = at(9, 1, 2, chains=tuple((call("a", n, "g" if n == 3 else "f"),) for n in range(1, 8)))
    assert "in 7 expansions of macro `a` (f:1, :2, g:3, f:4, and 3 more)" in TextReport({}).finding(many)


def test_summary_and_statistics():
    error, fixable = at(1, 1, 2), at(2, 1, 2, fix=Fix("safe", "t", ()))
    unsafe = Finding(**{**error.__dict__, "severity": "warning", "fix": Fix("unsafe", "t", ()), "code": "J405"})
    note = Finding(**{**error.__dict__, "severity": "note"})
    assert summary([]) == "All checks passed."
    assert summary([error]) == "Found 1 error."
    assert summary([error, fixable, unsafe, note]) == (
        "Found 2 errors, 1 warning, 1 note (1 fixable with --fix, 1 with --fix --unsafe-fixes)."
    )
    assert [line.split()[:2] for line in statistics([unsafe, error, fixable])] == [["2", "T203"], ["1", "J405"]]


def test_what_a_terminal_would_obey_is_not_printed():
    source = Source("f.xacro", "\x1b]0;pwn\x07\x1b[2J<robot>\x9b")
    shown = TextReport({"f.xacro": source}).finding(at(1, 1, 2))
    assert not any(ord(letter) < 32 or 127 <= ord(letter) < 160 for letter in shown.replace("\n", ""))
    assert "<robot>" in shown
