"""parallel_gripper_action_controller: a gripper of one joint, whose goals and results are joint states.

It replaces the other ROS 2 gripper controllers from Jazzy on.

Sources: ros2_controllers 4.20, parallel_gripper_controller; control_msgs, ParallelGripperCommand.action.
"""

from collections.abc import Callable
from typing import Any, ClassVar

from urdfkit.messages import JOINT_STATE, from_fields
from urdfkit.sim.plugins.controllers.actions.action_goal import RefusalError
from urdfkit.sim.plugins.controllers.joints.gripper import Gripper
from urdfkit.sim.state.robot_state import State


class ParallelGripper(Gripper):
    """Gripper with joint states as goals on ``gripper_cmd``: position commands only."""

    types: ClassVar[dict[str, str]] = {"parallel_gripper_action_controller/GripperActionController": "position"}
    kind = "control_msgs/msg/ParallelGripperCommand"

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: no joint, or an invalid parameter.
        """
        super().configure()
        for name in ("max_effort_interface", "max_velocity_interface"):
            if self.settings.text(name, ""):
                self.note(
                    f"`{name}` is ignored: Gazebo's hardware has no such interface, so the controller fails in Gazebo"
                )

    def command(self, position: float) -> dict[str, Any]:
        """Return the fields of a goal.

        Args:
            position: target [rad or m].
        """
        return {"command": {"name": [self._name], "position": [position]}}

    def _read(self, command: Any) -> tuple[float, float]:
        """Return the position of a goal; its velocity and effort need interfaces that Gazebo does not offer.

        Raises:
            RefusalError: the goal is not for exactly one joint.
        """
        if len(command.position) != 1:
            raise RefusalError(f"a gripper accepts one position, not {len(command.position)}")
        return float(command.position[0]), self._usual

    def _result(self, state: State, **more: bool) -> dict[str, Any]:
        joint = {"position": [state.position(self._name)], "effort": [state.effort(self._name)]}
        return {"state": {"name": [self._name], **joint}, **more}

    def _feedback(self, state: State) -> Callable[[], dict[str, Any]]:
        result = self._result(state)
        return lambda: {"state": from_fields(JOINT_STATE, result["state"])}
