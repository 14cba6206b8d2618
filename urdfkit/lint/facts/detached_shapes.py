"""Detached shapes: shapes of a link that are far away from its other shapes and from its centre of mass."""

from math import sqrt

from urdfkit.description.urdf.principal_moments import principal_moments
from urdfkit.description.urdf.robot import Collision, Link, Visual
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import shapes_of

MIN_GYRATION = 0.05
"""Minimum ratio of radius of gyration to reach (see I508)."""

TIMES = 10.0
"""Minimum ratio of the reach of a detached shape to the reach of the other shapes."""


def detached_shapes(model: Model, link: Link) -> tuple[list[Visual | Collision], float, float]:
    """Return the shapes whose distance contradicts the other shapes and the inertia of their link.

    Args:
        model: the linted model.
        link: a link of the model.

    Returns:
        The shapes, their minimum reach from the centre of mass, and the maximum reach of the other shapes [m].
    """
    nothing: tuple[list[Visual | Collision], float, float] = ([], 0.0, 0.0)
    inertial, shapes, extent = link.inertial, shapes_of(link), model.extents.get(link.name)
    if inertial is None or not inertial.mass or inertial.mass < 0.0 or extent is None:
        return nothing
    largest = max((moments[2] for moments, _ in principal_moments(link)), default=0.0)
    if len(shapes) != len(extent.shapes) or largest <= 0.0:
        return nothing
    reaches = extent.reaches(inertial.origin.xyz)
    limit = sqrt(largest / inertial.mass) / MIN_GYRATION
    near = max((reach for reach in reaches if reach <= limit), default=0.0)
    far = min((reach for reach in reaches if reach > limit), default=0.0)
    if near <= 0.0 or far < TIMES * near:
        return nothing
    return [shape for shape, reach in zip(shapes, reaches, strict=True) if reach > limit], far, near
