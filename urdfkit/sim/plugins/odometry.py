"""Odometry of drives and controllers: an estimate of pose and twist, as a message and a transform."""

from dataclasses import dataclass
from math import cos, sin
from typing import Any

import numpy as np

from urdfkit.bus import Bus, Topic
from urdfkit.messages import ODOMETRY, TF, header, message_type, transform, twist
from urdfkit.messages.constructors import pose
from urdfkit.sim.plugins.wheel_odometry import Twist
from urdfkit.sim.state.quaternion import yaw_of

Pose = tuple[tuple[float, ...], tuple[float, ...]]
"""Position [m] and quaternion x y z w."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """Pose in the odometry frame and twist in the base frame.

    Attributes:
        position: position [m].
        quaternion: orientation x y z w.
        linear: linear velocity [m/s].
        angular: angular velocity [rad/s].
    """

    position: tuple[float, float, float]
    quaternion: tuple[float, float, float, float]
    linear: tuple[float, float, float]
    angular: tuple[float, float, float]

    @property
    def pose(self) -> Pose:
        """Position [m] and quaternion x y z w."""
        return self.position, self.quaternion


def planar(x: float, y: float, heading: float, velocity: Twist) -> Estimate:
    """Return the estimate of a robot that moves in the plane.

    Args:
        x: position [m].
        y: position [m].
        heading: yaw angle [rad].
        velocity: forward [m/s], to the left [m/s], turning [rad/s].
    """
    forward, left, turning = velocity
    quaternion = (0.0, 0.0, sin(heading / 2), cos(heading / 2))
    return Estimate((x, y, 0.0), quaternion, (forward, left, 0.0), (0.0, 0.0, turning))


def from_world(pose: tuple[float, ...], velocity: tuple[float, ...]) -> Estimate:
    """Return the estimate of world odometry: the model's true pose, not relative to where it was spawned.

    Args:
        pose: x y z and quaternion x y z w of the root link in the world.
        velocity: twist of the root link along and about the world's axes, linear first.
    """
    x, y, z, qx, qy, qz, qw = pose
    yaw = yaw_of(pose[3:])
    vx, vy = velocity[0], velocity[1]
    linear = (cos(yaw) * vx + sin(yaw) * vy, cos(yaw) * vy - sin(yaw) * vx, 0.0)
    return Estimate((x, y, z), (qx, qy, qz, qw), linear, (0.0, 0.0, velocity[5]))


class OdometryTopics:
    """Topics on which the estimates of one robot are published.

    Args:
        bus: the bus.
        topic: topic of the odometry message; None to publish no message.
        tf_topic: topic of the transform; None to publish no transform.
        frame: the odometry frame.
        child: the base frame.
        covariance: variances of the pose along [m²] and about [rad²] x, y, z; zeros where None.
        twist_covariance: variances of the twist; zeros where None.
        flat: publish zero height in the message; the transform keeps the true height.
    """

    def __init__(
        self,
        bus: Bus,
        *,
        topic: str | None,
        tf_topic: str | None,
        frame: str,
        child: str,
        covariance: tuple[float, ...] | None,
        twist_covariance: tuple[float, ...] | None = None,
        flat: bool = False,
    ) -> None:
        self.odometry: Topic | None = bus.advertise(topic, ODOMETRY) if topic else None
        self.tf: Topic | None = bus.advertise(tf_topic, TF) if tf_topic else None
        self.frame = frame
        self.child = child
        self._covariances = tuple(np.diag(each or (0.0,) * 6).ravel() for each in (covariance, twist_covariance))
        self._flat = flat

    @property
    def topics(self) -> tuple[Topic, ...]:
        """The topics that exist."""
        return tuple(topic for topic in (self.odometry, self.tf) if topic is not None)

    def publish(self, t: float, estimate: Estimate) -> None:
        """Offer message and transform of an estimate."""
        if self.odometry is not None:
            self.odometry.offer(lambda: self.message(t, estimate))
        if self.tf is not None:
            self.tf.offer(lambda: self.transform(t, estimate))

    def message(self, t: float, estimate: Estimate) -> Any:
        """Return the Odometry message."""
        x, y, z = estimate.position
        of_pose, of_twist = (covariance.copy() for covariance in self._covariances)
        return message_type(ODOMETRY)(
            header(t, self.frame),
            self.child,
            message_type("geometry_msgs/msg/PoseWithCovariance")(
                pose((x, y, 0.0 if self._flat else z), estimate.quaternion), of_pose
            ),
            message_type("geometry_msgs/msg/TwistWithCovariance")(twist(estimate.linear, estimate.angular), of_twist),
        )

    def transform(self, t: float, estimate: Estimate) -> Any:
        """Return the transform of the base frame in the odometry frame."""
        return message_type(TF)([transform(t, self.frame, self.child, estimate.position, estimate.quaternion)])
