"""The description of a robot as URDF, expanded, for programs that draw it."""

from __future__ import annotations

from xml.sax.saxutils import escape, quoteattr

from urdfkit.description import Robot
from urdfkit.description.xml.element import Element


def description_text(robot: Robot) -> str:
    """Return the URDF of a robot, after xacro."""
    return '<?xml version="1.0"?>\n' + _text(robot.element)


def _text(element: Element) -> str:
    attributes = "".join(f" {name}={quoteattr(value)}" for name, value in element.attributes.items())
    content = escape(element.text) + "".join(map(_text, element.children))
    return f"<{element.tag}{attributes}>{content}</{element.tag}>" if content else f"<{element.tag}{attributes}/>"
