"""Friction of mecanum wheels without rollers, whose direction ``fdir1`` stands for the axes of the rollers.

A mecanum wheel pulls along the axis of the roller on the ground. Seen from above, these four axes meet in the middle of
the base, so that the base can turn (gz-sim, MecanumDrive.cc and examples/worlds/mecanum_drive.sdf).
"""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from urdfkit.description.urdf.geometry import rotate
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number, numbers
from urdfkit.description.xml.source import Position
from urdfkit.lint.facts.root_cause import call_of
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_DIAGONAL = 0.3
"""Largest difference between the parts along x and y of a unit vector that is diagonal."""

_WHEELS = 4


@record(eq=False)
class _Friction:
    """The friction of a wheel: its link and position [m], direction in the root link, and the elements that set it."""

    link: str
    place: tuple[float, float]
    direction: tuple[float, float]
    element: Element
    along: Element
    is_across: bool

    def pulls(self, x: float, y: float) -> bool:
        """Return whether the wheel pulls along its rollers: towards or from the middle of the base, not past it."""
        (u, v), side = self.direction, (self.place[0] - x) * (self.place[1] - y)
        return (u * v * side < 0.0) is not self.is_across


def wrong_frictions(model: Model) -> Iterator[tuple[Element, Position | None, str, str, str]]:
    """Yield the directions and coefficients of mecanum wheels that pull across their rollers.

    Yields:
        The element, the macro call that makes it wrong if others make it right, message, help and link of the wheel.
    """
    found = list(_frictions(model))
    if len(found) != _WHEELS:
        return
    x, y = (sum(each.place[k] for each in found) / _WHEELS for k in (0, 1))
    corners = {(each.place[0] > x, each.place[1] > y) for each in found}
    wrong = [each for each in found if not each.pulls(x, y)]
    if len(corners) < _WHEELS:
        return
    for each in wrong:
        if each.is_across and all(other.is_across for other in found) and len(wrong) == _WHEELS:
            message = f"<{each.along.tag}> along <fdir1> is less than <mu2>, so mecanum wheels slip along their rollers"
            yield each.along, None, message, "exchange both coefficients", each.link
        else:
            right = "1 -1 0" if (each.place[0] > x) is (each.place[1] > y) else "1 1 0"
            wanted = {"1 -1 0": "1 1 0", "1 1 0": "1 -1 0"}[right] if each.is_across else right
            which = "front left and rear right" if right == "1 -1 0" else "front right and rear left"
            message = f"<fdir1> of mecanum wheel `{each.link}` points across its rollers"
            call = call_of(each.element, [other.element for other in found if other not in wrong])
            yield each.element, call, message, f"write {wanted} in the base for the {which} wheels", each.link


def _frictions(model: Model) -> Iterator[_Friction]:
    for block in model.robot.gazebo:
        frame = model.frames.get(block.reference or "")
        parts = {each.tag: each for each in block.element.walk() if each.tag in ("mu", "mu1", "mu2", "fdir1")}
        element, along, across = parts.get("fdir1"), parts.get("mu") or parts.get("mu1"), parts.get("mu2")
        if frame is None or block.reference is None or element is None or along is None or across is None:
            continue
        base = element.get("gz:expressed_in") or element.get("ignition:expressed_in")
        vector = numbers(element.text or "") if base in model.frames else None
        first, second = (number(each.text or each.get("value") or "") for each in (along, across))
        if base is None or vector is None or len(vector) != 3 or first is None or second is None or first == second:
            continue
        u, v, _ = rotate(model.frames[base].rotation, (vector[0], vector[1], vector[2]))
        length = hypot(u, v)
        if length > 0.0 and abs(abs(u) - abs(v)) < _DIAGONAL * length:
            place = frame.translation
            yield _Friction(block.reference, (place[0], place[1]), (u, v), element, along, first < second)
