"""Base of the controllers of wheeled robots: command timeout, speed limits, odometry on topics."""

from abc import abstractmethod
from collections.abc import Callable
from copy import copy
from math import inf, isfinite
from typing import Any

from urdfkit.description.control import Settings
from urdfkit.errors import DescriptionError
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import Reference
from urdfkit.sim.plugins.odometry import Estimate, OdometryTopics, Pose, planar
from urdfkit.sim.plugins.speed_limits import SpeedLimiter, SpeedLimits
from urdfkit.sim.plugins.wheel_geometry import collision_radius
from urdfkit.sim.plugins.wheel_odometry import Twist, WheelOdometry
from urdfkit.sim.state.robot_state import State

RATE = 50.0
"""Default ``publish_rate`` [Hz]."""

TIMEOUT = 0.5
"""Default ``cmd_vel_timeout`` [s]."""

DIAGONAL = (0.0, 7.0, 14.0, 21.0, 28.0, 35.0)
"""Default covariances of the steering and mecanum controllers, from the parameter files of ros2_controllers."""


class WheeledBase(RosController):
    """Base class of the controllers of wheeled robots; publishes odometry.

    Attributes:
        limits: limits of the commanded velocities.
        reference: the commanded velocity.
        odometry: wheel odometry.
        rate: rate of the odometry [Hz].
    """

    limits: SpeedLimits = SpeedLimits()
    reference: Reference
    odometry: WheelOdometry
    rate: float = RATE

    def publish_odometry(
        self,
        *,
        topic: str = "odom",
        transforms: str = "/tf",
        prefixed: bool = False,
        covariance: tuple[float, ...] | None = None,
    ) -> None:
        """Advertise odometry and its transform, with the parameters of ros_controllers and ros2_controllers.

        Args:
            topic: topic of the odometry, relative to the controller's name.
            transforms: topic of the transform, absolute or relative to the controller's name.
            prefixed: add the prefix ``tf_frame_prefix``, by default the namespace, to the frames (ROS 2).
            covariance: default variances; None if the parameters are required.

        Raises:
            DescriptionError: a parameter is missing or invalid, with its position.
        """
        read = self.settings
        prefix = self._prefix() if prefixed else ""
        of_pose, of_twist = (self._covariance(f"{name}_covariance_diagonal", covariance) for name in ("pose", "twist"))
        with_tf = read.flag("enable_odom_tf", True)
        topics = self._topics = OdometryTopics(
            self.hardware.setup.bus,
            topic=self.topic(topic),
            tf_topic=(transforms if transforms.startswith("/") else self.topic(transforms)) if with_tf else None,
            frame=prefix + read.text("odom_frame_id", "odom"),
            child=prefix + read.text("base_frame_id", "base_link"),
            covariance=of_pose,
            twist_covariance=of_twist,
        )
        for published, message in ((topics.odometry, topics.message), (topics.tf, topics.transform)):
            if published is not None:
                self.report(published, self.rate, self._measured(message))

    def _measured(self, message: Callable[[float, Estimate], Any]) -> Callable[[State], Callable[[], Any]]:
        def build(state: State) -> Callable[[], Any]:
            t, now = state.t, self._estimate(state, self.odometry)
            return lambda: message(t, now)

        return build

    def _estimate(self, state: State, odometry: WheelOdometry) -> Estimate:
        velocity = self.measure(state, odometry)
        return planar(*self.pose(odometry), velocity)

    @abstractmethod
    def measure(self, state: State, odometry: WheelOdometry) -> Twist:
        """Update the odometry to the present state, and return the measured velocity."""

    def pose(self, odometry: WheelOdometry) -> tuple[float, float, float]:
        """Return x [m], y [m] and heading [rad] of the base from the pose of the wheel odometry."""
        return odometry.x, odometry.y, odometry.heading

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose of the base in that frame."""
        return {self._topics.frame: self._estimate(state, copy(self.odometry)).pose}

    def start(self, state: State) -> None:
        """Start at rest, at the origin of the odometry frame."""
        super().start(state)
        self.reference.clear()
        self.limits.reset()
        self.odometry.reset()
        self.measure(state, self.odometry)

    def positive(self, name: str) -> float:
        """Return a length that is greater than zero [m].

        Raises:
            DescriptionError: it is missing or not positive, with its position.
        """
        value = self.settings.number(name)
        if value <= 0.0:
            place, name = self.settings.group(name).position, name.rpartition("/")[2]
            raise DescriptionError(f"`{name}` is {value:g} m; it must be greater than zero", position=place)
        return value

    def radius(self, output: Output) -> float:
        """Return the radius of a wheel's collision shape [m], as ROS 1 reads it from the URDF; zero if unknown."""
        return collision_radius(self.hardware.setup.kinematics.robot, output.handle.name) or 0.0

    def rest(self, t: float, *, settled: bool) -> float:
        """Return the time until the next update of the outputs [s]."""
        return min(1.0 / self.rate, self.reference.left(t)) if settled else 0.0

    def _prefix(self) -> str:
        """Return the frame prefix of diff_drive_controller and mecanum_drive_controller in ROS 2."""
        if not self.settings.flag("tf_frame_prefix_enable", True):
            return ""
        namespace = self.hardware.resolve("").strip("/")
        prefix = self.settings.text("tf_frame_prefix", "").replace("~", namespace) or namespace
        prefix = prefix.strip("/")
        return f"{prefix}/" if prefix else ""

    def _covariance(self, name: str, default: tuple[float, ...] | None) -> tuple[float, ...]:
        if default is None and self.settings.find(name) is None:
            self.settings.text(name)
        found = self.settings.numbers(name, default or (0.0,) * 6)
        if len(found) != 6:
            place = self.settings.group(name).position
            raise DescriptionError(f"`{name}` has {len(found)} numbers; it needs 6", position=place)
        return found


def limits_of_ros_1(group: Settings) -> SpeedLimiter:
    """Read the limits of ROS 1. A limit is active if its ``has_…`` is true; the lower defaults to minus the upper."""

    def bounds(which: str) -> tuple[float, float]:
        if not group.flag(f"has_{which}_limits", False):
            return -inf, inf
        most = group.number(f"max_{which}")
        return group.number(f"min_{which}", -most), most

    return SpeedLimiter(bounds("velocity"), bounds("acceleration"), bounds("jerk"))


def limits_of_ros_2(group: Settings) -> SpeedLimiter:
    """Read the limits of ROS 2. A limit is active if it is set and not ``nan``; ``has_…: false`` (Humble) disables it.

    Since Jazzy, acceleration and deceleration have separate limits for each direction. A missing limit defaults to that
    of the other direction, or to the acceleration limit. Humble's ``min_acceleration`` applies to both directions.
    """

    def bounds(which: str) -> tuple[float, float]:
        if not group.flag(f"has_{which}_limits", True):
            return -inf, inf
        most = group.number(f"max_{which}", inf, unset=True)
        return group.number(f"min_{which}", -most, unset=True), most

    speeding, backward = bounds("acceleration"), None
    if group.find("min_acceleration") is None and isfinite(speeding[1]):
        least = group.number("max_acceleration_reverse", speeding[0], unset=True)
        backward = (least, group.number("max_deceleration_reverse", speeding[1], unset=True))
        speeding = (group.number("max_deceleration", least, unset=True), speeding[1])
    return SpeedLimiter(bounds("velocity"), speeding, bounds("jerk"), backward=backward, jerk_when_slowing=False)
