"""Queries on a robot, shared by rules, `load`, the model builder and the simulator; likely corrections of children."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from urdfkit.description.urdf.robot import Joint, Link, Robot
from urdfkit.description.xml.element import Element
from urdfkit.errors import nearest

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Literal, TypeVar

    Named = TypeVar("Named", Link, Joint)

Owner = tuple[str | None, str | None]
"""Name of the link, or of the joint, that an element belongs to."""

UNDRIVEN = ("fixed", "floating", "planar")
"""Types of joints without exactly one degree of freedom: no transmission or interface can drive them."""


def cycles(robot: Robot) -> list[list[Joint]]:
    """Return the kinematic loops, each as a list of joints."""
    loops: list[list[Joint]] = []
    settled: set[str] = set()
    for joint in robot.joints:
        path: list[Joint] = []
        on_path: dict[str, int] = {}
        at = joint.child
        while at is not None and at not in settled and at not in on_path:
            on_path[at] = len(path)
            above = robot.parents_of.get(at, [])
            if not above:
                break
            path.append(above[0])
            at = above[0].parent
        if at is not None and at in on_path and at not in settled and robot.parents_of.get(at):
            loops.append(list(reversed(path[on_path[at] :])))
        settled.update(on_path)
    return loops


def is_loop(joint: Joint) -> bool:
    """Return whether a joint connects a link with itself."""
    return joint.child is not None and joint.parent == joint.child


def loop_closed_by(robot: Robot, joint: Joint, *, most: int = 100) -> list[str]:
    """Return the links of the loop that a second parent of a link closes, the link first; empty without a loop.

    Args:
        robot: the robot.
        joint: a joint to a link that has a parent already.
        most: maximum number of links to follow.
    """
    found: list[str] = []
    at = joint.parent
    while at is not None and len(found) < most:
        found.append(at)
        if at == joint.child:
            return found[::-1]
        above = robot.parents_of.get(at)
        at = above[0].parent if above else None
    return []


def tree_order(robot: Robot) -> list[Joint]:
    """Return the joints reachable from the roots, parents before children, depth first in document order."""
    order: list[Joint] = []
    seen: set[str] = set()
    stack = [link.name for link in reversed(robot.roots())]
    while stack:
        link = stack.pop()
        if link in seen:
            continue
        seen.add(link)
        joint = next(iter(robot.parents_of.get(link, [])), None)
        if joint is not None:
            order.append(joint)
        stack.extend(j.child for j in reversed(robot.children_of.get(link, [])) if j.child is not None)
    return order


def mass(robot: Robot, link: str) -> float:
    """Return the mass of a link [kg]; zero if it is missing."""
    inertial = robot.link_by_name[link].inertial if link in robot.link_by_name else None
    return (inertial.mass or 0.0) if inertial is not None else 0.0


def repeated(parts: tuple[Named, ...]) -> Iterator[tuple[Named, Named]]:
    """Yield each link or joint with a duplicate name, and the first with that name; unnamed parts are skipped."""
    first: dict[str, Named] = {}
    for part in parts:
        if part.name and first.setdefault(part.name, part) is not part:
            yield part, first[part.name]


def dangling(robot: Robot, end: Literal["parent", "child"]) -> Iterator[tuple[Joint, str, Element]]:
    """Yield each joint whose parent or child link is unknown, with the name and the element that contains it."""
    for joint in robot.joints:
        name = joint.parent if end == "parent" else joint.child
        if name is not None and name not in robot.link_by_name:
            yield joint, name, joint.element.find(end) or joint.element


def owners(robot: Robot) -> dict[Element, Owner]:
    """Return element → the names of the link and the joint that it belongs to."""
    found: dict[Element, Owner] = {}
    for link in robot.links:
        found.update((element, (link.name, None)) for element in link.element.walk())
    for joint in robot.joints:
        found.update((element, (None, joint.name)) for element in joint.element.walk())
    return found


_CUTOFF = 0.6
"""Minimum similarity to the name of a link without parent: `amr` for `arm`."""


def meant_child(robot: Robot, name: str) -> str | None:
    """Return the link most similar to an undefined child; None without a similar one."""
    return nearest(name, robot.link_by_name, cutoff=0.7) or nearest(name, robot.root_by_name, cutoff=_CUTOFF)


def likely_children(robot: Robot, *, most: int | None = None) -> dict[str, str]:
    """Return undefined child → its likely correction.

    Args:
        robot: the robot.
        most: maximum number of undefined children to correct, each of which costs a search; all without a number.
    """
    names = (name for _, name, _ in islice(dangling(robot, "child"), most))
    return {name: meant for name in names if (meant := meant_child(robot, name)) is not None}
