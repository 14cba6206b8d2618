"""Links and joints whose places or sizes depend on values that xacro could not compute."""

from collections.abc import Iterator

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position

_DECIDING = frozenset(("xacro:if", "xacro:unless", "xacro:attribute", "xacro:element"))
"""Directives whose unknown values leave no trace in the expanded robot."""


def unknown_parts(robot: Robot, expanded: Expanded) -> frozenset[str]:
    """Return the names of links and joints with unknown values or missing children, and of all parts below them.

    All names are returned if a condition is unknown, because any part may depend on it.
    """
    missing = {fault.position for fault in expanded.faults if fault.kind == "undefined-macro"}
    unknown = {position for position, _ in expanded.unresolved}
    if not missing and not unknown:
        return frozenset()
    spoilt: set[Position] = set()
    for document in expanded.documents.values():
        for element in document.walk():
            if element.tag in _DECIDING and element.origin.position in unknown:
                return frozenset((*robot.link_by_name, *robot.joint_by_name))
            if element.tag in ("link", "joint") and any(one.origin.position in missing for one in element.walk()):
                spoilt.add(element.origin.position)
    links = [link for link in robot.links if _is_unknown(link.element, unknown, spoilt)]
    joints = [joint for joint in robot.joints if _is_unknown(joint.element, unknown, spoilt)]
    names = {*(link.name for link in links), *(joint.name for joint in joints)}
    moved = [joint for joint in joints if not _is_placed(joint.element, unknown, spoilt)]
    pending = [joint.child for joint in moved if joint.child is not None]
    below: dict[str | None, list[Joint]] = {}
    for joint in robot.joints:
        below.setdefault(joint.parent, []).append(joint)
    seen: set[str] = set()
    while pending:
        link = pending.pop()
        if link not in seen:
            seen.add(link)
            names.update((link, *(joint.name for joint in below.get(link, ()))))
            pending += [joint.child for joint in below.get(link, ()) if joint.child is not None]
    return frozenset(names)


def _is_unknown(part: Element, unknown: set[Position], spoilt: set[Position]) -> bool:
    return part.origin.position in spoilt or any(position in unknown for position in _positions(part))


def _is_placed(joint: Element, unknown: set[Position], spoilt: set[Position]) -> bool:
    """Return whether the place and the axis of a joint are known."""
    parts = (joint.find(tag) for tag in ("origin", "axis", "parent", "child"))
    places = {joint.origin.position, *(part.origin.position for part in parts if part is not None)}
    return joint.origin.position not in spoilt and unknown.isdisjoint(places)


def _positions(element: Element) -> Iterator[Position]:
    """Yield the positions of an element and of all elements inside it except materials."""
    yield element.origin.position
    for child in element.children:
        if child.tag != "material":
            yield from _positions(child)
