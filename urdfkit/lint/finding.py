"""Finding: one defect at one source position, optionally with a fix."""

from __future__ import annotations

from urdfkit.defect_message import DefectMessage, Suggestion
from urdfkit.description.xml.source import Expansion, Span
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any, Literal

    Severity = Literal["error", "warning", "note"]
    Safety = Literal["safe", "unsafe"]
else:
    Severity = Safety = str

SEVERITIES = ("error", "warning", "note")
"""From most to least severe. A `note` does not make ``urdfkit lint`` exit with status 1."""


@record(order=True)
class Edit:
    """Replacement of a span of one file by `text`."""

    span: Span
    text: str

    def to_json(self) -> dict[str, Any]:
        """Return the edit as in ``--format json``."""
        return {**_place(self.span), "text": self.text}


@record
class Fix:
    """Edits that correct a finding.

    Attributes:
        safety: ``safe`` fixes preserve the intended meaning; ``unsafe`` fixes guess it.
        title: description of the fix in the imperative.
        edits: non-overlapping edits of literal source text.
    """

    safety: Safety
    title: str
    edits: tuple[Edit, ...]

    def to_json(self) -> dict[str, Any]:
        """Return the fix as in ``--format json``."""
        return {"safety": self.safety, "title": self.title, "edits": [edit.to_json() for edit in self.edits]}


@record
class Finding:
    """One defect, reported by a rule.

    Attributes:
        code: e.g. ``I503``.
        name: the rule's name, e.g. ``inertia-triangle-inequality``.
        severity: ``error``, ``warning`` or ``note``.
        message: one line that describes the defect, with values and units.
        span: the start tag, attribute or text in the source, with the file name as shown to the user.
        link: name of the affected link after expansion; of the first of several expansions.
        joint: name of the affected joint after expansion.
        help: how to correct the defect.
        fix: the edits of `urdfkit lint --fix`; None if there is no automatic fix.
        chains: chains of macro calls, innermost call first, one for each expansion; empty outside of macros.
        cause: words that findings of one rule share if they have one cause; empty if the message is the same.
        kind: which of the rule's defects it is, where groups or other rules depend on it; not in the output.
        names: further names that the finding is about, such as both joints of a pair; not in the output.
        suggestion: the valid name that message or help suggest in place of a misspelt one; None without one.
        other: the other side of a contradiction, where the finding is shown if that side is wrong; not in the output.
        is_other_wrong: whether the other side is certainly the wrong one; not in the output.
        related: the findings of other places with the same cause, and the places that contradict this one.
        trail: the use of a value, the expression that computes it, and the literal at `span`; not in the output.
        variant: the xacro arguments of a launch file, and the launch file, if the robot has the defect only with them.

    Examples:
        >>> import urdfkit
        >>> for finding in urdfkit.lint("arm.urdf"):
        ...     print(finding.file, finding.line, finding.column, finding.code, finding.severity)
        arm.urdf 6 7 I503 error
        >>> finding.text.partition(":")[0]
        'inertia of link `base` is impossible'
        >>> finding.to_json()["end_column"]
        69
    """

    code: str
    name: str
    severity: Severity
    message: str
    span: Span
    link: str | None = None
    joint: str | None = None
    help: str | None = None
    fix: Fix | None = None
    chains: tuple[tuple[Expansion, ...], ...] = ()
    cause: str = ""
    kind: str = ""
    names: tuple[str, ...] = ()
    suggestion: Suggestion | None = None
    other: Span | None = None
    is_other_wrong: bool = False
    related: tuple[Finding, ...] = ()
    variant: str = ""
    trail: tuple[Span, ...] = ()

    def __repr__(self) -> str:
        """Return code, position and message."""
        return f"<Finding {self.code} {self.file}:{self.line}:{self.column}: {self.message}>"

    @property
    def file(self) -> str:
        """The file as shown to the user."""
        return self.span.file

    @property
    def line(self) -> int:
        """The first line of the span, from 1."""
        return self.span.line

    @property
    def column(self) -> int:
        """The first column of the span, from 1, in characters."""
        return self.span.column

    @property
    def text(self) -> str:
        """The message, the variant and the help in one line."""
        variant = f"with {self.variant}" if self.variant else ""
        return "; ".join(part for part in (self.message, variant, self.help) if part)

    @property
    def meant(self) -> str:
        """The valid name nearest to a misspelt one; an element as ``<name>``; empty if the finding suggests none.

        Examples:
            >>> from pathlib import Path
            >>> import urdfkit
            >>> size = Path("typo.urdf").write_text('<robot name="arm"><link name="base"/><jiont/></robot>')
            >>> [finding.meant for finding in urdfkit.lint("typo.urdf")]
            ['joint']
        """
        return self.suggestion.meant if self.suggestion is not None else ""

    @property
    def expansions(self) -> tuple[Expansion, ...]:
        """Every macro call of every chain, without repetitions.

        Examples:
            >>> from pathlib import Path
            >>> import urdfkit
            >>> macro = '<xacro:macro name="frame"><link name="base" typo="1"/></xacro:macro><xacro:frame/>'
            >>> head = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">'
            >>> size = Path("frame.xacro").write_text(f"{head}{macro}</robot>")
            >>> [[call.macro for call in finding.expansions] for finding in urdfkit.lint("frame.xacro")]
            [['frame']]
        """
        return tuple(dict.fromkeys(call for chain in self.chains for call in chain))

    def to_json(self) -> dict[str, Any]:
        """Return the finding as in ``--format json``."""
        return {
            "code": self.code,
            "name": self.name,
            "severity": self.severity,
            "message": self.message,
            **_place(self.span),
            "link": self.link,
            "joint": self.joint,
            "help": self.help,
            "variant": self.variant or None,
            "expansions": [_call(call) for call in self.expansions],
            "chains": [[_call(call) for call in chain] for chain in self.chains],
            "fix": self.fix.to_json() if self.fix is not None else None,
            "related": [_related(finding) for finding in self.related],
        }


