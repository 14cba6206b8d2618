"""Motion of a robot in a recording."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.app.replay.recorded_frames import RecordedFrames
from urdfkit.app.replay.timeline import PoseTimeline, Timeline
from urdfkit.bridges.bag_file import BagFile
from urdfkit.errors import UsageError
from urdfkit.kinematics import Kinematics
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim.state.quaternion import from_matrix

Array = NDArray[np.float64]
JOINT_STATE, ODOMETRY = "sensor_msgs/msg/JointState", "nav_msgs/msg/Odometry"
TRANSFORMS = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")
FIXED_FRAMES = ("world", "map", "odom")
"""Fixed frames in the order of preference, as REP 105 names them."""


class RecordedRobot:
    """A robot that moves as in a recording.

    Args:
        bag: the recording; its transforms, joint states and odometry are read here.
        kinematics: the robot.
        fixed_frame: frame in which poses are given; None for the one of `FIXED_FRAMES` or the root of the transforms.
        progress: called with the read part of the recording, 0 to 1.

    Raises:
        UsageError: the recording has transforms, and none of the fixed frame.

    Attributes:
        frames: the transforms.
        fixed_frame: the frame in which poses are given.
    """

    def __init__(
        self,
        bag: BagFile,
        kinematics: Kinematics,
        *,
        fixed_frame: str | None = None,
        progress: Callable[[float], None] = lambda _: None,
    ) -> None:
        self._kinematics = kinematics
        self.frames = RecordedFrames()
        self._joints: dict[str, Timeline] = {}
        self._odometry: PoseTimeline | None = None
        self._read(bag, progress)
        self._prefix = self.frames.prefix(kinematics.root)
        valid = len(self.frames) == 0 or fixed_frame in (None, self._fixed_frame()) or fixed_frame in self.frames
        if not valid:
            raise UsageError(f"--fixed-frame: no frame `{fixed_frame}` in the recording")
        self.fixed_frame = fixed_frame or self._fixed_frame()

    def _read(self, bag: BagFile, progress: Callable[[float], None]) -> None:
        names = {each.name for each in bag.topics if each.type in (JOINT_STATE, ODOMETRY, *TRANSFORMS)}
        joints = set(self._kinematics.variable_names)
        for k, recorded in enumerate(bag.messages(topics=names)):
            if k % 1000 == 0 and bag.end > bag.begin:
                progress((recorded.time - bag.begin) / (bag.end - bag.begin))
            message, time = bag.message(recorded), recorded.time
            if recorded.topic.type in TRANSFORMS:
                self.frames.add(time, message, static=recorded.topic.name.endswith("static"))
            elif recorded.topic.type == JOINT_STATE:
                for name, position in zip(message.name, message.position, strict=False):
                    if name in joints:
                        self._joints.setdefault(name, Timeline()).add(time, (float(position),))
            else:
                if self._odometry is None:
                    self._odometry = PoseTimeline()
                at, turned = message.pose.pose.position, message.pose.pose.orientation
                self._odometry.add(time, (at.x, at.y, at.z, turned.x, turned.y, turned.z, turned.w))

    def _fixed_frame(self) -> str:
        above = self.frames.ancestors(self._prefix + self._kinematics.root)
        return next((name for name in FIXED_FRAMES if name in above), above[-1])

    def positions(self, time: float) -> dict[str, float]:
        """Return the recorded joint positions at a time [rad or m]."""
        return {name: float(line.at(time)[0]) for name, line in self._joints.items()}

    def link_poses(self, time: float) -> Array:
        """Return the poses of all links in the fixed frame; shape (links, 7), in the order of `link_names`.

        A link without recorded transforms keeps its pose relative to its parent by the joint positions.
        """
        kinematics = self._kinematics
        relative = pose_matrices(kinematics.link_poses(kinematics.configuration(self.positions(time))))
        index = {name: k for k, name in enumerate(kinematics.link_names)}
        parents = {str(joint.child): str(joint.parent) for joint in kinematics.robot.joints}
        placed: dict[str, Array] = {}

        def place(name: str) -> Array:
            if name not in placed:
                frame = self._prefix + name
                found = self.frames.transform(self.fixed_frame, frame, time) if frame in self.frames else None
                if found is None and (parent := parents.get(name)) is not None:
                    between = np.linalg.inv(relative[index[parent]]) @ relative[index[name]]
                    found = place(parent) @ between
                placed[name] = self._root(time) @ relative[index[name]] if found is None else found
            return placed[name]

        poses = np.empty((len(index), 7))
        for name, k in index.items():
            matrix = place(name)
            poses[k, :3], poses[k, 3:] = matrix[:3, 3], from_matrix(matrix[:3, :3])
        return poses

    def _root(self, time: float) -> Array:
        """Return the pose of the root link by the odometry; shape (4, 4)."""
        return np.eye(4) if self._odometry is None else pose_matrices(self._odometry.at(time))[0]

    def frame_pose(self, frame: str, time: float) -> Array:
        """Return the pose of a sensor's frame in the fixed frame, shape (4, 4); the origin for an unknown frame."""
        name = frame.lstrip("/")
        found = self.frames.transform(self.fixed_frame, name, time) if name in self.frames else None
        link = name.removeprefix(self._prefix)
        if found is None and link in self._kinematics.link_names:
            return np.asarray(pose_matrices(self.link_poses(time))[self._kinematics.link_names.index(link)])
        return np.eye(4) if found is None else found


def recorded_description(bag: BagFile) -> Any:
    """Return the last robot description of a recording as a text; None without one."""
    names = {each.name for each in bag.topics if each.name.endswith("robot_description")}
    texts = [bag.message(each) for each in bag.messages(topics=names)] if names else []
    return next((text.data for text in reversed(texts) if getattr(text, "data", "")), None)
