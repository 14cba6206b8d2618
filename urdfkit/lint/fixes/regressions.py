"""Regressions: distinguish new findings that a fix causes from defects that it only uncovers.

A defect often masks others: children of a misspelt element are not checked, nor is the inertia if the mass is not a
number. A fix causes a new finding if

- the file is no longer well-formed, or a unique element occurs twice;
- the finding is about text written by the fix: any finding for unsafe fixes, spelling and numbers for safe fixes;
- xacro fails at a tag that the fix has changed;
- the finding is about a name that the fix has removed or inserted.

Other new findings are defects that were masked before. Notes are never regressions.
"""

import re
from collections.abc import Iterable, Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.engine.run import Outcome
from urdfkit.lint.finding import Finding

_ALWAYS = frozenset(("E001", "E013"))
"""The file is not well-formed; a unique element occurs twice."""

_WORD = re.compile(r"[\w./:-]+")


class WrittenText:
    """Changes of a set of edits, at their positions in the new text.

    Args:
        guessed: whether any of the fixes is unsafe.
    """

    def __init__(self, *, guessed: bool) -> None:
        self.guessed = guessed
        self._places: dict[str, list[tuple[int, int, bool]]] = {}
        self._removed: set[str] = set()
        self._inserted: set[str] = set()

    def add(self, file: str, before: str, changes: Iterable[tuple[int, int, str]]) -> None:
        """Add the changes of one file in order: start and end in the old text, and the new text."""
        moved = 0
        places = self._places.setdefault(file, [])
        for start, end, text in changes:
            self._removed.update(_WORD.findall(before[start:end]))
            self._inserted.update(_WORD.findall(text))
            places.append((start + moved, start + moved + len(text), before[:start].endswith(("<", "</"))))
            moved += len(text) - (end - start)

    @property
    def names(self) -> set[str]:
        """The words that the edits removed or inserted, without words in both sets."""
        return self._removed ^ self._inserted

    def explains(self, finding: Finding, source: Source) -> bool:
        """Return whether the edits cause a new finding."""
        if finding.severity == "note":
            return False
        about = {finding.link, finding.joint, *finding.names}
        if finding.code in _ALWAYS or not about.isdisjoint(self.names):
            return True
        span = finding.span
        start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
        met = [is_tag for a, b, is_tag in self._places.get(finding.file, ()) if start <= b and a <= end]
        if finding.code.startswith("X"):
            return bool(met)
        return (self.guessed or finding.code.startswith("E")) and not all(met)


def new_findings(before: Outcome, after: Outcome) -> Iterator[Finding]:
    """Yield the new findings of rules that report more findings than before."""
    counts = {code: -count for code, count in _counts(before.findings).items()}
    for code, count in _counts(after.findings).items():
        counts[code] = counts.get(code, 0) + count
    yield from (finding for finding in unmatched(after.findings, before.findings) if counts[finding.code] > 0)


def unmatched(some: Iterable[Finding], others: Iterable[Finding]) -> Iterator[Finding]:
    """Yield the findings of `some` that are not among `others`, independent of their lines."""
    remaining: dict[tuple[str, str, str], int] = {}
    for finding in others:
        key = (finding.code, finding.file, finding.message)
        remaining[key] = remaining.get(key, 0) + 1
    for finding in some:
        key = (finding.code, finding.file, finding.message)
        if remaining.get(key, 0) > 0:
            remaining[key] -= 1
        else:
            yield finding


def _counts(findings: Iterable[Finding]) -> dict[str, int]:
    counts: dict[str, int] = {}
    for finding in findings:
        counts[finding.code] = counts.get(finding.code, 0) + 1
    return counts
