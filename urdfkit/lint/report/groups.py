"""Findings with one cause as one finding: a package that is not installed, not each of its 393 meshes."""

from __future__ import annotations

from urdfkit.errors import kind_of
from urdfkit.lint.finding import SEVERITIES, Finding

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

SMALLEST = 4
"""Number of warnings, or of errors with a named cause, from which on they are grouped. Fewer are shown one by one."""
SMALLEST_ALIKE = 10
"""The same for errors with equal messages, which may be separate mistakes, and for notes without a named cause."""


def grouped(findings: Iterable[Finding]) -> list[Finding]:
    """Return one finding for each cause, sorted by position; `Finding.related` contains its other places.

    Findings have one cause if they have the same code, severity and `Finding.cause`. Where the rule names no cause,
    errors have one if their messages are equal, and warnings and notes if their messages differ in names, tags and
    numbers only: an export that gives no joint an effort limit, rounded angles.

    Args:
        findings: sorted by position.
    """
    groups: dict[tuple[str, str, str], list[Finding]] = {}
    for finding in findings:
        groups.setdefault((finding.code, finding.severity, finding.cause or _kind(finding)), []).append(finding)
    found: list[Finding] = []
    for first, *others in groups.values():
        if 1 + len(others) < _smallest(first, others):
            found += (first, *others)
        else:
            found.append(Finding(**{**first.__dict__, "related": tuple(others)}))
    return sorted(found, key=lambda one: (one.span, one.code, one.message))


def _smallest(finding: Finding, others: list[Finding]) -> int:
    """Return the number of findings like one from which on they are grouped.

    Notes on one cause always are, and findings whose cause and message are the same: a package that is not found.
    """
    if finding.cause and all(other.message == finding.message for other in others):
        return 2
    if finding.severity == "note":
        return 2 if finding.cause else SMALLEST_ALIKE
    return SMALLEST if finding.cause or finding.severity == "warning" else SMALLEST_ALIKE


def _kind(finding: Finding) -> str:
    if finding.severity == "error":
        return finding.message
    return kind_of(finding.message)


def worst_first(findings: Iterable[Finding]) -> list[Finding]:
    """Return findings sorted by severity, then as before."""
    return sorted(findings, key=lambda one: SEVERITIES.index(one.severity))


def commands(groups: Iterable[Finding], paths: str) -> list[str]:
    """Return up to three lines with commands that fix or hide most findings.

    Args:
        groups: the findings, grouped.
        paths: the linted paths, as on the command line.
    """
    fixes = {"safe": 0, "unsafe": 0}
    hidden: dict[str, int] = {}
    for group in groups:
        for finding in (group, *group.related):
            if finding.fix is not None:
                fixes[finding.fix.safety] += 1
            if finding.severity != "error" and (finding.fix is None or finding.fix.safety != "safe"):
                hidden[finding.code] = hidden.get(finding.code, 0) + 1
    found = [(count, f"--ignore {code}", "hides") for code, count in hidden.items()]
    found += [(fixes["safe"], "--fix", "fixes"), (fixes["unsafe"], "--fix --unsafe-fixes", "fixes, by a guess,")]
    best = sorted((one for one in found if one[0] > 1), key=lambda one: -one[0])[:3]
    return [f"`urdfkit lint {paths} {option}` {effect} {count} findings" for count, option, effect in best]
