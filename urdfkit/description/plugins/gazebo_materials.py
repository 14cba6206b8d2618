"""Names and colours of the materials of Gazebo Classic.

Source: gazebo-classic, media/materials/scripts/gazebo.material and grid.material.
"""

from collections.abc import Iterator

from urdfkit.description.plugins.sensor_elements import nearest
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.element import Element

Rgba = tuple[float, float, float, float]

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
"""Name without its prefix ``Gazebo/`` → diffuse colour; for textured materials, a colour similar to the texture."""

PLAIN = (
    *("BlueTransparentOverlay", "CloudySky", "Footway", "GreenTransparentOverlay", "Grid", "GreyGradientSky"),
    *("Lane_1", "Lanes_2", "Lanes_4", "Lanes_6", "Motorway", "Pedestrian", "PointCloud", "Primary"),
    *("RedTransparentOverlay", "Secondary", "Steps", "Tertiary", "Trunk", "TurquoiseGlowOutline", "WindowFrame"),
)
"""Other materials of Gazebo, drawn in the default colour of shapes without a material."""


def script_of(material: Element) -> tuple[Element, str]:
    """Return the element naming the script of a ``<material>``, and the name: ``<script><name>``, text or value."""
    script = material.find("script")
    place = (script.find("name") if script is not None else None) or material
    return place, (place.text or place.get("value") or "").strip()


def unknown_materials(robot: Robot) -> Iterator[tuple[Element, str, str | None]]:
    """Yield element, name and most similar name of each unknown material ``Gazebo/…`` in the ``<gazebo>`` blocks."""
    for block in robot.gazebo:
        for parent in (block.element, *block.element.find_all("visual")):
            for material in parent.find_all("material"):
                if (found := unknown_material(material)) is not None:
                    yield found


def unknown_material(material: Element) -> tuple[Element, str, str | None] | None:
    """Return element, name and most similar name if a ``<material>`` names an unknown ``Gazebo/…``; else None."""
    names = (*GAZEBO, *PLAIN)
    place, name = script_of(material)
    short = name.removeprefix("Gazebo/")
    if short == name:
        lower = {each.lower(): each for each in names}
        near = lower.get(name.lower().replace("_", ""))
        return (place, name, f"Gazebo/{near}") if near is not None and not material.children else None
    if short in names:
        return None
    near = nearest(short, names, cutoff=0.7)
    return place, name, None if near is None else f"Gazebo/{near}"
