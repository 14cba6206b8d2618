"""diff_drive_controller of ROS 1 and ROS 2: limits, timeout, multipliers, odometry.

Sources: ros_controllers noetic, diff_drive_controller.cpp, speed_limiter.cpp, odometry.cpp; ros2_controllers,
diff_drive_controller.cpp and its parameter file.
"""

from collections.abc import Callable
from math import inf
from typing import ClassVar

import numpy as np

from urdfkit.description.control import Settings
from urdfkit.description.control.parameter_defects import SIGNS, SIGNS_OF_MINIMA, sign_defect
from urdfkit.errors import DescriptionError
from urdfkit.linear_algebra import vector_norm
from urdfkit.messages import TWIST_STAMPED, header, message_type, twist
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import Reference
from urdfkit.sim.plugins.controllers.mobile_base.wheeled_base import (
    RATE,
    TIMEOUT,
    WheeledBase,
    limits_of_ros_1,
    limits_of_ros_2,
)
from urdfkit.sim.plugins.speed_limits import SpeedLimits
from urdfkit.sim.plugins.wheel_odometry import DifferentialOdometry, Twist, WheelOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State


class DiffDriveController(WheeledBase):
    """Differential drive: wheel speeds v ± w·separation/2; stops after the command timeout."""

    types: ClassVar[dict[str, str]] = {"diff_drive_controller/DiffDriveController": ""}

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: no wheels, or an invalid parameter.
        """
        self._ros1 = self.hardware.ros == 1
        self._left = self._wheels("left_wheel" if self._ros1 else "left_wheel_names")
        self._right = self._wheels("right_wheel" if self._ros1 else "right_wheel_names")
        self.outputs = (*self._left, *self._right)
        self._read_geometry()
        read = self.settings
        self._open = read.flag("open_loop", False)
        limits = limits_of_ros_1 if self._ros1 else limits_of_ros_2
        for axis in () if self._ros1 else ("linear/x", "angular/z"):
            _check_signs(read.group(axis), axis.replace("/", "."))
        self.limits = SpeedLimits(*(limits(read.group(name)) for name in ("linear/x", "angular/z")))
        self.rate = read.number("publish_rate", RATE)
        self.odometry = DifferentialOdometry(self._separation, exact=True)
        self._publish()
        self._subscribe()

    def _wheels(self, parameter: str) -> tuple[Output, ...]:
        named = self.settings.texts(parameter, required=True)
        return tuple(self.hardware.output(entry, "velocity") for entry in named)

    def _read_geometry(self) -> None:
        read = self.settings
        if len(self._left) != len(self._right):
            raise DescriptionError(
                f"{len(self._left)} left and {len(self._right)} right wheels; both must be equal", position=read.place
            )
        separation, radius = read.number("wheel_separation", 0.0), read.number("wheel_radius", 0.0)
        for name, value in (("wheel_separation", separation), ("wheel_radius", radius)):
            if value < 0 or (value == 0 and (not self._ros1 or read.find(name) is not None)):
                if read.find(name) is None:
                    read.number(name)
                raise DescriptionError(
                    f"`{name}` is {value:g} m; it must be greater than zero", position=read.group(name).position
                )
        separation = separation or self._measured_separation()
        if not (radius := radius or self.radius(self._left[0])):
            wheel = self._left[0].handle.name
            message = f"`wheel_radius` is missing, and the wheel of joint `{wheel}` has no cylinder or sphere as its "
            message += "collision shape"
            raise DescriptionError(message, position=read.place)
        both = read.number("wheel_radius_multiplier", 1.0)
        self._separation = separation * read.number("wheel_separation_multiplier", 1.0)
        self._left_radius = radius * read.number("left_wheel_radius_multiplier", both)
        self._right_radius = radius * read.number("right_wheel_radius_multiplier", both)

    def _measured_separation(self) -> float:
        """Return the distance between the joints of the first left and right wheel, as ROS 1 reads it from the URDF."""
        joints = self.hardware.setup.kinematics.robot.joint_by_name
        left, right = (joints[wheels[0].handle.name].origin.xyz for wheels in (self._left, self._right))
        return vector_norm(np.subtract(left, right))

    def _publish(self) -> None:
        read, ros1 = self.settings, self._ros1
        self.publish_odometry(prefixed=not ros1, covariance=None if ros1 else (0.0,) * 6)
        self._granted = None
        if read.flag("publish_cmd" if ros1 else "publish_limited_velocity", False):
            self._granted = self.hardware.setup.bus.advertise(self.topic("cmd_vel_out"), TWIST_STAMPED)
        if not read.flag("allow_multiple_cmd_vel_publishers", True):
            self.note("`allow_multiple_cmd_vel_publishers` has no effect: publishers are not distinguished")

    def _subscribe(self) -> None:
        distro = self.hardware.setup.distro.name
        stamped = not self._ros1
        name = "cmd_vel"
        plain = not self.settings.flag("use_stamped_vel", True)  # removed in Jazzy
        if stamped and plain and distro in ("", "foxy", "galactic", "humble", "iron"):
            stamped, name = False, "cmd_vel_unstamped"
        timeout = self.settings.number("cmd_vel_timeout", TIMEOUT)
        if not self._ros1 and timeout == 0.0:
            timeout = inf
        self.reference = Reference(self, timeout, topic=name, stamped=stamped)

    def start(self, state: State) -> None:
        """Start at rest, at the origin of the odometry frame."""
        self._speeds = (0.0, 0.0)
        super().start(state)

    # Control and odometry

    def update(self, state: State, motors: Motors) -> float:
        """Write the wheel commands and update the odometry."""
        t = state.t
        self.measure(state, self.odometry)
        v, _, w = self.reference.at(t) or (0.0, 0.0, 0.0)
        # After a long rest, the acceleration limit applies from this control period on.
        v_now, w_now = self.limits.limit((v, w), self.hardware.period)
        settled = self.limits.settled((v, w))
        half = w_now * self._separation / 2
        for outputs, speed, radius in (
            (self._left, v_now - half, self._left_radius),
            (self._right, v_now + half, self._right_radius),
        ):
            for output in outputs:
                settled = output.write(state, motors, speed / radius) > 0.0 and settled
        self._speeds = (v_now, w_now)
        if self._granted is not None:
            self._granted.offer(lambda: message_type(TWIST_STAMPED)(header(t, ""), twist((v_now, 0, 0), (0, 0, w_now))))
        return self.rest(t, settled=settled and self._granted is None)

    def _mean(self, wheels: tuple[Output, ...], of: Callable[[str], float]) -> float:
        return sum(of(wheel.handle.name) for wheel in wheels) / len(wheels)

    def measure(self, state: State, odometry: WheelOdometry) -> Twist:
        """Update the odometry to the present state, and return the measured velocity."""
        if self._open:  # open loop: integrate the commanded velocity
            (v, w), period = self._speeds, state.t - odometry.t
            left, right = odometry.rolled or (0.0, 0.0)
            half = w * self._separation / 2
            odometry.update(state.t, left + (v - half) * period, right + (v + half) * period)
            return v, 0.0, w
        pairs = ((self._left, self._left_radius), (self._right, self._right_radius))
        odometry.update(state.t, *(self._mean(wheels, state.position) * radius for wheels, radius in pairs))
        left, right = (self._mean(wheels, state.velocity) * radius for wheels, radius in pairs)
        return (left + right) / 2, 0.0, (right - left) / self._separation


def _check_signs(group: Settings, axis: str) -> None:
    """Raise an error for a limit with the sign that diff_drive_controller refuses since Jazzy."""
    is_new = any(group.find(name) is not None for name in SIGNS)
    for name, sign in (SIGNS | SIGNS_OF_MINIMA if is_new else SIGNS).items():
        if group.find(name) is not None:
            defect = sign_defect(f"{axis}.{name}", group.number(name, 0.0, unset=True), sign)
            if defect is not None:
                raise DescriptionError(defect, position=group.group(name).position)
