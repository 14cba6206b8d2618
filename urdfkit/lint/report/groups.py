"""Findings with one cause as one finding: a package that is not installed, not each of its 393 meshes."""

import re
from collections.abc import Iterable, Mapping

from urdfkit.description.xml.source import Source
from urdfkit.lint.finding import SEVERITIES, Finding

SMALLEST = 4
"""Number of warnings, or of errors with a named cause, from which on they are grouped. Fewer are shown one by one."""
SMALLEST_ALIKE = 10
"""The same for errors of one kind, which may be separate mistakes, and for notes without a named cause."""

_SUBJECT = r"<?/?[\w:.-]+"
"""Matches the tag or attribute at the start of a place in XML."""
_KEY = r"\W*([\w.]+)"
"""Matches the first word of a line in YAML, Python or CMake."""
_NUMBER = r"(?<![\w.-])-?[\d.]+(?:[eE][+-]?\d+)?(?![\w.])"
_VALUE = r"-?(?:\d*\.\d{2,}|[1-9]\d*\.\d+|[1-9]\d{2,})"
"""Matches a number with three digits, which two separate mistakes seldom share."""


def grouped(findings: Iterable[Finding], sources: Mapping[str, Source]) -> list[Finding]:
    """Return one finding for each cause, sorted by position; `Finding.related` contains its other places.

    Findings have one cause if they have the same code, severity and `Finding.cause`. Where the rule names no cause,
    warnings and notes have one if they have the same kind, or without a kind are about the same attribute, tag or key:
    an export that gives no joint an effort limit, rounded angles. Errors have one if there are many of these, or if
    they come from copies of a robot: their places have the same numbers, or each is in a file of its own.

    Args:
        findings: sorted by position.
        sources: the files with findings, by name.
    """
    groups: dict[tuple[str, ...], list[Finding]] = {}
    for finding in findings:
        kind = (finding.cause,) if finding.cause else _kind(finding, sources)
        groups.setdefault((finding.code, finding.severity, *kind), []).append(finding)
    found: list[Finding] = []
    for group in groups.values():
        for numbers, part in _parts(group, sources):
            first, *others = part
            if len(part) < _smallest(part, numbers):
                found += part
            else:
                places = [*first.related, *(each for one in others for each in (one, *one.related))]
                found.append(Finding(**{**first.__dict__, "related": tuple(places)}))
    return sorted(found, key=lambda one: (one.span, one.code, one.message))


def _parts(group: list[Finding], sources: Mapping[str, Source]) -> Iterable[tuple[tuple[str, ...], list[Finding]]]:
    """Return errors of one kind by the numbers of their places, unless there are many; other findings in one part."""
    if group[0].severity != "error" or group[0].cause or len(group) >= SMALLEST_ALIKE:
        return [((), group)]
    parts: dict[tuple[str, ...], list[Finding]] = {}
    for finding in group:
        parts.setdefault(tuple(re.findall(_NUMBER, _marked(finding, sources)[0])), []).append(finding)
    return parts.items()


def _smallest(group: list[Finding], numbers: Iterable[str]) -> int:
    """Return the number of findings from which on a group of them is shown as one.

    Notes on one cause always are, and findings whose cause and message are the same: a package that is not found.
    """
    first = group[0]
    if first.cause and all(other.message == first.message for other in group):
        return 2
    if first.severity == "note":
        return 2 if first.cause else SMALLEST_ALIKE
    if first.cause or first.severity == "warning":
        return SMALLEST
    is_of_copies = any(re.fullmatch(_VALUE, each) for each in numbers) or len({one.file for one in group}) == len(group)
    return SMALLEST if is_of_copies and not first.meant else SMALLEST_ALIKE


def _kind(finding: Finding, sources: Mapping[str, Source]) -> tuple[str, ...]:
    """Return which of the rule's defects a finding is, and the part of the file; misspelt names are separate errors."""
    if finding.severity == "error" and finding.meant:
        return finding.kind, finding.message
    if finding.kind:
        return (finding.kind,)
    marked, line = _marked(finding, sources)
    found = re.match(_SUBJECT, marked) if line.lstrip().startswith("<") else re.match(_KEY, line)
    return "", found[found.re.groups] if found is not None else finding.message


def _marked(finding: Finding, sources: Mapping[str, Source]) -> tuple[str, str]:
    """Return the text of the place of a finding, and its line until the end of the place; empty if it was not read."""
    source, span = sources.get(finding.file), finding.span
    if source is None:
        return "", ""
    start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
    return source.text[start:end], source.text[source.offset(span.line, 1) : end]


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
