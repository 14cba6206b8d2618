"""Ackermann steering: the new Gazebo's AckermannSteering. The command's angular.z is the yaw rate.

Source: gz-sim main, src/systems/ackermann_steering/AckermannSteering.cc.
"""

from __future__ import annotations

from copy import copy
from math import atan, copysign, cos, isfinite, sin
from typing import TYPE_CHECKING, Any

from urdfkit.errors import SimulationError
from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.drives.gazebo_pid import Pid
from urdfkit.sim.plugins.drives.odometry_output import from_wheels, odometer
from urdfkit.sim.plugins.drives.velocity_command import Command
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.speed_limits import limiter
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.plugins.wheel_odometry import BicycleOdometry

if TYPE_CHECKING:
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State

STRAIGHT = 0.001
"""Yaw rates smaller than this [rad/s] mean straight on."""

FAR = 1e9
"""The radius [m] of straight on."""

STEERED = 1e-6
"""Steering that is nearer to its target than this [rad] may be left alone while nothing changes."""


class AckermannSteering(Drive):
    """Wheels turned as by a differential, steered wheels turned towards their angles by a PID law on the joint's speed.

    With ``steering_only`` the command is the steering angle and no wheel is driven.
    """

    kind = "ackermann_steering"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """
        read = Parameters(self.plugin, self.spec, setup.names)
        topics = Topics(self.plugin, self.spec)
        self._setup = setup
        self._only_steers = read.flag("steering_only")
        if read.flag("use_actuator_message"):
            raise SimulationError(
                "steering by actuator messages is not simulated; leave <use_actuator_msg> out and command by Twist",
                position=read.place("use_actuator_message"),
            )
        self._left_steering = self._find(setup, read, "left_steering_joint")
        self._right_steering = self._find(setup, read, "right_steering_joint")
        self._separation = read.number("wheel_separation", positive=True)
        self._base = read.number("wheel_base", positive=True)
        self._steepest = read.number("max_steer", positive=True)
        self._pid = Pid(
            read.number("steer_p"),
            read.number("steer_i"),
            read.number("steer_d"),
            read.number("steer_i_min"),
            read.number("steer_i_max"),
            (read.number("steer_min"), read.number("steer_max")),
            read.number("steer_offset"),
        )
        self._limiters = (limiter(read, "linear"), limiter(read, "angular"))
        self._angle = 0.0
        self._listen(setup, read, topics)
        if not self._only_steers:
            self._left, self._right = self._find(setup, read, "left_joint"), self._find(setup, read, "right_joint")
            self._radius = read.number("wheel_radius", positive=True)
            self._kingpin = read.number("kingpin_width", positive=True)
            self._odometer = odometer(setup, read, topics, published=True, with_tf=True)
            self._odometry = BicycleOdometry(self._base)
            self._last_read = 0.0
        self.read_rate = read.number("odometry_rate")

    def _find(self, setup: Setup, read: Parameters, meaning: str) -> tuple[str, ...]:
        names = read.texts(meaning)
        if not names:
            raise SimulationError(
                f"no <{read.tag(meaning)}>; this drive needs at least one", position=read.place(meaning)
            )
        return tuple(setup.joint(name, read.place(meaning)) for name in names)

    def _listen(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        name = "steer_angle" if self._only_steers else "cmd_vel"
        topic = read.text("command_topic") or f"/model/{setup.model}/{read.text('command_subtopic', name)}"
        self._topic = topics.resolve(topic)
        if self._only_steers:
            setup.bus.subscribe(self._topic, "std_msgs/msg/Float64", self._steer)
        else:
            self._command = Command(setup, self._topic, self._wake)
            self.commands = (self._topic,)

    def _wake(self) -> None:
        self.resting = False

    def _steer(self, message: Any) -> None:
        angle = float(message.data)
        if not isfinite(angle):
            self._setup.note(f"dropped a command on {self._topic}: {angle:g} rad is not finite")
            return
        self._angle = angle
        self.resting = False

    # Before the step

    def write(self, state: State, motors: Motors) -> None:
        """Set the velocities of wheels and steering."""
        dt = self._setup.dt
        linear, angular = self._limiters
        if self._only_steers:
            wanted = angular.limit(self._angle, dt)
            self._targets = self._held(max(-self._steepest, min(self._steepest, wanted)))
            settled = angular.settled(self._angle)
        else:
            if not self._odometry.started:
                self._odometry.update(*self._rolled(state))
            asked = self._command.linear[0], self._command.angular[2]
            v, w = linear.limit(asked[0], dt), angular.limit(asked[1], dt)
            settled = linear.settled(asked[0]) and angular.settled(asked[1])
            self._drive(v, w, motors)
        for joints, target in ((self._left_steering, self._targets[0]), (self._right_steering, self._targets[1])):
            self._pid.reset()
            speed = self._pid.update(state.position(joints[0]) - target, dt)
            for joint in joints:
                motors.drive(joint, speed)
        self.resting = settled and self._steered(state)

    def _drive(self, v: float, w: float, motors: Motors) -> None:
        """Turn the wheels, and find where the steered ones have to point."""
        tightest = self._base / sin(self._steepest)
        if abs(w) < STRAIGHT:
            radius = FAR
        elif v != 0.0:
            radius = v / w
            radius = copysign(max(abs(radius), tightest), radius)
        else:
            radius = copysign(tightest, w)
        self._targets = (
            atan(self._base / (radius - self._kingpin / 2)),
            atan(self._base / (radius + self._kingpin / 2)),
        )
        # tan(atan(base / radius)) · separation / (2 · base), a simple differential
        share = self._separation / (2 * radius)
        for joints, speed in ((self._left, v * (1 - share)), (self._right, v * (1 + share))):
            for joint in joints:
                motors.drive(joint, speed / self._radius)

    def _held(self, angle: float) -> tuple[float, float]:
        """Return the angles [rad] of the left and the right wheel for a steering angle."""
        rise, run, half = self._base * sin(angle), self._base * cos(angle), self._separation * sin(angle) / 2
        return atan(rise / (run - half)), atan(rise / (run + half))

    def _steered(self, state: State) -> bool:
        pairs = zip((self._left_steering, self._right_steering), self._targets, strict=True)
        return all(abs(state.position(joints[0]) - target) < STEERED for joints, target in pairs)

    # After the step

    def read(self, state: State) -> None:
        """Publish odometry: distance of the first wheels along the mean of the first steering angles."""
        if self.resting and not self._steered(state):
            self.resting = False
        if self._only_steers:
            return
        self._odometry.update(*self._rolled(state))
        now = from_wheels(self._odometry, state.t - self._last_read or self._setup.dt, signed=True)
        self._last_read = state.t
        self._odometer.publish(state.t, lambda: now)

    def _rolled(self, state: State) -> tuple[float, float]:
        turned = state.position(self._left[0]) + state.position(self._right[0])
        steered = state.position(self._left_steering[0]) + state.position(self._right_steering[0])
        return turned / 2 * self._radius, steered / 2

    def estimate(self, state: State) -> dict[str, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return where the drive believes the robot to be."""
        if self._only_steers:
            return {}
        ahead = copy(self._odometry)
        ahead.update(*self._rolled(state))
        now = from_wheels(ahead, self._setup.dt, signed=True)
        return {self._odometer.frame: (now.position, now.quaternion)}

    def reset(self) -> None:
        """Forget commands and odometry."""
        self._angle = 0.0
        self.resting = False
        for limited in self._limiters:
            limited.reset()
        if not self._only_steers:
            self._command.clear()
            self._odometry = BicycleOdometry(self._base)
            self._last_read = 0.0
