"""Mecanum drive: the new Gazebo's MecanumDrive, four wheels with rollers at 45° (friction along ``<fdir1>`` only).

Source: gz-sim main, src/systems/mecanum_drive/MecanumDrive.cc.
"""

from __future__ import annotations

from copy import copy
from typing import TYPE_CHECKING

from urdfkit.errors import SimulationError
from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.drives.odometry_output import from_mecanum, odometer
from urdfkit.sim.plugins.drives.velocity_command import Command
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.speed_limits import limiter
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.plugins.wheel_odometry import MecanumOdometry

if TYPE_CHECKING:
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State

CORNERS = {
    "front_left_joint": (-1, -1),
    "front_right_joint": (1, 1),
    "back_left_joint": (1, -1),
    "back_right_joint": (-1, 1),
}
"""With which sign a wheel's rate has the velocity to the left, and the yaw rate."""


class MecanumDrive(Drive):
    """Wheels turned at vx ± vy ± w·(separation + base)/2. A command holds until the next one."""

    kind = "mecanum_drive"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """
        read = Parameters(self.plugin, self.spec, setup.names)
        topics = Topics(self.plugin, self.spec)
        self._setup = setup
        self._joints = {corner: self._find(setup, read, corner) for corner in CORNERS}
        separation = read.number("wheel_separation", positive=True)
        self._reach = (separation + read.number("wheel_base", positive=True)) / 2
        self._radius = read.number("wheel_radius", positive=True)
        # Forward and sideways share their limits, not their past.
        self._limiters = (limiter(read, "linear"), limiter(read, "linear"), limiter(read, "angular"))
        self.read_rate = read.number("odometry_rate")
        self._command = Command(setup, topics.resolve(read.text("command_topic")), self._wake)
        self.commands = (self._command.topic,)
        self._odometer = odometer(setup, read, topics, published=True, with_tf=True)
        self._odometry = MecanumOdometry(self._reach)
        self._last_read = 0.0

    def _find(self, setup: Setup, read: Parameters, corner: str) -> tuple[str, ...]:
        names = read.texts(corner)
        if not names:
            raise SimulationError(
                f"no <{read.tag(corner)}>; this drive needs at least one", position=read.place(corner)
            )
        return tuple(setup.joint(name, read.place(corner)) for name in names)

    def _wake(self) -> None:
        self.resting = False

    def write(self, state: State, motors: Motors) -> None:
        """Set the wheels' velocity motors."""
        if not self._odometry.started:
            self._odometry.update(*self._rolled(state))
        asked = (*self._command.linear[:2], self._command.angular[2])
        pairs = tuple(zip(self._limiters, asked, strict=True))
        vx, vy, w = (limited.limit(wanted, self._setup.dt) for limited, wanted in pairs)
        self.resting = all(limited.settled(wanted) for limited, wanted in pairs)
        for corner, (left, turn) in CORNERS.items():
            for joint in self._joints[corner]:
                motors.drive(joint, (vx + left * vy + turn * w * self._reach) / self._radius)

    def read(self, state: State) -> None:
        """Publish odometry from the first wheel of each corner."""
        self._odometry.update(*self._rolled(state))
        now = from_mecanum(self._odometry, state.t - self._last_read or self._setup.dt)
        self._last_read = state.t
        self._odometer.publish(state.t, lambda: now)

    def _rolled(self, state: State) -> tuple[float, float, float, float]:
        first = [state.position(joints[0]) * self._radius for joints in self._joints.values()]
        return first[0], first[1], first[2], first[3]

    def estimate(self, state: State) -> dict[str, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return where the drive believes the robot to be."""
        ahead = copy(self._odometry)
        ahead.update(*self._rolled(state))
        now = from_mecanum(ahead, self._setup.dt)
        return {self._odometer.frame: (now.position, now.quaternion)}

    def reset(self) -> None:
        """Forget commands and odometry."""
        self._command.clear()
        self.resting = False
        for limited in self._limiters:
            limited.reset()
        self._odometry = MecanumOdometry(self._reach)
        self._last_read = 0.0
