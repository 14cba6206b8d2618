"""Questions to a robot that rules, `load`, the model builder and the simulator ask alike."""

from __future__ import annotations

from urdfkit.description.robot import Joint, Link, Robot


def cycles(robot: Robot) -> list[list[Joint]]:
    """Return kinematic loops: each a list of joints that lead from a link back to itself."""
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


def bodies(robot: Robot) -> dict[str, list[str]]:
    """Return the rigid bodies: first link of each (the one that moves it) → its links, joined by fixed joints."""
    found: dict[str, list[str]] = {}
    body_of: dict[str, str] = {}
    for root in robot.roots():
        body_of[root.name] = root.name
        found[root.name] = [root.name]
    for joint in tree_order(robot):
        if joint.parent is None or joint.child is None or joint.parent not in body_of:
            continue
        body = body_of[joint.parent] if joint.type == "fixed" else joint.child
        body_of[joint.child] = body
        found.setdefault(body, []).append(joint.child)
    return found


def mass(robot: Robot, link: str) -> float:
    """Return the mass of a link [kg]; zero where none is written."""
    inertial = robot.link_by_name[link].inertial if link in robot.link_by_name else None
    return (inertial.mass or 0.0) if inertial is not None else 0.0


def massless_moving_links(robot: Robot, *, floating_base: bool = False) -> list[Link]:
    """Return the links that must move but have no mass, in tree order.

    Links joined by fixed joints are one body, and the sum of their masses counts: a massless ``base_footprint`` is
    fine when the chassis fixed to it has mass.

    Args:
        robot: one tree (or several).
        floating_base: the root moves too, as that of a mobile robot does.
    """
    roots = {link.name for link in robot.roots()}
    return [
        robot.link_by_name[first]
        for first, links in bodies(robot).items()
        if (floating_base or first not in roots)
        and sum(mass(robot, link) for link in links) <= 0.0
        and first in robot.link_by_name
    ]
