"""Search for a free place on a link for a new part."""

from collections.abc import Iterator
from dataclasses import dataclass

from urdfkit.description.urdf.geometry import Bounds, box_around_all
from urdfkit.description.urdf.robot import Vector
from urdfkit.scaffold.additions.link_boxes import gap, moved

_CLEARANCE = 0.005
"""Distance between a new part and other links [m]."""
_TOUCHES = 0.001
"""Allowed overlap of a part with the link that it stands on [m]; coordinates are rounded to a tenth of it."""
_STEPS = 20
"""Number of intervals between the places tried along an edge of a link."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part to mount.

    Attributes:
        boxes: boxes around its shapes, in the frame that is placed.
        foot: box around the shapes that must stand on the parent.
        where: ``top``, ``front`` or ``middle`` of the parent; in the middle, the part is inside the parent.
        far_from_others: whether to place it as far from other shapes as possible, for a free view, instead of as
            near to the default place as possible.
    """

    boxes: tuple[Bounds, ...]
    foot: Bounds
    where: str = "top"
    far_from_others: bool = False


def spot(own: list[Bounds], part: Part) -> Vector:
    """Return the default place of a part on a link, in the link's frame [m], ignoring other links.

    The default place is the centre of the top, the upper edge of the front, or the centre of the link.

    Args:
        own: the boxes around the link's shapes.
        part: the part to mount.
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
    """Return a place on a link where a part overlaps nothing, in the link's frame [m].

    The default place if it is free; otherwise the free place nearest to it, or farthest from other shapes.

    Args:
        own: the boxes around the link's shapes; empty for a link without shapes.
        others: the boxes around other links, in the same frame.
        part: the part to mount.

    Returns:
        None if no place is free.
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

    def cost(place: Vector) -> tuple[int, float, float]:
        x, y, z = (place[k] - usual[k] for k in range(3))
        # On top, prefer places along the middle line; at the front, prefer places at the same height.
        near = round(x * x + y * y * (2 if part.where == "top" else 1) + 4 * z * z, 9)
        return _overhangs(own, part, place), -_room(part, place, others) if part.far_from_others else 0.0, near

    return min(places, key=cost, default=None)


def overlapped(part: Part, place: Vector, named: list[tuple[str, Bounds]]) -> str | None:
    """Return the name of a box that a part overlaps; None if it overlaps none.

    Args:
        part: the part to mount.
        place: in the link's frame [m].
        named: boxes in the link's frame, with names.
    """
    return next((name for name, box in named if _hit(part, place, [box], _TOUCHES)), None)


def _hit(part: Part, place: Vector, boxes: list[Bounds], allowed: float = -_CLEARANCE) -> bool:
    """Return whether a part overlaps one of the boxes by more than `allowed` [m]."""
    return any(gap(moved(box, place), other) < -allowed for box in part.boxes for other in boxes)


def _room(part: Part, place: Vector, others: list[Bounds]) -> float:
    """Return the distance from a part to the nearest box at its height [m]."""
    bounds = moved(box_around_all(list(part.boxes)), place)
    level = [box for box in others if box[0][2] < bounds[1][2] and bounds[0][2] < box[1][2]]
    return round(min((gap(bounds, box) for box in level), default=0.0), 4)


def _overhangs(own: list[Bounds], part: Part, place: Vector) -> int:
    """Return how many corners of the part's foot are not supported by the top of the link."""
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
    """Yield places on the top or the front of a link, or inside it, starting at the left front top."""
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
    """Return evenly spaced numbers including both ends; only the middle if `last` is not above `first`."""
    if last <= first:
        return [round((first + last) / 2, 4)]
    return [round(first + (last - first) * step / _STEPS, 4) for step in range(_STEPS + 1)]


def _surface(own: list[Bounds], axis: int, point: Vector) -> float | None:
    """Return the greatest coordinate along an axis of the boxes that contain the point across it; None without one."""
    across = [k for k in range(3) if k != axis]

    def contains(low: Vector, high: Vector) -> bool:
        return all(low[k] - _TOUCHES <= point[k] <= high[k] + _TOUCHES for k in across)

    return max((high[axis] for low, high in own if contains(low, high)), default=None)
