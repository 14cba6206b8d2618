"""Ground-truth pose: gazebo_ros_p3d of ROS 1 and ROS 2, which publishes Odometry.

Pose and twist are relative to ``frameName``, the world or another link; the twist is along the axes of that frame.
"""

from functools import partial
from typing import Any

import numpy as np

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.linear_algebra import matmul
from urdfkit.messages import ODOMETRY, header, message_type, twist
from urdfkit.messages.constructors import pose
from urdfkit.sim.plugins.base import Sensor
from urdfkit.sim.plugins.sensors.point_motion import KinematicSnapshot, PointMotion
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.quaternion import from_matrix, from_rpy, product
from urdfkit.sim.state.robot_state import State

WORLD = ("world", "map")
"""Names of the world frame (gazebo_ros_p3d.cpp)."""


class P3d(Sensor):
    """Ground-truth pose and twist of a link."""

    kind = "p3d"

    def configure(self, setup: Setup) -> None:
        """Read the parameters and advertise the topic.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        links = setup.kinematics.link_names
        self._link = read.text("body")
        if self._link not in links:
            message = f"<{read.tag('body')}> is `{self._link}`, which is not a link" + did_you_mean(self._link, links)
            raise SimulationError(message, position=read.place("body"))
        self._frame = read.text("frame").lstrip("/")
        if self._frame not in (*WORLD, *links):
            raise SimulationError(
                f"<{read.tag('frame')}> is `{self._frame}`; it must be world or a link"
                + did_you_mean(self._frame, (*WORLD, *links)),
                position=read.place("frame"),
            )
        name = read.text("topic") if self.spec.generation == "ros1" else "odom"
        if not name:
            raise SimulationError("gazebo_ros_p3d has no <topicName>", position=self.plugin.element.origin.position)
        self.name = self.plugin.name or "p3d"
        self.rate = read.number("update_rate")
        self._offset = np.array(read.vector("xyz_offset", 3))
        roll, pitch, yaw = read.vector("rpy_offset", 3)
        self._turn = from_rpy(roll, pitch, yaw)
        self._noise = read.number("gaussian_noise")
        self._key = int(setup.random.integers(1 << 62))
        self._kinematics = setup.kinematics
        self.topics = (setup.bus.advertise(self.topic_names().resolve(name), ODOMETRY),)

    def measure(self, state: State, count: int) -> None:
        """Publish the measurement of this state."""
        self.topics[0].offer(partial(self._message, KinematicSnapshot(self._kinematics, state), self.done), count=count)

    def _seen_from_there(self, now: KinematicSnapshot, motion: PointMotion) -> PointMotion:
        """Return a motion relative to the reference frame."""
        if self._frame in WORLD:
            return motion
        there = now.motion(self._frame, np.eye(4))
        back, arm = there.rotation.T, motion.position - there.position
        # Velocity of a moving point in a rotating frame.
        linear = motion.linear - there.linear - np.cross(there.angular, arm)
        return PointMotion(
            matmul(back, motion.rotation),
            matmul(back, arm),
            matmul(back, linear),
            matmul(back, motion.angular - there.angular),
        )

    def _message(self, now: KinematicSnapshot, turn: int) -> Any:
        motion = self._seen_from_there(now, now.motion(self._link, np.eye(4)))
        random = np.random.Generator(np.random.Philox(key=[self._key, turn]))
        shaken = self._noise * random.standard_normal((2, 3))
        position = (motion.position + self._offset).tolist()
        quaternion = product(self._turn, from_matrix(motion.rotation))
        covariance = np.diag([self._noise**2] * 6).ravel()
        moving = twist((motion.linear + shaken[0]).tolist(), (motion.angular + shaken[1]).tolist())
        return message_type(ODOMETRY)(
            header(now.t, self._frame), self._link,
            message_type("geometry_msgs/msg/PoseWithCovariance")(pose(position, quaternion), covariance),
            message_type("geometry_msgs/msg/TwistWithCovariance")(moving, covariance.copy()),
        )  # fmt: skip
