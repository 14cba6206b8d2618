"""A place in a file: what errors and findings point at."""

from __future__ import annotations

from urdfkit.record import record


@record(order=True)
class Position:
    """A place in a file. Lines and columns count from 1; columns count characters, not bytes."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"
