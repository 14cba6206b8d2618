"""Files that are not in UTF-8, which other readers of robot descriptions reject."""

from __future__ import annotations

from collections.abc import Iterable

from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.xacro.faults import Fault
from urdfkit.description.xml.source import Source

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xacro.expanded import Expanded


def encoding_repairs(sources: Iterable[Source]) -> tuple[Repair, ...]:
    """Return the repairs of files in UTF-16 or UTF-32, and of single bytes that are not UTF-8, which are notes."""
    found = []
    for source in sources:
        if source.flaw is None:
            continue
        at, what = source.flaw
        place = source.position(at)
        if what.startswith("UTF-"):
            message = f"the file is in {what}, which other readers reject; urdfkit decodes it: save the file as UTF-8"
            found.append(Repair("xacro", "E001", message, place))
        else:
            message = f"{what} is not UTF-8; it is read as the character U+FFFD: save the file as UTF-8"
            found.append(Repair("xacro", "E001", message, place, severity="note"))
    return tuple(found)


def encoding_faults(expanded: Expanded) -> tuple[Fault, ...]:
    """Return one fault for each otherwise well-formed file that is not UTF-8."""
    broken = {fault.position.file for fault in expanded.faults if fault.kind == "xml"}
    sources = [one for one in expanded.sources.values() if one.flaw is not None and one.file not in broken]
    is_xacro = expanded.path.suffix == ".xacro" or any(
        "xmlns:xacro" in source.text for source in expanded.sources.values()
    )
    found = []
    for source in sources:
        at, what = source.flaw or (0, "")
        message, readers = f"{what} is not UTF-8", "programs that read it as text reject"
        is_wide = what.startswith("UTF-")
        if is_wide:
            message, readers = f"the file is in {what}", "urdfdom rejects"
        rejects = "xacro rejects" if is_xacro else readers
        facts = {"severity": "error" if is_xacro or is_wide else "warning"}
        found.append(Fault("encoding", f"{message}: {rejects} the file", source.position(at), details=facts))
    return tuple(found)
