"""From the answers of `urdfkit new world` to what is in the file."""

from __future__ import annotations

from collections.abc import Mapping

from urdfkit.errors import UsageError
from urdfkit.scaffold.world.floor_layouts import house, office, one_room
from urdfkit.scaffold.world.floor_plan import Plan, wall_shapes
from urdfkit.scaffold.world.furniture import furnish
from urdfkit.scaffold.world.obstacles import clutter
from urdfkit.scaffold.world.random_numbers import Chance
from urdfkit.scaffold.world.sdf_markup import markup
from urdfkit.scaffold.world.shapes import Thing

_ALL = ("kind", "length", "width")
_WALLS = (*_ALL, "height", "wall_thickness", "doors", "door_width")
_ROOMS = (*_WALLS, "rooms", "furniture", "clear_radius", "seed")
_SAID = {
    "room": _WALLS,
    "office": _ROOMS,
    "house": _ROOMS,
    "clutter": (*_ALL, "count", "largest", "loose", "clear_radius", "seed"),
}


def contents(answers: Mapping[str, str]) -> dict[str, str]:
    """Return what the template of a world wants beside the answers.

    These are ``things``, the models as SDF, a ``title``, and the answers as they were ``said``, to make it again.

    Args:
        answers: to the questions of the template.

    Raises:
        UsageError: what is asked for has no room.
    """
    length, width = float(answers["length"]), float(answers["width"])
    extent = f"{length:g} m by {width:g} m"
    if answers["kind"] == "clutter":
        chance, count = Chance(_whole(answers, "seed")), _whole(answers, "count")
        things = clutter(
            length,
            width,
            count=count,
            largest=float(answers["largest"]),
            loose=answers["loose"] == "yes",
            clear_radius=float(answers["clear_radius"]),
            chance=chance,
        )
        title = f"{count} obstacles on {extent}, by chance; the origin is free."
    else:
        plan, things = _building(answers, length, width)
        doors = sum(len(wall.doors) for wall in plan.walls)
        names = {"room": "A room", "office": "An office", "house": "A house"}
        title = f"{names[answers['kind']]} of {extent}, {len(plan.rooms)} rooms and {doors} doors; the origin is free."
    said = ", ".join(f"{name} {answers[name]}" for name in _SAID[answers["kind"]])
    return {
        "things": markup(things),
        "said": said,
        "title": title.replace("1 rooms", "one room").replace("1 doors", "one door"),
    }


def _building(answers: Mapping[str, str], length: float, width: float) -> tuple[Plan, list[Thing]]:
    thickness, door_width = float(answers["wall_thickness"]), float(answers["door_width"])
    chance = Chance(_whole(answers, "seed"))
    doors = _whole(answers, "doors")
    if answers["kind"] == "room":
        plan = one_room(length, width, doors=doors, door_width=door_width, thickness=thickness)
    elif answers["kind"] == "office":
        rooms = _whole(answers, "rooms")
        plan = office(length, width, rooms=rooms, doors=doors, door_width=door_width, thickness=thickness)
    else:
        rooms = _whole(answers, "rooms")
        plan = house(length, width, rooms=rooms, doors=doors, door_width=door_width, thickness=thickness, chance=chance)
    shapes = wall_shapes(plan.walls, thickness=thickness, height=float(answers["height"]), door_width=door_width)
    things = [Thing("walls", shapes)]
    if answers["kind"] != "room" and answers["furniture"] == "yes":
        radius = float(answers["clear_radius"])
        things += furnish(plan, door_width=door_width, thickness=thickness, clear_radius=radius, chance=chance)
    return plan, things


def _whole(answers: Mapping[str, str], name: str) -> int:
    value = float(answers[name])
    if value != int(value):
        raise UsageError(f"--{name.replace('_', '-')} {answers[name]} is no whole number")
    return int(value)
