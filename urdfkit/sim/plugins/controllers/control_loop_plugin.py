"""Base of the plugins that run a control loop: gazebo_ros_control and gz_ros2_control."""

from urdfkit.sim.plugins.base import Controller
from urdfkit.sim.plugins.controllers.control_loop import ControlLoop
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State


class ControlLoopPlugin(Controller):
    """A plugin that runs the controllers of a controller manager."""

    loop: ControlLoop

    def begin(self, state: State) -> None:
        """Start from the initial state."""
        self.loop.begin(state)

    def next(self, step: int) -> int:
        """Return the first step at or after `step` before which `write` is due."""
        return self.loop.next(step)

    def write(self, state: State, motors: Motors) -> None:
        """Update the controllers."""
        self.loop.update(state, motors)
