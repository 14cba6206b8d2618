"""Controllers that forward commands to the hardware, for one joint or a group.

Sources: ros_controllers noetic, forward_command_controller, {position,velocity,effort}_controllers; ros2_controllers,
forward_command_controller.
"""

from typing import ClassVar

from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.messages import FLOAT, FLOATS
from urdfkit.sim.plugins.controllers.command_output import INTERFACES, PositionOutput
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.setup import LARGEST, is_command
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State


class Forward(RosController):
    """Forwards commands to one joint: ``command`` (Float64)."""

    types: ClassVar[dict[str, str]] = {
        "position_controllers/JointPositionController": "position",
        "velocity_controllers/JointVelocityController": "velocity",
        "effort_controllers/JointEffortController": "effort",
    }

    def configure(self) -> None:
        """Read the parameters and subscribe.

        Raises:
            DescriptionError: no joint, or a joint without the command interface.
        """
        output = self.hardware.output(self.settings.entry("joint"), self.types[self.type])
        self.outputs = (output,)
        self.listen(self.topic("command"), FLOAT, lambda message: self.take([float(message.data)]))
        if isinstance(output, PositionOutput) and output.joint_pid is None and self.settings.find("pid") is not None:
            self.hardware.setup.note(
                f"{self.settings.place.file}: {self.type} does not read `pid`: the hardware uses "
                "gazebo_ros_control/pid_gains/JOINT; without these gains it sets the position with any effort"
            )

    def start(self, state: State) -> None:
        """Start from the present state."""
        super().start(state)
        self._values = [output.command for output in self.outputs]

    def take(self, values: list[float]) -> None:
        """Accept a command; drop it with a warning if its length is wrong or a value is not finite."""
        if len(values) != len(self.outputs):
            self.note(f"dropped a command of {len(values)} values; it has {len(self.outputs)} joints")
        elif not is_command(values):
            self.note(f"dropped a command that is not finite, or above {LARGEST:g}")
        else:
            self._values = values

    def update(self, state: State, motors: Motors) -> float:
        """Write the commands of the joints."""
        return min(output.write(state, motors, value) for output, value in zip(self.outputs, self._values, strict=True))


class ForwardGroup(Forward):
    """Forwards commands to several joints: ``command`` (ROS 1) or ``commands`` (ROS 2), Float64MultiArray."""

    types: ClassVar[dict[str, str]] = {
        "position_controllers/JointGroupPositionController": "position",
        "velocity_controllers/JointGroupVelocityController": "velocity",
        "effort_controllers/JointGroupEffortController": "effort",
        "forward_command_controller/ForwardCommandController": "",
    }

    def configure(self) -> None:
        """Read the parameters and subscribe.

        Raises:
            DescriptionError: no joints, or a joint without the command interface.
        """
        interface = self.types[self.type] or self.settings.text("interface_name")
        if interface not in INTERFACES:
            raise DescriptionError(
                f"unknown interface `{interface}`" + did_you_mean(interface, INTERFACES) + f" "
                f"(available: {', '.join(INTERFACES)})",
                position=self.settings.group("interface_name").position,
            )
        joints = self.settings.texts("joints", required=True)
        named = self.settings.find("interface_name")
        place = None if named is None else named.position
        self.outputs = tuple(self.hardware.output(entry, interface, place) for entry in joints)
        topic = self.topic("command" if self.hardware.ros == 1 else "commands")
        self.listen(topic, FLOATS, lambda message: self.take([float(value) for value in message.data]))
