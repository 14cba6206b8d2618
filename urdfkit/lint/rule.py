"""Rule: one check, whose docstring is its page in the catalogue.

There are three layers of rules, by what they look at: `SourceRule` the text of each file, `FaultRule` what xacro could
not expand, `RobotRule` the robot that came out. All of them yield findings at the place a person wrote.
"""

from __future__ import annotations

from urdfkit.description.xml.source import Position
from urdfkit.lint.finding import Finding

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any, ClassVar, Literal

    from urdfkit.description.xacro.faults import Fault
    from urdfkit.description.xml.element import Element
    from urdfkit.description.xml.source import Origin
    from urdfkit.lint.finding import Fix, Severity
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Document

NOT_GAZEBO = frozenset(("mujoco", "isaac", "drake", "moveit"))
"""Targets that read neither ``<gazebo>`` nor what belongs to controllers."""

_LONGEST = 1_000
"""Characters of a message: names can be as long as a file."""

SECTIONS = ("What it does", "Why is this bad?", "Example", "Use instead", "Fix safety", "References")
"""The headings a rule's docstring may have, in this order; the first four are required."""


class Rule:
    """One check.

    Attributes:
        code: e.g. ``I503``.
        name: reads as "allow <name>", e.g. ``inertia-triangle-inequality``.
        severity: of its findings.
        fix: whether its findings are mended by ``--fix`` (``safe``), by ``--unsafe-fixes`` (``unsafe``) or by hand.
        not_for: targets whose consumers do not mind.
        only_for: targets whose consumers mind, where the others do not; without ``--target`` it is not asked then.
    """

    code: ClassVar[str]
    name: ClassVar[str]
    severity: ClassVar[Severity] = "error"
    fix: ClassVar[Literal["safe", "unsafe", "none"]] = "none"
    not_for: ClassVar[frozenset[str]] = frozenset()
    only_for: ClassVar[tuple[str, ...]] = ()

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
    ) -> Finding:
        """Make a finding.

        Args:
            model: what is being linted.
            where: the element, fault or place it is about.
            message: one line: what is wrong, with values and units.
            attribute: the attribute to point at; the start tag where it is None or not written there.
            link: the link it is about.
            joint: the joint it is about.
            help: what to do about it.
            fix: how to mend it.
            severity: other than the rule's own.
        """
        message = message if len(message) <= _LONGEST else f"{message[: _LONGEST - 100]} … {message[-90:]}"
        place: Any = where if isinstance(where, Position) else getattr(where, "origin", where)
        chain = getattr(place, "expansions", ())
        return Finding(
            self.code,
            self.name,
            severity or self.severity,
            message,
            model.span(getattr(place, "position", place), attribute),
            link,
            joint,
            help,
            fix,
            (chain,) if chain else (),
        )


class SourceRule(Rule):
    """A rule on the text of one file, as written."""

    def check(self, document: Document, model: Model) -> Iterator[Finding]:
        """Yield what is wrong in one file of the model."""
        raise NotImplementedError


class FaultRule(Rule):
    """A rule that reports what xacro could not expand.

    Attributes:
        kinds: of the faults it claims.
        may_be_elsewhere: what it misses may be in an included file that is not there; then it only makes a note of it.
    """

    kinds: ClassVar[tuple[str, ...]] = ()
    may_be_elsewhere: ClassVar[bool] = False

    def claims(self, fault: Fault) -> bool:
        """Return whether the fault is this rule's."""
        return fault.kind in self.kinds

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding of a fault that the rule claims."""
        if self.may_be_elsewhere and (missing := model.missing_file):
            help = f"it may be defined in {missing}, which is not there"
            yield self.at(model, fault, fault.message, attribute=fault.attribute, help=help, severity="note")
        else:
            yield self.at(model, fault, fault.message, attribute=fault.attribute)


class RobotRule(Rule):
    """A rule on the robot after expansion."""

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield what is wrong with the robot."""
        raise NotImplementedError
