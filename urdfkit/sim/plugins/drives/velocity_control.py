"""Velocity control: gz sim's VelocityControl, which sets the linear and angular velocity of the model.

Source: gz-sim main, src/systems/velocity_control/VelocityControl.cc. It publishes no odometry.
"""

from urdfkit.bus import Topic
from urdfkit.sim.plugins.drives.planar_move import movable
from urdfkit.sim.plugins.drives.velocity_drive import VelocityDrive
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State


class VelocityControl(VelocityDrive):
    """Sets the velocity of the base, in the base frame, before each step; contacts are solved afterwards.

    The velocity is set from the start on, even before the first command, so gravity does not move the robot.
    """

    kind = "velocity_control"
    read_rate = 1.0  # nothing to publish

    def configure(self, setup: Setup) -> None:
        """Read the parameters and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        if read.texts("link"):
            setup.note(
                f"{read.place('link')}: velocities of single links are not simulated, only the velocity of the model"
            )
        self._ignored = 0  # commands before the last reset
        self._initial = (read.vector("initial_linear", 3), read.vector("initial_angular", 3))
        self._movable = movable(setup, read)
        self.subscribe(setup, self.topic_names().resolve(read.text("command_topic")))
        self.resting = not self._movable

    def wake(self) -> None:
        """Call `write` again, unless the base is fixed."""
        self.resting = not self._movable

    def write(self, state: State, motors: Motors) -> None:
        """Set the velocity of the base."""
        commanded = self.command.count > self._ignored
        linear, angular = (self.command.linear, self.command.angular) if commanded else self._initial
        motors.move_base(linear, angular)

    @property
    def published(self) -> tuple[Topic, ...]:
        """Return no topics."""
        return ()

    def read(self, state: State) -> None:
        """Publish nothing."""

    def reset(self) -> None:
        """Return to the initial velocity."""
        super().reset()
        self.wake()
        self._ignored = self.command.count
