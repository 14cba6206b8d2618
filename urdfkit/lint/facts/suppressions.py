"""Comments that suppress findings.

::

    <!-- urdfkit: ignore I503 -->            after an element: this line; alone on its line: the next element, whole
    <!-- urdfkit: ignore I503, J403 why -->  several codes; text after the codes is a comment
    <!-- urdfkit: ignore -->                 every rule
    <!-- urdfkit: ignore-file I503 -->       the whole file, wherever the comment stands
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from urdfkit.description.xml.source import Position
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.tags import Document
from urdfkit.record import record

_COMMENT = re.compile(r"\s*urdfkit:\s*([\w-]*)(.*)", re.DOTALL)
_CODE = re.compile(r"[A-Z]+[0-9][0-9A-Z]*")
_INTENDED_CODE = re.compile(r"[A-Z][0-9A-Z]{2,}")
"""A first word that is intended as a code, so that ``ignore ZZZ`` does not suppress every rule."""
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

    def covers(self, finding: Finding) -> bool:
        """Return whether the comment suppresses a finding of the same file."""
        if self.verb not in ("ignore", "ignore-file") or (self.codes and finding.code not in self.codes):
            return False
        return self.verb == "ignore-file" or self.first <= finding.line <= self.last


def suppressions(document: Document) -> list[Suppression]:
    """Return the suppressions of a file, in order."""
    found = []
    for start, end, text in document.comments:
        written = _COMMENT.match(text)
        if written is not None:
            first, last = _covered(document, start, end)
            found.append(Suppression(written[1], _codes(written[2]), document.source.position(start), first, last))
    return found


def suppressed(
    findings: Iterable[Finding], by_file: Mapping[str, list[Suppression]]
) -> tuple[list[Finding], set[tuple[Suppression, str]]]:
    """Return the findings that no comment suppresses, and pairs of comments and suppressed codes."""
    left: list[Finding] = []
    used: set[tuple[Suppression, str]] = set()
    for finding in findings:
        met = [item for item in by_file.get(finding.file, ()) if item.covers(finding)]
        used.update((item, finding.code) for item in met)
        if not met:
            left.append(finding)
    return left, used


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
    last = source.position(end - 1).line
    after = source.line(last)[end - source.line_starts[last - 1] :]
    if before.strip() or after.strip():
        return line, last
    following = next((tag for tag in document.walk() if tag.start >= end), None)
    if following is None or source.text[end : following.start].lstrip().startswith("</"):
        return line, last + 1
    return line, source.position(following.close_end - 1).line
