"""Mass and inertia of solids of uniform density, for ``<inertial auto="true">`` (SDF 1.11)."""

from collections.abc import Iterable
from math import pi

from urdfkit.description.sdf.model import WorldInertial
from urdfkit.description.sdf.shapes import Ellipsoid, WorldGeometry
from urdfkit.description.urdf.geometry import combined, principal_moments, volume_of
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere, Vector

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
