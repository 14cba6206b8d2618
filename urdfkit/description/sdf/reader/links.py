"""Links of SDF, their mass properties, and lights.

``<inertial auto="true">`` (SDF 1.11) is computed from solids of uniform density.
"""

from collections.abc import Iterable
from math import pi

from urdfkit.description.sdf.frame_graph import Scope
from urdfkit.description.sdf.model import WorldInertial, WorldLink
from urdfkit.description.sdf.reader.reading_state import Context
from urdfkit.description.sdf.reader.shapes import read_shape
from urdfkit.description.sdf.reader.vocabulary import note_unknown_elements
from urdfkit.description.sdf.shapes import Ellipsoid, Light, WorldGeometry, WorldShape, keep
from urdfkit.description.sdf.values import boolean, color, name_of, raw_pose, scalar, vector, wrong
from urdfkit.description.urdf.geometry import combined, principal_moments, volume_of
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere, Vector
from urdfkit.description.xml.element import Element
from urdfkit.errors import did_you_mean

_READ = {"collision", "gravity", "inertial", "kinematic", "light", "pose", "self_collide", "velocity_decay", "visual"}
_LIGHT_READ = {"attenuation", "cast_shadows", "diffuse", "direction", "intensity", "pose", "specular", "spot", "frame"}
_LIGHTS = ("point", "directional", "spot")


def read_link(context: Context, element: Element, scope: Scope) -> WorldLink:
    """Read a ``<link>``.

    Args:
        context: the file.
        element: the link.
        scope: the frames of its model, including the frame of the link.

    Raises:
        DescriptionError: the link cannot be read.
    """
    note_unknown_elements(context, element)
    name = name_of(element)
    collisions = _shapes(context, element, "collision", scope, name)
    self_collide = element.find("self_collide")
    decay = element.find("velocity_decay")
    lights = [(light, scope.place(raw_pose(light), name, name)) for light in element.find_all("light")]
    return WorldLink(
        name,
        scope.pose(name),
        _inertial(context, element, scope, collisions),
        collisions,
        _shapes(context, element, "visual", scope, name),
        gravity=boolean(element, "gravity", True),
        self_collide=None if self_collide is None else boolean(element, "self_collide", False),
        kinematic=boolean(element, "kinematic", False),
        damping=(scalar(decay, "linear", 0.0), scalar(decay, "angular", 0.0)),
        lights=tuple([read_light(context, light, pose) for light, pose in lights]),
        kept=tuple([keep(child) for child in element.children if child.tag not in _READ]),
        position=element.origin.position,
    )


def _shapes(context: Context, link: Element, tag: str, scope: Scope, name: str) -> tuple[WorldShape, ...]:
    found: dict[str, WorldShape] = {}
    for element in link.find_all(tag):
        shape = read_shape(context, element, scope.place(raw_pose(element), name, name))
        if name_of(element) in found:
            raise wrong(element, f"link `{name}` already has a {tag} `{element.get('name')}`")
        if shape is not None:
            found[shape.name] = shape
    return tuple(found.values())


def _inertial(context: Context, link: Element, scope: Scope, collisions: tuple[WorldShape, ...]) -> WorldInertial:
    element = link.find("inertial")
    if element is None:
        return WorldInertial()
    note_unknown_elements(context, element)
    if element.get("auto", "false").lower() in ("true", "1"):  # type: ignore[union-attr]
        return _automatic(link, element, collisions)
    default = WorldInertial()
    tensor = element.find("inertia")
    name = name_of(link)
    return WorldInertial(
        scalar(element, "mass", default.mass),
        scope.place(raw_pose(element), name, name),
        scalar(tensor, "ixx", default.ixx),
        scalar(tensor, "ixy", default.ixy),
        scalar(tensor, "ixz", default.ixz),
        scalar(tensor, "iyy", default.iyy),
        scalar(tensor, "iyz", default.iyz),
        scalar(tensor, "izz", default.izz),
    )


