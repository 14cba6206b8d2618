"""Axis-aligned bounding boxes of a robot's shapes, in the frame of one link."""

from collections.abc import Iterator

from urdfkit.description.urdf.geometry import Bounds, between, box_around, compose, link_poses
from urdfkit.description.urdf.robot import Box, Geometry, Link, Mesh, Pose, Robot, Vector
from urdfkit.errors import MissingDependencyError, ResourceError

_IDENTITY = Pose()
_SMALL_PART = Box((0.02, 0.02, 0.02))
"""Assumed shape of a link with a mass and without shapes, such as an inertial unit inside another link [m]."""


class Boxes:
    """Bounding boxes of the shapes of a robot in the zero position.

    Args:
        robot: the loaded robot; its meshes are read on demand.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._poses = link_poses(robot)
        self._meshes: dict[Mesh, Bounds | None] = {}

    def of(self, link: Link, at: Pose = _IDENTITY) -> list[Bounds] | None:
        """Return the boxes around a link's collision shapes, or around its visuals if it has none.

        Args:
            link: a link of the robot.
            at: pose of the link in the frame of the boxes.

        Returns:
            None if a mesh cannot be read.
        """
        boxes = [self._around(item.geometry, compose(at, item.origin)) for item in link.collisions or link.visuals]
        readable = [box for box in boxes if box is not None]
        return readable if len(readable) == len(boxes) else None

    def seen_from(self, link: Link, at: Pose = _IDENTITY) -> Iterator[tuple[str, Bounds]]:
        """Yield the name and the boxes of every link that is connected to this one, in this link's frame.

        Args:
            link: a link of the robot.
            at: pose of this link in the frame of the boxes.
        """
        for other in self._robot.links:
            if other.name not in self._poses or link.name not in self._poses:
                continue
            placed = compose(at, between(self._poses[link.name], self._poses[other.name]))
            boxes = self.of(other, placed)
            if boxes == [] and other.inertial is not None:
                boxes = [box_around(_SMALL_PART, placed)]
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
        """Return the bounding box of a mesh in its own frame; None if it cannot be read."""
        from urdfkit.meshes.loader import MeshLoader

        entry = self._robot.files[0] if self._robot.files else None
        if entry is None or self._robot.packages is None:
            return None
        try:
            low, high = MeshLoader().load(self._robot.packages.resolve(mesh.uri, entry), mesh.scale).bounds.tolist()
        except (ResourceError, MissingDependencyError):
            return None
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def moved(box: Bounds, by: Vector) -> Bounds:
    """Return a box after a translation.

    Args:
        box: the box.
        by: the translation [m].
    """
    (a, b, c), (d, e, f) = box
    return (a + by[0], b + by[1], c + by[2]), (d + by[0], e + by[1], f + by[2])


def gap(one: Bounds, other: Bounds) -> float:
    """Return the largest distance of two boxes along an axis [m]; negative if they overlap.

    Args:
        one: a box.
        other: a box.
    """
    return max(max(one[0][k] - other[1][k], other[0][k] - one[1][k]) for k in range(3))
