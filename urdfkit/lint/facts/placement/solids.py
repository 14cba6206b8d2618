"""Boxes, cylinders and spheres as solids: depths of points in them, and the solids of the moving bodies of a robot."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from math import sqrt

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.geometry import rotate
from urdfkit.description.urdf.robot import Box, Cylinder, Geometry, Joint, Link, Pose, Sphere, Vector
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Frame
from urdfkit.record import record


def diagonal(shape: Geometry) -> float:
    """Return the diagonal of the box around a shape [m]."""
    half = half_sizes(shape)
    return 2.0 * sqrt(sum(part * part for part in half))


def half_sizes(shape: Geometry) -> Vector:
    """Return half the sizes of the box around a shape, in its own frame [m]."""
    if isinstance(shape, Box):
        x, y, z = shape.size
        return x / 2.0, y / 2.0, z / 2.0
    if isinstance(shape, Cylinder):
        return shape.radius, shape.radius, shape.length / 2.0
    radius = shape.radius if isinstance(shape, Sphere) else 0.0
    return radius, radius, radius


def local(at: Frame, point: Vector) -> Vector:
    """Return a point of the root link in another frame [m]."""
    (x, y, z), (a, b, c) = point, at.translation
    return turned_back(at, (x - a, y - b, z - c))


def turned_back(at: Frame, vector: Vector) -> Vector:
    """Return a vector of the root link along the axes of another frame."""
    (a, b, c), (d, e, f), (g, h, i) = at.rotation
    x, y, z = vector
    return a * x + d * y + g * z, b * x + e * y + h * z, c * x + f * y + i * z


def depth(shape: Geometry, point: Vector) -> float:
    """Return the depth of a point below the surface of a shape [m]; negative outside."""
    x, y, z = point
    if isinstance(shape, Sphere):
        return shape.radius - sqrt(x * x + y * y + z * z)
    if isinstance(shape, Cylinder):
        return min(shape.radius - sqrt(x * x + y * y), shape.length / 2.0 - abs(z))
    return min(half - abs(part) for half, part in zip(half_sizes(shape), point, strict=True))


@record(eq=False)
class Solid:
    """A box, cylinder or sphere of a link.

    Attributes:
        link: the link.
        shape: its shape.
        pose: pose of the shape in the link.
        at: frame of the shape in the root link.
    """

    link: Link
    shape: Geometry
    pose: Pose
    at: Frame

    def depth(self, point: Vector) -> float:
        """Return the depth of a point of the root link below the surface [m]; negative outside."""
        return depth(self.shape, local(self.at, point))

    @cached_property
    def thickness(self) -> float:
        """Half the smallest size [m]."""
        return min(half_sizes(self.shape))

    def points(self, steps: tuple[float, ...]) -> Iterator[Vector]:
        """Yield points of the box around the shape in the root link: all combinations of some parts of its half sizes.

        Args:
            steps: -1 and 1 are the sides, 0 is the centre.
        """
        a, b, c = half_sizes(self.shape)
        for i in steps:
            for j in steps:
                for k in steps:
                    offset = rotate(self.at.rotation, (i * a, j * b, k * c))
                    x, y, z = (p + q for p, q in zip(self.at.translation, offset, strict=True))
                    yield x, y, z


class MovingBodies:
    """The bodies of a robot that joints move against each other, with their solids.

    Args:
        model: the robot. Its links have collision shapes, or visual shapes if they have no others.
    """

    def __init__(self, model: Model) -> None:
        self._model = model
        self._body_of = AttachedBodies(model.robot).body_of
        self.links: dict[str, list[Link]] = {}
        for link in model.robot.links:
            self.links.setdefault(self._body_of(link.name), []).append(link)
        self.carriers: dict[str, tuple[str, Joint]] = {}
        """Body → the body that carries it, and the joint between them."""
        for joint in model.robot.joints:
            if joint.type != "fixed" and joint.parent and joint.child:
                self.carriers.setdefault(self._body_of(joint.child), (self._body_of(joint.parent), joint))

    @cached_property
    def solids(self) -> dict[str, list[Solid]]:
        """Body → its solids."""
        return {
            body: [
                Solid(link, shape.geometry, shape.origin, frame.moved(shape.origin))
                for link in links
                if (frame := self._model.frames.get(link.name)) is not None
                for shape in (link.collisions or link.visuals)
                if isinstance(shape.geometry, (Box, Cylinder, Sphere))
            ]
            for body, links in self.links.items()
        }

    def above(self, body: str) -> Iterator[tuple[str, Joint]]:
        """Yield the bodies that carry a body, nearest first, each with the joint below it; stops at loops."""
        seen = {body}
        while body in self.carriers:
            body, joint = self.carriers[body]
            if body in seen:
                return
            seen.add(body)
            yield body, joint

    def below(self, body: str) -> list[str]:
        """Return a body and all bodies that it carries."""
        found = [body]
        for one in found:  # The list grows during the iteration.
            found += [name for name, (carrier, _) in self.carriers.items() if carrier == one and name not in found]
        return found


def moving_bodies(model: Model, most: int) -> MovingBodies | None:
    """Return the moving bodies of a robot; None if it has more than `most` moving joints."""
    count = sum(joint.type != "fixed" for joint in model.robot.joints)
    return MovingBodies(model) if count <= most else None
