"""gripper_action_controller: moves one joint until it reaches the goal position or stalls.

Sources: ros_controllers noetic, gripper_action_controller_impl.h; ros2_controllers, gripper_controllers.
"""

from collections.abc import Callable
from typing import Any, ClassVar

from urdfkit.errors import DescriptionError
from urdfkit.sim.plugins.controllers.actions.action_goal import ABORTED, SUCCEEDED, Action, RefusalError
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.controllers.joint_handle import JointPid
from urdfkit.sim.plugins.setup import is_command
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.pid import read_gains
from urdfkit.sim.state.robot_state import State

MONITOR_RATE = 20.0
"""Default ``action_monitor_rate`` [Hz]."""


class Gripper(RosController):
    """Gripper with goals on ``gripper_cmd``: position commands, or a PID (``gains/JOINT``) within ``max_effort``."""

    types: ClassVar[dict[str, str]] = {
        "position_controllers/GripperActionController": "position",
        "effort_controllers/GripperActionController": "effort",
    }
    kind: ClassVar[str] = "control_msgs/msg/GripperCommand"
    """Type of the goals; see `Action`."""

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a joint, its gains or another parameter is missing or invalid.
        """
        read = self.settings
        output = self.hardware.output(read.entry("joint"), self.types[self.type])
        self.outputs = (output,)
        self._name = output.handle.name
        self._joint_pid: JointPid | None = None
        self._usual = abs(read.number("max_effort", 0.0))
        if output.interface == "effort":
            gains = read_gains(read, f"gains/{self._name}", self.hardware.setup.note)
            if gains is None:
                raise DescriptionError(
                    f"`{self.name}` has no `gains/{self._name}`, which is required", position=read.place
                )
            self._joint_pid = JointPid(output.handle, gains, output.limits)
            if self._usual == 0.0:
                self.note("`max_effort` defaults to 0: without a goal the gripper exerts no force")
        self._near = abs(read.number("goal_tolerance", 0.01))
        self._still = read.number("stall_velocity_threshold", 0.001)
        self._patience = read.number("stall_timeout", 1.0)
        self._content = self.hardware.ros == 2 and read.flag("allow_stalling", False)
        self._action = Action(
            self, "gripper_cmd", self.kind, pursue=self._pursue, stop=self._hold,
            feedback=self._feedback, rate=read.number("action_monitor_rate", MONITOR_RATE),
            clock=lambda: self._present.t,
        )  # fmt: skip

    @property
    def joint_pids(self) -> tuple[JointPid, ...]:
        """The PID of the joint, for the effort interface."""
        return () if self._joint_pid is None else (self._joint_pid,)

    def start(self, state: State) -> None:
        """Hold the present position."""
        super().start(state)
        self._present = state
        self._action.give_up("the controller was restarted")
        if self._joint_pid is not None:
            self._joint_pid.integral.reset()
        self._hold()

    def stop(self) -> None:
        """Cancel the goal."""
        self._action.give_up("the controller was stopped")

    def _hold(self) -> None:
        self._wanted, self._most = self._present.position(self._name), self._usual

    def _pursue(self, goal: Any) -> None:
        """Accept a goal.

        Raises:
            RefusalError: the goal is not finite, or not for exactly one joint.
        """
        position, most = self._read(goal.command)
        if not is_command((position, most)):
            raise RefusalError(f"a gripper cannot move to {position} with {most}")
        self._wanted, self._most = position, abs(most)
        self._moved = self._present.t

    def update(self, state: State, motors: Motors) -> float:
        """Write the command, and check whether the goal is reached or the joint stalls."""
        goal = self._action.goal
        if goal is not None:
            self._judge(state)
        if self._joint_pid is None:
            rest = self.outputs[0].write(state, motors, self._wanted)
        else:
            position = self._joint_pid.handle.target(self._wanted, state.position(self._name))
            self._joint_pid.follow(state, motors, position, limit=self._most)
            rest = self._joint_pid.rest()
        return 0.0 if goal is not None else rest

    def _judge(self, state: State) -> None:
        position, velocity = state.position(self._name), state.velocity(self._name)
        if abs(self._wanted - position) < self._near:
            self._action.end(SUCCEEDED, **self._result(state, reached_goal=True))
        elif abs(velocity) > self._still:
            self._moved = state.t
        elif state.t - self._moved > self._patience:
            end = SUCCEEDED if self._content else ABORTED
            self._action.end(end, "stalled", **self._result(state, stalled=True))

    # Overridden for other types of goals

    def command(self, position: float) -> dict[str, Any]:
        """Return the fields of a goal.

        Args:
            position: target [rad or m].
        """
        return {"command": {"position": position, "max_effort": self._usual}}

    def _read(self, command: Any) -> tuple[float, float]:
        """Return the position and the greatest effort of a goal.

        Raises:
            RefusalError: the goal is not for exactly one joint.
        """
        return float(command.position), float(command.max_effort)

    def _result(self, state: State, **more: bool) -> dict[str, Any]:
        return {"position": state.position(self._name), "effort": state.effort(self._name), **more}

    def _feedback(self, state: State) -> Callable[[], dict[str, Any]]:
        result = self._result(state)
        return lambda: result
