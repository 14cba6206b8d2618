"""What is where on a robot: boxes along the axes of a frame, one around each shape of each link."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.urdf.geometry import Bounds, between, box_around, compose, link_poses
from urdfkit.description.urdf.robot import Box, Geometry, Link, Mesh, Pose, Robot, Vector
from urdfkit.errors import MissingDependencyError, ResourceError

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
        self._poses = link_poses(robot)
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
            if boxes == [] and other.inertial is not None:
                boxes = [box_around(_CHIP, placed)]
            yield from ((other.name, box) for box in boxes or [])

    def _around(self, geometry: Geometry | None, pose: Pose) -> Bounds | None:
        if geometry is None:
            return None
        if not isinstance(geometry, Mesh):
            return box_around(geometry, pose)
        if geometry not in self._meshes:
            self._meshes[geometry] = self._read(geometry)
        box = self._meshes[geometry]
        if box is None:
            return None
        (a, b, c), (d, e, f) = box
        middle = compose(pose, Pose(((a + d) / 2, (b + e) / 2, (c + f) / 2)))
        return box_around(Box((d - a, e - b, f - c)), middle)

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
