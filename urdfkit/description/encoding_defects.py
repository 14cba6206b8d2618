"""Files that are not in UTF-8, which other readers of robot descriptions reject."""

from __future__ import annotations

from collections.abc import Iterable

from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.xml.source import Source


def encoding_repairs(sources: Iterable[Source]) -> tuple[Repair, ...]:
    """Return the repairs of files in UTF-16 or UTF-32, and of single bytes that are not UTF-8, which are notes."""
    found = []
    for source in sources:
        if source.flaw is None:
            continue
        at, what = source.flaw
        place = source.position(at)
        if what.startswith("UTF-"):
            message = f"the file is in {what}, which other readers reject; it is decoded: save it as UTF-8"
            found.append(Repair("xacro", "E001", message, place))
        else:
            message = f"{what} is not UTF-8; it is read as the character U+FFFD: save the file as UTF-8"
            found.append(Repair("xacro", "E001", message, place, severity="note"))
    return tuple(found)
