"""Findings as JUnit XML: one test suite per file, one failed test case per error and warning.

The output follows the schema of the Jenkins xUnit plugin (junit-10.xsd).
"""

import re
from collections.abc import Iterable, Sequence
from xml.sax.saxutils import escape, quoteattr

from urdfkit.lint.finding import Finding

_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML 1.0 does not allow."""


def as_junit(findings: Sequence[Finding], files: Iterable[str]) -> str:
    """Return the document. Files without findings have one passed test case; notes are skipped test cases.

    Args:
        findings: the findings.
        files: every file that was read.
    """
    by_file: dict[str, list[Finding]] = {file: [] for file in sorted(files)}
    for finding in findings:
        by_file.setdefault(finding.file, []).append(finding)
    suites = [_suite(file, found) for file, found in by_file.items()]
    tests = sum(max(len(found), 1) for found in by_file.values())
    head = f'<testsuites name="urdfkit lint" tests="{tests}" failures="{_failures(findings)}" errors="0">'
    return "\n".join(['<?xml version="1.0" encoding="UTF-8"?>', head, *suites, "</testsuites>"])


def _failures(findings: Iterable[Finding]) -> int:
    return sum(finding.severity != "note" for finding in findings)


def _suite(file: str, findings: list[Finding]) -> str:
    skipped = len(findings) - _failures(findings)
    counts = f'tests="{max(len(findings), 1)}" failures="{_failures(findings)}" errors="0" skipped="{skipped}"'
    cases = [_case(finding) for finding in findings] or [
        f'    <testcase classname={_attribute(file)} name="no finding"/>'
    ]
    return "\n".join([f"  <testsuite name={_attribute(file)} {counts}>", *cases, "  </testsuite>"])


def _case(finding: Finding) -> str:
    name = f"{finding.code} {finding.name}, line {finding.line}"
    head = f"    <testcase classname={_attribute(finding.file)} name={_attribute(name)}>"
    if finding.severity == "note":
        return f"{head}\n      <skipped message={_attribute(finding.message)}/>\n    </testcase>"
    lines = [f"{finding.file}:{finding.line}:{finding.column}: {finding.message}"]
    lines += [f"with {finding.variant}"] if finding.variant else []
    lines += [f"help: {finding.help}"] if finding.help else []
    body = escape(_clean("\n".join(lines)))
    attributes = f"type={_attribute(finding.severity)} message={_attribute(finding.message)}"
    return f"{head}\n      <failure {attributes}>{body}</failure>\n    </testcase>"


def _attribute(text: str) -> str:
    return quoteattr(_clean(text), {"\n": "&#10;", "\r": "&#13;", "\t": "&#9;"})


def _clean(text: str) -> str:
    return _FORBIDDEN.sub("\ufffd", text)
