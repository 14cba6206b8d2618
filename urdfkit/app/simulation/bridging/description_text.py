"""The description of a robot as URDF, expanded, for programs that draw it."""

from xml.sax.saxutils import escape, quoteattr

from urdfkit.description import Robot
from urdfkit.description.xml.element import Element
from urdfkit.sim.simulator import Simulator

DESCRIPTION = "/robot_description"
STRING = "std_msgs/msg/String"


def publish_description(simulator: Simulator) -> str:
    """Publish the description of a simulated robot on `DESCRIPTION`, unless it has been published; return it."""
    from urdfkit.messages import from_fields

    text = description_text(simulator.robot)
    if simulator.bus.latest(DESCRIPTION) is None:
        simulator.bus.publish(DESCRIPTION, STRING, from_fields(STRING, {"data": text}))
    return text


def description_text(robot: Robot) -> str:
    """Return the URDF of a robot, after xacro."""
    return '<?xml version="1.0"?>\n' + _text(robot.element)


def _text(element: Element) -> str:
    attributes = "".join(f" {name}={quoteattr(value)}" for name, value in element.attributes.items())
    content = escape(element.text) + "".join(map(_text, element.children))
    return f"<{element.tag}{attributes}>{content}</{element.tag}>" if content else f"<{element.tag}{attributes}/>"
