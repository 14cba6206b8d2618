"""Findings as text: position, message, source line with a caret, macro calls and help.

::

    urdf/macros.xacro:22:7: I503 inertia of link `left_wheel` is impossible: principal moments …
       |
    22 |       <inertia ixx="0.4" ixy="0.1" ixz="0.1" iyy="0.4" iyz="0.1" izz="0.2"/>
       |       ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
       |
       = in 2 expansions of macro `wheel` (urdf/simpleton.xacro:41, :42)
       = help: compute it from shape and mass
"""

import re
from collections.abc import Iterable, Mapping, Sequence

from urdfkit.description.xml.source import Expansion, Source
from urdfkit.lint.finding import Finding

_RESET = "\x1b[0m"
_STYLES = {"error": "\x1b[1;31m", "warning": "\x1b[1;33m", "note": "\x1b[1;36m", "bold": "\x1b[1m", "dim": "\x1b[34m"}
_TAB = "    "
_CONTROL = r"[\x00-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]"
"""Control characters, which a terminal may interpret."""
_LISTED_CALLS = 4
_LISTED_PLACES = 9
"""Places listed after the first one of a group."""
_LONG = 400
"""Maximum width of a source line if the output is not a terminal [columns]."""


class TextReport:
    """Formats findings as text.

    Args:
        sources: name in findings → text of the file.
        colour: whether to use colours.
        width: width of the terminal [columns], to which source lines are cut; None if the output is not a terminal.
    """

    def __init__(self, sources: Mapping[str, Source], *, colour: bool = False, width: int | None = None) -> None:
        self.sources = sources
        self.colour = colour
        self.width = width

    def finding(self, finding: Finding) -> str:
        """Return one finding as text, without a trailing newline."""
        place = self._styled(f"{finding.file}:{finding.line}:{finding.column}", "bold")
        fixable = "" if finding.fix is None or finding.fix.safety != "safe" else " [*]"
        mild = "" if finding.severity == "error" else f" {finding.severity}:"
        lines = [f"{place}: {self._styled(finding.code, finding.severity)}{fixable}{mild} {finding.message}"]
        excerpt = self._excerpt(finding)
        notes = self._notes(finding)
        if excerpt:
            lines += excerpt
        if notes:
            margin = " " * (len(str(finding.line)) if excerpt else 2)
            lines += [f"{margin} {self._styled('=', 'dim')} {note}" for note in notes]
        return "\n".join((*lines, *self._related(finding)))

    def _related(self, finding: Finding) -> list[str]:
        """Return the places of a group, with the messages where they differ."""
        if not finding.related:
            return []
        shown = finding.related[:_LISTED_PLACES]
        same = all(one.message == finding.message for one in finding.related)
        left = len(finding.related) - len(shown)
        lines = [f"  {len(finding.related)} more place{'s' if len(finding.related) > 1 else ''}:"]
        lines += [f"    {one.file}:{one.line}:{one.column}{'' if same else f': {one.message}'}" for one in shown]
        return [*lines, f"    and {left} more"] if left else lines

    def _notes(self, finding: Finding) -> list[str]:
        notes = [_expansions(finding.chains)] if finding.chains else []
        if finding.variant:
            notes.append(f"with {finding.variant}")
        if finding.help:
            notes.append(f"{self._styled('help', 'bold')}: {finding.help}")
        if finding.fix is not None:
            how = "--fix" if finding.fix.safety == "safe" else "--fix --unsafe-fixes"
            notes.append(f"{self._styled('fix', 'bold')} ({how}): {finding.fix.title}")
        return notes

    def _excerpt(self, finding: Finding) -> list[str]:
        source = self.sources.get(finding.file)
        span = finding.span
        line, first = source.part_of_line(span.line, span.column, 4 * _LONG) if source is not None else ("", 1)
        if not line.strip():
            return []
        column = span.column - first + 1
        end = span.end_column - first + 1 if span.end_line == span.line else len(line.rstrip()) + 1
        before, marked = line[: column - 1], line[column - 1 : max(end, column + 1) - 1]
        shown = re.sub(_CONTROL, "\ufffd", line.rstrip().replace("\t", _TAB))
        start, length = _columns(before), max(_columns(marked), 1)
        number = str(span.line)
        if self.width is not None or len(shown) > _LONG:
            shown, start, length = _cut(shown, start, length, max((self.width or _LONG) - len(number) - 3, 20))
        bar = self._styled("|", "dim")
        caret = self._styled("^" * length, finding.severity)
        return [
            f"{' ' * len(number)} {bar}",
            f"{self._styled(number, 'dim')} {bar} {shown}",
            f"{' ' * len(number)} {bar} {' ' * start}{caret}",
        ]

    def _styled(self, text: str, style: str) -> str:
        return f"{_STYLES[style]}{text}{_RESET}" if self.colour else text


