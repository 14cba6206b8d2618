"""Friction of links: ``<mu1>``, ``<mu2>``, ``<fdir1>`` of ``<gazebo reference="LINK">``."""

from dataclasses import replace
from math import isfinite

from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.sim.engine import Surface


def surfaces_of(robot: Robot) -> dict[str, Surface]:
    """Return the surfaces of links that define one; without ``<mu2>``, ``<mu1>`` applies to both directions.

    Invalid numbers are ignored; they are problems of the robot.

    Raises:
        SimulationError: the frame of a direction is not a link; with its place.
    """
    found: dict[str, Surface] = {}
    across: set[str | None] = set()
    for block in robot.gazebo:
        if block.reference not in robot.link_by_name:
            continue
        mu1 = _numbers(block.element.find("mu1"), 1)
        mu2 = _numbers(block.element.find("mu2"), 1)
        fdir1 = _numbers(block.element.find("fdir1"), 3)
        if mu1 is None and mu2 is None and fdir1 is None:
            continue
        before = found.get(block.reference or "", Surface())
        if mu1 is not None:
            before = replace(before, mu1=mu1[0], mu2=before.mu2 if block.reference in across else mu1[0])
        if mu2 is not None:
            before = replace(before, mu2=mu2[0])
            across.add(block.reference)
        if fdir1 is not None and any(fdir1):
            frame = _frame(robot, block.element.find("fdir1"))
            before = replace(before, fdir1=(fdir1[0], fdir1[1], fdir1[2]), frame=frame)
        found[block.reference or ""] = before
    return found


def _frame(robot: Robot, element: Element | None) -> str:
    """Return the link in ``expressed_in`` (in Gazebo with the prefix ``gz:`` or ``ignition:``)."""
    for name in ("gz:expressed_in", "ignition:expressed_in", "expressed_in"):
        link = element.get(name) if element is not None else None
        if element is not None and link:
            if link not in robot.link_by_name:
                raise SimulationError(
                    f"<fdir1> is expressed in `{link}`, which is not a link" + did_you_mean(link, robot.link_by_name),
                    position=element.origin.position,
                )
            return link
    return ""


def _numbers(element: Element | None, count: int) -> tuple[float, ...] | None:
    """Return the numbers of an element, written as its text or as its ``value`` attribute."""
    if element is None:
        return None
    text = element.text or element.get("value") or ""
    try:
        numbers = tuple(float(word) for word in text.split())
    except ValueError:
        numbers = ()
    if len(numbers) != count or not all(isfinite(number) for number in numbers) or (count == 1 and numbers[0] < 0.0):
        return None
    return numbers
