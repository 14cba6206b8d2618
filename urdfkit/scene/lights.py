"""Lights of a world, for the renderers."""

from dataclasses import dataclass, field
from math import cos

import numpy as np

from urdfkit.description.sdf import Light, World
from urdfkit.description.xml.element import Element
from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.rays.shading.direct_lighting import DIRECTIONAL, LIGHT, POINT, SPOT

Color = tuple[float, float, float]

AMBIENT: Color = (0.4, 0.4, 0.4)
BACKGROUND: Color = (0.7, 0.7, 0.7)
"""Defaults of a world (sdformat, scene.sdf)."""

_KINDS = {"directional": DIRECTIONAL, "point": POINT, "spot": SPOT}


@dataclass(frozen=True, eq=False)
class Lighting:
    """The lighting of a world.

    Attributes:
        lights: `LIGHT` numbers each; shape (lights, `LIGHT`).
        ambient: ambient light, 0..1.
        background: background colour, 0..1.
    """

    lights: Array = field(default_factory=lambda: np.empty((0, LIGHT)))
    ambient: Color = AMBIENT
    background: Color = BACKGROUND

    @property
    def has_shadows(self) -> bool:
        """Whether a light casts shadows."""
        return bool(self.lights[:, 11].any())

    @property
    def air(self) -> Array:
        """Ambient light and background; shape (2, 3)."""
        return np.array([self.ambient, self.background])


def lighting_of(world: World) -> Lighting:
    """Return the lights of a world, and the ambient light, background and shadows of its ``<scene>``."""
    scene = next((kept.element for kept in world.kept if kept.element.tag == "scene"), None)
    shadows = scene is None or (written := scene.find("shadows")) is None or written.text.lower() in ("true", "1")
    rows = [_numbers(light, shadows=shadows) for light in world.lights if light.type in _KINDS]
    return Lighting(
        np.array(rows).reshape(-1, LIGHT), _color(scene, "ambient", AMBIENT), _color(scene, "background", BACKGROUND)
    )


def _numbers(light: Light, *, shadows: bool) -> list[float]:
    placement = pose_matrix(light.pose)
    towards = matmul(placement[:3, :3], np.array(light.direction))
    towards = towards / (vector_norm(towards) or 1.0)
    where = -towards if light.type == "directional" else placement[:3, 3]
    red, green, blue = (channel * light.intensity for channel in light.diffuse[:3])
    inner, outer, falloff = light.spot
    return [
        _KINDS[light.type], *where, red, green, blue, *light.attenuation, float(light.cast_shadows and shadows),
        *towards, cos(inner / 2), cos(outer / 2), falloff, *(each * light.intensity for each in light.specular[:3]),
    ]  # fmt: skip


def _color(scene: Element | None, tag: str, default: Color) -> Color:
    child = None if scene is None else scene.find(tag)
    try:
        numbers = [float(word) for word in child.text.split()] if child is not None else []
    except ValueError:
        numbers = []
    return (numbers[0], numbers[1], numbers[2]) if len(numbers) in (3, 4) else default
