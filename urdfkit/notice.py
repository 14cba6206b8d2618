"""Notice: a line for the user of a simulation with its cause and position."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Hashable
    from typing import Literal

    from urdfkit.position import Position


class Notice(str):
    """Line for the user of a simulation; a plain text is a warning of its own.

    Attributes:
        severity: ``progress`` for the announcement of a compilation; a note begins with ``note:``.
        position: source position that the line begins with; None without one.
        cause: equal for lines that may share one; None for a line of its own.
        package: the missing package that causes the line; lines about one package always share one.
    """

    severity: Literal["warning", "note", "progress"]
    position: Position | None
    cause: Hashable
    package: str

    def __new__(
        cls,
        text: str,
        severity: Literal["warning", "note", "progress"] = "warning",
        *,
        position: Position | None = None,
        cause: Hashable = None,
        package: str = "",
    ) -> Notice:
        """Create the line from its text, with the position."""
        self = super().__new__(cls, f"note: {text}" if severity == "note" else text)
        self.severity, self.position, self.cause, self.package = severity, position, cause, package
        return self

    @classmethod
    def of(cls, text: str) -> Notice:
        """Return a line as a notice; a plain text is a warning."""
        return text if isinstance(text, Notice) else cls(text)
