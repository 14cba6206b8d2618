"""Reckoning: what controllers of wheeled robots publish about where they believe the robot to be."""

from __future__ import annotations

from copy import copy
from math import cos, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from urdfkit.errors import DescriptionError
from urdfkit.messages import ODOMETRY, TF, header, message_type, transform, twist

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.sim.plugins.controllers.controller import Law
    from urdfkit.sim.state.robot_state import State

    Measure = Callable[[State], tuple[tuple[float, float, float], tuple[float, float, float]]]
    """Returns x [m], y [m], heading [rad] and the velocities forward [m/s], to the left [m/s], turning [rad/s]."""


class Reckoning:
    """Odometry and its transform, under the parameters and with the defaults of ros_controllers and ros2_controllers.

    Args:
        law: the controller; its ``pose_covariance_diagonal``, ``odom_frame_id`` and so on are read.
        measure: says where the robot is now: a method of the controller, which takes note of how far the wheels came.
        rate: [Hz].
        topic: of the odometry, below the controller's name.
        transforms: topic of the transform; below the controller's name where it is not absolute.
        prefixed: frames go below ``tf_frame_prefix``, or the namespace where there is none (ROS 2).
        covariance: the variances where none are written; None where they have to be.

    Raises:
        DescriptionError: a parameter is missing or makes no sense, with its place.

    Attributes:
        frame: of the odometry.
    """

    def __init__(
        self,
        law: Law,
        measure: Measure,
        rate: float,
        *,
        topic: str = "odom",
        transforms: str = "/tf",
        prefixed: bool = False,
        covariance: tuple[float, ...] | None = None,
    ) -> None:
        read, bus = law.settings, law.hardware.setup.bus
        prefix = _prefix(law) if prefixed else ""
        self.frame = prefix + read.text("odom_frame_id", "odom")
        self._child = prefix + read.text("base_frame_id", "base_link")
        self._covariances = tuple(_covariance(law, name, covariance) for name in ("pose", "twist"))
        self._law, self._measure = law, measure
        law.report(bus.advertise(law.topic(topic), ODOMETRY), rate, self._message)
        if read.flag("enable_odom_tf", True):
            place = transforms if transforms.startswith("/") else law.topic(transforms)
            law.report(bus.advertise(place, TF), rate, self._transform)

    def estimate(self, state: State) -> tuple[tuple[float, float, float], tuple[float, float, float, float]]:
        """Return position [m] and quaternion x y z w at which the controller believes the robot to be now.

        What it goes by stays as it is: a copy of it looks.
        """
        law: Any = copy(self._law)
        if hasattr(law, "_odometry"):
            law._odometry = copy(law._odometry)
        (x, y, heading), _ = getattr(law, self._measure.__name__)(state)
        return (x, y, 0.0), (0.0, 0.0, sin(heading / 2), cos(heading / 2))

    def _message(self, state: State) -> Callable[[], Any]:
        t, ((x, y, heading), (vx, vy, w)) = state.t, self._measure(state)

        def build() -> Any:
            pose = message_type("geometry_msgs/msg/Pose")(
                message_type("geometry_msgs/msg/Point")(x, y, 0.0),
                message_type("geometry_msgs/msg/Quaternion")(0.0, 0.0, sin(heading / 2), cos(heading / 2)),
            )
            of_pose, of_twist = (np.diag(diagonal).ravel() for diagonal in self._covariances)
            return message_type(ODOMETRY)(
                header(t, self.frame),
                self._child,
                message_type("geometry_msgs/msg/PoseWithCovariance")(pose, of_pose),
                message_type("geometry_msgs/msg/TwistWithCovariance")(twist((vx, vy, 0), (0, 0, w)), of_twist),
            )

        return build

    def _transform(self, state: State) -> Callable[[], Any]:
        t, ((x, y, heading), _) = state.t, self._measure(state)
        quaternion = (0.0, 0.0, sin(heading / 2), cos(heading / 2))
        return lambda: message_type(TF)([transform(t, self.frame, self._child, (x, y, 0.0), quaternion)])


def _prefix(law: Law) -> str:
    """Return what diff_drive_controller and mecanum_drive_controller of ROS 2 put before the names of frames."""
    if not law.settings.flag("tf_frame_prefix_enable", True):
        return ""
    namespace = law.hardware.resolve("").strip("/")
    prefix = law.settings.text("tf_frame_prefix", "").replace("~", namespace) or namespace
    prefix = prefix.strip("/")
    return f"{prefix}/" if prefix else ""


def _covariance(law: Law, which: str, default: tuple[float, ...] | None) -> tuple[float, ...]:
    name = f"{which}_covariance_diagonal"
    if default is None and law.settings.find(name) is None:
        law.settings.text(name)
    found = law.settings.numbers(name, default or (0.0,) * 6)
    if len(found) != 6:
        place = law.settings.group(name).position
        raise DescriptionError(f"`{name}` has {len(found)} numbers; it needs 6", position=place)
    return found
