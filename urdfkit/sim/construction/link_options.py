"""Links without gravity and links with self-collision, from ``<gazebo reference="LINK">``."""

from urdfkit.description.urdf.robot import Robot
from urdfkit.description.urdf.values import TRUTHS


def weightless_links(robot: Robot) -> frozenset[str]:
    """Return the links with ``<gravity>false</gravity>``, or the older ``<turnGravityOff>true</turnGravityOff>``.

    Values that are neither true nor false are ignored; they are problems of the robot.
    """
    found = dict(_truths(robot, "gravity"))
    found |= {link: not off for link, off in _truths(robot, "turnGravityOff").items()}
    return frozenset(link for link, pulled in found.items() if link and not pulled)


def self_colliding(robot: Robot) -> frozenset[str]:
    """Return the links with ``<selfCollide>`` or ``<self_collide>``; a block without reference applies to all links.

    Values that are neither true nor false are ignored; they are problems of the robot.
    """
    found = _truths(robot, "selfCollide") | _truths(robot, "self_collide")
    default = found.pop("", False)
    return frozenset(link.name for link in robot.links if found.get(link.name, default))


def _truths(robot: Robot, tag: str) -> dict[str, bool]:
    """Return the value of a tag by link; the value for all links has an empty key."""
    found: dict[str, bool] = {}
    for block in robot.gazebo:
        element = block.element.find(tag)
        if element is not None and (not block.reference or block.reference in robot.link_by_name):
            value = TRUTHS.get((element.text or element.get("value") or "").strip().lower())
            if value is not None:
                found[block.reference or ""] = value
    return found
