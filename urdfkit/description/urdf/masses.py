"""Links that move without mass or inertia; used by rules and by the simulator."""

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Joint, Link, Robot


def massless(robot: Robot, *, floating: bool) -> list[tuple[Link, Joint | None]]:
    """Return the links that move without mass or inertia, each with the joint that moves it.

    Links fixed to each other are one body: a body needs a link with a mass and one with an inertia tensor.

    Args:
        robot: one tree of links.
        floating: whether the base is floating; the joint of the root link is then None.

    Returns:
        The topmost link of each body without mass or inertia, in document order of the tree. Unknown links
        that joints name are skipped.
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
    heavy, turning = set(), set()
    for link in robot.link_by_name_in_order():
        inertial = link.inertial
        if inertial is None:
            continue
        if inertial.mass is not None and inertial.mass > 0:
            heavy.add(body_of.get(link.name))
        tensor = inertial.inertia
        if tensor is not None and any((tensor.ixx, tensor.iyy, tensor.izz)):
            turning.add(body_of.get(link.name))
    fit = heavy & turning
    links = robot.link_by_name
    return [(links[top], joint) for top, joint in tops.items() if top not in fit and top in links]
