"""Findings as one JSON value; the keys are a stable interface."""

from collections.abc import Iterable

from urdfkit.lint.finding import Finding


def as_json(findings: Iterable[Finding]) -> str:
    """Return the findings as a JSON list."""
    import json

    return json.dumps([finding.to_json() for finding in findings], indent=1, ensure_ascii=False)
