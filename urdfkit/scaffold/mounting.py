"""Where a new part goes on a robot: on which link, and where on it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from urdfkit.description.robot import Box, Capsule, Cylinder, Geometry, Link, Pose, Robot, Sphere, Vector
from urdfkit.errors import ResourceError, did_you_mean


def parent_link(robot: Robot, name: str | None) -> Link:
    """Return the link that something is mounted on.

    Args:
        robot: the robot.
        name: as asked for; None: ``base_link`` if that is more than a frame, else the heaviest link.

    Raises:
        ResourceError: there is no such link.
    """
    if name is not None:
        if name not in robot.link_by_name:
            near = did_you_mean(name, robot.link_by_name)
            raise ResourceError(f"no link `{name}` in robot `{robot.name}`{near or f'; {_listed(robot)}'}")
        return robot.link_by_name[name]
    base = robot.link_by_name.get("base_link")
    if base is not None and (base.visuals or base.collisions):
        return base
    heavy = [link for link in robot.links if link.inertial is not None and link.inertial.mass]
    if not heavy:
        return base or robot.links[0]
    return max(heavy, key=lambda link: (link.inertial.mass or 0.0) if link.inertial is not None else 0.0)


def spot(link: Link, where: str, offset: tuple[float, float]) -> Vector | None:
    """Return a place on a link, in its frame [m]; None where its extent is not known without reading a mesh.

    Args:
        link: with boxes, cylinders, capsules or balls.
        where: ``top``, ``front`` or ``middle``.
        offset: from there, along x and z [m].
    """
    bounds = _bounds(link)
    if bounds is None:
        return None
    low, high = bounds
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    x = {"front": high[0]}.get(where, middle[0]) + offset[0]
    z = {"middle": middle[2]}.get(where, high[2]) + offset[1]
    return round(x, 4), round(middle[1], 4), round(z, 4)


def extent(link: Link) -> Vector | None:
    """Return how long, wide and high a link is [m]; None where that is not known without reading a mesh.

    Args:
        link: with boxes, cylinders, capsules or balls.
    """
    bounds = _bounds(link)
    if bounds is None:
        return None
    x, y, z = (high - low for low, high in zip(*bounds, strict=True))
    return x, y, z


def _listed(robot: Robot) -> str:
    return f"links: {', '.join(list(robot.link_by_name)[:8])}"


def _bounds(link: Link) -> tuple[Vector, Vector] | None:
    shapes = link.collisions or link.visuals
    boxes = [_box(shape.origin, shape.geometry) for shape in shapes]
    known = [box for box in boxes if box is not None]
    if not known or len(known) < len(boxes):
        return None
    lows, highs = zip(*known, strict=True)
    (ax, ay, az), (bx, by, bz) = (tuple(map(min, *lows, lows[0])), tuple(map(max, *highs, highs[0])))
    return (ax, ay, az), (bx, by, bz)


def _box(pose: Pose, geometry: Geometry | None) -> tuple[Vector, Vector] | None:
    """Return the least and greatest corner of a shape along the axes of its link."""
    half = _half(geometry)
    if half is None:
        return None
    reach = [sum(abs(entry) * size for entry, size in zip(row, half, strict=True)) for row in rotation(pose.rpy)]
    low = [at - by for at, by in zip(pose.xyz, reach, strict=True)]
    high = [at + by for at, by in zip(pose.xyz, reach, strict=True)]
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def _half(geometry: Geometry | None) -> Vector | None:
    match geometry:
        case Box(size=(x, y, z)):
            return x / 2, y / 2, z / 2
        case Cylinder(radius=radius, length=length):
            return radius, radius, length / 2
        case Capsule(radius=radius, length=length):
            return radius, radius, length / 2 + radius
        case Sphere(radius=radius):
            return radius, radius, radius
    return None


def rotation(rpy: Vector) -> tuple[Vector, Vector, Vector]:
    """Return the rows of the rotation matrix of fixed-axis roll, pitch and yaw [rad].

    Args:
        rpy: as in ``<origin>``.
    """
    (sr, cr), (sp, cp), (sy, cy) = (tuple(_sin_cos(angle)) for angle in rpy)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def _sin_cos(angle: float) -> Iterator[float]:
    yield math.sin(angle)
    yield math.cos(angle)
