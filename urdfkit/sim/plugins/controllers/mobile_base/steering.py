"""Controllers of robots that are steered: bicycle, tricycle and Ackermann.

Sources: ros2_controllers, steering_controllers_library (steering_odometry.cpp, steering_controllers_library.cpp) and
the three controllers on it; ros_controllers noetic, ackermann_steering_controller.cpp.
"""

from __future__ import annotations

from math import atan, atan2, cos, sin, tan
from typing import TYPE_CHECKING, ClassVar

from urdfkit.errors import DescriptionError
from urdfkit.sim.plugins.controllers.controller import Law
from urdfkit.sim.plugins.controllers.mobile_base.diff_drive import RATE, TIMEOUT, limits_of_ros_1
from urdfkit.sim.plugins.controllers.mobile_base.odometry import Reckoning
from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import Reference
from urdfkit.sim.plugins.wheel_odometry import BicycleOdometry, along_arc

if TYPE_CHECKING:
    from urdfkit.description.control import Settings
    from urdfkit.sim.plugins.controllers.command_output import Output
    from urdfkit.sim.plugins.speed_limits import SpeedLimiter
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State

SLOW = 1.1920929e-07
"""Speeds below this [m/s] have no steering angle (``std::numeric_limits<float>::epsilon``)."""

COVARIANCE = (0.0, 7.0, 14.0, 21.0, 28.0, 35.0)
"""Default of ROS 2, as odd as it is."""


