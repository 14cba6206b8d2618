"""Validation of masses, inertias, sizes and limits before anything is computed with them."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.description.urdf.robot import Collision, Link, Mesh, Robot
from urdfkit.description.value_defects import invalid_values
from urdfkit.description.xacro.evaluation.failures import chain_words
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError

IMPOSSIBLE = 1e-3
"""Tolerance for impossible moments of inertia, relative to the largest, for rounded numbers (I502, I503)."""

Problem = tuple[str, Element]
"""Message, and the element that it refers to."""


def require_valid(robot: Robot) -> None:
    """Check that all bodies and joints are physically possible.

    Raises:
        SimulationError: the first that is not; with its place.
    """
    for message, element in problems(robot):
        raise SimulationError(message + chain_words(element.origin.expansions), position=element.origin.position)


def problems(robot: Robot) -> Iterator[Problem]:
    """Yield a message and an element for every property that is physically impossible."""
    for link in robot.links:
        yield from _masses(link)
        for collision in link.collisions:
            yield from invalid_sizes(link, collision)
    for joint in robot.joints:
        for _, message, element in invalid_values(joint):
            yield message, element


def _masses(link: Link) -> Iterator[Problem]:
    inertial = link.inertial
    if inertial is None:
        return
    if inertial.mass is not None and inertial.mass < 0.0:
        element = inertial.element.find("mass") or inertial.element
        yield f"link `{link.name}` has a mass of {inertial.mass:g} kg; it must be positive", element
    if (i := inertial.inertia) is None:
        return
    if why := impossible(i.rows):
        yield f"the inertia of link `{link.name}` is impossible: {why}", i.element


def impossible(tensor: ArrayLike, tolerance: float = IMPOSSIBLE) -> str:
    """Return why a tensor of inertia is impossible for a body; empty if it is possible.

    Args:
        tensor: the tensor [kg·m²]; shape (3, 3).
        tolerance: largest violation that is possible, relative to the largest moment.
    """
    a, b, c = np.linalg.eigvalsh(np.asarray(tensor, dtype=float)).tolist()
    if a < -tolerance * max(abs(a), abs(c)):
        why = "one is negative"
    elif c - a - b > tolerance * abs(c):
        why = "the largest exceeds the sum of the others, which is physically impossible"
    else:
        return ""
    return f"of its principal moments {a:.6g}, {b:.6g} and {c:.6g} kg·m² {why}"


def invalid_sizes(link: Link, collision: Collision) -> Iterator[Problem]:
    """Yield a message and an element for each size of a collision shape that is not positive."""
    element = collision.element.find("geometry") or collision.element
    kind = type(collision.geometry).__name__.lower()
    for name, length in sizes_not_positive(collision):
        value = "scale of 0; it must not be zero" if name == "scale" else f"{name} of {length:g} m; it must be positive"
        yield f"the {kind} of link `{link.name}` has a {value}", element.find(kind) or element


def sizes_not_positive(collision: Collision) -> Iterator[tuple[str, float]]:
    """Yield attribute and value [m] for each size of a collision shape that is not positive, or zero in a scale."""
    shape = collision.geometry
    if isinstance(shape, Mesh) and 0.0 in shape.scale:
        yield "scale", 0.0
    if shape is None or isinstance(shape, Mesh):
        return
    for name in ("size", "radius", "length"):
        for length in np.atleast_1d(getattr(shape, name, 1.0)).tolist():
            # A capsule without a cylindrical part is a sphere.
            if not (length > 0.0 or (name == "length" and type(shape).__name__ == "Capsule" and length == 0.0)):
                yield name, length
