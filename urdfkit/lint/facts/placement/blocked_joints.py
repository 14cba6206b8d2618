"""Joints that move their load into the robot or below the ground, but would not in the opposite direction."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import cos, dist, inf, sin

from urdfkit.description.urdf.geometry import rotate, rotation_of_quaternion, unit
from urdfkit.description.urdf.robot import Joint, Vector
from urdfkit.lint.facts.placement.solids import Solid, diagonal, moving_bodies
from urdfkit.lint.model.model import Model

TYPE_CHECKING = False
if TYPE_CHECKING:
    Movement = Callable[[Vector], Vector]
    """Function that moves a point of the root link."""

_MOST = 40
"""Largest number of moving bodies of a robot that is checked."""

_ONE_SIDED = 0.5
"""Smallest ratio of the sum of both limits to their difference in a range that is mainly on one side of zero."""

_WIDEST = 3.2
"""Widest range of a joint that is checked [rad or m]; joints that turn farther meet the robot in either direction."""

_POSITIONS = 6
"""Number of positions between the limits, both included."""

_BLOCKED = 3
"""Smallest number of them at which the load is in the robot or in the ground."""

_POINTS = (-1.0, -0.5, 0.0, 0.5, 1.0)
"""Places of the points of a shape that are checked, as parts of half its sizes."""

_DEEP = 0.1
"""Smallest depth of such a point in another shape, as a part of half the smallest size of that shape."""

_ROUNDING = 1.0 + 1e-9
"""Factor of distances that rounding errors do not exceed."""

_GROUND = 0.02
"""Depth below the lowest point of the robot at zero that is in the ground [m]."""


def blocked_joints(model: Model) -> Iterator[tuple[Joint, str]]:
    """Yield the joints with the name of the link that their load enters; empty for the ground."""
    bodies = moving_bodies(model, _MOST)
    if bodies is None:
        return
    for body, (_, joint) in bodies.carriers.items():
        limits = _one_sided(joint)
        axis, frame = unit(joint.axis), model.frames.get(joint.child or "")
        if limits is None or axis is None or frame is None:
            continue
        below = set(bodies.below(body))
        load = [solid for name in below for solid in bodies.solids.get(name, ())]
        rest = [solid for name, solids in bodies.solids.items() if name not in below for solid in solids]
        if not load or not rest:
            continue
        positions = [limits[0] + (limits[1] - limits[0]) * step / (_POSITIONS - 1) for step in range(_POSITIONS)]
        move = _movement(joint, frame.translation, rotate(frame.rotation, axis))
        met = _met(_points(load, rest), rest, _ground(load, rest))
        hits = [name for position in positions if (name := met(move(position))) is not None]
        if len(hits) >= _BLOCKED and all(met(move(-position)) is None for position in positions):
            yield joint, next((name for name in hits if name), "")


def _one_sided(joint: Joint) -> tuple[float, float] | None:
    """Return the limits of a joint whose range is mainly on one side of zero; None for others."""
    limit = joint.limit
    if joint.type not in ("revolute", "prismatic") or limit is None or limit.lower is None or limit.upper is None:
        return None
    low, high = limit.lower, limit.upper
    if not low <= 0.0 <= high or not 0.0 < high - low <= _WIDEST or abs(low + high) < _ONE_SIDED * (high - low):
        return None
    return low, high


def _points(load: list[Solid], rest: list[Solid]) -> list[Vector]:
    """Return points of a load, fewer of shapes that are smaller than all of the rest."""
    size = min(diagonal(solid.shape) for solid in rest)
    return [
        point for solid in load for point in solid.points(_POINTS if diagonal(solid.shape) > size else (-1.0, 0.0, 1.0))
    ]


def _ground(load: list[Solid], rest: list[Solid]) -> float:
    """Return the height of the ground: of the lowest point of the robot, if that is not in the load."""
    lowest, lowest_of_load = (
        min(point[2] for solid in solids for point in solid.points((-1.0, 1.0))) for solids in (rest, load)
    )
    return lowest - _GROUND if lowest < lowest_of_load - _GROUND else -inf


def _movement(joint: Joint, pivot: Vector, axis: Vector) -> Callable[[float], Movement]:
    """Return a function of a position of the joint: the movement of a point of the load to it."""
    a, b, c = pivot

    def slid(position: float) -> Movement:
        i, j, k = (position * part for part in axis)
        return lambda point: (point[0] + i, point[1] + j, point[2] + k)

    def turned(position: float) -> Movement:
        i, j, k = (sin(0.5 * position) * part for part in axis)
        rotation = rotation_of_quaternion(i, j, k, cos(0.5 * position))

        def moved(point: Vector) -> Vector:
            x, y, z = rotate(rotation, (point[0] - a, point[1] - b, point[2] - c))
            return a + x, b + y, c + z

        return moved

    return slid if joint.type == "prismatic" else turned


def _met(points: list[Vector], rest: list[Solid], ground: float) -> Callable[[Movement], str | None]:
    """Return a function: the link that the points enter by a movement; empty for the ground, None for none."""
    every = [(solid, diagonal(solid.shape) / 2.0, solid.at.translation) for solid in rest]

    def around(point: Vector, solids: list[tuple[Solid, float, Vector]]) -> str | None:
        for solid, reach, centre in solids:
            if dist(point, centre) < reach and solid.depth(point) > _DEEP * solid.thickness:
                return solid.link.name
        return "" if point[2] < ground else None

    free = [point for point in points if around(point, every) is None]
    x, y, z = (sum(part) / len(points) for part in zip(*points, strict=True))
    middle = x, y, z
    radius = max((dist(middle, point) for point in free), default=0.0)

    def met(move: Movement) -> str | None:
        at = move(middle)
        near = [each for each in every if dist(at, each[2]) < (each[1] + radius) * _ROUNDING]
        if not near and ground == -inf:
            return None
        names = (around(move(point), near) for point in free)
        return next((name for name in names if name is not None), None)

    return met
