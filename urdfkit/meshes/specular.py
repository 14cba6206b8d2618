"""Specular colours and exponents of surfaces.

A surface has specular reflections if the description defines them: with ``<specular>`` and a ``<shininess>`` above zero
in SDF or in a ``<gazebo>`` block, by the name of a glossy Gazebo material, or with ``Ks`` and ``Ns`` in the materials
of an OBJ file. The default shininess of SDF is zero (sdformat, material.sdf), and OGRE, the renderer of Gazebo Classic,
skips specular reflections without shininess (OGRE 1, FFPLighting::preAddToRenderState).
"""

from math import isfinite
from typing import Any

from urdfkit.description.plugins.gazebo_materials import script_of
from urdfkit.description.xml.element import Element

Gloss = tuple[float, float, float, float]
"""Red, green, blue, 0..1, and the exponent."""

MATT: Gloss = (0.0, 0.0, 0.0, 0.0)

MOST = 1000.0
"""Largest exponent; sharper highlights would be at most a pixel wide."""

GLOSSY: dict[str, Gloss] = {
    "Bricks": (0.2, 0.2, 0.2, 12.5),
    "Gold": (0.4, 0.4, 0.4, 12.5),
    "Orange": (0.5, 0.5, 0.5, 128.0),
    "Pioneer2Body": (0.5, 0.5, 0.5, 12.5),
    "PioneerBody": (0.5, 0.0, 0.0, 10.0),
    "RedBright": (0.87, 0.26, 0.07, 1.0),
    "Wood": (0.2, 0.2, 0.2, 12.5),
    "ZincYellow": (0.9725, 0.9529, 0.2078, 1.0),
}
"""Gazebo's materials with a gloss of more than 0.175, without their prefix ``Gazebo/``; with its usual sun, the others'
is 9 of 255 at most (gazebo-classic, media/materials/scripts/gazebo.material)."""


def gloss_of(material: Element) -> Gloss | None:
    """Return the specular properties of a ``<material>`` of SDF or of a ``<gazebo>`` block; None without any."""
    color, sharpness = material.find("specular"), material.find("shininess")
    if color is not None and sharpness is not None:
        return gloss_from(color.text.split(), sharpness.text)
    return GLOSSY.get(script_of(material)[1].removeprefix("Gazebo/")) if color is None else None


def gloss_from(color: Any, exponent: Any) -> Gloss | None:
    """Return the specular properties from three or four numbers 0..1 and an exponent; None if invalid or matt."""
    try:
        red, green, blue = (min(max(float(each), 0.0), 1.0) for each in list(color)[:3])
        sharpness = float(exponent)
    except (TypeError, ValueError):
        return None
    if not (isfinite(red + green + blue) and sharpness > 0.0 and max(red, green, blue) > 0.0):
        return None
    return red, green, blue, min(sharpness, MOST)
