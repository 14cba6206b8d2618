"""Ackermann steering: gz sim's AckermannSteering. The command's angular.z is the yaw rate.

Source: gz-sim main, src/systems/ackermann_steering/AckermannSteering.cc.
"""

from math import copysign, isfinite, sin, tan
from typing import Any

from urdfkit.bus import Topic
from urdfkit.errors import SimulationError
from urdfkit.sim.plugins.drives.odometry_parameters import odometry_topics
from urdfkit.sim.plugins.drives.velocity_drive import VelocityDrive, joints_of
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.speed_limits import SpeedLimits, limiter
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.plugins.wheel_geometry import steering_angles
from urdfkit.sim.plugins.wheel_odometry import EncoderOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.odometer import Encoder
from urdfkit.sim.state.pid import Gains, GazeboPid
from urdfkit.sim.state.robot_state import State

STRAIGHT = 0.001
"""Yaw rate below which the robot drives straight ahead [rad/s]."""

FAR = 1e9
"""Turning radius used for driving straight ahead [m]."""

STEERED = 1e-6
"""Steering error below which the drive rests until the targets change [rad]."""


class AckermannSteering(VelocityDrive):
    """Drives the wheels as a differential does, and steers by a PID with velocity output.

    With ``steering_only`` the command is the steering angle and no wheel is driven.
    """

    kind = "ackermann_steering"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = self.topic_names()
        self._setup = setup
        self._only_steers = read.flag("steering_only")
        if read.flag("use_actuator_message"):
            raise SimulationError(
                "steering by actuator messages is not simulated; remove <use_actuator_msg> and publish Twist commands",
                position=read.place("use_actuator_message"),
            )
        self._left_steering = joints_of(setup, read, "left_steering_joint")
        self._right_steering = joints_of(setup, read, "right_steering_joint")
        self._separation = read.number("wheel_separation")
        self._base = read.number("wheel_base")
        self._steepest = read.number("max_steer")
        gains = Gains(
            read.number("steer_p"), read.number("steer_i"), read.number("steer_d"),
            read.number("steer_i_min"), read.number("steer_i_max"),
        )  # fmt: skip
        self._pid = GazeboPid(gains, (read.number("steer_min"), read.number("steer_max")), read.number("steer_offset"))
        # The engine itself follows a velocity in proportion to the error.
        others = (gains.i, gains.d, self._pid.offset, sum(self._pid.bounds))
        self._in_proportion = gains.p > 0.0 and others == (0.0, 0.0, 0.0, 0.0)
        self.limits = SpeedLimits(limiter(read, "linear"), limiter(read, "angular"))
        self._angle = 0.0
        self._subscribe(setup, read, topics)
        if not self._only_steers:
            self._left, self._right = joints_of(setup, read, "left_joint"), joints_of(setup, read, "right_joint")
            self._radius = read.number("wheel_radius")
            self._kingpin = read.number("kingpin_width")
            self.topics = odometry_topics(setup, read, topics, published=True, with_tf=True)
            wheels = (Encoder(joints[0], self._radius / 2) for joints in (self._left, self._right))
            steering = (Encoder(joints[0], angle=0.5) for joints in (self._left_steering, self._right_steering))
            self.odometry = EncoderOdometry([*wheels, *steering], axles=self._base)
        self.read_rate = read.number("odometry_rate")

    def _subscribe(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        name = "steer_angle" if self._only_steers else "cmd_vel"
        topic = read.text("command_topic") or f"/model/{setup.model}/{read.text('command_subtopic', name)}"
        self._topic = topics.resolve(topic)
        if self._only_steers:
            setup.bus.subscribe(self._topic, "std_msgs/msg/Float64", self._steer)
        else:
            self.subscribe(setup, self._topic)

    def _steer(self, message: Any) -> None:
        angle = float(message.data)
        if not isfinite(angle):
            self._setup.note(f"dropped a command on {self._topic}: {angle:g} rad is not finite")
            return
        self._angle = angle
        self.resting = False

    # Before the step

    def write(self, state: State, motors: Motors) -> None:
        """Set the velocities of the wheels and of the steering joints."""
        dt = self._setup.dt
        self.start_odometry(state)
        targets = (0.0, self._angle) if self._only_steers else (self.command.linear[0], self.command.angular[2])
        v, w = self.limits.limit(targets, dt)
        settled = self.limits.settled(targets)
        if self._only_steers:
            slope = tan(max(-self._steepest, min(self._steepest, w)))
            self._targets = steering_angles(slope, self._separation / 2 / self._base)
        else:
            self._drive(v, w, motors)
        for joints, target in ((self._left_steering, self._targets[0]), (self._right_steering, self._targets[1])):
            if self._in_proportion:
                for joint in joints:
                    motors.approach(joint, target, rate=self._pid.gains.p, fastest=self._pid.bounds[1])
                continue
            self._pid.reset()
            speed = self._pid.update(state.position(joints[0]) - target, dt)
            for joint in joints:
                motors.drive(joint, speed)
        self.resting = settled and (self._in_proportion or self._steered(state))

    def _drive(self, v: float, w: float, motors: Motors) -> None:
        """Set the wheel velocities, and compute the steering angles."""
        tightest = self._base / sin(self._steepest)
        if abs(w) < STRAIGHT:
            radius = FAR
        elif v != 0.0:
            radius = v / w
            radius = copysign(max(abs(radius), tightest), radius)
        else:
            radius = copysign(tightest, w)
        self._targets = steering_angles(self._base / radius, self._kingpin / 2 / self._base)
        # Kinematics of a differential drive: tan(atan(base / radius)) · separation / (2 · base)
        share = self._separation / (2 * radius)
        for joints, speed in ((self._left, v * (1 - share)), (self._right, v * (1 + share))):
            for joint in joints:
                motors.drive(joint, speed / self._radius)

    def _steered(self, state: State) -> bool:
        pairs = zip((self._left_steering, self._right_steering), self._targets, strict=True)
        return all(abs(state.position(joints[0]) - target) < STEERED for joints, target in pairs)

    # After the step

    @property
    def published(self) -> tuple[Topic, ...] | None:
        """Topics of the odometry; None if `read` checks the steering."""
        return super().published if self._in_proportion else None

    def read(self, state: State) -> None:
        """Publish the odometry of the first wheels and the first steering joints."""
        if self.resting and not self._in_proportion and not self._steered(state):
            self.resting = False
        if not self._only_steers:
            super().read(state)

    def reset(self) -> None:
        """Clear commands and odometry."""
        super().reset()
        self._angle = 0.0
