"""How links rub: ``<mu1>``, ``<mu2>``, ``<fdir1>`` of ``<gazebo reference="LINK">``."""

from __future__ import annotations

from math import isfinite

from urdfkit.description.element import Element
from urdfkit.description.robot import Robot
from urdfkit.errors import SimulationError
from urdfkit.sim.engine import Surface


def surfaces_of(robot: Robot) -> dict[str, Surface]:
    """Return link name → surface for the links that have one written.

    Raises:
        SimulationError: a coefficient is no number or negative, with its place.
    """
    found: dict[str, Surface] = {}
    for block in robot.gazebo:
        if block.reference not in robot.link_by_name:
            continue
        mu1 = _numbers(block.element.find("mu1"), 1)
        mu2 = _numbers(block.element.find("mu2"), 1)
        fdir1 = _numbers(block.element.find("fdir1"), 3)
        if mu1 is None and mu2 is None and fdir1 is None:
            continue
        before = found.get(block.reference or "", Surface())
        found[block.reference or ""] = Surface(
            mu1=before.mu1 if mu1 is None else mu1[0],
            mu2=before.mu2 if mu2 is None else mu2[0],
            fdir1=before.fdir1 if fdir1 is None or not any(fdir1) else (fdir1[0], fdir1[1], fdir1[2]),
        )
    return found


def _numbers(element: Element | None, count: int) -> tuple[float, ...] | None:
    """Return the numbers of an element, written as its text or as its ``value`` attribute."""
    if element is None:
        return None
    text = element.text or element.get("value") or ""
    try:
        numbers = tuple(float(word) for word in text.split())
    except ValueError:
        numbers = ()
    if len(numbers) != count or not all(isfinite(number) for number in numbers) or (count == 1 and numbers[0] < 0):
        wanted = "a number, zero or greater" if count == 1 else f"{count} numbers"
        raise SimulationError(f"<{element.tag}> is `{text}`; it must be {wanted}", position=element.origin.position)
    return numbers