class SteeringController(Law):
    """Driven wheels and steered wheels: one of each, two driven, or two of both, the right one first.

    ROS 2 takes the yaw rate on ``reference``, and stops the wheels when references cease; the steering stays. ROS 1 has
    the bicycle only, takes the steering *angle* on ``cmd_vel``, and steers straight on when commands cease.
    """

    types: ClassVar[dict[str, str]] = {
        "bicycle_steering_controller/BicycleSteeringController": "1 1",
        "tricycle_steering_controller/TricycleSteeringController": "2 1",
        "ackermann_steering_controller/AckermannSteeringController": "2 2",
    }

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a joint or a measure is missing, or a parameter makes no sense.
        """
        self._ros1 = self.hardware.ros == 1
        self._driven: tuple[Output, ...] = ()
        self._steered: tuple[Output, ...] = ()
        self._limiters: tuple[SpeedLimiter, ...] = ()
        if self._ros1:
            self._configure_ros_1()
        else:
            self._configure_ros_2()
        self.outputs = (*self._driven, *self._steered)
        self._speeds = (0.0, 0.0)

    def _configure_ros_1(self) -> None:
        read = self.settings
        if not self.type.startswith("ackermann"):
            raise DescriptionError(f"`{self.type}` is one of ROS 2", position=read.group("type").position)
        self._driven = (self.hardware.output(_named(read, "rear_wheel", "rear_wheel_joint"), "velocity"),)
        self._steered = (self.hardware.output(_named(read, "front_steer", "front_steer_joint"), "position"),)
        self._track = 0.0
        self._base = self._positive("wheel_separation_h") * read.number("wheel_separation_h_multiplier", 1.0)
        self._command_radius = self._positive("wheel_radius")
        self._radius = self._command_radius * read.number("wheel_radius_multiplier", 1.0)
        self._share = read.number("steer_pos_multiplier", 1.0)
        self._open = read.flag("open_loop", False)
        self._limiters = (limits_of_ros_1(read.group("linear/x")), limits_of_ros_1(read.group("angular/z")))
        self._reference = Reference(self, read.number("cmd_vel_timeout", TIMEOUT))
        self._rate = read.number("publish_rate", RATE)
        self.reckoning = Reckoning(self, self._reckon, self._rate)

    def _configure_ros_2(self) -> None:
        read = self.settings
        driven, steered = (int(number) for number in self.types[self.type].split())
        ahead = read.flag("front_steering", True)  # Humble named the wheels by where they are
        rear, front = ("rear", "front") if ahead else ("front", "rear")
        self._driven = self._joints(("traction_joints_names", f"{rear}_wheels_names"), driven, "velocity")
        self._steered = self._joints(("steering_joints_names", f"{front}_wheels_names"), steered, "position")
        self._base = self._positive("wheelbase")
        self._track = 0.0
        if driven == 2:
            self._track = self._positive("traction_track_width", f"{rear}_wheel_track", "wheel_track")
        self._steered_track = self._track
        if steered == 2 and (own := self._first("steering_track_width", f"{front}_wheel_track")):
            self._steered_track = self._positive(own)
        self._radius = self._positive(
            "traction_wheels_radius", "traction_wheel_radius", f"{rear}_wheels_radius", f"{rear}_wheel_radius"
        )
        self._command_radius, self._share = self._radius, 1.0
        self._open = read.flag("open_loop", False)
        if read.flag("reduce_wheel_speed_until_steering_reached", False):
            self.note("`reduce_wheel_speed_until_steering_reached` is not simulated: wheels turn as they are told")
        self._reference = Reference(self, read.number("reference_timeout", 1.0))
        self._rate = 1.0 / self.hardware.period
        self.reckoning = Reckoning(
            self, self._reckon, self._rate, topic="odometry", transforms="tf_odometry", covariance=COVARIANCE
        )

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
        name = self._first(*names) or names[0]
        value = self.settings.number(name)
        if value <= 0.0:
            raise DescriptionError(
                f"`{name}` is {value:g} m; it must be greater than zero", position=self.settings.group(name).position
            )
        return value

    # At work

    def start(self, state: State) -> None:
        """Stand, and believe to be at the origin."""
        super().start(state)
        self._reference.clear()
        for limiter in self._limiters:
            limiter.reset()
        self._odometry = BicycleOdometry(self._base)
        self._rolled = self._turns(state)
        self._covered = 0.0
        self._angle = self._measured_angle(state)
        self._odometry.update(0.0, self._angle)
        self._speeds, self._then = (0.0, 0.0), state.t

    def update(self, state: State, motors: Motors) -> float:
        """Turn and steer the wheels, and keep the odometry."""
        self._integrate(state)
        wanted = self._reference.at(state.t)
        settled = self._steer(state, motors, wanted) if self._ros1 else self._follow(state, motors, wanted)
        return min(1.0 / self._rate, self._reference.left(state.t)) if settled else 0.0

    def _steer(self, state: State, motors: Motors, wanted: tuple[float, float, float] | None) -> bool:
        """Obey ROS 1: the speed of the wheel and the angle of the steering."""
        v, _, angle = wanted or (0.0, 0.0, 0.0)
        period = self.hardware.period
        now = tuple(limiter.limit(wish, period) for limiter, wish in zip(self._limiters, (v, angle), strict=True))
        (wheel,), (steering,) = self._driven, self._steered
        rest = min(wheel.write(state, motors, now[0] / self._command_radius), steering.write(state, motors, now[1]))
        self._speeds = (now[0], now[1])
        return rest > 0.0 and all(
            limiter.settled(wish) for limiter, wish in zip(self._limiters, (v, angle), strict=True)
        )

    def _follow(self, state: State, motors: Motors, wanted: tuple[float, float, float] | None) -> bool:
        """Obey ROS 2: the speed of the axle's middle and the yaw rate."""
        if wanted is None:
            self._speeds = (0.0, 0.0)
            rest = min(output.write(state, motors, 0.0) for output in self._driven)
            return min(rest, *(output.keep(state, motors) for output in self._steered)) > 0.0
        v, _, w = wanted
        angle = 0.0 if abs(v) < SLOW else atan(w * self._base / v)
        bend = tan(angle if self._open else self._measured_angle(state)) / self._base
        sides = (1.0, -1.0) if len(self._driven) == 2 else (0.0,)
        for output, side in zip(self._driven, sides, strict=True):
            output.write(state, motors, v / self._radius * (1.0 + side * bend * self._track / 2))
        sides = (1.0, -1.0) if len(self._steered) == 2 else (0.0,)
        for output, side in zip(self._steered, sides, strict=True):
            across = 2 * self._base * cos(angle) + side * self._steered_track * sin(angle) if side else 0.0
            own = atan2(2 * self._base * sin(angle), across) if side else angle
            output.write(state, motors, own)
        self._speeds = (v, w)
        return False

    # Odometry

    def _turns(self, state: State) -> list[float]:
        return [state.position(output.handle.name) * self._radius for output in self._driven]

    def _measured_angle(self, state: State) -> float:
        """Return the angle of the one wheel that would steer as those there are [rad]."""
        angles = [state.position(output.handle.name) * self._share for output in self._steered]
        if len(angles) == 1:
            return angles[0]
        half = self._steered_track / 2
        return sum(
            atan(self._base * tan(angle) / (self._base - side * half * tan(angle)))
            for angle, side in zip(angles, (1.0, -1.0), strict=True)
        ) / 2  # fmt: skip

    def _integrate(self, state: State) -> None:
        period, self._then = state.t - self._then, state.t
        if self._open:
            v, w = self._speeds
            self._advance(v * period, (v * tan(w) / self._base if self._ros1 else w) * period)
            return
        rolled, angle = self._turns(state), self._measured_angle(state)
        bend = tan((angle + self._angle) / 2) / self._base
        sides = (1.0, -1.0) if len(rolled) == 2 else (0.0,)
        steps = [
            (now - before) / (1.0 + side * bend * self._track / 2)
            for now, before, side in zip(rolled, self._rolled, sides, strict=True)
        ]
        self._rolled, self._angle = rolled, angle
        self._covered += sum(steps) / len(steps)
        self._odometry.update(self._covered, angle)

    def _advance(self, arc: float, turn: float) -> None:
        dx, dy = along_arc(arc, self._odometry.heading, turn)
        self._odometry.x += dx
        self._odometry.y += dy
        self._odometry.heading += turn

    def _reckon(self, state: State) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        self._integrate(state)
        here = (self._odometry.x, self._odometry.y, self._odometry.heading)
        if self._open:
            v, w = self._speeds
            return here, (v, 0.0, v * tan(w) / self._base if self._ros1 else w)
        bend = tan(self._angle) / self._base
        sides = (1.0, -1.0) if len(self._driven) == 2 else (0.0,)
        v = sum(
            state.velocity(output.handle.name) * self._radius / (1.0 + side * bend * self._track / 2)
            for output, side in zip(self._driven, sides, strict=True)
        ) / len(self._driven)  # fmt: skip
        return here, (v, 0.0, v * bend)


def _named(read: Settings, path: str, default: str) -> Settings:
    """Return a parameter that names a joint, also where it is left out."""
    from urdfkit.description.control import Settings

    return read.find(path) or Settings(path, read.position, default)
