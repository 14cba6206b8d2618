"""Random obstacles that overlap neither each other nor the surroundings of the origin."""

import math

from urdfkit.errors import UsageError
from urdfkit.scaffold.world.random_numbers import Random
from urdfkit.scaffold.world.shapes import OBSTACLES, ModelShape, SdfModel

GAP = 0.05
"""Minimum distance between two obstacles [m]."""
DENSITY = 150.0
"""Density of movable obstacles [kg/m³], as of a filled carton."""
_TRIES = 2000


def clutter(
    length: float, width: float, *, count: int, largest: float, movable: bool, clear_radius: float, random: Random
) -> list[SdfModel]:
    """Return obstacles on a rectangle around the origin.

    Args:
        length: length of the rectangle along x [m].
        width: width of the rectangle along y [m].
        count: number of obstacles.
        largest: maximum side length or diameter [m]; the minimum is a fifth of it.
        movable: whether obstacles can be pushed.
        clear_radius: radius around the origin that is left free [m].
        random: random numbers for shapes and places.

    Raises:
        UsageError: the rectangle has no room for the obstacles.
    """
    placed: list[tuple[float, float, float]] = []
    models: list[SdfModel] = []
    for number in range(1, count + 1):
        shape, radius = _obstacle(largest, random)
        for _ in range(_TRIES):
            x = round(random.between(radius - length / 2, length / 2 - radius), 3)
            y = round(random.between(radius - width / 2, width / 2 - radius), 3)
            free = math.hypot(x, y) >= clear_radius + radius
            if free and all(math.hypot(x - a, y - b) >= radius + r + GAP for a, b, r in placed):
                break
        else:
            raise UsageError(
                f"no room for --count {count} obstacles on {length:g} m by {width:g} m; use fewer or smaller obstacles "
                "(--largest), or a larger --length or --width"
            )
        placed.append((x, y, radius))
        yaw = round(random.between(0, math.pi), 3)
        mass = round(max(DENSITY * _volume(shape), 0.01), 3) if movable else None
        models.append(SdfModel(f"{shape.kind}_{number}", (shape,), (x, y, yaw), mass))
    return models


def _obstacle(largest: float, random: Random) -> tuple[ModelShape, float]:
    """Return a box or cylinder on the ground, and the radius of its circumscribed circle."""
    colour = random.one_of(OBSTACLES)
    a, b, height = (round(random.between(largest / 5, largest), 3) for _ in range(3))
    if random.one_of((True, False)):
        return ModelShape("box", "box", (a, b, height), (0, 0, height / 2), colour), math.hypot(a, b) / 2
    return ModelShape("cylinder", "cylinder", (a / 2, height), (0, 0, height / 2), colour), a / 2


def _volume(shape: ModelShape) -> float:
    if shape.kind == "box":
        return math.prod(shape.size)
    return math.pi * shape.size[0] ** 2 * shape.size[1]
