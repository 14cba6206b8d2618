"""Comments that suppress findings.

::

    <!-- urdfkit: ignore I503 -->            after an element: this line; alone on its line: the next element, whole
    <!-- urdfkit: ignore I503, J403 why -->  several codes; text after the codes is a comment
    <!-- urdfkit: ignore -->                 every rule
    <!-- urdfkit: ignore-file I503 -->       the whole file, wherever the comment stands
"""

from __future__ import annotations

import math
import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Mapping

from urdfkit.description.xml.source import Position, Span
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.tags import Document
from urdfkit.record import record

_COMMENT = re.compile(r"\s*urdfkit:\s*([\w-]*)(.*)", re.DOTALL)
_CODE = re.compile(r"[A-Z]+[0-9][0-9A-Z]*")
_INTENDED_CODE = re.compile(r"[A-Z][0-9A-Z]{2,}")
"""A first word that is intended as a code, so that ``ignore ZZZ`` does not suppress every rule."""
_VERBS = ("ignore", "ignore-file")
_SEPARATOR = re.compile(r"[\s,;:]+")


@record
class Suppression:
    """One suppression comment.

    Attributes:
        verb: ``ignore``, ``ignore-file``, or an unknown word.
        codes: codes of the suppressed rules; empty for all rules.
        position: start of the comment.
        first: first suppressed line.
        last: last suppressed line.
    """

    verb: str
    codes: tuple[str, ...]
    position: Position
    first: int
    last: int

    @property
    def lines(self) -> tuple[float, float]:
        """First and last suppressed line."""
        return (0, math.inf) if self.verb == "ignore-file" else (self.first, self.last)


def suppressions(document: Document) -> list[Suppression]:
    """Return the suppressions of a file, in order."""
    found = []
    for start, end, text in document.comments:
        written = _COMMENT.match(text)
        if written is not None and written[1] != "format":  # a range that `urdfkit format` keeps as it is
            first, last = _covered(document, start, end)
            found.append(Suppression(written[1], _codes(written[2]), document.source.position(start), first, last))
    return found


def suppressed(
    findings: Iterable[Finding], by_file: Mapping[str, list[Suppression]]
) -> tuple[list[Finding], set[tuple[Suppression, str]]]:
    """Return the findings that no comment suppresses, and pairs of comments and suppressed codes."""
    findings = list(findings)
    lines: dict[str, dict[str, list[int]]] = {}
    for finding in findings:
        for span in _places(finding):
            if span.file in by_file:
                lines.setdefault(span.file, {}).setdefault(finding.code, []).append(span.line)
    used: set[tuple[Suppression, str]] = set()
    met: dict[tuple[str, str], _Lines] = {}
    for file, by_code in lines.items():
        for code, at in by_code.items():
            at.sort()
            items = [one for one in by_file[file] if one.verb in _VERBS and (not one.codes or code in one.codes)]
            found = [one for one in items if _meets(one, at)]
            used.update((one, code) for one in found)
            met[file, code] = _Lines(one.lines for one in found)

    def is_met(code: str, span: Span) -> bool:
        return (span.file, code) in met and span.line in met[span.file, code]

    left = [one for one in findings if not any(is_met(one.code, span) for span in _places(one))]
    return left, used


def _places(finding: Finding) -> tuple[Span, ...]:
    """Return the place of a finding, and of the other side of a contradiction, where it may be shown."""
    return (finding.span,) if finding.other is None else (finding.span, finding.other)


def _meets(item: Suppression, lines: list[int]) -> bool:
    """Return whether a comment covers any of some sorted lines."""
    first, last = item.lines
    at = bisect_left(lines, first)
    return at < len(lines) and lines[at] <= last


class _Lines:
    """A set of lines from ranges that may overlap."""

    def __init__(self, ranges: Iterable[tuple[float, float]]) -> None:
        self._first: list[float] = []
        self._last: list[float] = []
        for first, last in sorted(ranges):
            self._first.append(first)
            self._last.append(max(last, self._last[-1]) if self._last else last)

    def __contains__(self, line: int) -> bool:
        at = bisect_right(self._first, line)
        return at > 0 and line <= self._last[at - 1]


def _codes(text: str) -> tuple[str, ...]:
    codes: list[str] = []
    for word in _SEPARATOR.split(text.strip()):
        if not (_CODE if codes else _INTENDED_CODE).fullmatch(word):
            break
        codes.append(word)
    return tuple(codes)


def _covered(document: Document, start: int, end: int) -> tuple[int, int]:
    source = document.source
    line = source.position(start).line
    before = source.text[source.line_starts[line - 1] : start]
    last = source.position(end).line
    after = source.line(last)[end - source.line_starts[last - 1] :]
    if before.strip() or after.strip():
        return line, last
    following = document.tag_from(end)
    if following is None or source.text[end : following.start].lstrip().startswith("</"):
        return line, last + 1
    return line, source.position(following.close_end - 1).line
