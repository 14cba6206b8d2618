"""Furniture along the walls of rooms that leaves doors and passages free."""

import math
from collections.abc import Sequence

from urdfkit.scaffold.world.floor_plan import Plan, Room
from urdfkit.scaffold.world.random_numbers import Random
from urdfkit.scaffold.world.shapes import CLOTH, DARK, WOOD, ModelShape, SdfModel

PASSAGE = 0.8
"""Minimum distance between two pieces, and between a piece and a wall that it does not stand at [m]."""
DOORWAY = 1.2
"""Minimum distance of furniture from a door [m]."""
_TRIES = 40


def _box(
    name: str, size: tuple[float, float, float], x: float, y: float, z: float, colour: tuple[float, ...]
) -> ModelShape:
    """Return a box whose bottom is at height `z`."""
    return ModelShape(name, "box", size, (x, y, z + size[2] / 2), (colour[0], colour[1], colour[2]))


def _table(length: float, depth: float, height: float) -> tuple[ModelShape, ...]:
    x, y = length / 2 - 0.04, depth / 2 - 0.04
    corners = ((x, y), (x, -y), (-x, y), (-x, -y))
    legs = (_box(f"leg_{i}", (0.05, 0.05, height - 0.04), *c, 0, DARK) for i, c in enumerate(corners, 1))
    return (_box("top", (length, depth, 0.04), 0, 0, height - 0.04, WOOD), *legs)


_BED = (_box("bed", (1.4, 2.0, 0.4), 0, 0, 0, CLOTH), _box("pillow", (1.2, 0.4, 0.1), 0, 0.75, 0.4, (0.9, 0.9, 0.9)))
_SOFA = (_box("seat", (1.8, 0.8, 0.42), 0, 0, 0, CLOTH), _box("back", (1.8, 0.2, 0.4), 0, 0.3, 0.42, CLOTH))
PIECES: dict[str, tuple[tuple[float, float], tuple[ModelShape, ...]]] = {
    "table": ((1.2, 0.8), _table(1.2, 0.8, 0.75)),
    "desk": ((1.4, 0.7), _table(1.4, 0.7, 0.74)),
    "cupboard": ((1.0, 0.45), (_box("cupboard", (1.0, 0.45, 1.9), 0, 0, 0, WOOD),)),
    "shelf": ((0.8, 0.3), (_box("shelf", (0.8, 0.3, 1.8), 0, 0, 0, WOOD),)),
    "bed": ((1.4, 2.0), _BED),
    "sofa": ((1.8, 0.8), _SOFA),
    "counter": ((1.6, 0.6), (_box("counter", (1.6, 0.6, 0.9), 0, 0, 0, (0.75, 0.75, 0.75)),)),
}
"""Piece → its width along the wall and its depth [m], and its shapes; origin in the middle of the floor, back at +y."""
IN_ROOM = {
    "office": ("desk", "cupboard", "shelf"),
    "living room": ("sofa", "table", "shelf"),
    "bedroom": ("bed", "cupboard"),
    "kitchen": ("counter", "table"),
    "study": ("desk", "shelf"),
}
"""Kind of room → its furniture, as far as the room is large enough."""

Footprint = tuple[float, float, float, float]


def furnish(plan: Plan, *, door_width: float, thickness: float, clear_radius: float, random: Random) -> list[SdfModel]:
    """Return the furniture of a floor plan.

    Args:
        plan: the rooms and walls.
        door_width: width of the doors [m].
        thickness: thickness of the walls [m].
        clear_radius: radius around the origin that is left free [m].
        random: random numbers for the places.
    """
    models: list[SdfModel] = []
    doorways = _doorways(plan, door_width)
    count: dict[str, int] = {}
    for room in plan.rooms:
        taken: list[Footprint] = []
        for piece in IN_ROOM.get(room.name, ()):
            place = _place(room, PIECES[piece][0], doorways, taken, thickness / 2, clear_radius, random)
            if place is None:
                continue
            (x, y, yaw), footprint = place
            taken.append(footprint)
            count[piece] = count.get(piece, 0) + 1
            models.append(SdfModel(f"{piece}_{count[piece]}", PIECES[piece][1], (x, y, yaw)))
    return models


def _doorways(plan: Plan, door_width: float) -> list[Footprint]:
    areas: list[Footprint] = []
    half = door_width / 2 + 0.2
    for wall in plan.walls:
        for door in wall.doors:
            across, along = (wall.at - DOORWAY, wall.at + DOORWAY), (door - half, door + half)
            areas.append((*across, *along) if wall.axis else (*along, *across))
    return areas


def _place(
    room: Room,
    size: tuple[float, float],
    doorways: Sequence[Footprint],
    taken: Sequence[Footprint],
    inset: float,
    clear_radius: float,
    random: Random,
) -> tuple[tuple[float, float, float], Footprint] | None:
    """Return x, y and yaw of a piece with its back to a wall, and its footprint; None if no place was found."""
    for _ in range(_TRIES):
        side = random.one_of((0, 1, 2, 3))  # direction of its back: +y, -x, -y, +x
        axis = side % 2  # its width is along x (0) or y (1)
        (low, high), (near, far) = room.along(axis), room.along(1 - axis)
        low, high, near, far = low + inset, high - inset, near + inset, far - inset
        along, depth = size
        if high - low < along or far - near < depth + PASSAGE:
            continue
        middle = random.between(low + along / 2, high - along / 2)
        # Either in the corner or with a passage: narrower gaps are useless.
        if middle - along / 2 - low < PASSAGE:
            middle = low + along / 2
        elif high - middle - along / 2 < PASSAGE:
            middle = high - along / 2
        at = (far if side in (0, 3) else near) + (-1 if side in (0, 3) else 1) * (depth / 2 + 0.01)
        middle, at = round(middle, 3), round(at, 3)
        x, y = (at, middle) if axis else (middle, at)
        dx, dy = (depth / 2, along / 2) if axis else (along / 2, depth / 2)
        footprint = (x - dx, x + dx, y - dy, y + dy)
        nearest = math.hypot(max(abs(x) - dx, 0), max(abs(y) - dy, 0))
        clear = all(not _overlap(footprint, other, 0) for other in doorways)
        clear = clear and all(not _overlap(footprint, other, PASSAGE) for other in taken)
        if clear and nearest >= clear_radius:
            return (x, y, side * math.pi / 2), footprint
    return None


def _overlap(one: Footprint, other: Footprint, gap: float) -> bool:
    return one[0] < other[1] + gap and other[0] < one[1] + gap and one[2] < other[3] + gap and other[2] < one[3] + gap
