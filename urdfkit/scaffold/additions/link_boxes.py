"""What is where on a robot: boxes along the axes of a frame, one around each shape of each link."""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt

from urdfkit.description.sdf.poses import Rotation, between, compose, rotation_of
from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Link, Mesh, Pose, Robot, Sphere, Vector
from urdfkit.errors import MissingDependencyError, ResourceError

Bounds = tuple[Vector, Vector]
"""The least and the greatest corner of a box [m]."""

_HERE = Pose()
_CHIP = Box((0.02, 0.02, 0.02))
"""What a link that weighs something and has no shape is taken for: an inertial unit inside of another [m]."""


class Boxes:
    """The boxes around the shapes of a robot whose joints are at zero.

    Args:
        robot: as loaded; its meshes are read when they are asked for.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._poses = {root.name: Pose() for root in robot.roots()}
        for joint in tree_order(robot):
            if joint.parent in self._poses and joint.child is not None:
                self._poses[joint.child] = compose(self._poses[joint.parent], joint.origin)
        self._meshes: dict[Mesh, Bounds | None] = {}

    def of(self, link: Link, at: Pose = _HERE) -> list[Bounds] | None:
        """Return the boxes around what a link collides with, or looks like where that is nothing.

        Args:
            link: of the robot.
            at: the link's frame in the frame whose axes the boxes are along.

        Returns:
            None where one of them is a mesh that cannot be read.
        """
        found = [self._around(item.geometry, compose(at, item.origin)) for item in link.collisions or link.visuals]
        known = [box for box in found if box is not None]
        return known if len(known) == len(found) else None

    def seen_from(self, link: Link, at: Pose = _HERE) -> Iterator[tuple[str, Bounds]]:
        """Yield the boxes of every link that is joined to this one, with its name, in this one's frame.

        Args:
            link: of the robot.
            at: this link's frame in the frame whose axes the boxes are along.
        """
        for other in self._robot.links:
            if other.name not in self._poses or link.name not in self._poses:
                continue
            placed = compose(at, between(self._poses[link.name], self._poses[other.name]))
            boxes = self.of(other, placed)
            if boxes == [] and other.inertial is not None and (chip := around(_CHIP, placed)) is not None:
                boxes = [chip]
            yield from ((other.name, box) for box in boxes or [])

    def _around(self, geometry: Geometry | None, pose: Pose) -> Bounds | None:
        if not isinstance(geometry, Mesh):
            return around(geometry, pose)
        if geometry not in self._meshes:
            self._meshes[geometry] = self._read(geometry)
        box = self._meshes[geometry]
        if box is None:
            return None
        (a, b, c), (d, e, f) = box
        middle = compose(pose, Pose(((a + d) / 2, (b + e) / 2, (c + f) / 2)))
        return around(Box((d - a, e - b, f - c)), middle)

    def _read(self, mesh: Mesh) -> Bounds | None:
        """Return the box of a mesh in its own frame; None where it cannot be read."""
        from urdfkit.scene.meshes.loader import MeshLoader

        entry = self._robot.files[0] if self._robot.files else None
        if entry is None or self._robot.packages is None:
            return None
        try:
            low, high = MeshLoader().load(self._robot.packages.resolve(mesh.uri, entry), mesh.scale).bounds.tolist()
        except (ResourceError, MissingDependencyError):
            return None
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def around(geometry: Geometry | None, pose: Pose) -> Bounds | None:
    """Return the box around a solid; None for a mesh, or for nothing.

    Args:
        geometry: the solid.
        pose: in the frame whose axes the box is along.
    """
    turn = rotation_of(pose)
    match geometry:
        case Box(size=size):
            reach = [sum(abs(entry) * side / 2 for entry, side in zip(row, size, strict=True)) for row in turn]
        case Cylinder(radius=radius, length=length):
            reach = [_lengthwise(turn, k) * length / 2 + _crosswise(turn, k) * radius for k in range(3)]
        case Capsule(radius=radius, length=length):
            reach = [_lengthwise(turn, k) * length / 2 + radius for k in range(3)]
        case Sphere(radius=radius):
            reach = [radius] * 3
        case _:
            return None
    x, y, z = pose.xyz
    a, b, c = reach
    return (x - a, y - b, z - c), (x + a, y + b, z + c)


def whole(boxes: list[Bounds]) -> Bounds:
    """Return the box around boxes.

    Args:
        boxes: one at least.
    """
    (a, b, c), (d, e, f) = boxes[0]
    for low, high in boxes[1:]:
        a, b, c = min(a, low[0]), min(b, low[1]), min(c, low[2])
        d, e, f = max(d, high[0]), max(e, high[1]), max(f, high[2])
    return (a, b, c), (d, e, f)


def moved(box: Bounds, by: Vector) -> Bounds:
    """Return a box somewhere else.

    Args:
        box: where it was.
        by: how far [m].
    """
    (a, b, c), (d, e, f) = box
    return (a + by[0], b + by[1], c + by[2]), (d + by[0], e + by[1], f + by[2])


def gap(one: Bounds, other: Bounds) -> float:
    """Return how far two boxes are apart along the axis where that is most [m]; less than zero where they overlap.

    Args:
        one: a box.
        other: a box.
    """
    return max(max(one[0][k] - other[1][k], other[0][k] - one[1][k]) for k in range(3))


def _lengthwise(turn: Rotation, axis: int) -> float:
    return abs(turn[axis][2])


def _crosswise(turn: Rotation, axis: int) -> float:
    return sqrt(max(0.0, 1.0 - turn[axis][2] ** 2))
