"""Positions of repairs: the lines and columns in which the linter reports the same defects."""

from collections.abc import Iterable
from dataclasses import replace

from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.xml.start_tag import WrittenAttributes

_ATTRIBUTES = {
    **dict.fromkeys(("C701", "C703", "I511", "T203", "T204", "T206", "T207"), "name"),
    **dict.fromkeys(("G601", "G602", "G606", "G607"), "filename"),
    **dict.fromkeys(("T201", "T202", "T205"), "link"),
    "E023": "quat_xyzw",
    "I501": "value",
    "J402": "type",
    "J411": "xyz",
    "J416": "joint",
    "Z801": "reference",
}
"""Code → attribute at which the rule reports a defect, for repairs without an attribute."""


def at_attributes(repairs: Iterable[Repair]) -> list[Repair]:
    """Return repairs with the position of the attribute that has the defect, if its tag has it."""
    sources = WrittenAttributes()
    return [_at_attribute(repair, sources) for repair in repairs]


def _at_attribute(repair: Repair, sources: WrittenAttributes) -> Repair:
    attribute = repair.attribute or _ATTRIBUTES.get(repair.code or "")
    if attribute is None or repair.position is None:
        return repair
    written = sources.at(repair.position, attribute) or sources.at(repair.position, "link")  # of <parent> and <child>
    return repair if written is None else replace(repair, position=written.name.start)
