"""Namespaces that elements of launch files set, and launch files that are included in a namespace."""

import re
from collections.abc import Iterator

from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.launch.actions import LaunchAction, roots_of
from urdfkit.lint.facts.launch.records import LaunchActions
from urdfkit.record import record

PUSHED = r"PushR\w+Namespace"
"""Matches the action that sets the namespace of a group in Python."""


@record(eq=False)
class LaunchPlace:
    """Namespace of an element, the attribute that sets it, and whether the element is conditional."""

    namespace: str | None = ""
    spaced_by: Named | None = None
    is_conditional: bool = False


def inside(place: LaunchPlace, element: LaunchAction) -> LaunchPlace:
    """Return the place of the children of an element, and of the node that it is."""
    at = element.attributes
    place = _entered(place, element, at.get("ns") or (at.get("namespace") if "pkg" in at else None))
    for child in element.children if element.tag == "group" else ():
        if child.tag in ("push_ros_namespace", "push-ros-namespace"):
            place = _entered(place, child, child.attributes.get("namespace"))
    return place


def _entered(place: LaunchPlace, element: LaunchAction, space: Named | None) -> LaunchPlace:
    """Return the place of the children of an element with a namespace."""
    is_conditional = place.is_conditional or "if" in element.attributes or "unless" in element.attributes
    if space is None:
        return LaunchPlace(place.namespace, place.spaced_by, is_conditional)
    if "$" in space.name or (place.namespace is None and not space.name.startswith("/")):
        return LaunchPlace(None, space, is_conditional)
    outer = "" if space.name.startswith("/") else place.namespace
    return LaunchPlace(f"{outer}/{space.name.strip('/')}".strip("/"), space, is_conditional)


def included_in_namespace(file: LaunchActions) -> Iterator[str]:
    """Yield the names of the launch files that a file includes in a namespace."""
    if file.source.file.endswith(".py"):
        is_moved = re.search(PUSHED, file.source.text) is not None
        yield from (call.path.rpartition("/")[2] for call in file.includes if is_moved)
        return
    waiting = [(element, LaunchPlace()) for element in roots_of(file.source)]
    while waiting:
        element, place = waiting.pop()
        place = inside(place, element)
        if element.tag == "include" and place.namespace != "" and "file" in element.attributes:
            yield element.attributes["file"].name.rpartition("/")[2]
        waiting += [(child, place) for child in element.children]
