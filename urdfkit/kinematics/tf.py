"""TransformTree: the transform from any frame to any other."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.kinematics.model import Kinematics
from urdfkit.kinematics.pinocchio_model import pin
from urdfkit.linear_algebra import Array


@dataclass(frozen=True, slots=True)
class Edge:
    """One transform of the tree, as tf has it.

    Attributes:
        parent: frame (link) name.
        child: frame (link) name.
        joint: the joint that connects them.
        type: the joint's type as written.
        is_static: whether it never changes (published once, on ``/tf_static``).
        mimics: the joint that leads this one, if it is a mimic joint.
    """

    parent: str
    child: str
    joint: str
    type: str
    is_static: bool
    mimics: str | None = None


@dataclass(frozen=True, slots=True)
class Transform:
    """Pose of one frame in another, in plain numbers (no negative zeros).

    Attributes:
        parent: the frame it is expressed in.
        child: the frame it places.
        translation: x y z [m].
        quaternion: x y z w, w not negative.
        rpy: fixed-axis roll, pitch, yaw [rad].
        matrix: the four rows of the homogeneous matrix.
    """

    parent: str
    child: str
    translation: list[float]
    quaternion: list[float]
    rpy: list[float]
    matrix: list[list[float]]


class TransformTree:
    """The frames of a robot and the transforms between them.

    Args:
        kinematics: the robot, or its `Kinematics` where one already exists.

    Attributes:
        kinematics: places the links.
        root: name of the root frame.
        frames: all frames in document order.
        edges: one per joint, parents before children, in document order.
        parents: frame → the frame above it; None above the root.

    Examples:
        >>> import urdfkit
        >>> from urdfkit.kinematics import TransformTree
        >>> tree = TransformTree(urdfkit.load("simpleton"))
        >>> tree.placement("left_wheel", "base_footprint", {"left_wheel_joint": 0.3}).translation  # [m]
        array([0.  , 0.21, 0.1 ])
        >>> tree.transform("base_footprint", "left_wheel", {"left_wheel_joint": 0.3}).rpy  # [rad]
        [0.0, 0.3, 0.0]
        >>> [pose.child for pose in tree.transforms(tree.kinematics.neutral()) if pose.translation[2] > 0.1]
        ['camera', 'camera_link_optical']
    """

    def __init__(self, kinematics: Kinematics | Robot) -> None:
        self.kinematics = kinematics if isinstance(kinematics, Kinematics) else Kinematics(kinematics)
        self.root = self.kinematics.root
        self.frames = self.kinematics.link_names
        self.edges = tuple(_edge(joint) for joint in tree_order(self.kinematics.robot))
        self.parents: dict[str, str | None] = {self.root: None}
        self.parents.update((edge.child, edge.parent) for edge in self.edges)

    def __repr__(self) -> str:
        """Return the name of the robot, the root and the number of frames."""
        return f"<TransformTree of {self.kinematics.robot.name}: {len(self.frames)} frames, root {self.root}>"

    def placement(
        self, frame: str, relative_to: str | None = None, q: Array | Mapping[str, float] | None = None
    ) -> Any:
        """Return the pose of `frame` in `relative_to`, as ``pin.SE3``.

        Args:
            frame: the frame to locate (tf's *child* or *source*).
            relative_to: the frame to express it in (tf's *parent* or *target*); the root when None.
            q: configuration, shape (nq,), or joint positions by name; all at zero when None.

        Raises:
            KinematicsError: an unknown frame or joint.
        """
        kinematics = self.kinematics
        here, there = kinematics.frame(frame), kinematics.frame(relative_to or self.root)
        if q is None or isinstance(q, Mapping):
            q = kinematics.configuration(q)
        placements = kinematics.placements(q)
        return placements[there].actInv(placements[here])

    def transform(self, parent: str | None, child: str, q: Array | Mapping[str, float] | None = None) -> Transform:
        """Return `placement` of `child` in `parent` in plain numbers.

        Raises:
            KinematicsError: an unknown frame or joint.
        """
        return _transform(parent or self.root, child, self.placement(child, parent, q))

    def transforms(self, q: Array) -> list[Transform]:
        """Return the transform of every frame in the root frame; shape of q (nq,)."""
        placements = self.kinematics.placements(q)
        here = placements[self.kinematics.frame(self.root)]
        return [
            _transform(self.root, frame, here.actInv(placements[self.kinematics.frame(frame)])) for frame in self.frames
        ]


def _transform(parent: str, child: str, placement: Any) -> Transform:
    quaternion = pin.SE3ToXYZQUAT(placement)[3:]
    return Transform(
        parent=parent,
        child=child,
        translation=_plain(placement.translation),
        quaternion=_plain(-quaternion if quaternion[3] < 0.0 else quaternion),
        rpy=_plain(pin.rpy.matrixToRpy(placement.rotation)),
        matrix=[_plain(row) for row in placement.homogeneous],
    )


def _plain(numbers: Any) -> list[float]:
    return [float(number) + 0.0 for number in numbers]


def _edge(joint: Joint) -> Edge:
    leader = joint.mimic.joint if joint.mimic is not None and joint.is_movable else None
    return Edge(joint.parent or "", joint.child or "", joint.name, joint.type or "", not joint.is_movable, leader)
