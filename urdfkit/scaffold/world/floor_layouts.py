"""Floor plans of `urdfkit new world`: a room, an office along a corridor, a randomly divided house."""

from dataclasses import replace
from itertools import pairwise

from urdfkit.errors import UsageError
from urdfkit.scaffold.world.floor_plan import JAMB, Plan, Room, Wall, outer_walls, shared
from urdfkit.scaffold.world.random_numbers import Random

CORRIDOR = 2.0
"""Width of an office's corridor, from wall to wall [m]."""
HOUSE = ("living room", "bedroom", "kitchen", "bedroom", "study")
_MIN_WIDTH = 2.0
"""Minimum width of a room [m]."""


def one_room(length: float, width: float, *, doors: int, door_width: float, thickness: float) -> Plan:
    """Return a room centred on the origin.

    Args:
        length: length along x, between the middle planes of the walls [m].
        width: width along y [m].
        doors: number of outer doors.
        door_width: width of each door [m].
        thickness: thickness of the walls [m].

    Raises:
        UsageError: the walls have no room for the doors.
    """
    room = Room("room", (-length / 2, length / 2), (-width / 2, width / 2))
    return Plan((room,), tuple(outer_walls(room, [room], doors=doors, door_width=door_width, thickness=thickness)))


def office(length: float, width: float, *, rooms: int, doors: int, door_width: float, thickness: float) -> Plan:
    """Return an office: a corridor along x through the origin, and rooms with doors on both sides of it.

    Args:
        length: length along x, between the middle planes of the outer walls [m].
        width: width along y [m].
        rooms: number of rooms, distributed over both sides.
        doors: number of outer doors; the first two are at the ends of the corridor.
        door_width: width of each door [m].
        thickness: thickness of the walls [m].

    Raises:
        UsageError: the office has no room for the rooms or the doors.
    """
    half = (CORRIDOR + thickness) / 2
    counts = ((rooms + 1) // 2, rooms // 2)
    if width / 2 - half < _MIN_WIDTH + thickness or length / counts[0] < _MIN_WIDTH + thickness:
        raise UsageError(
            f"an office of {length:g} m by {width:g} m has no room for a corridor and --rooms {rooms}: "
            f"each needs a width of {_MIN_WIDTH:g} m; use fewer rooms, or a larger --length or --width"
        )
    outline = Room("", (-length / 2, length / 2), (-width / 2, width / 2))
    all_rooms, walls = [Room("corridor", outline.x, (-half, half))], []
    for side, count in zip((1, -1), counts, strict=True):
        edges = [outline.x[0] + length * i / max(count, 1) for i in range(max(count, 1))] + [outline.x[1]]
        y = (half, outline.y[1]) if side > 0 else (outline.y[0], -half)
        row = [Room("office", (a, b), y) for a, b in pairwise(edges)]
        all_rooms += row
        walls.append(Wall(0, side * half, *outline.x, tuple(room.centre[0] for room in row)))
        walls += [Wall(1, x, *y) for x in edges[1:-1]]
    outer = outer_walls(outline, all_rooms, doors=0, door_width=door_width, thickness=thickness)
    ends = min(doors, 2)
    outer[0] = replace(outer[0], doors=(0.0,) * (ends > 0))
    outer[1] = replace(outer[1], doors=(0.0,) * (ends > 1))
    if doors > 2:
        rest = outer_walls(outline, all_rooms[1:], doors=doors - 2, door_width=door_width, thickness=thickness)
        outer = [
            replace(wall, doors=tuple(sorted((*wall.doors, *more.doors))))
            for wall, more in zip(outer, rest, strict=True)
        ]
    return Plan(tuple(all_rooms), (*outer, *walls))


def house(
    length: float, width: float, *, rooms: int, doors: int, door_width: float, thickness: float, random: Random
) -> Plan:
    """Return a house: a rectangle that is divided repeatedly, with a door in every dividing wall.

    Thus every room is connected to every other. The origin is in the middle of the largest room.

    Args:
        length: length along x, between the middle planes of the outer walls [m].
        width: width along y [m].
        rooms: number of rooms.
        doors: number of outer doors.
        door_width: width of each door [m].
        thickness: thickness of the walls [m].
        random: random numbers for the places of walls and doors.

    Raises:
        UsageError: the house has no room for the rooms or the doors.
    """
    outline = Room("", (0.0, length), (0.0, width))
    min_width = max(_MIN_WIDTH, door_width + 2 * JAMB) + thickness
    leaves, cuts = [outline], []
    while len(leaves) < rooms:
        room = max(leaves, key=lambda r: round((r.x[1] - r.x[0]) * (r.y[1] - r.y[0]), 9))
        axis = 0 if room.x[1] - room.x[0] >= room.y[1] - room.y[0] else 1
        low, high = room.along(axis)
        if high - low < 2 * min_width:
            raise UsageError(
                f"a house of {length:g} m by {width:g} m has no room for --rooms {rooms}; use fewer rooms, or a larger "
                "--length or --width"
            )
        at = round(
            random.between(max(low + min_width, 0.6 * low + 0.4 * high), min(high - min_width, 0.4 * low + 0.6 * high)),
            3,
        )
        index = leaves.index(room)
        leaves[index : index + 1] = [_cut(room, axis, (low, at)), _cut(room, axis, (at, high))]
        cuts.append((1 - axis, at, *room.along(1 - axis)))
    walls = [_divide(cut, leaves, door_width, thickness, random) for cut in cuts]
    walls = outer_walls(outline, leaves, doors=doors, door_width=door_width, thickness=thickness) + walls
    return _centred(leaves, walls)


def _cut(room: Room, axis: int, extent: tuple[float, float]) -> Room:
    return replace(room, x=extent) if axis == 0 else replace(room, y=extent)


def _divide(
    cut: tuple[int, float, float, float], leaves: list[Room], door_width: float, thickness: float, random: Random
) -> Wall:
    """Return the wall at a cut, with a door that connects two rooms."""
    axis, at, start, end = cut
    inside = [room for room in leaves if room.along(axis)[0] >= start - 1e-9 and room.along(axis)[1] <= end + 1e-9]
    before = [room for room in inside if room.along(1 - axis)[1] == at]
    after = [room for room in inside if room.along(1 - axis)[0] == at]
    spare = thickness / 2 + JAMB + door_width / 2
    stretches = [(low + spare, high - spare) for a in before for b in after for low, high in (shared(a, b, axis),)]
    fits = [stretch for stretch in stretches if stretch[1] >= stretch[0]]
    if not fits:
        raise UsageError("no room for a door in one of the walls; use fewer --rooms, a larger house, or another --seed")
    return Wall(axis, at, start, end, (round(random.between(*random.one_of(fits)), 3),))


def _centred(rooms: list[Room], walls: list[Wall]) -> Plan:
    """Return a plan whose origin is in the middle of the largest room, which becomes the first and the living room."""
    ordered = sorted(rooms, key=lambda r: -round((r.x[1] - r.x[0]) * (r.y[1] - r.y[0]), 9))
    dx, dy = ordered[0].centre
    by = (dx, dy)
    return Plan(
        tuple(
            Room(HOUSE[i % len(HOUSE)], (r.x[0] - dx, r.x[1] - dx), (r.y[0] - dy, r.y[1] - dy))
            for i, r in enumerate(ordered)
        ),
        tuple(
            Wall(
                w.axis,
                w.at - by[1 - w.axis],
                w.start - by[w.axis],
                w.end - by[w.axis],
                tuple(door - by[w.axis] for door in w.doors),
            )
            for w in walls
        ),
    )
