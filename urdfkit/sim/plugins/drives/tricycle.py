"""Tricycle drive: gazebo_ros_tricycle_drive (ROS 1, ROS 2). The command's angular.z is the steering angle, not a rate.

Sources: gazebo_ros_pkgs noetic-devel and ros2, gazebo_plugins/src/gazebo_ros_tricycle_drive.cpp. Three bugs of the
plugin are fixed here: with a steering speed it compares the steering error with the speed of the wheel, and so steers
away from most targets; its encoders have the wrong sign; its velocity is in the odometry frame, not in the base frame.
"""

from math import pi

from urdfkit.sim.plugins.drives.odometry_parameters import by_encoder, odometry_topics
from urdfkit.sim.plugins.drives.velocity_drive import VelocityDrive, put
from urdfkit.sim.plugins.drives.wheel_messages import Wheels
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.wheel_odometry import DifferentialOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.periodic_steps import PeriodicSteps
from urdfkit.sim.state.robot_state import State


class Tricycle(VelocityDrive):
    """Drives and steers one wheel; two other wheels have encoders. The steering angle is limited to ±90°.

    Acceleration limits apply to the wheel's rotation [rad/s²]. Without a steering speed, the angle is set directly.
    """

    kind = "tricycle"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = self.topic_names(setup.model)
        self._setup = setup
        self._steering, self._actuated, self._left, self._right = (
            setup.joint(read.text(meaning), read.place(meaning))
            for meaning in ("steering_joint", "actuated_joint", "left_joint", "right_joint")
        )
        self._radius = read.number("actuated_diameter") / 2
        self._encoder_radius = read.number("encoder_diameter") / 2
        self._torque = read.number("max_wheel_torque")
        self._faster = read.number("max_wheel_acceleration")
        self._slower = read.number("max_wheel_deceleration", self._faster)
        self._wheel_tolerance = read.number("wheel_tolerance")
        self._steering_speed = read.number("steering_speed")
        self._steering_tolerance = read.number("steering_tolerance")
        self.write_rate = self.read_rate = read.number("update_rate")
        self._period = PeriodicSteps(self.write_rate, setup.dt).period
        self.subscribe(setup, topics.resolve(read.text("command_topic", "cmd_vel")))
        separation = read.number("wheel_separation")
        if by_encoder(read):
            wheels = self._left, self._right
            self.odometry = DifferentialOdometry(separation, wheels, self._encoder_radius)
        published = self.spec.generation == "ros1" or read.flag("publish_odometry")
        self.topics = odometry_topics(setup, read, topics, published=published, with_tf=published)
        self.wheels = Wheels(
            setup,
            (self._steering, self._actuated, self._left, self._right),
            with_tf=read.flag("publish_wheel_tf"),
            states=topics.resolve("joint_states") if read.flag("publish_wheel_joint_state") else None,
            measured=True,
            named_by_joint=True,
        )

    def write(self, state: State, motors: Motors) -> None:
        """Set the velocities of the driven wheel and of the steering joint."""
        self.start_odometry(state)
        motors.drive(self._actuated, self._speed(state), self._torque)
        angle = max(-pi / 2, min(pi / 2, self.command.angular[2]))
        if self._steering_speed <= 0:
            put(self._steering, angle, self._period, setup=self._setup, state=state, motors=motors)
            return
        missing = angle - state.position(self._steering)
        speed = 0.0
        if abs(missing) >= self._steering_tolerance:
            speed = self._steering_speed if missing > 0 else -self._steering_speed
        motors.drive(self._steering, speed, self._torque)

    def _speed(self, state: State) -> float:
        """Return the wheel speed within the acceleration limits [rad/s]."""
        target = self.command.linear[0] / self._radius
        if self._faster <= 0 and self._slower <= 0:
            return target
        now = state.velocity(self._actuated)
        if abs(now - target) < self._wheel_tolerance:
            return now
        if target - now > self._faster * self._period:
            return now + self._faster * self._period
        if now - target > self._slower * self._period:
            return now - self._slower * self._period
        return target
