"""Planar move: gazebo_ros_planar_move (ROS 1, ROS 2), which sets the velocity of the model without using wheels.

Sources: gazebo_ros_pkgs noetic-devel and ros2, gazebo_plugins/src/gazebo_ros_planar_move.cpp. Gazebo sets the velocity
of every link; urdfkit sets that of the root link, and joints keep their velocities.
"""

from math import cos, pi, remainder, sin

from urdfkit.description.plugins import PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.sim.plugins.drives.odometry_parameters import odometry_topics
from urdfkit.sim.plugins.drives.velocity_drive import VelocityDrive
from urdfkit.sim.plugins.odometry import Estimate
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.quaternion import rotate, yaw_of
from urdfkit.sim.state.robot_state import State


class PlanarMove(VelocityDrive):
    """Sets the planar velocity and the yaw rate of the base to the command; the vertical velocity is zero.

    ROS 1 sets the velocity before each step, so gravity and friction act for one step only. ROS 2 sets it at the update
    rate; gravity and friction act in between. Contacts are solved afterwards, so a wall stops the robot.
    """

    kind = "planar_move"

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        super().__init__(plugin, spec)
        self._ros1 = spec.generation == "ros1"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = self.topic_names()
        self._movable = movable(setup, read)
        self.subscribe(setup, topics.resolve(read.text("command_topic", "cmd_vel")))
        self.write_rate = 0.0 if self._ros1 else read.number("update_rate")
        self.read_rate = read.number("odometry_rate")
        published = self.read_rate > 0 if self._ros1 else read.flag("publish_odometry")
        if self._ros1 and not published:
            self.read_rate = 1.0  # nothing to publish at every step
        self.topics = odometry_topics(
            setup,
            read,
            topics,
            published=published,
            with_tf=published if self._ros1 else read.flag("publish_odometry_tf"),
            twist_covariance=not self._ros1,
            flat=self._ros1,
        )
        old = bool(setup.distro.name) and setup.distro.name != "noetic"
        self._timeout = -1.0 if old else read.number("command_timeout", -1.0)
        self._last_command = (0, 0.0)
        self._before: tuple[float, float, float, float] | None = None

    def write(self, state: State, motors: Motors) -> None:
        """Set the velocity of the base."""
        rotation = x, y, z, w = state.base_pose[3:]
        heading = yaw_of(rotation)
        if self._before is None:
            self._before = _place(state, heading)
        if not self._movable:
            return
        if self._timeout >= 0:
            if self._last_command[0] != self.command.count:
                self._last_command = (self.command.count, state.t)
            elif state.t - self._last_command[1] > self._timeout:
                self.command.clear()
        (ahead, aside, _), turning = self.command.linear, self.command.angular[2]
        cosine, sine = cos(heading), sin(heading)
        along, across = ahead * cosine - aside * sine, aside * cosine + ahead * sine
        back = (-x, -y, -z, w)
        motors.move_base(rotate(back, (along, across, 0.0)), rotate(back, (0.0, 0.0, turning)))

    @property
    def published(self) -> None:
        """Return None: `read` computes mean velocities between two calls."""
        return

    def read(self, state: State) -> None:
        """Publish the true pose in the world, in ROS 1 with the mean velocity since the last message."""
        now = self.measure(state, None)
        if self._ros1:
            now = self._difference(state, now)
        assert self.topics is not None
        self.topics.publish(state.t, now)

    def _difference(self, state: State, now: Estimate) -> Estimate:
        """Return the estimate with the mean velocity since the last message, in the base frame."""
        heading = yaw_of(state.base_pose[3:])
        t, x, y, last = self._before or _place(state, heading)
        period = state.t - t
        here = self._before = _place(state, heading)
        if period <= 0:
            return now
        vx, vy = (here[1] - x) / period, (here[2] - y) / period
        w = self.command.angular[2]
        if w <= pi / period:  # faster rotations are ambiguous: keep the commanded yaw rate
            w = remainder(heading - last, 2 * pi) / period
        linear = (cos(heading) * vx + sin(heading) * vy, cos(heading) * vy - sin(heading) * vx, 0.0)
        return Estimate(now.position, now.quaternion, linear, (0.0, 0.0, w))

    def reset(self) -> None:
        """Clear commands and odometry."""
        super().reset()
        self._last_command = (self.command.count, 0.0)
        self._before = None


def movable(setup: Setup, read: Parameters) -> bool:
    """Return whether the robot's base can move; report a warning if it cannot."""
    if not setup.kinematics.floating_base:
        setup.note(f"{read.place('command_topic')}: the robot has a fixed base, so this plugin cannot move it")
    return bool(setup.kinematics.floating_base)


def _place(state: State, heading: float) -> tuple[float, float, float, float]:
    return state.t, state.base_pose[0], state.base_pose[1], heading
