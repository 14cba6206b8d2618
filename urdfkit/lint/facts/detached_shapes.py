"""Shapes of a link that are far from where its others, and its inertia, say that it is."""

from __future__ import annotations

from math import sqrt

from urdfkit.lint.facts.inertia.principal_moments import principal_moments
from urdfkit.lint.model.placement import shapes_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Collision, Link, Visual
    from urdfkit.lint.model.model import Model

LEAST = 0.05
"""Of a reach: what a radius of gyration is at least (see I508)."""

TIMES = 10.0
"""How many times farther than all others a shape has to reach."""


def apart(model: Model, link: Link) -> tuple[list[Visual | Collision], float, float]:
    """Return the shapes that neither the others nor the inertia of their link explain.

    Args:
        model: what is being linted.
        link: of it.

    Returns:
        The shapes, how far they reach from the centre of mass at least, and how far the others do at most [m].
    """
    nothing: tuple[list[Visual | Collision], float, float] = ([], 0.0, 0.0)
    inertial, shapes, extent = link.inertial, shapes_of(link), model.extents.get(link.name)
    if inertial is None or not inertial.mass or inertial.mass < 0.0 or extent is None:
        return nothing
    largest = max((moments[2] for moments, _ in principal_moments(link)), default=0.0)
    if len(shapes) != len(extent.shapes) or largest <= 0.0:
        return nothing
    reaches = extent.reaches(inertial.origin.xyz)
    limit = sqrt(largest / inertial.mass) / LEAST
    near = max((reach for reach in reaches if reach <= limit), default=0.0)
    far = min((reach for reach in reaches if reach > limit), default=0.0)
    if near <= 0.0 or far < TIMES * near:
        return nothing
    return [shape for shape, reach in zip(shapes, reaches, strict=True) if reach > limit], far, near
