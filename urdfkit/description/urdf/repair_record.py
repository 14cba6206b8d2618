"""Repair: a change to a defective description without which a robot could not be shown or simulated."""

from __future__ import annotations

from dataclasses import replace

from urdfkit.defect_message import DefectMessage
from urdfkit.errors import one_line
from urdfkit.position import Position
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any, Literal

    RepairKind = Literal[
        "xacro", "structure", "inertia", "mass", "shape", "mesh", "joint", "plugin", "hardware", "controller"
    ]
    Severity = Literal["warning", "note"]
else:
    RepairKind = Severity = str

SMALLEST_GROUP = 10
"""Number of warnings of one kind from which on they are one line in the terminal; notes of one kind always are."""

ALL_PLACES = "`urdfkit lint --target urdfkit` lists them"
"""End of a message about several repairs: the command that lists the places of all."""


@record
class Repair:
    """Change to a defective description without which a robot could not be shown or simulated.

    Attributes:
        kind: parameter that was repaired.
        code: code of the lint rule that reports the same defect; None if it depends on the parameter.
        message: the defect and the repair, with amounts and units, without the position.
        position: source position of the defect; None if the robot was not read from a file.
        link: name of the repaired link; None if no link was repaired.
        joint: name of the joint that moves the link, or of the repaired joint; None if unknown.
        severity: ``note`` for changes within rounding errors of the source, else ``warning``.
        attribute: attribute that has the defect; None if it depends on the code.
        package: name of the missing package that causes the defect; empty without one.
    """

    kind: RepairKind
    code: str | None
    message: str
    position: Position | None
    link: str | None = None
    joint: str | None = None
    severity: Severity = "warning"
    attribute: str | None = None
    package: str = ""

    @property
    def cause(self) -> tuple[str | None, ...]:
        """Equal for repairs of one kind: of the same parameter, code and severity."""
        return self.code, self.severity, self.kind, self.attribute, self.package

    def __str__(self) -> str:
        """Return the message with its position."""
        return one_line(self.message if self.position is None else f"{self.position}: {self.message}")

    def as_json(self) -> dict[str, Any]:
        """Return the repair as JSON values."""
        place = self.position
        return {
            "kind": self.kind,
            "severity": self.severity,
            "code": self.code,
            "message": self.message,
            "file": place and place.file,
            "line": place and place.line,
            "column": place and place.column,
            "link": self.link,
            "joint": self.joint,
        }


def grouped(repairs: Iterable[Repair]) -> list[Repair]:
    """Return the repairs for the terminal: from `SMALLEST_GROUP` on, repairs of one kind are one, with their number.

    The line names the command that lists all places.

    Repairs are of one kind if they have the same `Repair.cause`.
    """
    groups: dict[tuple[str | None, ...], list[Repair]] = {}
    for repair in dict.fromkeys(repairs):
        groups.setdefault(repair.cause, []).append(repair)
    found: list[Repair] = []
    for group in groups.values():
        if len(group) < (SMALLEST_GROUP if group[0].severity == "warning" else 2):
            found += group
            continue
        more = f" (and {len(group) - 1} more of this kind; {ALL_PLACES})"
        found.append(replace(group[0], message=DefectMessage.of(group[0].message).inserted(more)))
    return found
