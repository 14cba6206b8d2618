"""Shapes and lights of a world, and the base of all records of a world.

SI units throughout. Records compare by content, not by source position.
"""

from typing import Any

from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Plugin, Pose, Sphere, Vector
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position
from urdfkit.record import field, record

Rgba = tuple[float, float, float, float]

_PLACES = frozenset(("position", "notes", "files", "unknown_plugins", "element"))


class Written:
    """Base of records that compare by content, not by source position."""

    def _content(self) -> tuple[Any, ...]:
        names: tuple[str, ...] = type(self).__match_args__  # type: ignore[attr-defined]
        return tuple([self.__dict__[name] for name in names if name not in _PLACES])

    def __eq__(self, other: object) -> bool:
        return self._content() == other._content() if isinstance(other, type(self)) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._content())


@record
class Plane:
    """An infinite plane through the origin of its frame; `size` [m] is the visible part, `normal` a unit vector."""

    normal: Vector = (0.0, 0.0, 1.0)
    size: tuple[float, float] = (1.0, 1.0)


@record
class Ellipsoid:
    """An ellipsoid with `radii` along x, y and z [m]."""

    radii: Vector


@record
class Cone:
    """A cone with its apex along +z and its origin at half height; base `radius` and `length` [m] (SDF 1.11)."""

    radius: float
    length: float


WorldGeometry = Box | Cylinder | Sphere | Capsule | Cone | Ellipsoid | Plane | Mesh


@record(eq=False)
class Kept(Written):
    """An element preserved without interpretation: a plugin, a sensor, or an unsupported setting.

    Attributes:
        text: XML of the element on one line.
        element: the parsed element.
    """

    text: str
    element: Element = field(repr=False)


@record
class Surface:
    """Contact parameters of a collision; the defaults are sdformat's (surface.sdf), for ODE.

    Attributes:
        mu: Coulomb friction coefficient along `fdir1`.
        mu2: Coulomb friction coefficient perpendicular to `fdir1`.
        fdir1: first friction direction in the collision's frame; zero if missing.
        slip1: slip along `fdir1` [m/(s·N)].
        slip2: slip perpendicular to `fdir1` [m/(s·N)].
        kp: contact stiffness [N/m].
        kd: contact damping [N·s/m].
        min_depth: penetration below which a contact exerts no correction [m].
        max_vel: maximum correction velocity of a penetration [m/s].
        restitution: coefficient of restitution.
        bounce_threshold: minimum impact velocity for restitution [m/s].
        collide_bitmask: two shapes collide if their bits overlap.
        collide_without_contact: whether contacts are detected by sensors only, without contact forces.
    """

    mu: float = 1.0
    mu2: float = 1.0
    fdir1: Vector = (0.0, 0.0, 0.0)
    slip1: float = 0.0
    slip2: float = 0.0
    kp: float = 1e12
    kd: float = 1.0
    min_depth: float = 0.0
    max_vel: float = 0.01
    restitution: float = 0.0
    bounce_threshold: float = 100_000.0
    collide_bitmask: int = 65535
    collide_without_contact: bool = False


@record(eq=False)
class WorldShape(Written):
    """A collision or a visual of a link.

    Attributes:
        name: unique among the collisions or visuals of its link.
        geometry: geometry of the shape.
        pose: pose in the link.
        surface: contact parameters of a collision; ignored for a visual.
        rgba: diffuse colour of a visual, each 0..1; None if missing.
        transparency: transparency of a visual: 0 is opaque, 1 is invisible.
        material: name of the Gazebo material script, e.g. ``Gazebo/Grey``; empty if missing.
        laser_retro: intensity that a lidar measures.
        file: the mesh on this machine; empty for other shapes and missing meshes.
        kept: other elements, preserved unchanged.
        position: source position.
    """

    name: str
    geometry: WorldGeometry
    pose: Pose = Pose()
    surface: Surface = Surface()
    rgba: Rgba | None = None
    transparency: float = 0.0
    material: str = ""
    laser_retro: float = 0.0
    file: str = ""
    kept: tuple[Kept, ...] = ()
    position: Position | None = field(default=None, repr=False)


@record(eq=False)
class Light(Written):
    """A light.

    Attributes:
        name: unique among its sibling lights.
        type: ``point``, ``directional`` or ``spot``.
        pose: pose in the world or the link.
        direction: direction of directional and spot lights, in the light's frame.
        diffuse: colour, each 0..1.
        specular: colour, each 0..1.
        attenuation: range [m], constant, linear [1/m] and quadratic [1/m²] factor.
        spot: inner and outer angle [rad], falloff.
        cast_shadows: whether it casts shadows.
        intensity: factor on the colours.
        kept: other elements, preserved unchanged.
        position: source position.
    """

    name: str
    type: str = "point"
    pose: Pose = Pose()
    direction: Vector = (0.0, 0.0, -1.0)
    diffuse: Rgba = (1.0, 1.0, 1.0, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    attenuation: tuple[float, float, float, float] = (10.0, 1.0, 1.0, 0.0)
    spot: Vector = (0.0, 0.0, 0.0)
    cast_shadows: bool = False
    intensity: float = 1.0
    kept: tuple[Kept, ...] = ()
    position: Position | None = field(default=None, repr=False)


def plugins_of(kept: tuple[Kept, ...]) -> tuple[Plugin, ...]:
    """Return the plugins among preserved elements."""
    elements = [each.element for each in kept if each.element.tag == "plugin"]
    return tuple([Plugin(e.get("name"), e.get("filename"), e) for e in elements])


def keep(element: Element) -> Kept:
    """Return an element as a `Kept` record."""
    return Kept(xml_of(element), element)


def xml_of(element: Element) -> str:
    """Return an element as XML on one line."""
    parts = [element.tag]
    parts += [f'{name}="{escaped(value, quoted=True)}"' for name, value in element.attributes.items()]
    inside = escaped(element.text) + "".join([xml_of(child) for child in element.children])
    return f"<{' '.join(parts)}>{inside}</{element.tag}>" if inside else f"<{' '.join(parts)}/>"


def escaped(text: str, *, quoted: bool = False) -> str:
    """Return text escaped for XML, `quoted` for an attribute."""
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("\r", "&#13;")
    if quoted:
        text = text.replace('"', "&quot;").replace("\n", "&#10;").replace("\t", "&#9;")
    return text
