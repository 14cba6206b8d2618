"""Parts that a lenient expansion left out of a robot: missing includes, undefined macros, and values that need them."""

from collections.abc import Iterator

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xacro.faults import Fault
from urdfkit.description.xml.element import Element

_CODES = {
    "include-not-found": "X113",
    "package-not-found": "X113",
    "undefined-macro": "X103",
    "undefined-property": "X104",
}
"""Kind of a fault that a robot can be loaded with → the lint rule that reports it."""
_DISPENSABLE = frozenset(("material", "gazebo", "ros2_control"))
"""Elements without whose values the links and joints stay as they are."""
_DECIDING = frozenset(("xacro:if", "xacro:unless", "xacro:attribute", "xacro:element"))
"""Directives whose unknown values leave no trace in the expanded document."""


def without_unknown_values(expanded: Expanded) -> list[Repair] | None:
    """Remove materials and extensions with unknown values from a leniently expanded robot.

    Args:
        expanded: result of `expand_leniently`; its tree is changed.

    Returns:
        One repair for each include, macro call and undefined property; None if links, joints or their shapes depend on
        a value that is unknown, or if another error was found. The tree of that robot must not be used.
    """
    root = expanded.root
    if root is None or any(fault.kind not in _CODES or fault.defined_at is not None for fault in expanded.faults):
        return None
    tags = {
        element.origin.position: element.tag for document in expanded.documents.values() for element in document.walk()
    }
    if any(tags.get(position) in _DECIDING for position, _ in expanded.unresolved):
        return None
    for parent, child, is_dispensable in [*_unknown(root, expanded)]:
        if is_dispensable:
            parent.children[:] = [other for other in parent.children if other is not child]
        elif child.tag != "mesh":
            return None
    repairs = (_repair(fault, tags.get(fault.position, "")) for fault in expanded.faults)
    return list(dict.fromkeys(repairs))


def _unknown(root: Element, expanded: Expanded) -> Iterator[tuple[Element, Element, bool]]:
    """Yield parent and element for each element with an unknown value, and whether it can be left out."""
    pending = [(root, child, child.tag in _DISPENSABLE) for child in reversed(root.children)]
    while pending:
        parent, element, is_dispensable = pending.pop()
        position = element.origin.position
        values = (*element.attributes.items(), (None, element.text))
        if any("$" in value and (position, attribute) in expanded.unresolved for attribute, value in values):
            yield parent, element, is_dispensable
        else:
            pending += [
                (element, child, is_dispensable or child.tag in _DISPENSABLE) for child in reversed(element.children)
            ]


def _repair(fault: Fault, tag: str) -> Repair:
    if fault.kind == "undefined-macro":
        meant = fault.details.get("meant")
        effect = f"it is read as `{meant}`" if meant else "the call is ignored"
    else:
        effect = "the include is ignored" if tag == "xacro:include" else "everything that uses it is ignored"
    message = with_effect(fault.message, effect)
    return Repair("xacro", _CODES[fault.kind], message, fault.position, attribute=fault.attribute)
