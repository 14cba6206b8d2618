"""Planar move: gazebo_ros_planar_move (ROS 1, ROS 2), which moves the model itself and looks at no wheels.

Sources: gazebo_ros_pkgs noetic-devel and ros2, gazebo_plugins/src/gazebo_ros_planar_move.cpp. Gazebo gives every link
the commanded velocity; here the root link has it, and joints go on moving as they did.
"""

from __future__ import annotations

from math import cos, pi, remainder, sin
from typing import TYPE_CHECKING

from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.drives.odometry_output import Estimate, from_world, odometer
from urdfkit.sim.plugins.drives.velocity_command import Command
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.state.quaternion import rotate, yaw_of

if TYPE_CHECKING:
    from urdfkit.description.plugins import PluginSpec
    from urdfkit.description.urdf.robot import Plugin
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


class PlanarMove(Drive):
    """The base has the commanded velocity in the plane, no vertical one, and turns about the vertical only.

    ROS 1 says so before every step, so gravity and friction act for one step at a time; ROS 2 at its update rate, and
    in between the robot sags and slips. Contacts come after, so a wall stops it.
    """

    kind = "planar_move"

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        super().__init__(plugin, spec)
        self._ros1 = spec.generation == "ros1"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """
        read = Parameters(self.plugin, self.spec, setup.names)
        topics = Topics(self.plugin, self.spec)
        self._movable = movable(setup, read)
        self._command = Command(setup, topics.resolve(read.text("command_topic", "cmd_vel")), lambda: None)
        self.commands = (self._command.topic,)
        self.write_rate = 0.0 if self._ros1 else read.number("update_rate")
        self.read_rate = read.number("odometry_rate")
        published = self.read_rate > 0 if self._ros1 else read.flag("publish_odometry")
        if self._ros1 and not published:
            self.read_rate = 1.0  # nothing to publish, and no reason to look at every step
        self._odometer = odometer(
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
        self._heard = (0, 0.0)
        self._before: tuple[float, float, float, float] | None = None

    def write(self, state: State, motors: Motors) -> None:
        """Give the base its velocity."""
        rotation = x, y, z, w = state.base_pose[3:]
        heading = yaw_of(rotation)
        if self._before is None:
            self._before = _place(state, heading)
        if not self._movable:
            return
        if self._timeout >= 0:
            if self._heard[0] != self._command.count:
                self._heard = (self._command.count, state.t)
            elif state.t - self._heard[1] > self._timeout:
                self._command.clear()
        (ahead, aside, _), turning = self._command.linear, self._command.angular[2]
        cosine, sine = cos(heading), sin(heading)
        along, across = ahead * cosine - aside * sine, aside * cosine + ahead * sine
        back = (-x, -y, -z, w)
        motors.move_base(rotate(back, (along, across, 0.0)), rotate(back, (0.0, 0.0, turning)))

    def read(self, state: State) -> None:
        """Publish odometry: the true pose in the world; in ROS 1 with the velocity since the message before."""
        now = from_world(state.base_pose, state.base_velocity)
        if self._ros1:
            now = self._difference(state, now)
        self._odometer.publish(state.t, lambda: now)

    def _difference(self, state: State, now: Estimate) -> Estimate:
        """Return the estimate with the velocity that the displacement since the last one makes, in the base's axes."""
        heading = yaw_of(state.base_pose[3:])
        t, x, y, last = self._before or _place(state, heading)
        period = state.t - t
        here = self._before = _place(state, heading)
        if period <= 0:
            return now
        vx, vy = (here[1] - x) / period, (here[2] - y) / period
        w = self._command.angular[2]
        if w <= pi / period:  # faster turns are ambiguous; then the command is what there is
            w = remainder(heading - last, 2 * pi) / period
        linear = (cos(heading) * vx + sin(heading) * vy, cos(heading) * vy - sin(heading) * vx, 0.0)
        return Estimate(now.position, now.quaternion, linear, (0.0, 0.0, w))

    def estimate(self, state: State) -> dict[str, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return where the robot is: this odometry knows."""
        return {self._odometer.frame: (state.base_pose[:3], state.base_pose[3:])}

    def reset(self) -> None:
        """Forget commands and odometry."""
        self._command.clear()
        self._heard = (self._command.count, 0.0)
        self._before = None


def movable(setup: Setup, read: Parameters) -> bool:
    """Return whether the robot's base can move; tell the user where it cannot."""
    if not setup.kinematics.floating_base:
        setup.note(f"{read.place('command_topic')}: the robot is bolted to the world, so this plugin cannot move it")
    return bool(setup.kinematics.floating_base)


def _place(state: State, heading: float) -> tuple[float, float, float, float]:
    return state.t, state.base_pose[0], state.base_pose[1], heading
