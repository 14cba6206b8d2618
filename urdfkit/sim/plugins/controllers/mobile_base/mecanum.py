"""mecanum_drive_controller of ROS 2: four mecanum wheels.

Source: ros2_controllers, mecanum_drive_controller.cpp and odometry.cpp.
"""

from math import cos, inf, sin
from typing import ClassVar

from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import usual_reference
from urdfkit.sim.plugins.controllers.mobile_base.wheeled_base import DIAGONAL, WheeledBase, limits_of_ros_2
from urdfkit.sim.plugins.speed_limits import SpeedLimits
from urdfkit.sim.plugins.wheel_odometry import MecanumOdometry, Twist, WheelOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State

CORNERS = {"front_left": (-1, -1), "front_right": (1, 1), "rear_left": (1, -1), "rear_right": (-1, 1)}
"""Wheel → signs of the lateral velocity and of the yaw rate in its speed, in the order of `MecanumOdometry`."""


class MecanumController(WheeledBase):
    """Wheel speeds vx ± vy ± w·(lx + ly) from the twist of the wheels' centre, which may be offset from the base."""

    types: ClassVar[dict[str, str]] = {"mecanum_drive_controller/MecanumDriveController": ""}

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a wheel or a length is missing, or a parameter is invalid.
        """
        read = self.settings
        wheels = []
        for corner in CORNERS:
            name = f"{corner}_wheel_command_joint_name"
            wheels.append(self.hardware.output(read.entry(name), "velocity"))
        self.outputs = tuple(wheels)
        self._radius = self.positive("kinematics/wheels_radius")
        self._reach = self.positive("kinematics/sum_of_robot_center_projection_on_X_Y_axis")
        offset = read.group("kinematics/base_frame_offset")
        self._offset = (offset.number("x", 0.0), offset.number("y", 0.0), offset.number("theta", 0.0))
        self.limits = SpeedLimits(*(limits_of_ros_2(read.group(f)) for f in ("linear/x", "linear/y", "angular/z")))
        self.reference = usual_reference(self, read.number("reference_timeout", 0.0))
        self.rate = 1.0 / self.hardware.period
        self.odometry = MecanumOdometry(self._reach)
        self.publish_odometry(topic="odometry", transforms="tf_odometry", prefixed=True, covariance=DIAGONAL)

    def update(self, state: State, motors: Motors) -> float:
        """Write the wheel commands and update the odometry."""
        self.measure(state, self.odometry)
        targets = self.reference.at(state.t) or (0.0, 0.0, 0.0)
        vx, vy, w = self.limits.limit(targets, self.hardware.period)
        x, y, theta = self._offset
        ahead = vx * cos(theta) - vy * sin(theta) + y * w
        left = vx * sin(theta) + vy * cos(theta) - x * w
        rest = inf
        for output, (across, turn) in zip(self.outputs, CORNERS.values(), strict=True):
            rate = (ahead + across * left + turn * self._reach * w) / self._radius
            rest = min(rest, output.write(state, motors, rate))
        if rest <= 0.0 or not self.limits.settled(targets):
            return 0.0
        return min(10 * self.hardware.period, self.reference.left(state.t))

    def measure(self, state: State, odometry: WheelOdometry) -> Twist:
        """Update the odometry to the present state, and return the velocity of the base."""
        names = [output.handle.name for output in self.outputs]
        odometry.update(state.t, *(state.position(name) * self._radius for name in names))
        rates = [state.velocity(name) * self._radius for name in names]
        signs = list(CORNERS.values())
        ahead = sum(rates) / 4
        left = sum(rate * across for rate, (across, _) in zip(rates, signs, strict=True)) / 4
        w = sum(rate * turn for rate, (_, turn) in zip(rates, signs, strict=True)) / 4 / self._reach
        x, y, theta = self._offset
        ahead, left = ahead - y * w, left + x * w
        return cos(theta) * ahead + sin(theta) * left, cos(theta) * left - sin(theta) * ahead, w

    def pose(self, odometry: WheelOdometry) -> tuple[float, float, float]:
        """Return x [m], y [m] and heading [rad] of the base from the pose of the wheels' centre."""
        x, y, theta = self._offset
        c, s = cos(odometry.heading), sin(odometry.heading)
        # Displacement of the base in the initial frame of the wheels' centre, then in the initial frame of the base.
        dx, dy = odometry.x + c * x - s * y - x, odometry.y + s * x + c * y - y
        return cos(theta) * dx + sin(theta) * dy, cos(theta) * dy - sin(theta) * dx, odometry.heading