def _automatic(link: Element, inertial: Element, collisions: tuple[WorldShape, ...]) -> WorldInertial:
    """Return mass properties from the collisions, with the density of collision, link or water (SDF 1.11)."""
    common = scalar(inertial, "density", WATER)
    densities = {name_of(each): scalar(each, "density", common) for each in link.find_all("collision")}
    parts: list[tuple[Pose, Solid]] = []
    for shape in collisions:
        density = densities[shape.name]
        if density <= 0:
            raise wrong(inertial, f"density of collision `{shape.name}` is {density:g}; it must be greater than zero")
        body = solid(shape.geometry, density)
        if body is None:
            kind = type(shape.geometry).__name__.lower()
            raise wrong(
                inertial, f"no automatic inertia of a {kind} (collision `{shape.name}`): write <mass> and <inertia>"
            )
        parts.append((shape.pose, body))
    if not parts:
        raise wrong(inertial, f"link `{link.get('name')}` has no collision to compute its inertia from")
    return together(parts)


def read_light(context: Context, element: Element, pose: Pose) -> Light:
    """Read a ``<light>``.

    Args:
        context: the file.
        element: the light.
        pose: pose of the light in its parent.

    Raises:
        DescriptionError: the light cannot be read.
    """
    note_unknown_elements(context, element)
    name, kind = name_of(element), element.get("type") or "point"
    if kind not in _LIGHTS:
        raise wrong(element, f"unknown type `{kind}` of light `{name}`" + did_you_mean(kind, _LIGHTS))
    default = Light(name)
    fading, spot = element.find("attenuation"), element.find("spot")
    far, constant, linear, quadratic = default.attenuation
    return Light(
        name,
        kind,
        pose,
        vector(element, "direction", default.direction),
        color(element, "diffuse", default.diffuse) or default.diffuse,
        color(element, "specular", default.specular) or default.specular,
        (
            scalar(fading, "range", far),
            scalar(fading, "constant", constant),
            scalar(fading, "linear", linear),
            scalar(fading, "quadratic", quadratic),
        ),
        (scalar(spot, "inner_angle", 0.0), scalar(spot, "outer_angle", 0.0), scalar(spot, "falloff", 0.0)),
        boolean(element, "cast_shadows", default.cast_shadows),
        scalar(element, "intensity", default.intensity),
        tuple([keep(child) for child in element.children if child.tag not in _LIGHT_READ]),
        element.origin.position,
    )


WATER = 1000.0
"""Default density [kg/m³] (sdformat, collision.sdf)."""

Solid = tuple[float, Vector]


def solid(geometry: WorldGeometry, density: float) -> Solid | None:
    """Return mass [kg] and principal moments of inertia [kg·m²] about the centre; None if it is not a solid.

    Args:
        geometry: the shape.
        density: density [kg/m³].
    """
    if isinstance(geometry, Ellipsoid):
        a, b, c = geometry.radii
        mass = density * 4 / 3 * pi * a * b * c
        return mass, (mass / 5 * (b * b + c * c), mass / 5 * (a * a + c * c), mass / 5 * (a * a + b * b))
    if not isinstance(geometry, (Box, Cylinder, Sphere, Capsule)):
        return None
    mass = density * volume_of(geometry)
    return mass, principal_moments(geometry, mass)


def together(parts: Iterable[tuple[Pose, Solid]]) -> WorldInertial:
    """Return the mass properties of a body of several solids about its centre of mass, along the axes of the body.

    Args:
        parts: pose of each solid in the body, and its mass and moments.
    """
    mass, center, tensor = combined([(pose, own, moments) for pose, (own, moments) in parts])
    return WorldInertial(
        mass, Pose(center), tensor[0][0], tensor[0][1], tensor[0][2], tensor[1][1], tensor[1][2], tensor[2][2]
    )
