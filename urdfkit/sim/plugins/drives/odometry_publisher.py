"""Odometry publisher: gz sim's OdometryPublisher, for robots whose drive has no odometry.

Source: gz-sim main, src/systems/odometry_publisher/OdometryPublisher.cc. Gazebo publishes the mean velocity of ten
steps; urdfkit publishes the velocity of the present state.
"""

from urdfkit.bus import Topic
from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.odometry import Estimate, OdometryTopics, Pose, from_world
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.quaternion import from_rpy, product, rotate
from urdfkit.sim.state.robot_state import State


class OdometryPublisher(Drive):
    """Publishes the true pose in the world, and the velocity in the robot's frame with optional noise."""

    kind = "odometry_publisher"
    resting = True

    def configure(self, setup: Setup) -> None:
        """Read the parameters and advertise.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = self.topic_names()
        self.read_rate = read.number("odometry_rate")
        self._flat = read.choice("dimensions") == "2"
        x, y, z = read.vector("xyz_offset", 3)
        self._offset = (x, y, z)
        roll, pitch, yaw = read.vector("rpy_offset", 3)
        self._turn = from_rpy(roll, pitch, yaw)
        self._noise = read.number("gaussian_noise")
        self._random = setup.random
        frame, child = read.text("odometry_frame"), read.text("base_frame")
        variances = (self._noise**2,) * 6
        self._topics = (
            OdometryTopics(
                setup.bus,
                topic=topics.resolve(read.text("odometry_topic")),
                tf_topic=topics.resolve(read.text("tf_topic")),
                frame=frame,
                child=child,
                covariance=None,
            ),
            OdometryTopics(
                setup.bus,
                topic=topics.resolve(read.text("covariance_topic")),
                tf_topic=None,
                frame=frame,
                child=child,
                covariance=variances,
                twist_covariance=variances,
            ),
        )

    def write(self, state: State, motors: Motors) -> None:
        """Do nothing; this plugin has no joint commands."""

    @property
    def published(self) -> tuple[Topic, ...] | None:
        """Topics of the odometry; None if each message consumes random numbers."""
        return None if self._noise else tuple(topic for topics in self._topics for topic in topics.topics)

    def read(self, state: State) -> None:
        """Publish the odometry."""
        now = self._with_noise(self._estimate(state))
        for topics in self._topics:
            topics.publish(state.t, now)

    def _estimate(self, state: State) -> Estimate:
        """Return pose and twist of the frame at the offset."""
        pose, velocity = state.base_pose, state.base_velocity
        arm, quaternion = rotate(pose[3:], self._offset), product(pose[3:], self._turn)
        position = (pose[0] + arm[0], pose[1] + arm[1], pose[2] + arm[2])
        (vx, vy, vz), (wx, wy, wz) = velocity[:3], velocity[3:]
        linear = (vx + wy * arm[2] - wz * arm[1], vy + wz * arm[0] - wx * arm[2], vz + wx * arm[1] - wy * arm[0])
        if self._flat:
            now = from_world((*position, *quaternion), (*linear, wx, wy, wz))
            return Estimate((position[0], position[1], 0.0), quaternion, now.linear, now.angular)
        back = (-quaternion[0], -quaternion[1], -quaternion[2], quaternion[3])
        return Estimate(position, quaternion, rotate(back, linear), rotate(back, (wx, wy, wz)))

    def _with_noise(self, now: Estimate) -> Estimate:
        if self._noise == 0.0:
            return now
        noise = self._random.normal(0.0, self._noise, (2, 3)).tolist()
        linear, angular = (
            (x + dx, y + dy, z + dz) for (x, y, z), (dx, dy, dz) in zip((now.linear, now.angular), noise, strict=True)
        )
        return Estimate(now.position, now.quaternion, linear, angular)

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → the published pose."""
        return {self._topics[0].frame: self._estimate(state).pose}

    def reset(self) -> None:
        """Do nothing; this plugin has no state."""
