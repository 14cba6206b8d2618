"""diff_drive_controller of ROS 1 and ROS 2: limits, timeout, multipliers, odometry.

Sources: ros_controllers noetic, diff_drive_controller.cpp, speed_limiter.cpp, odometry.cpp; ros2_controllers,
diff_drive_controller.cpp and its parameter file.
"""

from __future__ import annotations

from math import inf, isfinite
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from urdfkit.description.urdf.robot import Cylinder, Sphere
from urdfkit.errors import DescriptionError
from urdfkit.linear_algebra import vector_norm
from urdfkit.messages import TWIST, TWIST_STAMPED, header, message_type, twist
from urdfkit.sim.plugins.controllers.controller import Law
from urdfkit.sim.plugins.controllers.mobile_base.odometry import Reckoning
from urdfkit.sim.plugins.speed_limits import SpeedLimiter
from urdfkit.sim.plugins.wheel_odometry import WheelOdometry

if TYPE_CHECKING:
    from urdfkit.description.control import Settings
    from urdfkit.sim.plugins.controllers.command_output import Output
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State

RATE = 50.0
"""Default ``publish_rate`` [Hz]."""

TIMEOUT = 0.5
"""Default ``cmd_vel_timeout`` [s]."""


class DiffDriveController(Law):
    """Wheels at v ± w·separation/2; stops when commands cease."""

    types: ClassVar[dict[str, str]] = {"diff_drive_controller/DiffDriveController": ""}

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: no wheels, or a parameter that makes no sense.
        """
        self._ros1 = self.hardware.ros == 1
        self._left = self._wheels("left_wheel" if self._ros1 else "left_wheel_names")
        self._right = self._wheels("right_wheel" if self._ros1 else "right_wheel_names")
        self.outputs = (*self._left, *self._right)
        self._read_geometry()
        read = self.settings
        self._timeout = read.number("cmd_vel_timeout", TIMEOUT)
        if not self._ros1 and self._timeout == 0.0:
            self._timeout = inf
        self._open = read.flag("open_loop", False)
        limits = limits_of_ros_1 if self._ros1 else limits_of_ros_2
        self._limiters = (limits(read.group("linear/x")), limits(read.group("angular/z")))
        self._rate = read.number("publish_rate", RATE)
        self._publish()
        self._subscribe()
        self._wanted, self._heard = (0.0, 0.0), -inf

    def _wheels(self, parameter: str) -> tuple[Output, ...]:
        named = self.settings.texts(parameter)
        if not named:
            self.settings.text(parameter)
        return tuple(self.hardware.output(entry, "velocity") for entry in named)

    def _read_geometry(self) -> None:
        read = self.settings
        if len(self._left) != len(self._right):
            raise DescriptionError(
                f"{len(self._left)} left and {len(self._right)} right wheels; as many are wanted", position=read.place
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
        radius = radius or self._measured_radius()
        both = read.number("wheel_radius_multiplier", 1.0)
        self._separation = separation * read.number("wheel_separation_multiplier", 1.0)
        self._left_radius = radius * read.number("left_wheel_radius_multiplier", both)
        self._right_radius = radius * read.number("right_wheel_radius_multiplier", both)

    def _measured_separation(self) -> float:
        """Return the distance of the first wheels' joints, as ROS 1 takes it from the URDF."""
        joints = self.hardware.setup.kinematics.robot.joint_by_name
        left, right = (joints[wheels[0].handle.name].origin.xyz for wheels in (self._left, self._right))
        return vector_norm(np.subtract(left, right))

    def _measured_radius(self) -> float:
        """Return the radius of the first left wheel's collision shape, as ROS 1 takes it from the URDF."""
        robot = self.hardware.setup.kinematics.robot
        link = robot.link_by_name[robot.joint_by_name[self._left[0].handle.name].child or ""]
        for collision in link.collisions:
            if isinstance(collision.geometry, Cylinder | Sphere):
                return collision.geometry.radius
        raise DescriptionError(
            f"no `wheel_radius`, and link `{link.name}` has no cylinder or sphere to collide with that would tell it",
            position=self.settings.place,
        )

    def _publish(self) -> None:
        read, ros1 = self.settings, self._ros1
        self.reckoning = Reckoning(
            self, self._reckon, self._rate, prefixed=not ros1, covariance=None if ros1 else (0.0,) * 6
        )
        self._granted = None
        if read.flag("publish_cmd" if ros1 else "publish_limited_velocity", False):
            self._granted = self.hardware.setup.bus.advertise(self.topic("cmd_vel_out"), TWIST_STAMPED)
        if not read.flag("allow_multiple_cmd_vel_publishers", True):
            self.note("commands are taken from whoever sends them: publishers are not told apart")

    def _subscribe(self) -> None:
        distro = self.hardware.setup.distro.name
        stamped = not self._ros1
        name = "cmd_vel"
        plain = not self.settings.flag("use_stamped_vel", True)  # gone since Jazzy
        if stamped and plain and distro in ("", "foxy", "galactic", "humble", "iron"):
            stamped, name = False, "cmd_vel_unstamped"
        topic = self.topic(name)
        self.commands[topic] = TWIST_STAMPED if stamped else TWIST
        self.listen(topic, self.commands[topic], lambda message: self._take(message.twist if stamped else message))

    # Commands

    def _take(self, message: Any) -> None:
        v, w = float(message.linear.x), float(message.angular.z)
        if isfinite(v) and isfinite(w):
            self._wanted, self._fresh = (v, w), True
        else:
            self.note("dropped a command that is not finite")

    def start(self, state: State) -> None:
        """Stand, and believe to be at the origin."""
        super().start(state)
        for limiter in self._limiters:
            limiter.reset()
        self._wanted, self._fresh, self._heard = (0.0, 0.0), False, -inf
        self._odometry = WheelOdometry(self._separation, exact=True)
        self._odometry.update(*((0.0, 0.0) if self._open else self._rolled(state)))
        self._speeds = self._rolled_open = (0.0, 0.0)
        self._read_at = state.t

    # At work

    def update(self, state: State, motors: Motors) -> float:
        """Turn the wheels and keep the odometry."""
        t = state.t
        self._integrate(state)
        if self._fresh:
            self._heard, self._fresh = t, False
        stale = t - self._heard > self._timeout + 1e-9
        v, w = (0.0, 0.0) if stale else self._wanted
        linear, angular = self._limiters
        # A long time at rest is none to catch up with: acceleration starts now.
        v_now, w_now = linear.limit(v, self.hardware.period), angular.limit(w, self.hardware.period)
        settled = linear.settled(v) and angular.settled(w)
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
        if not settled or self._granted is not None:
            return 0.0
        due = self._heard + self._timeout - t
        return min(1.0 / self._rate, max(0.0, due) if not stale and isfinite(due) else inf)

    def _rolled(self, state: State) -> tuple[float, float]:
        def mean(wheels: tuple[Output, ...]) -> float:
            return sum(state.position(wheel.handle.name) for wheel in wheels) / len(wheels)

        return mean(self._left) * self._left_radius, mean(self._right) * self._right_radius

    def _integrate(self, state: State) -> None:
        if self._open:  # what was commanded since, as if the wheels had obeyed
            period, (v, w) = state.t - self._read_at, self._speeds
            left, right = self._rolled_open
            half = w * self._separation / 2
            self._rolled_open = (left + (v - half) * period, right + (v + half) * period)
            self._odometry.update(*self._rolled_open)
        else:
            self._odometry.update(*self._rolled(state))
        self._read_at = state.t

    def _measured(self, state: State) -> tuple[float, float]:
        if self._open:
            return self._speeds
        left, right = (
            sum(state.velocity(wheel.handle.name) for wheel in wheels) / len(wheels) * radius
            for wheels, radius in ((self._left, self._left_radius), (self._right, self._right_radius))
        )
        return (left + right) / 2, (right - left) / self._separation

    # Odometry

    def _reckon(self, state: State) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        self._integrate(state)
        v, w = self._measured(state)
        return (self._odometry.x, self._odometry.y, self._odometry.heading), (v, 0.0, w)


def limits_of_ros_1(group: Settings) -> SpeedLimiter:
    """Read the limits of ROS 1: each holds where its ``has_…`` is true; the lower is minus the upper where left out."""

    def bounds(which: str) -> tuple[float, float]:
        if not group.flag(f"has_{which}_limits", False):
            return -inf, inf
        most = group.number(f"max_{which}")
        return group.number(f"min_{which}", -most), most

    return SpeedLimiter(bounds("velocity"), bounds("acceleration"), bounds("jerk"))


def limits_of_ros_2(group: Settings) -> SpeedLimiter:
    """Read the limits of ROS 2: each holds where it is written and not ``nan``; ``has_…: false`` (Humble) lifts it.

    Since Jazzy, speeding up and slowing down have limits of their own in either direction; what is left out is that of
    the other direction, or of speeding up. Humble's ``min_acceleration`` is for both directions.
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
