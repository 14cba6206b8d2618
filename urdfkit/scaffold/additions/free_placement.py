"""Where on a link nothing else is: the place of a part that is added to a robot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from urdfkit.description.urdf.geometry import Bounds, box_around_all
from urdfkit.description.urdf.robot import Vector
from urdfkit.scaffold.additions.link_boxes import gap, moved

_CLEARANCE = 0.005
"""What is left between a new part and what is there [m]."""
_TOUCHES = 0.001
"""What a part may sink into the link it stands on [m]: numbers are rounded to tenths of that."""
_STEPS = 20
"""How many places are tried along an edge of a link, less one."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part that is to be mounted.

    Attributes:
        boxes: around its shapes, in the frame that is placed.
        foot: around those of them that have to stand on the parent.
        where: ``top``, ``front`` or ``middle`` of the parent; in its middle it is inside of it.
        apart: whether it goes as far from other things as it can, not as near as it may: it looks about.
    """

    boxes: tuple[Bounds, ...]
    foot: Bounds
    where: str = "top"
    apart: bool = False


def spot(own: list[Bounds], part: Part) -> Vector:
    """Return the usual place of a part on a link, in its frame [m], whatever else is there.

    On top in the middle, at the front below the upper edge, or in its very middle.

    Args:
        own: the boxes around the link's shapes.
        part: what is mounted.
    """
    low, high = box_around_all(own)
    x, y, z = ((a + b) / 2 for a, b in zip(low, high, strict=True))
    if part.where == "front":
        x, z = high[0] - part.foot[0][0], high[2] - part.foot[1][2]
    if part.where == "top":
        top = _surface(own, 2, (x, y, z))
        z = (high[2] if top is None else top) - part.foot[0][2]
    return round(x, 4), round(y, 4), round(z, 4)


def free_place(own: list[Bounds], others: list[Bounds], part: Part) -> Vector | None:
    """Return a place on a link where a part is inside of nothing, in the link's frame [m].

    The usual place if that is free; otherwise the free one nearest to it, or farthest from other things.

    Args:
        own: the boxes around the link's shapes; none of a link that is a frame only.
        others: those of the other links, in its frame.
        part: what is mounted.

    Returns:
        None where there is none.
    """
    if not own:
        return next((place for place in _above(-part.foot[0][2]) if not _hit(part, place, others)), None)
    usual = spot(own, part)
    solid = [] if part.where == "middle" else own
    if not _hit(part, usual, others) and not _hit(part, usual, solid, _TOUCHES):
        return usual
    places = [
        place
        for place in _places(own, part, usual)
        if not _hit(part, place, others) and not _hit(part, place, solid, _TOUCHES)
    ]

    def farness(place: Vector) -> tuple[int, float, float]:
        x, y, z = (place[k] - usual[k] for k in range(3))
        # On top rather along the middle than beside it, at the front rather beside it than below.
        near = round(x * x + y * y * (2 if part.where == "top" else 1) + 4 * z * z, 9)
        return _overhangs(own, part, place), -_room(part, place, others) if part.apart else 0.0, near

    return min(places, key=farness, default=None)


def inside(part: Part, place: Vector, named: list[tuple[str, Bounds]]) -> str | None:
    """Return the name of something that a part would be inside of; None for nothing.

    Args:
        part: what is mounted.
        place: in the link's frame [m].
        named: boxes in the link's frame, with names.
    """
    return next((name for name, box in named if _hit(part, place, [box], _TOUCHES)), None)


def _hit(part: Part, place: Vector, boxes: list[Bounds], allowed: float = -_CLEARANCE) -> bool:
    """Whether a part overlaps one of the boxes by more than is allowed [m]."""
    return any(gap(moved(box, place), other) < -allowed for box in part.boxes for other in boxes)


def _room(part: Part, place: Vector, others: list[Bounds]) -> float:
    """Return how far the nearest thing is that a part at this place has beside it [m]."""
    about = moved(box_around_all(list(part.boxes)), place)
    beside = [box for box in others if box[0][2] < about[1][2] and about[0][2] < box[1][2]]
    return round(min((gap(about, box) for box in beside), default=0.0), 4)


def _overhangs(own: list[Bounds], part: Part, place: Vector) -> int:
    """Return how many corners of its foot have nothing under them: the link's shapes have steps."""
    if part.where != "top":
        return 0
    low, high = moved(part.foot, place)
    corners = [(x, y, 0.0) for x in (low[0], high[0]) for y in (low[1], high[1])]
    under = (_surface(own, 2, corner) for corner in corners)
    return sum(1 for surface in under if surface is None or abs(surface - low[2]) > _TOUCHES)


def _above(first: float) -> Iterator[Vector]:
    """Yield places above a frame."""
    yield from ((0.0, 0.0, round(first + 0.01 * step, 4)) for step in range(101))


def _places(own: list[Bounds], part: Part, usual: Vector) -> Iterator[Vector]:
    """Yield places all over the top or the front of a link, or in it, from the left front top on."""
    low, high = box_around_all(own)
    (ax, ay, az), (bx, by, bz) = part.foot
    along = [
        sorted({*_row(low[k] - a, high[k] - b), round(usual[k], 4)}, reverse=True)
        for k, (a, b) in enumerate(((ax, bx), (ay, by), (az, bz)))
    ]
    fixed = {"top": 2, "front": 0}.get(part.where)
    if fixed is not None:
        along[fixed] = [usual[fixed]]
    for x in along[0]:
        for y in along[1]:
            for z in along[2]:
                place = [x, y, z]
                if fixed is not None:
                    surface = _surface(own, fixed, (x, y, z))
                    if surface is None:
                        continue
                    place[fixed] = round(surface - part.foot[0][fixed], 4)
                yield place[0], place[1], place[2]


def _row(first: float, last: float) -> list[float]:
    """Return numbers from one to the other, both included; the middle where they are the wrong way round."""
    if last <= first:
        return [round((first + last) / 2, 4)]
    return [round(first + (last - first) * step / _STEPS, 4) for step in range(_STEPS + 1)]


def _surface(own: list[Bounds], axis: int, point: Vector) -> float | None:
    """Return how far the boxes reach along an axis, of those that have the point beside them; None where none has."""
    across = [k for k in range(3) if k != axis]

    def has(low: Vector, high: Vector) -> bool:
        return all(low[k] - _TOUCHES <= point[k] <= high[k] + _TOUCHES for k in across)

    return max((high[axis] for low, high in own if has(low, high)), default=None)
