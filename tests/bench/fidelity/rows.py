"""All rows of the table, in its order."""

from __future__ import annotations

from fidelity import contacts, free, robots, touch
from fidelity.row import Row

SECTIONS: tuple[tuple[str, tuple[Row, ...]], ...] = (
    ("Free motion", free.ROWS),
    ("Bodies that touch", touch.ROWS),
    ("Joints and wheels", robots.ROWS),
    ("Robots in contact", contacts.ROWS),
)

ROWS: tuple[Row, ...] = tuple(row for _, rows in SECTIONS for row in rows)