def summary(findings: Sequence[Finding]) -> str:
    """Return the summary line: number of findings by severity, and number of fixable findings."""
    if not findings:
        return "All checks passed."
    counts = [(sum(f.severity == severity for f in findings), severity) for severity in ("error", "warning", "note")]
    words = {"error": ("error", "errors"), "warning": ("warning", "warnings"), "note": ("note", "notes")}
    found = ", ".join(f"{count} {words[severity][count != 1]}" for count, severity in counts if count)
    places = sum(1 + len(finding.related) for finding in findings)
    found += f" in {places} places" if places > len(findings) else ""
    fixes = [one.fix for finding in findings for one in (finding, *finding.related) if one.fix is not None]
    safe = sum(fix.safety == "safe" for fix in fixes)
    unsafe = len(fixes) - safe
    ways = [f"{safe} fixable with --fix"] if safe else []
    ways += [f"{unsafe} with --fix --unsafe-fixes"] if unsafe else []
    fixable = f" ({', '.join(ways)})" if ways else ""
    return f"Found {found}{fixable}."


def counts(findings: Iterable[Finding]) -> list[tuple[str, str, str, int]]:
    """Return code, name, severity and number of findings of each rule with findings, most findings first."""
    found: dict[tuple[str, str, str], int] = {}
    for finding in findings:
        key = (finding.code, finding.name, finding.severity)
        found[key] = found.get(key, 0) + 1
    return [(*key, count) for key, count in sorted(found.items(), key=lambda item: (-item[1], item[0]))]


def statistics(findings: Iterable[Finding]) -> list[str]:
    """Return one line for each rule with findings, most findings first."""
    return [f"{count:6d}  {code}  {severity:7s}  {name}" for code, name, severity, count in counts(findings)]


def _expansions(chains: Sequence[tuple[Expansion, ...]]) -> str:
    """Return the positions of the macro calls: the innermost macro first, then its callers."""
    macro = chains[0][0].macro
    calls = list(dict.fromkeys((c[0].position.file, c[0].position.line) for c in chains if c[0].macro == macro))
    places = []
    for index, (file, line) in enumerate(calls[:_LISTED_CALLS]):
        repeated = index > 0 and calls[index - 1][0] == file
        places.append(f":{line}" if repeated else f"{file}:{line}")
    if len(calls) > _LISTED_CALLS:
        places.append(f"and {len(calls) - _LISTED_CALLS} more")
    often = f"{len(chains)} expansions" if len(chains) > 1 else "the expansion"
    outer = [f"`{call.macro}` ({call.position.file}:{call.position.line})" for call in chains[0][1:]]
    within = f", called from {', from '.join(outer)}" if outer else ""
    return f"in {often} of macro `{macro}` ({', '.join(places)}){within}"


def _columns(text: str) -> int:
    """Return the width of a text in terminal columns; a tab is four columns wide."""
    if text.isascii():
        return len(text) + text.count("\t") * (len(_TAB) - 1)
    from unicodedata import combining, east_asian_width

    wide = sum(1 for letter in text if east_asian_width(letter) in "WF")
    return len(text) + wide - sum(1 for letter in text if combining(letter)) + text.count("\t") * (len(_TAB) - 1)


def _cut(line: str, start: int, length: int, width: int) -> tuple[str, int, int]:
    """Return the part of a line around the marked text that fits into `width` columns."""
    if len(line) <= width:
        return line, start, length
    first = 0 if start + min(length, width // 2) <= width - 1 else max(start - width // 4, 0)
    last = first + width
    part = line[first:last]
    if first > 0:
        part = "…" + part[1:]
    if last < len(line):
        part = part[:-1] + "…"
    start -= first
    return part, start, max(min(length, len(part) - start), 1)
