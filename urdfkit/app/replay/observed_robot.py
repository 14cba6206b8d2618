"""Motion of a robot by its messages, of a recording or of a live robot."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.app.replay.recorded_frames import RecordedFrames
from urdfkit.app.replay.recorded_values import PoseTimeline, Timeline
from urdfkit.kinematics import Kinematics
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim.state.quaternion import from_matrix

Array = NDArray[np.float64]
JOINT_STATE, ODOMETRY = "sensor_msgs/msg/JointState", "nav_msgs/msg/Odometry"
TRANSFORMS = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")
MOTION = (JOINT_STATE, ODOMETRY, *TRANSFORMS)
"""Types of the messages that move a robot."""
FIXED_FRAMES = ("world", "map", "odom")
"""Fixed frames in the order of preference, as REP 105 names them."""


class ObservedRobot:
    """A robot whose transforms, joint states and odometry are received.

    Args:
        kinematics: the robot.
        fixed_frame: frame in which poses are given; None for the one of `FIXED_FRAMES` or the root of the transforms.
        length: number of values of each frame and joint that are kept; None for all.

    Attributes:
        frames: the transforms.
    """

    def __init__(self, kinematics: Kinematics, *, fixed_frame: str | None = None, length: int | None = None) -> None:
        self._kinematics, self._requested, self._length = kinematics, fixed_frame, length
        self.frames = RecordedFrames(length)
        self._joints: dict[str, Timeline] = {}
        self._names = set(kinematics.variable_names)
        self._odometry: PoseTimeline | None = None
        self._tree = (0, "", "")

    def add(self, topic: str, type: str, message: Any, time: float) -> None:
        """Add a message of one of the types `MOTION`, received at a time [s]."""
        if type in TRANSFORMS:
            self.frames.add(time, message, static=topic.endswith("static"))
        elif type == JOINT_STATE:
            for name, position in zip(message.name, message.position, strict=False):
                if name in self._names:
                    self._joints.setdefault(name, Timeline(self._length)).add(time, (float(position),))
        else:
            if self._odometry is None:
                self._odometry = PoseTimeline(self._length)
            at, turned = message.pose.pose.position, message.pose.pose.orientation
            self._odometry.add(time, (at.x, at.y, at.z, turned.x, turned.y, turned.z, turned.w))

    @property
    def fixed_frame(self) -> str:
        """The frame in which poses are given."""
        return self._found()[0]

    @property
    def _prefix(self) -> str:
        return self._found()[1]

    def _found(self) -> tuple[str, str]:
        """Return the fixed frame and the prefix of frames, found again when frames were added."""
        count = len(self.frames)
        if self._tree[0] != count or not count:
            prefix = self.frames.prefix(self._kinematics.root)
            above = self.frames.ancestors(prefix + self._kinematics.root)
            fixed = self._requested or next((name for name in FIXED_FRAMES if name in above), above[-1])
            self._tree = count, fixed, prefix
        return self._tree[1:]

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

    def frame_pose(self, frame: str, time: float) -> Array | None:
        """Return the pose of a frame in the fixed frame, shape (4, 4); None for an unknown frame."""
        name = frame.lstrip("/")
        if name in ("", self.fixed_frame):
            return np.eye(4)
        found = self.frames.transform(self.fixed_frame, name, time) if name in self.frames else None
        link = name.removeprefix(self._prefix)
        if found is None and link in self._kinematics.link_names:
            return np.asarray(pose_matrices(self.link_poses(time))[self._kinematics.link_names.index(link)])
        return found
