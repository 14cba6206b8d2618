"""TransformTree: where one frame is in another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from urdfkit.description.robot import Joint, Robot
from urdfkit.kinematics.build import pin
from urdfkit.kinematics.model import Array, Kinematics


@dataclass(frozen=True, slots=True)
class Edge:
    """One transform of the tree, as tf has it.

    Attributes:
        parent: frame (link) name.
        child: frame (link) name.
        joint: the joint that connects them.
        type: the joint's type as written.
        is_static: whether it never changes (published once, on ``/tf_static``).
    """

    parent: str
    child: str
    joint: str
    type: str
    is_static: bool


class TransformTree:
    """The frames of a robot and the transforms between them.

    Args:
        kinematics: the robot, or its `Kinematics` where one exists already.

    Attributes:
        kinematics: places the links.
        root: name of the root frame.
        frames: all frames in document order.
        edges: one per joint, parents before children, in document order.
        parents: frame → the frame above it; None above the root.
    """

    def __init__(self, kinematics: Kinematics | Robot) -> None:
        self.kinematics = kinematics if isinstance(kinematics, Kinematics) else Kinematics(kinematics)
        self.root = self.kinematics.root
        self.frames = self.kinematics.link_names
        self.edges = tuple(_edge(joint) for joint in self.kinematics.robot.tree_order())
        self.parents: dict[str, str | None] = {self.root: None}
        self.parents.update((edge.child, edge.parent) for edge in self.edges)

    def placement(
        self, frame: str, relative_to: str | None = None, q: Array | Mapping[str, float] | None = None
    ) -> Any:
        """Return where `frame` is in `relative_to`, as ``pin.SE3``.

        Args:
            frame: the frame looked for (tf's *child* or *source*).
            relative_to: the frame to express it in (tf's *parent* or *target*); the root when None.
            q: configuration, shape (nq,), or joint positions by name; all at zero when None.

        Raises:
            KinematicsError: an unknown frame or joint.
        """
        kinematics = self.kinematics
        here, there = kinematics.frame(frame), kinematics.frame(relative_to or self.root)
        if q is None or isinstance(q, Mapping):
            q = kinematics.configuration(q)
        pin.framesForwardKinematics(kinematics.model, kinematics.data, q)
        return kinematics.data.oMf[there].actInv(kinematics.data.oMf[here])


def _edge(joint: Joint) -> Edge:
    return Edge(joint.parent or "", joint.child or "", joint.name, joint.type or "", not joint.is_movable)
