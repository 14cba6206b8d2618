"""Shapes and models of generated worlds."""

from dataclasses import dataclass

WALL = (0.92, 0.92, 0.9)
WOOD = (0.55, 0.38, 0.22)
CLOTH = (0.25, 0.35, 0.5)
DARK = (0.2, 0.2, 0.22)
OBSTACLES = ((0.8, 0.35, 0.2), (0.25, 0.5, 0.75), (0.35, 0.6, 0.35), (0.85, 0.7, 0.25))


@dataclass(frozen=True, slots=True)
class ModelShape:
    """A box, cylinder or sphere.

    Attributes:
        name: unique in its model.
        kind: ``box``, ``cylinder`` or ``sphere``.
        size: x, y and z of a box [m]; radius and length of a cylinder; radius of a sphere.
        centre: position in the frame of the model [m].
        colour: red, green and blue from 0 to 1.
    """

    name: str
    kind: str
    size: tuple[float, ...]
    centre: tuple[float, float, float]
    colour: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class SdfModel:
    """A model of the world.

    Attributes:
        name: unique in the world.
        shapes: its shapes.
        place: x, y [m] and yaw [rad] of its frame, which is on the ground.
        mass: mass of a movable model with one shape [kg]; None: the model is static.
    """

    name: str
    shapes: tuple[ModelShape, ...]
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    mass: float | None = None


def inertia(shape: ModelShape, mass: float) -> tuple[float, float, float]:
    """Return the principal moments of inertia of a solid shape about its centre, in kg·m².

    Args:
        shape: the shape.
        mass: its mass [kg].
    """
    if shape.kind == "box":
        x, y, z = shape.size
        return mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)
    if shape.kind == "cylinder":
        radius, length = shape.size
        across = mass / 12 * (3 * radius * radius + length * length)
        return across, across, mass / 2 * radius * radius
    about_any = 0.4 * mass * shape.size[0] ** 2
    return about_any, about_any, about_any
