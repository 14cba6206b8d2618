"""Features of a robot: tags, joint types and suspicious properties, which select the rules to run.

A clean robot needs a third of the rules; importing and running the others takes longer than computing the features. The
set must be complete: a rule whose feature is missing does not run.
"""

import re
from collections import Counter
from collections.abc import Callable, Hashable
from math import pi

from urdfkit.description.urdf.robot import (
    JOINT_TYPES,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Inertial,
    Joint,
    Limit,
    Link,
    Mesh,
    Robot,
    Sphere,
    Visual,
)
from urdfkit.description.urdf.version import RATES
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.model.element_facts import ElementFacts

_TENSOR = frozenset(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
_FAR = 2.0 * pi
"""[rad]: larger limits and angles are suspicious."""
_TINY = 0.11
"""[rad]: if both limits of a revolute joint are smaller, they may have been converted to radians twice."""
_PART = re.compile(r"left|front|steer|wheel|(?<![a-z])(?:f[lr]|[rb]l|l[fbh]|rf|l)(?![a-z])", re.IGNORECASE)
"""Matches names of joints that have a counterpart or a purpose."""


def features_of(
    robot: Robot, facts: ElementFacts | None = None, key: Callable[[Link | Joint | Element], Hashable] | None = None
) -> set[str]:
    """Return the features of a robot: tags, joint types, and suspicious properties, which end with ``!``.

    Args:
        robot: the robot.
        facts: facts of its elements at an earlier check; updated by this function.
        key: returns the same for children of the root element that differ in names only; None if all differ.
    """
    facts = ElementFacts() if facts is None else facts
    root = robot.element
    found = _of_elements(Element(root.tag, root.attributes, [], root.text, root.origin))
    parts: tuple[Link | Joint, ...] = (*robot.links, *robot.joints)
    by_element = {part.element: part for part in parts}
    children: list[Link | Joint | Element] = [by_element.get(child, child) for child in root.children]
    found.update(*{*facts.of(_of_child, children, key), *facts.of(_of_names, parts)})
    found.update(f"{problem.kind}!" for problem in robot.problems)
    if robot.element.tag != "robot" or not robot.element.get("name"):
        found.add("unnamed!")
    if not root.children:
        found.add("childless!")
    if "version" in robot.element.attributes:
        found.add("version!")
    tensors = Counter(facts.of(inertia_components, robot.links))
    del tensors[None]
    if max(tensors.values(), default=0) > 2:
        found.add("copied!")
    _of_tree(robot, found)
    return found


def inertia_components(link: Link) -> tuple[float, ...] | None:
    """Return ixx, ixy, ixz, iyy, iyz and izz of a link; None without an inertia."""
    inertia = link.inertial.inertia if link.inertial is not None else None
    if inertia is None:
        return None
    return inertia.ixx, inertia.ixy, inertia.ixz, inertia.iyy, inertia.iyz, inertia.izz


def _of_child(part: Link | Joint | Element) -> frozenset[str]:
    """Return the features of a link, a joint or another child of the root element, except of its names."""
    if isinstance(part, Element):
        return frozenset(_of_elements(part))
    found = _of_elements(part.element)
    if isinstance(part, Link):
        _of_link(part, found)
    else:
        _of_joint(part, found)
    return frozenset(found)


def _of_names(part: Link | Joint) -> frozenset[str]:
    """Return the features of the names in a link or joint."""
    found = {"name!"} if _is_unusual(part.name) else set()
    if isinstance(part, Joint):
        if _PART.search(part.name):
            found.add("part!")
        if part.child is not None and "optical" in part.child.lower():
            found.add("optical!")
    return frozenset(found)


def _is_unusual(name: str) -> bool:
    plain = name.replace("_", "").replace("-", "").replace(".", "")
    return not (plain.isalnum() and plain.isascii()) or name[:1] == "_" or name == "world"


def _of_elements(root: Element) -> set[str]:
    """Return the tags, and whether elements have text, large rotations, or attributes of a later version of URDF."""
    found: set[str] = set()
    checked: set[str] = set()
    pending = [root]
    for element in pending:  # The list grows during the iteration.
        found.add(element.tag)
        if element.text:
            found.add("text!")
        pending += element.children
        if element.tag == "geometry" and len(element.children) != 1:
            found.add("size!")
        if element.tag == "limit" and not element.attributes.keys().isdisjoint(RATES):
            found.add("rates!")
        if element.tag == "origin":
            if "quat_xyzw" in element.attributes:
                found.add("quat_xyzw!")
            angles = element.attributes.get("rpy")
            if angles is not None and angles not in checked:
                checked.add(angles)
                if any(abs(angle) > _FAR for angle in numbers(angles) or ()):
                    found.add("turned-far!")
    return found


def _of_link(link: Link, found: set[str]) -> None:
    inertial = link.inertial
    if inertial is None or not inertial.mass or inertial.inertia is None:
        found.add("massless!")
        if link.collisions:
            found.add("bare-collision!")
    if inertial is not None:
        if inertial.mass is None or not inertial.mass > 0.0:
            found.add("mass!")
        if not _is_possible(inertial):
            found.add("inertia!")
    if link.visuals and not link.collisions:
        found.add("unhit!")
    shapes: tuple[Visual | Collision, ...] = (*link.visuals, *link.collisions)
    for shape in shapes:
        geometry = shape.geometry
        if isinstance(geometry, Box):
            least = min(geometry.size)
        elif isinstance(geometry, (Cylinder, Capsule)):
            least = min(geometry.radius, geometry.length)
        elif isinstance(geometry, Mesh):
            least = min(map(abs, geometry.scale))
        else:
            least = geometry.radius if isinstance(geometry, Sphere) else 1.0 if geometry is not None else 0.0
        if not least > 0.0:
            found.add("size!")


def _is_possible(inertial: Inertial) -> bool:
    """Return whether mass and tensor are certainly physical, by Gershgorin circles."""
    inertia = inertial.inertia
    written = [child for child in inertial.element.children if child.tag == "inertia"]
    if inertia is None or len(written) != 1 or not written[0].attributes.keys() >= _TENSOR:
        return False
    xx, yy, zz = inertia.ixx, inertia.iyy, inertia.izz
    radius = abs(inertia.ixy) + abs(inertia.ixz) + abs(inertia.iyz)
    slack = 3.0 * radius + 1e-9 * (abs(xx) + abs(yy) + abs(zz))
    return xx + yy > zz + slack and xx + zz > yy + slack and yy + zz > xx + slack and not (xx == yy == zz == 1.0)


def _of_tree(robot: Robot, found: set[str]) -> None:
    links = robot.link_by_name
    children = {joint.child for joint in robot.joints if joint.child is not None}
    reached = links.keys() - children
    if len(reached) != 1:
        found.add("roots!")
    if len(children) < sum(joint.child is not None for joint in robot.joints):
        found.add("parents!")
    if len({*links, *robot.joint_by_name}) < len(robot.links) + len(robot.joints):
        found.add("same-name!")
    for joint in robot.joints:
        child, parent = joint.child, joint.parent
        if parent not in links or child not in links:
            found.add("dangling!")
        if parent in reached and child is not None and child != parent:
            reached.add(child)
        else:
            found.add("order!")


def _of_joint(joint: Joint, found: set[str]) -> None:
    kind = joint.type
    found.add(f"type={kind}" if kind is None or kind in JOINT_TYPES else "type=unknown")
    axis = joint.element.find("axis")
    if axis is not None and not abs(sum(part * part for part in joint.axis) - 1.0) < 1e-4:
        found.add("axis!")
    if joint.is_movable:
        found.add("movable!")
        if axis is None:
            found.add("no-axis!")
    limit = joint.limit
    if limit is None:
        if kind in ("revolute", "prismatic"):
            found.add("no-limit!")
    elif not _is_valid(limit, kind):
        found.add("limit!")


def _is_valid(limit: Limit, kind: str | None) -> bool:
    """Return whether a limit is certainly valid for a joint type."""
    if not ((limit.effort or 0.0) > 0.0 and (limit.velocity or 0.0) > 0.0):
        return False
    if any(rate is not None and not rate >= 0.0 for rate in (limit.acceleration, limit.deceleration, limit.jerk)):
        return False
    if kind == "continuous":
        return limit.element.attributes.keys().isdisjoint(("lower", "upper"))
    lower, upper = limit.lower or 0.0, limit.upper or 0.0
    is_tiny = kind == "revolute" and max(-lower, upper) < _TINY
    return kind in ("revolute", "prismatic") and -_FAR <= lower < upper <= _FAR and not is_tiny
