"""Findings as a notebook shows them."""

from __future__ import annotations

from urdfkit.description.xml.source import Span
from urdfkit.lint.finding import Finding, Findings

FINDING = Finding("J403", "limit-missing", "error", "no <limit> in `a`", Span("arm.urdf", 3, 5, 3, 9))


def test_a_finding_shows_its_code_position_and_message() -> None:
    assert repr(FINDING) == "<Finding J403 arm.urdf:3:5: no <limit> in `a`>"


def test_findings_are_a_table_in_a_notebook() -> None:
    table = Findings([FINDING])._repr_html_()
    assert "<td>arm.urdf:3:5</td><td>J403</td><td>error</td><td>no &lt;limit&gt; in `a`</td>" in table
    assert "<tr><td>" not in Findings()._repr_html_()
