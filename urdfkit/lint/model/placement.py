"""Poses of links and shapes without numpy: rotations, link frames at zero joint positions, bounding boxes."""

from __future__ import annotations

from math import cos, hypot, pi, sin, sqrt

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.description.urdf.robot import Collision, Geometry, Link, Pose, Robot, Vector, Visual

Matrix = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def rotation(rpy: Vector) -> Matrix:
    """Return Rz(yaw) · Ry(pitch) · Rx(roll) for fixed-axis angles [rad]."""
    if rpy == (0.0, 0.0, 0.0):
        return IDENTITY
    (sr, sp, sy), (cr, cp, cy) = map(sin, rpy), map(cos, rpy)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def rotated(matrix: Matrix, vector: Vector) -> Vector:
    """Return matrix · vector."""
    x, y, z = (row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2] for row in matrix)
    return x, y, z


def product(first: Matrix, second: Matrix) -> Matrix:
    """Return first · second."""
    columns = [rotated(first, (second[0][k], second[1][k], second[2][k])) for k in range(3)]
    a, b, c = ((columns[0][i], columns[1][i], columns[2][i]) for i in range(3))
    return a, b, c


def unit(vector: Vector) -> Vector | None:
    """Return the vector with length 1, None where it has none."""
    length = sqrt(sum(value * value for value in vector))
    return (vector[0] / length, vector[1] / length, vector[2] / length) if length > 1e-12 else None


@record
class Frame:
    """Rotation and translation [m] of a frame in another one."""

    rotation: Matrix = IDENTITY
    translation: Vector = (0.0, 0.0, 0.0)

    def moved(self, pose: Pose) -> Frame:
        """Return the frame at a pose that is given in this one."""
        offset = rotated(self.rotation, pose.xyz)
        x, y, z = (a + b for a, b in zip(self.translation, offset, strict=True))
        return Frame(product(self.rotation, rotation(pose.rpy)), (x, y, z))


def frames(robot: Robot) -> dict[str, Frame]:
    """Return link name → its frame in the root link, every joint at zero."""
    found = {link.name: Frame() for link in robot.roots()}
    for joint in tree_order(robot):
        if joint.child is not None and joint.parent in found and joint.child not in found:
            found[joint.child] = found[joint.parent].moved(joint.origin)
    return found


def shapes_of(link: Link) -> tuple[Visual | Collision, ...]:
    """Return the visual shapes of a link, then its collision shapes."""
    return (*link.visuals, *link.collisions)


@record
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

    @property
    def diagonal(self) -> float:
        """The length of the box's diagonal [m]."""
        return sqrt(sum((high - low) ** 2 for low, high in zip(self.low, self.high, strict=True)))

    def radius(self, point: Vector) -> float:
        """Return how far the farthest point of a shape is from `point` [m]."""
        return max(self.reaches(point))

    def reaches(self, point: Vector) -> list[float]:
        """Return how far the farthest point of each shape is from `point` [m]."""
        return [_farthest(shape, pose, point) for shape, pose in self.shapes]

    def outside(self, point: Vector) -> float:
        """Return how far `point` is outside of the box [m]; 0 inside."""
        return sqrt(sum(max(a - x, 0.0, x - b) ** 2 for a, x, b in zip(self.low, point, self.high, strict=True)))


def extent(link: Link, box_of: Callable[[Mesh], tuple[Vector, Vector] | None]) -> Extent | None:
    """Return the extent of a link's shapes; None if it has no shapes or a shape of unknown size.

    Args:
        link: the link.
        box_of: returns centre and size of a mesh's bounding box, scale included; None if it cannot be read.
    """
    shapes: list[tuple[Geometry, Pose]] = []
    volumes: list[float] = []
    from urdfkit.description.urdf.robot import Pose

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
        return Extent(low, high, tuple(shapes), tuple(volumes))
    corners = [box_around(geometry, pose) for geometry, pose in shapes]
    a, b, c = (min(corner[0][i] for corner in corners) for i in range(3))
    d, e, f = (max(corner[1][i] for corner in corners) for i in range(3))
    return Extent((a, b, c), (d, e, f), tuple(shapes), tuple(volumes))


def _is_impossible(shape: Geometry) -> bool:
    """Return whether a primitive has a negative size."""
    if isinstance(shape, Box):
        return min(shape.size) < 0.0
    if isinstance(shape, (Cylinder, Capsule)):
        return min(shape.radius, shape.length) < 0.0
    return isinstance(shape, Sphere) and shape.radius < 0.0


def volume_of(shape: Geometry) -> float:
    """Return the volume of a shape [m³]; 0 for a mesh."""
    if isinstance(shape, Box):
        return abs(shape.size[0] * shape.size[1] * shape.size[2])
    if isinstance(shape, Sphere):
        return 4.0 / 3.0 * pi * shape.radius**3
    if isinstance(shape, Cylinder):
        return pi * shape.radius**2 * shape.length
    if isinstance(shape, Capsule):
        return pi * shape.radius**2 * (shape.length + 4.0 / 3.0 * shape.radius)
    return 0.0


def box_around(shape: Geometry, pose: Pose) -> tuple[Vector, Vector]:
    """Return the lowest and highest corner of the box along the axes around a shape at a pose [m]."""
    rows = rotation(pose.rpy)
    half: list[float] = []
    if rows is IDENTITY and isinstance(shape, Box):
        half = [abs(size) / 2.0 for size in shape.size]
        rows = ()  # type: ignore[assignment]
    for row in rows:
        if isinstance(shape, Box):
            half.append(sum(abs(a * size) / 2.0 for a, size in zip(row, shape.size, strict=True)))
        elif isinstance(shape, Cylinder):
            half.append(abs(row[2]) * shape.length / 2.0 + shape.radius * sqrt(max(0.0, 1.0 - row[2] ** 2)))
        elif isinstance(shape, Capsule):
            half.append(abs(row[2]) * shape.length / 2.0 + shape.radius)
        else:
            half.append(shape.radius if isinstance(shape, Sphere) else 0.0)
    x, y, z = pose.xyz
    return (x - half[0], y - half[1], z - half[2]), (x + half[0], y + half[1], z + half[2])


def _farthest(shape: Geometry, pose: Pose, point: Vector) -> float:
    rows = rotation(pose.rpy)
    offset = (point[0] - pose.xyz[0], point[1] - pose.xyz[1], point[2] - pose.xyz[2])
    x, y, z = offset
    if rows is not IDENTITY:
        x, y, z = (sum(rows[i][k] * offset[i] for i in range(3)) for k in range(3))
    if isinstance(shape, Box):
        return sqrt(sum((abs(a) + abs(size) / 2.0) ** 2 for a, size in zip((x, y, z), shape.size, strict=True)))
    if isinstance(shape, Cylinder):
        return hypot(hypot(x, y) + shape.radius, abs(z) + shape.length / 2.0)
    if isinstance(shape, Capsule):
        return hypot(hypot(x, y), abs(z) + shape.length / 2.0) + shape.radius
    return hypot(hypot(x, y), z) + (shape.radius if isinstance(shape, Sphere) else 0.0)