@record(eq=False)
class EntryResult:
    """Result of linting one entry file.

    Attributes:
        findings: findings that no comment suppresses.
        files: name in findings → absolute path, for every file read.
        note: one line with the guessed target and the reason; empty if no target was guessed.
        target: the guessed target; empty if no target was guessed.
        used: position of each comment that suppresses findings of this entry, with a code.
        unused: position of each comment with unused suppressions, with their codes; without codes if it has none.
        without_robot: name of the package, if it has no robot, so that only its other files were linted.
        refused: one line with the reason why the entry was not linted, or not by all rules; else empty.
    """

    findings: tuple[Finding, ...]
    files: Mapping[str, str]
    note: str = ""
    used: tuple[tuple[str, str], ...] = ()
    refused: str = ""
    unused: tuple[tuple[str, tuple[str, ...]], ...] = ()
    without_robot: str = ""
    target: str = ""


def suggestion_of(*texts: str | None) -> Suggestion | None:
    """Return the suggestion at the end of the first of message and help that ends with one."""
    for text in texts:
        found = text.suggestion if isinstance(text, DefectMessage) and not text.tail else text
        if isinstance(found, Suggestion) and found:
            return found
    return None


def _place(span: Span) -> dict[str, Any]:
    return {
        "file": span.file,
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
    }


def _related(finding: Finding) -> dict[str, Any]:
    return {
        "message": finding.message,
        **_place(finding.span),
        "link": finding.link,
        "joint": finding.joint,
        "fix": finding.fix.to_json() if finding.fix is not None else None,
    }


def _call(call: Expansion) -> dict[str, Any]:
    at = call.position
    return {"macro": call.macro, "file": at.file, "line": at.line, "column": at.column}


class Findings(list[Finding]):
    """List of findings; a table in notebooks."""

    def _repr_html_(self) -> str:
        from html import escape

        cells = ((f"{each.file}:{each.line}:{each.column}", each.code, each.severity, each.message) for each in self)
        rows = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in cells)
        return f"<table><tr><th>position</th><th>code</th><th>severity</th><th>message</th></tr>{rows}</table>"
