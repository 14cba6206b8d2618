"""Colours of visuals from URDF materials and Gazebo's material names."""

from urdfkit.description.plugins.gazebo_materials import GAZEBO, Rgba, script_of
from urdfkit.description.urdf.robot import Material, Robot, Visual
from urdfkit.description.xml.element import Element
from urdfkit.meshes.specular import MATT, Gloss, gloss_of

__all__ = ["DEFAULT", "GAZEBO", "Palette", "Rgba"]

DEFAULT: Rgba = (0.7, 0.7, 0.7, 1.0)
"""Gazebo's default grey, for visuals without material."""


class Palette:
    """The colours of one robot.

    A colour defined at robot level takes precedence over a colour with the same name in a visual, and a colour defined
    in a visual applies to all later visuals that refer to its name, as in urdfdom and RViz. A URDF colour takes
    precedence over the ``<material>`` of a ``<gazebo reference=…>`` block, which only Gazebo Classic reads.
    """

    def __init__(self, robot: Robot) -> None:
        self._named: dict[str, Rgba] = {}
        inside = (visual.material for link in robot.links for visual in link.visuals)
        for material in (*robot.materials, *inside):
            if material is not None and material.name and material.rgba is not None:
                self._named.setdefault(material.name, material.rgba)
        self._textures: dict[str, Material] = {}
        for material in robot.materials:
            if material.name and material.texture:
                self._textures.setdefault(material.name, material)
        self._gazebo: dict[str, Rgba] = {}
        self._clear: dict[str, float] = {}
        self._gloss: dict[str, Gloss] = {}
        for block in robot.gazebo:
            if block.reference and (rgba := _gazebo_color(block.element)) is not None:
                self._gazebo[block.reference] = rgba
            if block.reference and (clear := _transparency(block.element)) is not None:
                self._clear[block.reference] = clear
            for written in _materials(block.element):
                if block.reference and (gloss := gloss_of(written)) is not None:
                    self._gloss[block.reference] = gloss

    def opacity(self, link: str) -> float:
        """Return the opacity of a link by the ``<transparency>`` of its ``<gazebo>`` block, 0..1; 1 without one."""
        return 1.0 - self._clear.get(link, 0.0)

    def gloss(self, link: str) -> Gloss:
        """Return the specular properties of a link by its ``<gazebo>`` block."""
        return self._gloss.get(link, MATT)

    def textured(self, visual: Visual) -> Material | None:
        """Return the material with the ``<texture>`` of a visual; None without one."""
        if visual.material is None:
            return None
        found = self._textures.get(visual.material.name or "", visual.material)
        return found if found.texture else None

    def of(self, link: str, visual: Visual) -> Rgba | None:
        """Return the colour of a visual, components in 0..1; None if none is defined."""
        if (material := visual.material) is not None:
            named = self._named.get(material.name or "", material.rgba)
            if named is not None:
                return named
        return self._gazebo.get(link)


def _gazebo_color(block: Element) -> Rgba | None:
    """Return the colour a ``<gazebo reference=…>`` block gives its link."""
    for material in _materials(block):
        for tag in ("diffuse", "ambient"):
            if (color := material.find(tag)) is not None and (rgba := _numbers(color.text)) is not None:
                return rgba
        if (rgba := GAZEBO.get(script_of(material)[1].removeprefix("Gazebo/"))) is not None:
            return rgba
    return None


def _materials(block: Element) -> list[Element]:
    """Return the materials that a ``<gazebo reference=…>`` block may define for its link, in document order."""
    places = (block, block.find("visual") or block)
    return [material for place in places if (material := place.find("material")) is not None]


def _transparency(block: Element) -> float | None:
    """Return the transparency, 0..1, that a ``<gazebo reference=…>`` block gives the visuals of its link."""
    written = (block.find("visual") or block).find("transparency")
    try:
        return None if written is None else min(max(float(written.text), 0.0), 1.0)
    except ValueError:
        return None


def _numbers(text: str) -> Rgba | None:
    """Parse ``r g b`` or ``r g b a``; None if the text is invalid."""
    try:
        numbers = [min(max(float(word), 0.0), 1.0) for word in text.split()]
    except ValueError:
        return None
    if len(numbers) == 3:
        numbers.append(1.0)
    return (numbers[0], numbers[1], numbers[2], numbers[3]) if len(numbers) == 4 else None
