"""Link frames at zero joint positions, and the extent of the shapes of a link."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from math import hypot, sqrt

from urdfkit.description.urdf.geometry import (
    UNROTATED,
    Rotation,
    box_around,
    box_around_all,
    product,
    rotate,
    rotation_of,
    volume_of,
)
from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Geometry,
    Joint,
    Link,
    Mesh,
    Pose,
    Robot,
    Sphere,
    Vector,
    Visual,
)
from urdfkit.record import record


@record
class Frame:
    """Rotation and translation [m] of a frame in another one."""

    rotation: Rotation = UNROTATED
    translation: Vector = (0.0, 0.0, 0.0)

    def moved(self, pose: Pose) -> Frame:
        """Return the frame at a pose relative to this frame."""
        offset = rotate(self.rotation, pose.xyz)
        x, y, z = (a + b for a, b in zip(self.translation, offset, strict=True))
        return Frame(product(self.rotation, rotation_of(pose.rpy)), (x, y, z))


def frames(robot: Robot) -> dict[str, Frame]:
    """Return link name → its frame in the root link, every joint at zero."""
    found = {link.name: Frame() for link in robot.roots()}
    for joint in tree_order(robot):
        if joint.child is not None and joint.parent in found and joint.child not in found:
            found[joint.child] = found[joint.parent].moved(joint.origin)
    return found


def offset_of(joint: Joint) -> float:
    """Return the distance of a joint from the frame of its parent link [m]."""
    return hypot(*joint.origin.xyz)


def shapes_of(link: Link) -> tuple[Visual | Collision, ...]:
    """Return the visual shapes of a link, then its collision shapes."""
    return (*link.visuals, *link.collisions)


@record(eq=False)
class Extent:
    """Extent of the shapes of a link, in the link's frame.

    Attributes:
        low: lower corner of the bounding box of all shapes [m].
        high: upper corner [m].
        shapes: each shape with its pose; meshes are replaced by their bounding boxes.
        volumes: volume of all visual shapes and of all collision shapes [m³]; groups with a mesh are omitted.
    """

    low: Vector
    high: Vector
    shapes: tuple[tuple[Geometry, Pose], ...]
    volumes: tuple[float, ...]

    @cached_property
    def diagonal(self) -> float:
        """The length of the box's diagonal [m]."""
        (a, b, c), (x, y, z) = self.low, self.high
        return sqrt((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2)

    def corners_in(self, frame: Frame) -> list[Vector]:
        """Return the corners of the bounding box in another frame [m].

        Args:
            frame: the frame of the link there.
        """
        box = (self.low, self.high)
        parts = [(box[n & 1][0], box[n >> 1 & 1][1], box[n >> 2][2]) for n in range(8)]
        moved = [rotate(frame.rotation, part) for part in parts]
        x, y, z = frame.translation
        return [(x + a, y + b, z + c) for a, b, c in moved]

    def radius(self, point: Vector) -> float:
        """Return the distance from `point` to the farthest point of all shapes [m]."""
        return max(self.reaches(point))

    def reaches(self, point: Vector) -> list[float]:
        """Return the distance from `point` to the farthest point of each shape [m]."""
        return [_farthest(shape, pose, point) for shape, pose in self.shapes]

    def outside(self, point: Vector) -> float:
        """Return the distance of `point` from the bounding box [m]; 0 inside."""
        return sqrt(sum(max(a - x, 0.0, x - b) ** 2 for a, x, b in zip(self.low, point, self.high, strict=True)))


def extent(link: Link, box_of: Callable[[Mesh], tuple[Vector, Vector] | None]) -> Extent | None:
    """Return the extent of a link's shapes; None if it has no shapes or a shape of unknown size.

    Args:
        link: the link.
        box_of: returns centre and size of a mesh's bounding box, scale included; None if it cannot be read.
    """
    shapes: list[tuple[Geometry, Pose]] = []
    volumes: list[float] = []
    groups: tuple[tuple[Visual | Collision, ...], ...] = (link.visuals, link.collisions)
    for group in groups:
        volume: float | None = 0.0
        for item in group:
            geometry = item.geometry
            pose = item.origin
            if geometry is None or _is_impossible(geometry):
                return None
            if isinstance(geometry, Mesh):
                box = box_of(geometry)
                if box is None:
                    return None
                frame = Frame().moved(pose).moved(Pose(box[0]))
                geometry, pose, volume = Box(box[1]), Pose(frame.translation, pose.rpy), None
            shapes.append((geometry, pose))
            volume = None if volume is None else volume + volume_of(geometry)
        if group and volume:
            volumes.append(volume)
    if not shapes:
        return None
    if len(shapes) == 1 or all(other == shapes[0] for other in shapes):
        low, high = box_around(*shapes[0])
    else:
        low, high = box_around_all([box_around(geometry, pose) for geometry, pose in shapes])
    return Extent(low, high, tuple(shapes), tuple(volumes))


def extent_of_primitives(link: Link) -> Extent | None:
    """Return the extent of a link's shapes; None if it has no shapes, a mesh or a shape of unknown size."""
    return extent(link, lambda mesh: None)


def extent_with_boxes(link_and_boxes: tuple[Link, tuple[tuple[Vector, Vector] | None, ...]]) -> Extent | None:
    """Return the extent of a link's shapes as `extent` does.

    Args:
        link_and_boxes: the link, and centre and size of the boxes of `meshes_in`, scale included.
    """
    link, boxes = link_and_boxes
    following = iter(boxes)
    return extent(link, lambda mesh: next(following))


def meshes_in(link: Link) -> list[Mesh]:
    """Return the meshes among the shapes of a link."""
    return [shape.geometry for shape in shapes_of(link) if isinstance(shape.geometry, Mesh)]


def solid(link: Link, extents: Mapping[str, Extent]) -> tuple[Extent | None, bool]:
    """Return the extent of a link, and whether it contains the visual shapes.

    If a mesh among them cannot be read, the extent is that of the collision shapes; None if they have a mesh too.

    Args:
        link: the link.
        extents: the known extents of all shapes of the links.
    """
    found = extents.get(link.name)
    shapes = [shape.geometry for shape in link.collisions]
    is_hidden = any(isinstance(shape.geometry, Mesh) for shape in link.visuals)
    if found is not None or not is_hidden or not shapes or any(isinstance(shape, Mesh) for shape in shapes):
        return found, bool(link.visuals)
    return extent_of_primitives(Link(link.name, link.inertial, (), link.collisions, link.element)), False


def _is_impossible(shape: Geometry) -> bool:
    """Return whether a primitive has a negative size."""
    if isinstance(shape, Box):
        return min(shape.size) < 0.0
    if isinstance(shape, (Cylinder, Capsule)):
        return min(shape.radius, shape.length) < 0.0
    return isinstance(shape, Sphere) and shape.radius < 0.0


def _farthest(shape: Geometry, pose: Pose, point: Vector) -> float:
    rows = rotation_of(pose.rpy)
    offset = (point[0] - pose.xyz[0], point[1] - pose.xyz[1], point[2] - pose.xyz[2])
    x, y, z = offset
    if rows is not UNROTATED:
        x, y, z = (sum(rows[i][k] * offset[i] for i in range(3)) for k in range(3))
    if isinstance(shape, Box):
        return sqrt(sum((abs(a) + abs(size) / 2.0) ** 2 for a, size in zip((x, y, z), shape.size, strict=True)))
    if isinstance(shape, Cylinder):
        return hypot(hypot(x, y) + shape.radius, abs(z) + shape.length / 2.0)
    if isinstance(shape, Capsule):
        return hypot(hypot(x, y), abs(z) + shape.length / 2.0) + shape.radius
    return hypot(hypot(x, y), z) + (shape.radius if isinstance(shape, Sphere) else 0.0)


def links_below(robot: Robot, name: str) -> set[str]:
    """Return the names of a link and of all links that its joints carry."""
    found = {name}
    pending = [name]
    while pending:
        for joint in robot.children_of.get(pending.pop(), ()):
            if joint.child is not None and joint.child not in found:
                found.add(joint.child)
                pending.append(joint.child)
    return found
