"""PID controllers for the position or velocity of joints.

Sources: ros_controllers noetic, effort_controllers and velocity_controllers, joint_position_controller.cpp,
joint_velocity_controller.cpp, joint_group_position_controller.cpp.
"""

from collections.abc import Callable
from math import inf
from typing import Any, ClassVar

import numpy as np

from urdfkit.errors import DescriptionError
from urdfkit.messages import FLOAT, FLOATS, JOINT_CONTROLLER_STATE, header, message_type
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.controllers.joint_handle import JointPid
from urdfkit.sim.plugins.setup import LARGEST, is_command
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.pid import Gains, read_gains
from urdfkit.sim.state.robot_state import State

STATES_EVERY = 10
"""Control periods between messages on ``state``."""


class PidPosition(RosController):
    """PID on position with effort or velocity output: ``command`` (Float64), ``state`` (JointControllerState)."""

    types: ClassVar[dict[str, str]] = {
        "effort_controllers/JointPositionController": "effort",
        "velocity_controllers/JointPositionController": "velocity",
    }

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a joint, its gains or another parameter is missing or invalid.
        """
        output = self.hardware.output(self.settings.entry("joint"), self.types[self.type])
        self.outputs = (output,)
        gains = read_gains(self.settings, "pid", self.hardware.setup.note)
        if gains is None:
            raise DescriptionError(f"`{self.name}` has no `pid`, which is required", position=self.settings.place)
        limits = output.limits if output.interface == "effort" else None
        self.joint_pid = JointPid(output.handle, gains, limits)
        self._wanted = 0.0
        self.listen(self.topic("command"), FLOAT, self._take)
        state = self.hardware.setup.bus.advertise(self.topic("state"), JOINT_CONTROLLER_STATE)
        self.report(state, 1.0 / (STATES_EVERY * self.hardware.period), self._state)

    @property
    def joint_pids(self) -> tuple[JointPid, ...]:
        """The PID of the joint."""
        return (self.joint_pid,)

    def start(self, state: State) -> None:
        """Start from the present state."""
        super().start(state)
        self.joint_pid.integral.reset()
        self._wanted = self.measured(state)

    def measured(self, state: State) -> float:
        """Return the present value of the controlled variable."""
        return state.position(self.joint_pid.handle.name)

    def _take(self, message: Any) -> None:
        if is_command([message.data]):
            self._wanted = float(message.data)
        else:
            self.note(f"dropped a command that is not finite, or above {LARGEST:g}")

    def update(self, state: State, motors: Motors) -> float:
        """Write the command of the joint."""
        handle, gains = self.joint_pid.handle, self.joint_pid.gains
        now = self.measured(state)
        position = handle.target(self._wanted, now)
        if self.outputs[0].interface == "effort":
            self.joint_pid.follow(state, motors, position)
            return self.joint_pid.rest()
        part = self.joint_pid.integral.update(state.t, position - now)
        velocity = gains.p * (position - now) + part - gains.d * state.velocity(handle.name)
        self.outputs[0].write(state, motors, velocity)
        return 0.0

    def _state(self, state: State) -> Callable[[], Any]:
        handle, gains = self.joint_pid.handle, self.joint_pid.gains
        t, now, speed = state.t, self.measured(state), state.velocity(handle.name)
        effort = state.effort(handle.name)
        wanted, error = self._wanted, self.error(now)
        return lambda: message_type(JOINT_CONTROLLER_STATE)(
            header(t, ""), wanted, now, speed, error, self.hardware.period, effort,
            gains.p, gains.i, gains.d, gains.i_max, gains.antiwindup,
        )  # fmt: skip

    def error(self, now: float) -> float:
        """Return the error for a measured value."""
        return self.joint_pid.handle.target(self._wanted, now) - now


class PidVelocity(PidPosition):
    """PID on velocity with effort output."""

    types: ClassVar[dict[str, str]] = {"effort_controllers/JointVelocityController": "effort"}

    def start(self, state: State) -> None:
        """Start with a target velocity of zero."""
        super().start(state)
        self._wanted = 0.0

    def measured(self, state: State) -> float:
        """Return the present value of the controlled variable."""
        return state.velocity(self.joint_pid.handle.name)

    def update(self, state: State, motors: Motors) -> float:
        """Write the command of the joint."""
        self.joint_pid.chase(state, motors, self._wanted, self.hardware.period)
        return 0.0 if self.joint_pid.gains.d else self.joint_pid.rest()

    def error(self, now: float) -> float:
        """Return the error for a measured value."""
        return self._wanted - now


class PidGroup(RosController):
    """PID on joint positions with effort output: ``command`` (Float64MultiArray), gains in ``<joint>/pid``."""

    types: ClassVar[dict[str, str]] = {"effort_controllers/JointGroupPositionController": "effort"}

    def configure(self) -> None:
        """Read the parameters and subscribe.

        Raises:
            DescriptionError: the joints, the gains of a joint or another parameter is missing or invalid.
        """
        joints = self.settings.texts("joints", required=True)
        self.outputs = tuple(self.hardware.output(entry, "effort") for entry in joints)
        joint_pids = []
        for entry, output in zip(joints, self.outputs, strict=True):
            gains: Gains | None = read_gains(self.settings, f"{entry.value}/pid", self.hardware.setup.note)
            if gains is None:
                raise DescriptionError(
                    f"`{self.name}` has no `{entry.value}/pid`, which is required", position=entry.position
                )
            joint_pids.append(JointPid(output.handle, gains, output.limits))
        self._joint_pids = tuple(joint_pids)
        self.listen(self.topic("command"), FLOATS, self._take)

    @property
    def joint_pids(self) -> tuple[JointPid, ...]:
        """The PIDs of the joints, in order."""
        return self._joint_pids

    def start(self, state: State) -> None:
        """Start from the present state."""
        super().start(state)
        for joint_pid in self._joint_pids:
            joint_pid.integral.reset()
        self._wanted = np.array([state.position(output.handle.name) for output in self.outputs])

    def _take(self, message: Any) -> None:
        values = np.asarray(message.data, dtype=float)
        if values.shape == self._wanted.shape and is_command(values):
            self._wanted = values
        else:
            self.note(f"dropped a command: {len(self._wanted)} finite values are expected")

    def update(self, state: State, motors: Motors) -> float:
        """Write the commands of the joints."""
        rest = inf
        for joint_pid, wanted in zip(self._joint_pids, self._wanted.tolist(), strict=True):
            joint_pid.follow(state, motors, joint_pid.handle.target(wanted, state.position(joint_pid.handle.name)))
            rest = min(rest, joint_pid.rest())
        return rest
