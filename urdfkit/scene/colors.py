"""Colours: what a visual looks like, from URDF materials and Gazebo's material names."""

from __future__ import annotations

from urdfkit.description.element import Element
from urdfkit.description.robot import Robot, Visual

Rgba = tuple[float, float, float, float]

DEFAULT: Rgba = (0.7, 0.7, 0.7, 1.0)
"""Gazebo's default grey, for what has no material."""

GAZEBO: dict[str, Rgba] = {
    "Black": (0.0, 0.0, 0.0, 1.0),
    "Blue": (0.0, 0.0, 1.0, 1.0),
    "BlueGlow": (0.0, 0.0, 1.0, 1.0),
    "BlueLaser": (0.0, 0.0, 1.0, 0.4),
    "BlueTransparent": (0.0, 0.0, 1.0, 0.5),
    "Bricks": (0.55, 0.35, 0.28, 1.0),
    "CeilingTiled": (0.8, 0.8, 0.8, 1.0),
    "DarkGray": (0.175, 0.175, 0.175, 1.0),
    "DarkGrey": (0.175, 0.175, 0.175, 1.0),
    "FlatBlack": (0.1, 0.1, 0.1, 1.0),
    "Gold": (0.8, 0.64869, 0.120759, 1.0),
    "Gray": (0.7, 0.7, 0.7, 1.0),
    "Green": (0.0, 1.0, 0.0, 1.0),
    "GreenGlow": (0.0, 1.0, 0.0, 1.0),
    "GreenTransparent": (0.0, 1.0, 0.0, 0.5),
    "Grey": (0.7, 0.7, 0.7, 1.0),
    "GreyTransparent": (0.5, 0.5, 0.5, 0.5),
    "JointAnchor": (1.0, 1.0, 1.0, 1.0),
    "LightOff": (1.0, 0.0, 0.0, 1.0),
    "LightOn": (0.0, 1.0, 0.0, 1.0),
    "Orange": (1.0, 0.5088, 0.0468, 1.0),
    "OrangeTransparent": (1.0, 0.44, 0.0, 0.4),
    "PaintedWall": (0.9, 0.9, 0.9, 1.0),
    "Pioneer2Body": (0.681193, 0.000923, 0.000923, 1.0),
    "PioneerBody": (1.0, 0.0, 0.0, 1.0),
    "Purple": (1.0, 0.0, 1.0, 1.0),
    "PurpleGlow": (1.0, 0.0, 1.0, 1.0),
    "Red": (1.0, 0.0, 0.0, 1.0),
    "RedBright": (0.87, 0.26, 0.07, 1.0),
    "RedGlow": (1.0, 0.0, 0.0, 1.0),
    "RedTransparent": (1.0, 0.0, 0.0, 0.5),
    "Residential": (0.35, 0.35, 0.35, 1.0),
    "Road": (0.35, 0.35, 0.35, 1.0),
    "SkyBlue": (0.0, 0.0, 1.0, 1.0),
    "Turquoise": (0.0, 1.0, 1.0, 1.0),
    "TurquoiseGlow": (0.0, 1.0, 1.0, 1.0),
    "White": (1.0, 1.0, 1.0, 1.0),
    "WhiteGlow": (1.0, 1.0, 1.0, 1.0),
    "Wood": (0.6, 0.45, 0.28, 1.0),
    "WoodFloor": (0.6, 0.45, 0.3, 1.0),
    "WoodPallet": (0.6, 0.48, 0.32, 1.0),
    "Yellow": (1.0, 1.0, 0.0, 1.0),
    "YellowGlow": (1.0, 1.0, 0.0, 1.0),
    "YellowTransparent": (1.0, 1.0, 0.0, 0.5),
    "ZincYellow": (0.9725, 0.9529, 0.2078, 1.0),
}
"""Gazebo classic's materials without their prefix ``Gazebo/`` (gazebo: media/materials/scripts/gazebo.material): the
diffuse colour, or one like the texture where the material is a picture."""


class Palette:
    """The colours of one robot.

    A colour defined at robot level wins over one written inside a visual under the same name, and a colour written in
    one visual serves all later ones that only name it: so does urdfdom, and with it RViz. A URDF colour wins over the
    ``<material>`` of a ``<gazebo reference=…>`` block, which only Gazebo classic reads.
    """

    def __init__(self, robot: Robot) -> None:
        self._named: dict[str, Rgba] = {}
        inside = (visual.material for link in robot.links for visual in link.visuals)
        for material in (*robot.materials, *inside):
            if material is not None and material.name and material.rgba is not None:
                self._named.setdefault(material.name, material.rgba)
        self._gazebo: dict[str, Rgba] = {}
        self._clear: dict[str, float] = {}
        for block in robot.gazebo:
            if block.reference and (rgba := _gazebo_color(block.element)) is not None:
                self._gazebo[block.reference] = rgba
            if block.reference and (clear := _transparency(block.element)) is not None:
                self._clear[block.reference] = clear

    def opacity(self, link: str) -> float:
        """Return what the ``<transparency>`` of a link's ``<gazebo>`` block leaves, 0..1; 1 where there is none."""
        return 1.0 - self._clear.get(link, 0.0)

    def of(self, link: str, visual: Visual) -> Rgba | None:
        """Return the colour of a visual, components in 0..1; None where nothing says one."""
        if (material := visual.material) is not None:
            named = self._named.get(material.name or "", material.rgba)
            if named is not None:
                return named
        return self._gazebo.get(link)


def _gazebo_color(block: Element) -> Rgba | None:
    """Return the colour a ``<gazebo reference=…>`` block gives its link."""
    for material in (block.find("material"), (block.find("visual") or block).find("material")):
        if material is None:
            continue
        for tag in ("diffuse", "ambient"):
            if (color := material.find(tag)) is not None and (rgba := _numbers(color.text)) is not None:
                return rgba
        script = material.find("script")
        name = (script.find("name") if script else None) or material
        if (known := GAZEBO.get(name.text.strip().removeprefix("Gazebo/"))) is not None:
            return known
    return None


def _transparency(block: Element) -> float | None:
    """Return the transparency, 0..1, that a ``<gazebo reference=…>`` block gives the visuals of its link."""
    written = (block.find("visual") or block).find("transparency")
    try:
        return None if written is None else min(max(float(written.text), 0.0), 1.0)
    except ValueError:
        return None


def _numbers(text: str) -> Rgba | None:
    """Read ``r g b`` or ``r g b a``; None where it is neither."""
    try:
        numbers = [min(max(float(word), 0.0), 1.0) for word in text.split()]
    except ValueError:
        return None
    if len(numbers) == 3:
        numbers.append(1.0)
    return (numbers[0], numbers[1], numbers[2], numbers[3]) if len(numbers) == 4 else None
