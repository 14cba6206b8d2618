"""Findings as annotations of GitHub Actions: one workflow command per line.

https://docs.github.com/en/actions/reference/workflow-commands-for-github-actions
"""

from collections.abc import Iterable

from urdfkit.lint.finding import Finding

_LEVELS = {"error": "error", "warning": "warning", "note": "notice"}


def as_github(findings: Iterable[Finding]) -> str:
    """Return one workflow command per finding."""
    return "\n".join(map(_line, findings))


def _line(finding: Finding) -> str:
    span = finding.span
    places = {"file": finding.file, "line": span.line, "endLine": span.end_line, "col": span.column}
    if span.end_line == span.line:  # GitHub supports columns only within one line
        places["endColumn"] = span.end_column
    places["title"] = f"{finding.code} {finding.name}"
    text = finding.text
    properties = ",".join(f"{name}={_property(str(value))}" for name, value in places.items())
    return f"::{_LEVELS[finding.severity]} {properties}::{_text(text)}"


def _text(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _text(text).replace(":", "%3A").replace(",", "%2C")
