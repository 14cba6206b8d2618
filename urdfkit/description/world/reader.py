"""The world as written: gravity and ground. Worlds we ship, and SDF files as far as they are read.

An SDF world may hold lights, physics settings, plugins and a ground plane. Other models are refused, with their place,
rather than left out silently.
"""

from __future__ import annotations

from math import isfinite
from pathlib import Path

from urdfkit.description.element import Element
from urdfkit.description.reading import document_of, read_source
from urdfkit.description.robot import Pose, Vector
from urdfkit.description.world.model import WorldLink, WorldModel
from urdfkit.description.world.shape import Plane, Surface, WorldShape
from urdfkit.description.world.world import GRAVITY, GROUND_MU, World
from urdfkit.errors import DescriptionError, ResourceError, did_you_mean

EARTH: Vector = (0.0, 0.0, -9.81)
"""Gravity of the worlds we ship [m/s²]."""


def ground_plane(name: str = "ground_plane", height: float = 0.0, mu: float = GROUND_MU) -> WorldModel:
    """Return a level plane that does not move."""
    shape = WorldShape("collision", Plane(), surface=Surface(mu=mu))
    link = WorldLink("link", collisions=(shape,))
    return WorldModel(name, Pose((0.0, 0.0, height)), static=True, links=(link,))


WORLDS = {"empty": World("empty", EARTH, (ground_plane(),)), "void": World("void", EARTH)}
"""The worlds we ship: ``empty`` has a sun and a ground plane, ``void`` has nothing at all."""

_SUFFIXES = (".world", ".sdf")


def load_world(world: str | Path) -> World:
    """Return the world of that name or in that file.

    Raises:
        ResourceError: there is none.
        XmlError: the file is not well-formed XML, or hostile.
        DescriptionError: it holds what cannot be simulated yet, with its place.
    """
    if str(world) in WORLDS:
        return WORLDS[str(world)]
    path = Path(world)
    if path.suffix not in _SUFFIXES:
        raise ResourceError(
            f"no world `{world}`{did_you_mean(str(world), WORLDS)}"
            f" (worlds: {', '.join(WORLDS)}, or a path to a .world or .sdf file)"
        )
    root = document_of(read_source(path))
    written = root.find("world") if root.tag == "sdf" else None
    if written is None:
        raise DescriptionError("an SDF world starts with <sdf> and has a <world> in it", position=root.origin.position)
    gravity = written.find("gravity")
    ground: WorldModel | None = None
    for element in written.children:
        if element.tag == "include":
            ground = _included(element) or ground
        elif element.tag == "model":
            ground = _plane(element)
    models = () if ground is None else (ground,)
    return World(written.get("name") or path.stem, GRAVITY if gravity is None else _vector(gravity), models)


def _included(element: Element) -> WorldModel | None:
    """Return the ground plane an ``<include>`` means; None for a light."""
    uri = element.find("uri")
    name = "" if uri is None else uri.text.rstrip("/").rpartition("/")[2].lower().replace(" ", "_")
    if name == "sun":
        return None
    if name == "ground_plane":
        pose = element.find("pose")
        called = element.find("name")
        return ground_plane("ground_plane" if called is None else called.text, _height(pose))
    raise DescriptionError(
        f"model `{'' if uri is None else uri.text}` cannot be simulated yet: worlds hold a ground plane and lights",
        position=element.origin.position,
    )


def _plane(model: Element) -> WorldModel:
    """Return the ground that a model with nothing but a horizontal plane is."""
    collisions = [element for element in model.walk() if element.tag == "collision"]
    geometry = collisions[0].find("geometry") if len(collisions) == 1 else None
    plane = geometry.find("plane") if geometry is not None else None
    normal = plane.find("normal") if plane is not None else None
    level = plane is not None and (normal is None or _vector(normal)[:2] == (0.0, 0.0))
    if not level:
        raise DescriptionError(
            f"model `{model.get('name') or ''}` cannot be simulated yet: worlds hold a ground plane and lights",
            position=model.origin.position,
        )
    mu = next((element for element in collisions[0].walk() if element.tag == "mu"), None)
    height = sum(
        _height(element.find("pose")) for element in model.walk() if element.tag in ("model", "link", "collision")
    )
    return ground_plane(model.get("name") or "ground_plane", height, 1.0 if mu is None else _numbers(mu, 1)[0])


def _height(pose: Element | None) -> float:
    """Return z of a pose that neither rolls nor pitches."""
    if pose is None:
        return 0.0
    numbers = _numbers(pose, 6)
    if any(numbers[3:5]):
        raise DescriptionError("a ground plane that is tilted cannot be simulated yet", position=pose.origin.position)
    return numbers[2]


def _vector(element: Element) -> Vector:
    x, y, z = _numbers(element, 3)
    return x, y, z


def _numbers(element: Element, count: int) -> tuple[float, ...]:
    try:
        numbers = tuple(float(word) for word in element.text.split())
    except ValueError:
        numbers = ()
    if len(numbers) != count or not all(isfinite(number) for number in numbers):
        raise DescriptionError(
            f"<{element.tag}> is `{element.text}`; it must be {count} finite number{'s' * (count > 1)}",
            position=element.origin.position,
        )
    return numbers
