"""Mass and inertia of solids of uniform density, for ``<inertial auto="true">`` (SDF 1.11)."""

from __future__ import annotations

from collections.abc import Iterable
from math import pi

from urdfkit.description.sdf.model import WorldInertial
from urdfkit.description.sdf.poses import rotation_of
from urdfkit.description.sdf.shapes import Ellipsoid, WorldGeometry
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere, Vector

WATER = 1000.0
"""Default density [kg/m³] (sdformat, collision.sdf)."""

Solid = tuple[float, Vector]


def solid(geometry: WorldGeometry, density: float) -> Solid | None:
    """Return mass [kg] and principal moments of inertia [kg·m²] about the centre; None if it is not a solid.

    The formulas are the textbook's; a capsule is a cylinder and two half spheres, each half with its centre of mass
    3/8·r from its base (parallel axes).

    Args:
        geometry: the shape.
        density: [kg/m³].
    """
    if isinstance(geometry, Box):
        x, y, z = geometry.size
        mass = density * x * y * z
        return mass, (mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y))
    if isinstance(geometry, Cylinder):
        r, h = geometry.radius, geometry.length
        mass = density * pi * r * r * h
        across = mass / 12 * (3 * r * r + h * h)
        return mass, (across, across, mass / 2 * r * r)
    if isinstance(geometry, Sphere):
        mass = density * 4 / 3 * pi * geometry.radius**3
        moment = 2 / 5 * mass * geometry.radius**2
        return mass, (moment, moment, moment)
    if isinstance(geometry, Ellipsoid):
        a, b, c = geometry.radii
        mass = density * 4 / 3 * pi * a * b * c
        return mass, (mass / 5 * (b * b + c * c), mass / 5 * (a * a + c * c), mass / 5 * (a * a + b * b))
    if isinstance(geometry, Capsule):
        r, h = geometry.radius, geometry.length
        tube, ball = density * pi * r * r * h, density * 4 / 3 * pi * r**3
        ends = ball * (2 / 5 * r * r + h * h / 4 + 3 / 8 * h * r)
        across = tube / 12 * (3 * r * r + h * h) + ends
        return tube + ball, (across, across, tube / 2 * r * r + 2 / 5 * ball * r * r)
    return None


def together(parts: Iterable[tuple[Pose, Solid]]) -> WorldInertial:
    """Return the mass properties of a body of several solids about its centre of mass, in the axes of the body.

    Args:
        parts: pose of each solid in the body, its mass and moments.
    """
    parts = list(parts)
    mass = sum(part[1][0] for part in parts)
    center = tuple([sum(pose.xyz[axis] * solid[0] for pose, solid in parts) / mass for axis in range(3)])
    tensor = [[0.0] * 3 for _ in range(3)]
    for pose, (own, moments) in parts:
        turn = rotation_of(pose)
        offset = [pose.xyz[axis] - center[axis] for axis in range(3)]
        square = sum(each * each for each in offset)
        for row in range(3):
            for column in range(3):
                turned = sum(turn[row][k] * moments[k] * turn[column][k] for k in range(3))
                offset_term = (square if row == column else 0.0) - offset[row] * offset[column]
                tensor[row][column] += turned + own * offset_term
    x, y, z = center
    return WorldInertial(
        mass, Pose((x, y, z)), tensor[0][0], tensor[0][1], tensor[0][2], tensor[1][1], tensor[1][2], tensor[2][2]
    )
