"""Rule: base classes of all checks. The docstring of a rule is its page in the catalogue.

Rules come in three layers: `SourceRule` checks the text of each file, `FaultRule` reports errors of xacro, `RobotRule`
checks the expanded robot. All rules yield findings at a position in the source text.
"""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xacro.faults import Fault
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Origin, Position, Span
from urdfkit.errors import nearest, shortened
from urdfkit.lint.finding import Finding, Fix, Severity, suggestion_of
from urdfkit.lint.model.model import Model as Model
from urdfkit.lint.model.tags import Document

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, ClassVar, Literal

Findings = Iterator[Finding]
"""What `Rule.check` returns."""

NOT_GAZEBO = frozenset(("mujoco", "isaac", "drake", "moveit"))
"""Targets that read neither ``<gazebo>`` elements nor controller configuration."""

SECTIONS = ("What it does", "Why is this bad?", "Example", "Fix safety", "References")
"""The headings a rule's docstring may have, in this order; the first three are required.

The example is a diff. Without its lines with ``+`` it has the defect; without its lines with ``-`` it does not."""


class Rule:
    """One check.

    Attributes:
        code: e.g. ``I503``.
        name: the defect, so that "allow <name>" is meaningful, e.g. ``inertia-triangle-inequality``.
        severity: default severity of its findings.
        fix: ``safe`` if ``--fix`` fixes its findings, ``unsafe`` if ``--unsafe-fixes`` is needed, else ``none``.
        not_for: targets that the rule does not apply to.
        only_for: if not empty, the only targets the rule applies to; such a rule does not run without ``--target``.
        checks_each_alone: whether it finds something in a child of the root element exactly if it finds something in a
            robot that has no other links and joints; see `urdfkit.lint.engine.clean_elements`.
    """

    code: ClassVar[str]
    name: ClassVar[str]
    severity: ClassVar[Severity] = "error"
    fix: ClassVar[Literal["safe", "unsafe", "none"]] = "none"
    not_for: ClassVar[frozenset[str]] = frozenset()
    only_for: ClassVar[tuple[str, ...]] = ()
    checks_each_alone: ClassVar[bool] = False

    def at(
        self,
        model: Model,
        where: Element | Fault | Origin | Position,
        message: str,
        *,
        attribute: str | None = None,
        link: str | None = None,
        joint: str | None = None,
        help: str | None = None,
        fix: Fix | None = None,
        severity: Severity | None = None,
        cause: str = "",
        kind: str = "",
        names: tuple[str, ...] = (),
        other: Span | None = None,
        is_other_wrong: bool = False,
    ) -> Finding:
        """Create a finding.

        Args:
            model: the linted model.
            where: the element, fault or position that the finding is about.
            message: one line that describes the defect, with values and units.
            attribute: the attribute to mark; by default, or if the source has no such attribute, the start tag.
            link: name of the affected link.
            joint: name of the affected joint.
            help: how to correct the defect.
            fix: edits that correct the defect.
            severity: overrides the rule's severity.
            cause: see `Finding.cause`.
            kind: see `Finding.kind`.
            names: see `Finding.names`.
            other: see `Finding.other`.
            is_other_wrong: see `Finding.is_other_wrong`.
        """
        message = shortened(message)
        place: Any = where if isinstance(where, Position) else getattr(where, "origin", where)
        chain = getattr(place, "expansions", ())
        span = model.span(getattr(place, "position", place), attribute)
        return self.at_span(
            span,
            message,
            severity,
            link=link,
            joint=joint,
            help=help,
            fix=fix,
            chains=(chain,) if chain else (),
            cause=cause,
            kind=kind,
            names=names,
            other=other,
            is_other_wrong=is_other_wrong,
        )

    def at_span(self, span: Span, message: str, severity: Severity | None = None, **details: Any) -> Finding:
        """Create a finding at a place in a file.

        Args:
            span: the place.
            message: one line that describes the defect, with values and units.
            severity: overrides the rule's severity.
            details: further attributes of `Finding`, such as ``help``.
        """
        details["suggestion"] = suggestion_of(message, details.get("help"))
        return Finding(self.code, self.name, severity or self.severity, str(message), span, **details)


class SourceRule(Rule):
    """A rule on the source text of one file."""

    def check(self, document: Document, model: Model) -> Findings:
        """Yield the findings in one file of the model."""
        raise NotImplementedError


class FaultRule(Rule):
    """A rule that reports errors of the xacro expansion.

    Attributes:
        kinds: fault kinds that the rule reports.
        may_be_elsewhere: whether a missing include file may define the missing name; the finding is then left out, or
            a note if the name is similar to another.
    """

    kinds: ClassVar[tuple[str, ...]] = ()
    may_be_elsewhere: ClassVar[bool] = False

    def claims(self, fault: Fault) -> bool:
        """Return whether this rule reports the fault."""
        return fault.kind in self.kinds

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding for a fault, unless a missing file may define the name and it is similar to no other."""
        if self.may_be_elsewhere and (missing := model.missing_file):
            if (
                nearest(fault.name or "", fault.candidates, cutoff=0.85) is None and model.target != "urdfkit"
            ):  # whose repairs are findings
                return  # include-not-found reports the missing file.
            help = f"it may be defined in {missing}, which was not found"
            severity: Severity | None = "note"
        else:
            help, severity, missing = None, None, ""
        names = (fault.name,) if fault.name else ()
        yield self.at(
            model,
            fault,
            fault.message,
            attribute=fault.attribute,
            help=help,
            severity=severity,
            cause=missing,
            names=names,
        )


class RobotRule(Rule):
    """A rule on the expanded robot."""

    def check(self, model: Model) -> Findings:
        """Yield the findings about the robot."""
        raise NotImplementedError
