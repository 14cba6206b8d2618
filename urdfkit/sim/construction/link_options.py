"""Links without gravity and links with self-collision, from ``<gazebo reference="LINK">``."""

from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError

TRUTHS = {"true": True, "1": True, "false": False, "0": False}


def weightless_links(robot: Robot) -> frozenset[str]:
    """Return the links with ``<gravity>false</gravity>``, or the older ``<turnGravityOff>true</turnGravityOff>``.

    Raises:
        SimulationError: a value is neither true nor false, with its place.
    """
    found = dict(_truths(robot, "gravity"))
    found |= {link: not off for link, off in _truths(robot, "turnGravityOff").items()}
    return frozenset(link for link, pulled in found.items() if link and not pulled)


def self_colliding(robot: Robot) -> frozenset[str]:
    """Return the links with ``<selfCollide>`` or ``<self_collide>``; a block without reference applies to all links.

    Raises:
        SimulationError: a value is neither true nor false, with its place.
    """
    found = _truths(robot, "selfCollide") | _truths(robot, "self_collide")
    default = found.pop("", False)
    return frozenset(link.name for link in robot.links if found.get(link.name, default))


def _truths(robot: Robot, tag: str) -> dict[str, bool]:
    """Return the value of a tag by link; the value for all links has an empty key."""
    found = {}
    for block in robot.gazebo:
        element = block.element.find(tag)
        if element is not None and (not block.reference or block.reference in robot.link_by_name):
            found[block.reference or ""] = _truth(element)
    return found


def _truth(element: Element) -> bool:
    text = (element.text or element.get("value") or "").strip()
    value = TRUTHS.get(text.lower())
    if value is None:
        raise SimulationError(
            f"<{element.tag}> is `{text}`; it must be true or false", position=element.origin.position
        )
    return value
