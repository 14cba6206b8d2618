"""Everything that a robot was read from, as text: two robots with the same content were read alike."""

from __future__ import annotations

from urdfkit.description import Robot


def content(robot: Robot) -> str:
    """Return the text of every attribute but the XML element and the packages."""
    return repr([getattr(robot, name) for name in Robot.__match_args__ if name not in ("element", "packages")])
