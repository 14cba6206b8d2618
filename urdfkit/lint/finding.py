"""Finding: one thing wrong at one place a person wrote, and perhaps how to mend it."""

from __future__ import annotations

from urdfkit.description.xml.source import Expansion, Span
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any, Literal

    Severity = Literal["error", "warning", "note"]
    Safety = Literal["safe", "unsafe"]

SEVERITIES = ("error", "warning", "note")
"""From worst to mildest. `note` does not make ``urdfkit lint`` exit with 1."""


@record(order=True)
class Edit:
    """Replace a stretch of one file by `text`."""

    span: Span
    text: str

    def to_json(self) -> dict[str, Any]:
        """Return the edit as in ``--format json``."""
        return {
            "file": self.span.file,
            "line": self.span.line,
            "column": self.span.column,
            "end_line": self.span.end_line,
            "end_column": self.span.end_column,
            "text": self.text,
        }


@record
class Fix:
    """How to mend a finding.

    Attributes:
        safety: ``safe`` fixes keep the meaning a person had in mind; ``unsafe`` ones guess it.
        title: what the fix does, as an imperative.
        edits: changes of literal source text; they do not overlap.
    """

    safety: Safety
    title: str
    edits: tuple[Edit, ...]

    def to_json(self) -> dict[str, Any]:
        """Return the fix as in ``--format json``."""
        return {"safety": self.safety, "title": self.title, "edits": [edit.to_json() for edit in self.edits]}


@record
class Finding:
    """One thing wrong.

    Attributes:
        code: e.g. ``I503``.
        name: the rule's name, e.g. ``inertia-triangle-inequality``.
        severity: ``error``, ``warning`` or ``note``.
        message: one line: what is wrong, with values and units.
        span: the start tag, attribute or text a person wrote, with the file as shown to the user.
        link: the link it is about, after expansion; the first of several expansions.
        joint: the joint it is about, after expansion.
        help: what to do about it.
        fix: how `urdfkit lint --fix` mends it; None where it does not.
        chains: the chains of macro calls it was reached through, innermost call first; one for each expansion, none
            for what is not inside a macro.
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

    @property
    def file(self) -> str:
        """The file as shown to the user."""
        return self.span.file

    @property
    def line(self) -> int:
        """Its first line, from 1."""
        return self.span.line

    @property
    def column(self) -> int:
        """Its first column, from 1, in characters."""
        return self.span.column

    @property
    def expansions(self) -> tuple[Expansion, ...]:
        """Every macro call of every chain, without repetitions."""
        return tuple(dict.fromkeys(call for chain in self.chains for call in chain))

    def to_json(self) -> dict[str, Any]:
        """Return the finding as in ``--format json``."""
        return {
            "code": self.code,
            "name": self.name,
            "severity": self.severity,
            "message": self.message,
            "file": self.span.file,
            "line": self.span.line,
            "column": self.span.column,
            "end_line": self.span.end_line,
            "end_column": self.span.end_column,
            "link": self.link,
            "joint": self.joint,
            "help": self.help,
            "expansions": [_call(call) for call in self.expansions],
            "chains": [[_call(call) for call in chain] for chain in self.chains],
            "fix": self.fix.to_json() if self.fix is not None else None,
        }


@record(eq=False)
class Found:
    """What linting one entry file found.

    Attributes:
        findings: those that no comment suppresses.
        files: name in findings → file, absolute, of every file that was read.
        note: what target was guessed and why, one line; empty where none was.
        used: the places of comments that suppress something here, each with a code.
        refused: why it could not be linted, or not by all rules, one line; empty where it could.
    """

    findings: tuple[Finding, ...]
    files: Mapping[str, str]
    note: str = ""
    used: tuple[str, ...] = ()
    refused: str = ""


def _call(call: Expansion) -> dict[str, Any]:
    at = call.position
    return {"macro": call.macro, "file": at.file, "line": at.line, "column": at.column}
