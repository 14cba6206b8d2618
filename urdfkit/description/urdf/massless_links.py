"""Links that move without mass or inertia; used by rules and by the simulator."""

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Joint, Link, Robot


def moving_bodies(robot: Robot, *, floating: bool) -> dict[str, tuple[Joint | None, list[Link]]]:
    """Return the bodies that move: links fixed to each other, by the name of the topmost link.

    Args:
        robot: one tree of links.
        floating: whether the base is floating; the joint of the root link is then None.

    Returns:
        The joint that moves each body, and its links in document order. Unknown links that joints name are skipped.
    """
    body_of: dict[str, str] = {}
    tops: dict[str, Joint | None] = {}
    for root in robot.roots():
        body_of[root.name] = root.name
        if floating:
            tops[root.name] = None
    for joint in tree_order(robot):
        if joint.child is None:
            continue
        if joint.is_movable:
            body_of[joint.child] = joint.child
            tops[joint.child] = joint
        else:
            body_of[joint.child] = body_of.get(joint.parent or "", joint.child)
    bodies: dict[str, tuple[Joint | None, list[Link]]] = {
        top: (joint, []) for top, joint in tops.items() if top in robot.link_by_name
    }
    for link in robot.link_by_name_in_order():
        if (top := body_of.get(link.name, "")) in bodies:
            bodies[top][1].append(link)
    return bodies


def massless(robot: Robot, *, floating: bool) -> list[tuple[Link, Joint | None]]:
    """Return a link of each body that moves without mass or inertia, and the joint that moves it.

    Links fixed to each other are one body: a body needs a link with a mass and one with an inertia tensor.

    Args:
        robot: one tree of links.
        floating: whether the base is floating; the joint of the root link is then None.

    Returns:
        The first link with a mass of each such body, else the first with a shape, else the topmost, in document order
        of the tree. Unknown links that joints name are skipped.
    """
    found: list[tuple[Link, Joint | None]] = []
    for top, (joint, links) in moving_bodies(robot, floating=floating).items():
        if not (any(map(has_mass, links)) and any(map(has_inertia, links))):
            found.append((first_of(links) or robot.link_by_name[top], joint))
    return found


def first_of(links: list[Link]) -> Link | None:
    """Return the first link with a mass, else the first with a shape; None if no link has one."""
    heavy = next((link for link in links if has_mass(link)), None)
    return heavy or next((link for link in links if link.visuals or link.collisions), None)


def is_free(robot: Robot) -> bool:
    """Return whether the base of a robot moves, unless the user fixes it: its root link is not ``world``."""
    roots = robot.roots()
    return len(roots) == 1 and roots[0].name != "world"


def first_massless(found: list[tuple[Link, Joint | None]]) -> tuple[Link, Joint | None]:
    """Return the link that represents a robot without any mass: the first with a shape, preferably moved by a joint."""
    shaped = [each for each in found if each[0].visuals or each[0].collisions] or found
    return next((each for each in shaped if each[1] is not None), shaped[0])


def has_mass(link: Link) -> bool:
    """Return whether a link has a mass greater than zero."""
    return link.inertial is not None and (link.inertial.mass or 0.0) > 0.0


def has_inertia(link: Link) -> bool:
    """Return whether a link has an inertia tensor whose diagonal is not zero."""
    tensor = link.inertial.inertia if link.inertial is not None else None
    return tensor is not None and any((tensor.ixx, tensor.iyy, tensor.izz))
