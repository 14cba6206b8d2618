"""All rows of the table, in its order."""

from __future__ import annotations

from fidelity import free, robots, touch
from fidelity.row import Row

SECTIONS: tuple[tuple[str, tuple[Row, ...]], ...] = (
    ("Free motion", free.ROWS),
    ("Bodies that touch", touch.ROWS),
    ("Joints and wheels", robots.ROWS),
)

ROWS: tuple[Row, ...] = tuple(row for _, rows in SECTIONS for row in rows)
