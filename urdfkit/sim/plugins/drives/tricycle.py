"""Tricycle drive: gazebo_ros_tricycle_drive (ROS 1, ROS 2). The command's angular.z is the steering angle, not a rate.

Sources: gazebo_ros_pkgs noetic-devel and ros2, gazebo_plugins/src/gazebo_ros_tricycle_drive.cpp. Three slips of theirs
are mended: with a steering speed they compare the angle that is missing with the speed of the wheel, and so turn away
from most targets; their encoders turn the wrong way round; their encoders' velocity is along the odometry frame's axes.
"""

from __future__ import annotations

from copy import copy
from math import pi
from typing import TYPE_CHECKING

from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.drives.odometry_output import by_encoder, from_wheels, from_world, odometer
from urdfkit.sim.plugins.drives.steering_joints import put
from urdfkit.sim.plugins.drives.velocity_command import Command
from urdfkit.sim.plugins.drives.wheel_messages import Wheels
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.plugins.wheel_odometry import WheelOdometry
from urdfkit.sim.state.ticks import Ticks

if TYPE_CHECKING:
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


class Tricycle(Drive):
    """One wheel that is steered and driven, two with encoders. Angles beyond a right angle are cut.

    Accelerations are of the wheel's rotation [rad/s²]. Without a steering speed the steering is simply put where it
    shall be.
    """

    kind = "tricycle"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """
        read = Parameters(self.plugin, self.spec, setup.names)
        topics = Topics(self.plugin, self.spec, namespace=setup.model)
        self._setup = setup
        self._steering, self._actuated, self._left, self._right = (
            setup.joint(read.text(meaning), read.place(meaning))
            for meaning in ("steering_joint", "actuated_joint", "left_joint", "right_joint")
        )
        self._radius = read.number("actuated_diameter", positive=True) / 2
        self._encoder_radius = read.number("encoder_diameter", positive=True) / 2
        self._separation = read.number("wheel_separation", positive=True)
        self._torque = read.number("max_wheel_torque", unsigned=True)
        self._faster = read.number("max_wheel_acceleration", unsigned=True)
        self._slower = read.number("max_wheel_deceleration", self._faster, unsigned=True)
        self._wheel_tolerance = read.number("wheel_tolerance", unsigned=True)
        self._steering_speed = read.number("steering_speed", unsigned=True)
        self._steering_tolerance = read.number("steering_tolerance", unsigned=True)
        self.write_rate = self.read_rate = read.number("update_rate")
        self._period = Ticks(self.write_rate, setup.dt).period
        self._command = Command(setup, topics.resolve(read.text("command_topic", "cmd_vel")), lambda: None)
        self.commands = (self._command.topic,)
        self._encoder = by_encoder(read)
        published = self.spec.generation == "ros1" or read.flag("publish_odometry")
        self._odometer = odometer(setup, read, topics, published=published, with_tf=published)
        self._odometry = WheelOdometry(self._separation)
        self._last_read = 0.0
        self._wheels = Wheels(
            setup,
            (self._steering, self._actuated, self._left, self._right),
            with_tf=read.flag("publish_wheel_tf"),
            states=topics.resolve("joint_states") if read.flag("publish_wheel_joint_state") else None,
            measured=True,
            named_by_joint=True,
        )

    def write(self, state: State, motors: Motors) -> None:
        """Set the velocities of the driven wheel and of the steering."""
        if not self._odometry.started:
            self._odometry.update(*self._rolled(state))
        motors.drive(self._actuated, self._speed(state), self._torque)
        angle = max(-pi / 2, min(pi / 2, self._command.angular[2]))
        if self._steering_speed <= 0:
            put(self._steering, angle, self._period, setup=self._setup, state=state, motors=motors)
            return
        missing = angle - state.position(self._steering)
        speed = 0.0
        if abs(missing) >= self._steering_tolerance:
            speed = self._steering_speed if missing > 0 else -self._steering_speed
        motors.drive(self._steering, speed, self._torque)

    def _speed(self, state: State) -> float:
        """Return the wheel's rate [rad/s] that the acceleration limits grant."""
        wanted = self._command.linear[0] / self._radius
        if self._faster <= 0 and self._slower <= 0:
            return wanted
        now = state.velocity(self._actuated)
        if abs(now - wanted) < self._wheel_tolerance:
            return now
        if wanted - now > self._faster * self._period:
            return now + self._faster * self._period
        if now - wanted > self._slower * self._period:
            return now - self._slower * self._period
        return wanted

    def read(self, state: State) -> None:
        """Publish odometry, wheel transforms and wheel states."""
        if self._encoder:
            self._odometry.update(*self._rolled(state))
            now = from_wheels(self._odometry, state.t - self._last_read or self._setup.dt, signed=True)
        else:
            now = from_world(state.base_pose, state.base_velocity)
        self._last_read = state.t
        self._odometer.publish(state.t, lambda: now)
        self._wheels.publish(state)

    def _rolled(self, state: State) -> tuple[float, float]:
        radius = self._encoder_radius
        return state.position(self._left) * radius, state.position(self._right) * radius

    def estimate(self, state: State) -> dict[str, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return where the drive believes the robot to be."""
        if not self._encoder:
            return {self._odometer.frame: (state.base_pose[:3], state.base_pose[3:])}
        ahead = copy(self._odometry)
        ahead.update(*self._rolled(state))
        now = from_wheels(ahead, self._setup.dt, signed=True)
        return {self._odometer.frame: (now.position, now.quaternion)}

    def reset(self) -> None:
        """Forget commands and odometry."""
        self._command.clear()
        self._odometry = WheelOdometry(self._separation)
        self._last_read = 0.0
