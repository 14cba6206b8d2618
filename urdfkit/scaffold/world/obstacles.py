"""Obstacles by chance: none in another, none near the origin."""

from __future__ import annotations

import math

from urdfkit.errors import UsageError
from urdfkit.scaffold.world.random_numbers import Chance
from urdfkit.scaffold.world.shapes import OBSTACLES, Shape, Thing

GAP = 0.05
"""Least distance between two obstacles [m]."""
DENSITY = 150.0
"""Of an obstacle that can be pushed [kg/m³]: a carton with something in it."""
_TRIES = 2000


def clutter(
    length: float, width: float, *, count: int, largest: float, loose: bool, clear_radius: float, chance: Chance
) -> list[Thing]:
    """Return obstacles on a rectangle about the origin.

    Args:
        length: of the rectangle along x [m].
        width: along y [m].
        count: how many.
        largest: greatest side or diameter of one; the least is a fifth of it [m].
        loose: whether they can be pushed.
        clear_radius: about the origin, left free [m].
        chance: which is where.

    Raises:
        UsageError: so many have no room.
    """
    placed: list[tuple[float, float, float]] = []
    things: list[Thing] = []
    for number in range(1, count + 1):
        shape, radius = _obstacle(largest, chance)
        for _ in range(_TRIES):
            x = round(chance.between(radius - length / 2, length / 2 - radius), 3)
            y = round(chance.between(radius - width / 2, width / 2 - radius), 3)
            free = math.hypot(x, y) >= clear_radius + radius
            if free and all(math.hypot(x - a, y - b) >= radius + r + GAP for a, b, r in placed):
                break
        else:
            raise UsageError(
                f"no room for --count {count} obstacles on {length:g} m by {width:g} m: fewer, smaller "
                "(--largest), or a larger --length or --width"
            )
        placed.append((x, y, radius))
        yaw = round(chance.between(0, math.pi), 3)
        mass = round(max(DENSITY * _volume(shape), 0.01), 3) if loose else None
        things.append(Thing(f"{shape.kind}_{number}", (shape,), (x, y, yaw), mass))
    return things


def _obstacle(largest: float, chance: Chance) -> tuple[Shape, float]:
    """Return a box or cylinder on the ground, and the radius of the circle about it."""
    colour = chance.one_of(OBSTACLES)
    a, b, height = (round(chance.between(largest / 5, largest), 3) for _ in range(3))
    if chance.one_of((True, False)):
        return Shape("box", "box", (a, b, height), (0, 0, height / 2), colour), math.hypot(a, b) / 2
    return Shape("cylinder", "cylinder", (a / 2, height), (0, 0, height / 2), colour), a / 2


def _volume(shape: Shape) -> float:
    if shape.kind == "box":
        return math.prod(shape.size)
    return math.pi * shape.size[0] ** 2 * shape.size[1]
