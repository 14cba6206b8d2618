"""Floor plans: rooms, walls between them, doors in the walls."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from urdfkit.errors import UsageError
from urdfkit.scaffold.world.shapes import WALL, ModelShape

DOOR_HEIGHT = 2.1
"""Height of a door [m]; lower walls have no lintel."""
JAMB = 0.1
"""Minimum width of the wall next to a door [m]."""


@dataclass(frozen=True, slots=True)
class Room:
    """A rectangular room, measured between the middle planes of its walls [m].

    Attributes:
        name: kind of the room, which determines its furniture: ``office``, ``corridor``, ``bedroom`` …
        x: minimum and maximum.
        y: minimum and maximum.
    """

    name: str
    x: tuple[float, float]
    y: tuple[float, float]

    def along(self, axis: int) -> tuple[float, float]:
        """Return the extent along x (0) or y (1)."""
        return self.y if axis else self.x

    @property
    def centre(self) -> tuple[float, float]:
        """The centre of the room."""
        return sum(self.x) / 2, sum(self.y) / 2


@dataclass(frozen=True, slots=True)
class Wall:
    """A straight wall with doors.

    Attributes:
        axis: direction of the wall, x (0) or y (1).
        at: coordinate on the other axis.
        start: lower end along its axis.
        end: upper end along its axis.
        doors: centres of its doors along its axis.
    """

    axis: int
    at: float
    start: float
    end: float
    doors: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Plan:
    """Rooms and the walls around them."""

    rooms: tuple[Room, ...]
    walls: tuple[Wall, ...]


def shared(room: Room, other: Room, axis: int) -> tuple[float, float]:
    """Return the overlap of two rooms along an axis; negative length if they do not overlap."""
    (a, b), (c, d) = room.along(axis), other.along(axis)
    return max(a, c), min(b, d)


def outer_walls(outline: Room, rooms: Sequence[Room], *, doors: int, door_width: float, thickness: float) -> list[Wall]:
    """Return the four walls of a building, with its outer doors distributed over the sides.

    Each door is in the middle of the longest free stretch of a room on its side.

    Args:
        outline: the building.
        rooms: its rooms; of equally long stretches, that of the first room is preferred.
        doors: number of outer doors.
        door_width: width of each door [m].
        thickness: thickness of the walls [m].

    Raises:
        UsageError: the walls have no room for the doors.
    """
    sides = [(1, outline.x[0]), (1, outline.x[1]), (0, outline.y[0]), (0, outline.y[1])]
    free = [
        [
            (lo + thickness / 2 + JAMB, hi - thickness / 2 - JAMB)
            for room in rooms
            if at in room.along(1 - axis)
            for lo, hi in (room.along(axis),)
        ]
        for axis, at in sides
    ]
    placed: list[list[float]] = [[] for _ in sides]
    turn = 0
    for _ in range(doors):
        fits = [i for i, stretches in enumerate(free) if any(hi - lo >= door_width for lo, hi in stretches)]
        if not fits:
            raise UsageError(
                f"no room for --doors {doors}; use a larger --length or --width, or a smaller --door-width"
            )
        while turn % 4 not in fits:
            turn += 1
        side, turn = turn % 4, turn + 1
        lo, hi = stretch = max(free[side], key=lambda s: round(s[1] - s[0], 9))
        middle = (lo + hi) / 2
        placed[side].append(middle)
        free[side].remove(stretch)
        free[side] += [(lo, middle - door_width / 2 - JAMB), (middle + door_width / 2 + JAMB, hi)]
    half = thickness / 2
    return [
        Wall(axis, at, *_ends(outline.along(axis), half if axis == 0 else -half), tuple(sorted(middles)))
        for (axis, at), middles in zip(sides, placed, strict=True)
    ]


def wall_shapes(walls: Sequence[Wall], *, thickness: float, height: float, door_width: float) -> tuple[ModelShape, ...]:
    """Return the boxes that walls consist of: stretches between doors, and lintels above doors.

    Args:
        walls: the walls.
        thickness: thickness of each wall [m].
        height: height of each wall [m].
        door_width: width of each door [m].
    """
    shapes: list[ModelShape] = []
    for number, wall in enumerate(walls, 1):
        edge = wall.start
        for piece, middle in enumerate((*wall.doors, None), 1):
            stop = wall.end if middle is None else middle - door_width / 2
            shapes += _piece(f"wall_{number}_{piece}", wall, edge, stop, (0, height), thickness)
            if middle is not None:
                edge = middle + door_width / 2
                shapes += _piece(f"lintel_{number}_{piece}", wall, stop, edge, (DOOR_HEIGHT, height), thickness)
    return tuple(shapes)


def _piece(
    name: str, wall: Wall, start: float, stop: float, heights: tuple[float, float], thickness: float
) -> Iterator[ModelShape]:
    low, high = heights
    if stop - start < 1e-6 or high - low < 1e-6:
        return
    middle, length = (start + stop) / 2, stop - start
    x, y = (wall.at, middle) if wall.axis else (middle, wall.at)
    size = (thickness, length, high - low) if wall.axis else (length, thickness, high - low)
    yield ModelShape(name, "box", size, (x, y, (low + high) / 2), WALL)


def _ends(extent: tuple[float, float], more: float) -> tuple[float, float]:
    return extent[0] - more, extent[1] + more
