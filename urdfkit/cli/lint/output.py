"""Output of ``urdfkit lint`` in each of its formats."""

from __future__ import annotations

import shlex
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.lint.engine.run import Outcome
    from urdfkit.lint.finding import Finding

_MANY = 10
"""Number of findings from which on commands that fix or hide most of them are shown."""

FORMATS = ("text", "json", "sarif", "github", "junit")


def show(outcome: Outcome, form: str, paths: Sequence[str], *, statistics: bool, color: str) -> None:
    """Print the findings.

    Args:
        outcome: the result of the run.
        form: one of `FORMATS`.
        paths: the linted paths, as on the command line.
        statistics: print the number of findings per rule, as text or JSON.
        color: ``auto``, ``always`` or ``never``.
    """
    from urdfkit.lint.report.groups import grouped

    findings = grouped(outcome.findings, outcome.sources)
    if statistics:
        _count(outcome.findings, as_json=form == "json")
    elif form == "json":
        from urdfkit.lint.report.json import as_json

        print(as_json(findings))
    elif form == "sarif":
        from urdfkit.lint.report.sarif import as_sarif

        print(as_sarif(findings))
    elif form == "junit":
        from urdfkit.lint.report.junit import as_junit

        print(as_junit(outcome.findings, outcome.files))
    elif form == "github":
        from urdfkit.lint.report.github import as_github

        if findings:
            print(as_github(findings))
    else:
        _text(outcome, findings, color, paths)


def _text(outcome: Outcome, findings: list[Finding], color: str, paths: Sequence[str]) -> None:
    from urdfkit.cli.colors import uses_color
    from urdfkit.lint.report.groups import commands, worst_first
    from urdfkit.lint.report.text import TextReport, summary

    width = None
    if sys.stdout.isatty():
        from urdfkit.cli.parser import columns

        width = columns()
    report = TextReport(outcome.sources, colour=uses_color(color), width=width)
    for finding in worst_first(findings):
        print(report.finding(finding), end="\n\n")
    print(summary(findings))
    if len(findings) >= _MANY:
        for line in commands(findings, shlex.join(paths)):
            print(f"  {line}")


def _count(findings: Sequence[Finding], *, as_json: bool) -> None:
    from urdfkit.lint.report.text import counts, statistics, summary

    if as_json:
        import json

        keys = ("code", "name", "severity", "count")
        print(json.dumps([dict(zip(keys, row, strict=True)) for row in counts(findings)], indent=1))
    else:
        print("\n".join([*statistics(findings), summary(findings)]))
