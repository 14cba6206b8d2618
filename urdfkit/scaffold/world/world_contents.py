"""Contents of the world file of `urdfkit new world`, from the answers."""

from collections.abc import Mapping

from urdfkit.errors import UsageError
from urdfkit.scaffold.world.floor_layouts import house, office, one_room
from urdfkit.scaffold.world.floor_plan import Plan, wall_shapes
from urdfkit.scaffold.world.furniture import furnish
from urdfkit.scaffold.world.obstacles import clutter
from urdfkit.scaffold.world.random_numbers import Random
from urdfkit.scaffold.world.sdf_markup import markup
from urdfkit.scaffold.world.shapes import SdfModel

_ALL = ("kind", "length", "width")
_WALLS = (*_ALL, "height", "wall_thickness", "doors", "door_width")
_ROOMS = (*_WALLS, "rooms", "furniture", "clear_radius", "seed")
_ARGUMENTS = {
    "room": _WALLS,
    "office": _ROOMS,
    "house": _ROOMS,
    "clutter": (*_ALL, "count", "largest", "loose", "clear_radius", "seed"),
}


def contents(answers: Mapping[str, str]) -> dict[str, str]:
    """Return the placeholders that the world template needs in addition to its answers.

    They are ``models``, the models as SDF, ``title``, and ``arguments``, the answers that reproduce the world.

    Args:
        answers: answers to the questions of the template.

    Raises:
        UsageError: the world has no room for the requested contents.
    """
    length, width = float(answers["length"]), float(answers["width"])
    extent = f"{length:g} m by {width:g} m"
    if answers["kind"] == "clutter":
        random, count = Random(_whole(answers, "seed")), _whole(answers, "count")
        models = clutter(
            length,
            width,
            count=count,
            largest=float(answers["largest"]),
            movable=answers["loose"] == "yes",
            clear_radius=float(answers["clear_radius"]),
            random=random,
        )
        title = f"{count} random obstacles on {extent}; the origin is free."
    else:
        plan, models = _building(answers, length, width)
        doors = sum(len(wall.doors) for wall in plan.walls)
        names = {"room": "A room", "office": "An office", "house": "A house"}
        title = f"{names[answers['kind']]} of {extent}, {len(plan.rooms)} rooms and {doors} doors; the origin is free."
    arguments = ", ".join(f"{name} {answers[name]}" for name in _ARGUMENTS[answers["kind"]])
    return {
        "models": markup(models),
        "arguments": arguments,
        "title": title.replace("1 rooms", "one room").replace("1 doors", "one door"),
    }


def _building(answers: Mapping[str, str], length: float, width: float) -> tuple[Plan, list[SdfModel]]:
    thickness, door_width = float(answers["wall_thickness"]), float(answers["door_width"])
    random = Random(_whole(answers, "seed"))
    doors = _whole(answers, "doors")
    if answers["kind"] == "room":
        plan = one_room(length, width, doors=doors, door_width=door_width, thickness=thickness)
    elif answers["kind"] == "office":
        rooms = _whole(answers, "rooms")
        plan = office(length, width, rooms=rooms, doors=doors, door_width=door_width, thickness=thickness)
    else:
        rooms = _whole(answers, "rooms")
        plan = house(length, width, rooms=rooms, doors=doors, door_width=door_width, thickness=thickness, random=random)
    shapes = wall_shapes(plan.walls, thickness=thickness, height=float(answers["height"]), door_width=door_width)
    models = [SdfModel("walls", shapes)]
    if answers["kind"] != "room" and answers["furniture"] == "yes":
        radius = float(answers["clear_radius"])
        models += furnish(plan, door_width=door_width, thickness=thickness, clear_radius=radius, random=random)
    return plan, models


def _whole(answers: Mapping[str, str], name: str) -> int:
    value = float(answers[name])
    if value != int(value):
        raise UsageError(f"--{name.replace('_', '-')} {answers[name]} is not an integer")
    return int(value)
