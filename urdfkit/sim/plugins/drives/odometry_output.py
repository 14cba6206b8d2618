"""Where a wheeled robot believes it is: odometry from the wheels or from the world, as a message and a transform."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING, Any

from urdfkit.errors import SimulationError
from urdfkit.messages import ODOMETRY, TF, header, message_type, transform, twist
from urdfkit.sim.state.quaternion import yaw_of

if TYPE_CHECKING:
    from urdfkit.bus import Bus, Topic
    from urdfkit.sim.plugins.parameters import Parameters
    from urdfkit.sim.plugins.setup import Setup
    from urdfkit.sim.plugins.topic_names import Topics
    from urdfkit.sim.plugins.wheel_odometry import BicycleOdometry, MecanumOdometry, WheelOdometry

HUGE = 1e12
"""Variance of what odometry does not measure, as gazebo_ros_diff_drive writes it."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """A pose in the odometry frame and the twist in the base frame.

    Attributes:
        position: [m].
        quaternion: x y z w.
        linear: [m/s].
        angular: [rad/s].
    """

    position: tuple[float, float, float]
    quaternion: tuple[float, float, float, float]
    linear: tuple[float, float, float]
    angular: tuple[float, float, float]


class Odometer:
    """Publishes estimates.

    Args:
        bus: where to.
        topic: of the odometry message; None to publish none.
        tf_topic: of the transform; None to publish none.
        frame: the odometry frame.
        child: the base frame.
        covariance: variances along [m²] and about [rad²] x, y, z; None leaves the matrix zero (the new Gazebo).
        twist_covariance: the twist has the same variances as the pose; without, its matrix is zero.
        flat: the message has no height; the transform has the true one.
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
        twist_covariance: bool = False,
        flat: bool = False,
    ) -> None:
        self._odometry: Topic | None = bus.advertise(topic, ODOMETRY) if topic else None
        self._tf: Topic | None = bus.advertise(tf_topic, TF) if tf_topic else None
        self.frame = frame
        self.child = child
        self._covariance = covariance
        self._twist_covariance = twist_covariance
        self._flat = flat

    def publish(self, t: float, estimate: Callable[[], Estimate]) -> None:
        """Offer message and transform of this moment; `estimate` must hold on to the values of now."""
        if self._odometry is not None:
            self._odometry.offer(lambda: self._message(t, estimate()))
        if self._tf is not None:
            self._tf.offer(lambda: self._transform(t, estimate()))

    def _message(self, t: float, estimate: Estimate) -> Any:
        import numpy as np

        x, y, z = estimate.position
        pose = message_type("geometry_msgs/msg/Pose")(
            message_type("geometry_msgs/msg/Point")(x, y, 0.0 if self._flat else z),
            message_type("geometry_msgs/msg/Quaternion")(*estimate.quaternion),
        )
        covariance = np.zeros(36)
        if self._covariance is not None:
            covariance[::7] = self._covariance
        return message_type(ODOMETRY)(
            header(t, self.frame),
            self.child,
            message_type("geometry_msgs/msg/PoseWithCovariance")(pose, covariance),
            message_type("geometry_msgs/msg/TwistWithCovariance")(
                twist(estimate.linear, estimate.angular),
                covariance.copy() if self._twist_covariance else np.zeros(36),
            ),
        )

    def _transform(self, t: float, estimate: Estimate) -> Any:
        return message_type(TF)([transform(t, self.frame, self.child, estimate.position, estimate.quaternion)])


def odometer(
    setup: Setup,
    read: Parameters,
    topics: Topics,
    *,
    published: bool,
    with_tf: bool,
    twist_covariance: bool = False,
    flat: bool = False,
) -> Odometer:
    """Return the odometer a drive's table describes.

    Args:
        setup: the drive's.
        read: its parameters; topics and covariance are those of gazebo_ros_diff_drive where its table has none.
        topics: its topics.
        published: publish the odometry message.
        with_tf: publish the transform.
        twist_covariance: the twist has the same variances as the pose.
        flat: the message has no height.
    """
    gz = read.generation == "gz"
    x, y, yaw = (
        read.number(f"covariance_{part}", default) for part, default in (("x", 1e-5), ("y", 1e-5), ("yaw", 1e-3))
    )
    return Odometer(
        setup.bus,
        topic=topics.resolve(read.text("odometry_topic", "odom")) if published else None,
        tf_topic=(topics.resolve(read.text("tf_topic")) if gz else "/tf") if with_tf else None,
        frame=read.text("odometry_frame"),
        child=read.text("base_frame"),
        covariance=None if gz else (x, y, HUGE, HUGE, HUGE, yaw),
        twist_covariance=twist_covariance,
        flat=flat,
    )


def by_encoder(read: Parameters) -> bool:
    """Return whether odometry comes from the wheels, not from the world.

    Raises:
        SimulationError: the parameter says neither.
    """
    source = read.text("odometry_source", "encoder").strip()
    if source not in ("encoder", "world", "0", "1"):
        raise SimulationError(
            f"<{read.tag('odometry_source')}> is `{source}`; it must be "
            + ("`encoder` or `world`" if read.generation == "ros1" else "0 (encoder) or 1 (world)"),
            position=read.place("odometry_source"),
        )
    return source in ("encoder", "0")


def from_wheels(odometry: WheelOdometry | BicycleOdometry, period: float, *, signed: bool) -> Estimate:
    """Return the estimate of encoder odometry.

    Args:
        odometry: after its last update.
        period: time since the update before [s].
        signed: report driving backwards as negative; gazebo_ros_diff_drive reports the length of the displacement,
            which is never negative.
    """
    speed = odometry.advanced if signed else odometry.distance
    return Estimate(
        (odometry.x, odometry.y, 0.0),
        (0.0, 0.0, sin(odometry.heading / 2), cos(odometry.heading / 2)),
        (speed / period, 0.0, 0.0),
        (0.0, 0.0, odometry.turned / period),
    )


def from_mecanum(odometry: MecanumOdometry, period: float) -> Estimate:
    """Return the estimate of mecanum wheels' odometry, `period` [s] after the update before the last one."""
    advanced, strafed, turned = odometry.moved
    return Estimate(
        (odometry.x, odometry.y, 0.0),
        (0.0, 0.0, sin(odometry.heading / 2), cos(odometry.heading / 2)),
        (advanced / period, strafed / period, 0.0),
        (0.0, 0.0, turned / period),
    )


def from_world(pose: tuple[float, ...], velocity: tuple[float, ...]) -> Estimate:
    """Return the estimate of world odometry: the model's true pose, not relative to where it was spawned.

    Args:
        pose: x y z and quaternion x y z w of the root link in the world.
        velocity: of the root link along and about the world's axes, linear first.
    """
    x, y, z, qx, qy, qz, qw = pose
    yaw = yaw_of(pose[3:])
    vx, vy = velocity[0], velocity[1]
    return Estimate(
        (x, y, z),
        (qx, qy, qz, qw),
        (cos(yaw) * vx + sin(yaw) * vy, cos(yaw) * vy - sin(yaw) * vx, 0.0),
        (0.0, 0.0, velocity[5]),
    )
