"""Controllers of bases with steered wheels: bicycle, tricycle and Ackermann.

Sources: ros2_controllers, steering_controllers_library (steering_odometry.cpp, steering_controllers_library.cpp) and
its three controllers; ros_controllers noetic, ackermann_steering_controller.cpp.
"""

from math import atan, tan
from typing import ClassVar

from urdfkit.description.control import Settings
from urdfkit.description.control.parameter_defects import STEERED, track_and_radius, traction_and_steering
from urdfkit.errors import DescriptionError
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import usual_reference
from urdfkit.sim.plugins.controllers.mobile_base.wheeled_base import (
    DIAGONAL,
    RATE,
    TIMEOUT,
    WheeledBase,
    limits_of_ros_1,
)
from urdfkit.sim.plugins.speed_limits import SpeedLimits
from urdfkit.sim.plugins.wheel_geometry import steering_angles
from urdfkit.sim.plugins.wheel_odometry import BicycleOdometry, Twist, WheelOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State

SLOW = 1.1920929e-07
"""Speed below which the steering angle is undefined [m/s] (``std::numeric_limits<float>::epsilon``)."""


class SteeringController(WheeledBase):
    """Drives one or two wheels and steers one or two wheels; the right wheel before the left one.

    ROS 2 commands the yaw rate on ``reference``. After a timeout the wheels stop and the steering keeps its angle.
    ROS 1 supports the bicycle only and commands the steering *angle* on ``cmd_vel``. After a timeout the angle returns
    to zero.
    """

    types: ClassVar[dict[str, str]] = dict.fromkeys(STEERED, "")

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a joint or a length is missing, or a parameter is invalid.
        """
        self._ros1 = self.hardware.ros == 1
        self._driven: tuple[Output, ...] = ()
        self._steered: tuple[Output, ...] = ()
        if self._ros1:
            self._configure_ros_1()
        else:
            self._configure_ros_2()
        self.outputs = (*self._driven, *self._steered)
        self.odometry: BicycleOdometry = BicycleOdometry(self._base, self._track)

    def _configure_ros_1(self) -> None:
        read = self.settings
        if not self.type.startswith("ackermann"):
            raise DescriptionError(f"`{self.type}` is a ROS 2 controller", position=read.group("type").position)
        self._driven = (self.hardware.output(_named(read, "rear_wheel", "rear_wheel_joint"), "velocity"),)
        self._steered = (self.hardware.output(_named(read, "front_steer", "front_steer_joint"), "position"),)
        self._track = 0.0
        self._base = self.positive("wheel_separation_h") * read.number("wheel_separation_h_multiplier", 1.0)
        self._command_radius = self.positive("wheel_radius")
        self._radius = self._command_radius * read.number("wheel_radius_multiplier", 1.0)
        self._share = read.number("steer_pos_multiplier", 1.0)
        self._open = read.flag("open_loop", False)
        self.limits = SpeedLimits(*(limits_of_ros_1(read.group(name)) for name in ("linear/x", "angular/z")))
        self.reference = usual_reference(self, read.number("cmd_vel_timeout", TIMEOUT))
        self.rate = read.number("publish_rate", RATE)
        self.publish_odometry()

    def _configure_ros_2(self) -> None:
        read = self.settings
        driven, steered = STEERED[self.type]
        front = "front" if read.flag("front_steering", True) else "rear"  # Humble names the wheels by axle
        of_traction, of_steering = traction_and_steering(read)
        track, radius = track_and_radius(read)
        self._driven = self._joints(of_traction, driven, "velocity")
        self._steered = self._joints(of_steering, steered, "position")
        self._base = self.positive("wheelbase")
        self._track = 0.0
        if driven == 2:
            self._track = self._positive(*track)
        self._steered_track = self._track
        if steered == 2 and (own := self._first("steering_track_width", f"{front}_wheel_track")):
            self._steered_track = self.positive(own)
        self._radius = self._positive(*radius)
        self._command_radius, self._share = self._radius, 1.0
        self._open = read.flag("open_loop", False)
        if read.flag("reduce_wheel_speed_until_steering_reached", False):
            self.note("`reduce_wheel_speed_until_steering_reached` is not simulated: wheels have their commanded speed")
        self.reference = usual_reference(self, read.number("reference_timeout", 1.0))
        self.rate = 1.0 / self.hardware.period
        self.publish_odometry(topic="odometry", transforms="tf_odometry", covariance=DIAGONAL)

    def _joints(self, names: tuple[str, ...], count: int, interface: str) -> tuple[Output, ...]:
        found = self.settings.texts(self._first(*names) or names[0])
        if len(found) != count:
            raise DescriptionError(
                f"`{names[0]}` names {len(found)} joints; `{self.type.partition('/')[2]}` has {count}, the right one "
                "first", position=self.settings.group(names[0]).place,
            )  # fmt: skip
        return tuple(self.hardware.output(entry, interface) for entry in found)

    def _first(self, *names: str) -> str | None:
        return next((name for name in names if self.settings.find(name) is not None), None)

    def _positive(self, *names: str) -> float:
        return self.positive(self._first(*names) or names[0])

    def start(self, state: State) -> None:
        """Start at rest, at the origin of the odometry frame."""
        self._speeds = (0.0, 0.0)
        super().start(state)

    def update(self, state: State, motors: Motors) -> float:
        """Write the wheel and steering commands, and update the odometry."""
        self.measure(state, self.odometry)
        target = self.reference.at(state.t)
        settled = self._steer(state, motors, target) if self._ros1 else self._follow(state, motors, target)
        return self.rest(state.t, settled=settled)

    def _steer(self, state: State, motors: Motors, target: Twist | None) -> bool:
        """Follow a command of ROS 1: wheel speed and steering angle."""
        v, _, angle = target or (0.0, 0.0, 0.0)
        v_now, angle_now = self.limits.limit((v, angle), self.hardware.period)
        (wheel,), (steering,) = self._driven, self._steered
        rest = min(wheel.write(state, motors, v_now / self._command_radius), steering.write(state, motors, angle_now))
        self._speeds = (v_now, angle_now)
        return rest > 0.0 and self.limits.settled((v, angle))

    def _follow(self, state: State, motors: Motors, target: Twist | None) -> bool:
        """Follow a command of ROS 2: speed of the axle's centre and yaw rate."""
        if target is None:
            self._speeds = (0.0, 0.0)
            rest = min(output.write(state, motors, 0.0) for output in self._driven)
            return min(rest, *(output.keep(state, motors) for output in self._steered)) > 0.0
        v, _, w = target
        angle = 0.0 if abs(v) < SLOW else atan(w * self._base / v)
        bend = tan(angle if self._open else self._measured_angle(state)) / self._base
        sides = (1.0, -1.0) if len(self._driven) == 2 else (0.0,)
        for output, side in zip(self._driven, sides, strict=True):
            output.write(state, motors, v / self._radius * (1.0 + side * bend * self._track / 2))
        left, right = steering_angles(tan(angle), self._steered_track / 2 / self._base)
        angles = (right, left) if len(self._steered) == 2 else (angle,)
        for output, own in zip(self._steered, angles, strict=True):
            output.write(state, motors, own)
        self._speeds = (v, w)
        return False

    # Odometry

    def _measured_angle(self, state: State) -> float:
        """Return the equivalent steering angle of a single wheel at the centre of the axle [rad]."""
        angles = [state.position(output.handle.name) * self._share for output in self._steered]
        if len(angles) == 1:
            return angles[0]
        half = self._steered_track / 2
        return sum(
            atan(self._base * tan(angle) / (self._base - side * half * tan(angle)))
            for angle, side in zip(angles, (1.0, -1.0), strict=True)
        ) / 2  # fmt: skip

    def measure(self, state: State, odometry: WheelOdometry) -> Twist:
        """Update the odometry to the present state, and return the measured velocity."""
        if self._open:  # open loop: integrate the commanded velocity
            v, w = self._speeds
            turning, period = v * tan(w) / self._base if self._ros1 else w, state.t - odometry.t
            odometry.t = state.t
            odometry.advance(v * period, 0.0, turning * period)
            return v, 0.0, turning
        angle = self._measured_angle(state)
        odometry.update(state.t, *(state.position(each.handle.name) * self._radius for each in self._driven), angle)
        speeds = [state.velocity(output.handle.name) * self._radius for output in self._driven]
        v = self.odometry.middle(speeds, angle)
        return v, 0.0, v * tan(angle) / self._base


def _named(read: Settings, path: str, default: str) -> Settings:
    """Return the parameter with the name of a joint, or its default."""
    return read.find(path) or Settings(path, read.position, default)
