"""Velocity control: the new Gazebo's VelocityControl, which gives the model a velocity in all six directions.

Source: gz-sim main, src/systems/velocity_control/VelocityControl.cc. It publishes no odometry.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.drives.planar_move import movable
from urdfkit.sim.plugins.drives.velocity_command import Command
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics

if TYPE_CHECKING:
    from urdfkit.description.plugins import PluginSpec
    from urdfkit.description.urdf.robot import Plugin
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


class VelocityControl(Drive):
    """The base has the commanded velocity, in its own axes, before every step; contacts come after.

    That holds from the start, without a command as well: such a robot does not fall.
    """

    kind = "velocity_control"

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        super().__init__(plugin, spec)
        self.read_rate = 1.0  # there is nothing to publish

    def configure(self, setup: Setup) -> None:
        """Read the parameters and subscribe.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """
        read = Parameters(self.plugin, self.spec, setup.names)
        if read.texts("link"):
            setup.note(f"{read.place('link')}: velocities of single links are not simulated, only that of the model")
        self._initial = (read.vector("initial_linear", 3), read.vector("initial_angular", 3))
        self._command = Command(setup, Topics(self.plugin, self.spec).resolve(read.text("command_topic")), self._heed)
        self.commands = (self._command.topic,)
        self.resting = not movable(setup, read)
        self._heard = False

    def _heed(self) -> None:
        self._heard = True

    def write(self, state: State, motors: Motors) -> None:
        """Give the base its velocity."""
        linear, angular = (self._command.linear, self._command.angular) if self._heard else self._initial
        motors.move_base(linear, angular)

    def read(self, state: State) -> None:
        """Publish nothing."""

    def reset(self) -> None:
        """Forget commands."""
        self._command.clear()
        self._heard = False
