"""Which new findings a fix has caused, and which it has only uncovered.

A defect often hides others: what stands in a misspelt element is not looked at, and where the mass is no number no
inertia is judged. A finding that is new after a fix was caused by it where

- the file cannot be read any more, or an element is there twice;
- it is about what the fix wrote: for fixes that guess all of it, for those that keep the meaning spelling and numbers;
- xacro stumbles over a tag that the fix has changed;
- it names what the fix has taken away or brought in.

Everything else was in the files before and is only seen now. Notes are never worse.
"""

from __future__ import annotations

import re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from urdfkit.description.xml.source import Source
    from urdfkit.lint.engine.run import Outcome
    from urdfkit.lint.finding import Finding

_ALWAYS = frozenset(("E001", "E013"))
"""The file is not well-formed; an element that may be there once is there twice."""

_NAMED = re.compile(r"`([^`]*)`")
_WORD = re.compile(r"[\w./:-]+")


class Written:
    """What a set of edits has changed, seen from the text that came out.

    Args:
        guessed: whether any of the fixes is an unsafe one.
    """

    def __init__(self, *, guessed: bool) -> None:
        self.guessed = guessed
        self._places: dict[str, list[tuple[int, int, bool]]] = {}
        self._removed: set[str] = set()
        self._inserted: set[str] = set()

    def add(self, file: str, before: str, changes: Iterable[tuple[int, int, str]]) -> None:
        """Add the changes of one file, in order: where each began and ended in the text before, what is there now."""
        moved = 0
        places = self._places.setdefault(file, [])
        for start, end, text in changes:
            self._removed.update(_WORD.findall(before[start:end]))
            self._inserted.update(_WORD.findall(text))
            places.append((start + moved, start + moved + len(text), before[:start].endswith(("<", "</"))))
            moved += len(text) - (end - start)

    @property
    def names(self) -> set[str]:
        """The words that were taken away and stand nowhere else now, and those that were brought in."""
        return self._removed ^ self._inserted

    def has_caused(self, finding: Finding, source: Source) -> bool:
        """Return whether the edits have caused a finding that is new after them."""
        if finding.severity == "note":
            return False
        if finding.code in _ALWAYS or not self.names.isdisjoint(_NAMED.findall(finding.message)):
            return True
        span = finding.span
        start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
        met = [is_tag for a, b, is_tag in self._places.get(finding.file, ()) if start <= b and a <= end]
        if finding.code.startswith("X"):
            return bool(met)
        return (self.guessed or finding.code.startswith("E")) and not all(met)


def new_findings(before: Outcome, after: Outcome) -> Iterator[Finding]:
    """Yield the findings of the rules that find more than before, those that were not there before."""
    counts = {code: -count for code, count in _counts(before.findings).items()}
    for code, count in _counts(after.findings).items():
        counts[code] = counts.get(code, 0) + count
    yield from (finding for finding in left_over(after.findings, before.findings) if counts[finding.code] > 0)


def left_over(some: Iterable[Finding], others: Iterable[Finding]) -> Iterator[Finding]:
    """Yield those of `some` findings that are not among the `others`, wherever they stand in their file."""
    known: dict[tuple[str, str, str], int] = {}
    for finding in others:
        key = (finding.code, finding.file, finding.message)
        known[key] = known.get(key, 0) + 1
    for finding in some:
        key = (finding.code, finding.file, finding.message)
        if known.get(key, 0) > 0:
            known[key] -= 1
        else:
            yield finding


def _counts(findings: Iterable[Finding]) -> dict[str, int]:
    counts: dict[str, int] = {}
    for finding in findings:
        counts[finding.code] = counts.get(finding.code, 0) + 1
    return counts
