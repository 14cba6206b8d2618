"""PID controllers for the position or velocity of joints.

Sources: ros_controllers noetic, effort_controllers and velocity_controllers, joint_position_controller.cpp,
joint_velocity_controller.cpp, joint_group_position_controller.cpp.
"""

from collections.abc import Callable
from math import inf, isfinite
from typing import Any, ClassVar

import numpy as np

from urdfkit.errors import DescriptionError
from urdfkit.messages import FLOAT, FLOATS, JOINT_CONTROLLER_STATE, header, message_type
from urdfkit.sim.plugins.controllers.controller import Law
from urdfkit.sim.plugins.controllers.joint_handle import Follower
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.pid import Gains, read_gains
from urdfkit.sim.state.robot_state import State

STATES_EVERY = 10
"""Control periods between messages on ``state``."""


class PidPosition(Law):
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
        self.settings.text("joint")
        (entry,) = self.settings.texts("joint")[:1]
        output = self.hardware.output(entry, self.types[self.type])
        self.outputs = (output,)
        gains = read_gains(self.settings, "pid", self.hardware.setup.note)
        if gains is None:
            raise DescriptionError(f"`{self.name}` has no `pid`, which it needs", position=self.settings.place)
        limits = output.limits if output.interface == "effort" else None
        self.follower = Follower(output.handle, gains, limits)
        self._wanted = 0.0
        self.listen(self.topic("command"), FLOAT, self._take)
        state = self.hardware.setup.bus.advertise(self.topic("state"), JOINT_CONTROLLER_STATE)
        self.report(state, 1.0 / (STATES_EVERY * self.hardware.period), self._state)

    @property
    def followers(self) -> tuple[Follower, ...]:
        """The PID of the joint."""
        return (self.follower,)

    def start(self, state: State) -> None:
        """Start from the present state."""
        super().start(state)
        self.follower.integral.reset()
        self._wanted = self.measured(state)

    def measured(self, state: State) -> float:
        """Return the present value of the controlled variable."""
        return state.position(self.follower.handle.name)

    def _take(self, message: Any) -> None:
        if isfinite(message.data):
            self._wanted = float(message.data)
        else:
            self.note("dropped a command that is not finite")

    def update(self, state: State, motors: Motors) -> float:
        """Write the command of the joint."""
        handle, gains = self.follower.handle, self.follower.gains
        now = self.measured(state)
        position = handle.target(self._wanted, now)
        if self.outputs[0].interface == "effort":
            self.follower.follow(state, motors, position)
            return self.follower.rest()
        part = self.follower.integral.update(state.t, position - now)
        velocity = gains.p * (position - now) + part - gains.d * state.velocity(handle.name)
        self.outputs[0].write(state, motors, velocity)
        return 0.0

    def _state(self, state: State) -> Callable[[], Any]:
        handle, gains = self.follower.handle, self.follower.gains
        t, now, speed = state.t, self.measured(state), state.velocity(handle.name)
        effort = state.effort(handle.name)
        wanted, error = self._wanted, self.error(now)
        return lambda: message_type(JOINT_CONTROLLER_STATE)(
            header(t, ""), wanted, now, speed, error, self.hardware.period, effort,
            gains.p, gains.i, gains.d, gains.i_max, gains.antiwindup,
        )  # fmt: skip

    def error(self, now: float) -> float:
        """Return the error for a measured value."""
        return self.follower.handle.target(self._wanted, now) - now


class PidVelocity(PidPosition):
    """PID on velocity with effort output."""

    types: ClassVar[dict[str, str]] = {"effort_controllers/JointVelocityController": "effort"}

    def start(self, state: State) -> None:
        """Start with a target velocity of zero."""
        super().start(state)
        self._wanted = 0.0

    def measured(self, state: State) -> float:
        """Return the present value of the controlled variable."""
        return state.velocity(self.follower.handle.name)

    def update(self, state: State, motors: Motors) -> float:
        """Write the command of the joint."""
        self.follower.chase(state, motors, self._wanted, self.hardware.period)
        return 0.0 if self.follower.gains.d else self.follower.rest()

    def error(self, now: float) -> float:
        """Return the error for a measured value."""
        return self._wanted - now


class PidGroup(Law):
    """PID on joint positions with effort output: ``command`` (Float64MultiArray), gains in ``<joint>/pid``."""

    types: ClassVar[dict[str, str]] = {"effort_controllers/JointGroupPositionController": "effort"}

    def configure(self) -> None:
        """Read the parameters and subscribe.

        Raises:
            DescriptionError: the joints, the gains of a joint or another parameter is missing or invalid.
        """
        joints = self.settings.texts("joints")
        if not joints:
            self.settings.text("joints")
        self.outputs = tuple(self.hardware.output(entry, "effort") for entry in joints)
        followers = []
        for entry, output in zip(joints, self.outputs, strict=True):
            gains: Gains | None = read_gains(self.settings, f"{entry.value}/pid", self.hardware.setup.note)
            if gains is None:
                raise DescriptionError(
                    f"`{self.name}` has no `{entry.value}/pid`, which it needs", position=entry.position
                )
            followers.append(Follower(output.handle, gains, output.limits))
        self._followers = tuple(followers)
        self.listen(self.topic("command"), FLOATS, self._take)

    @property
    def followers(self) -> tuple[Follower, ...]:
        """The PIDs of the joints, in order."""
        return self._followers

    def start(self, state: State) -> None:
        """Start from the present state."""
        super().start(state)
        for follower in self._followers:
            follower.integral.reset()
        self._wanted = np.array([state.position(output.handle.name) for output in self.outputs])

    def _take(self, message: Any) -> None:
        values = np.asarray(message.data, dtype=float)
        if values.shape == self._wanted.shape and np.isfinite(values).all():
            self._wanted = values
        else:
            self.note(f"dropped a command: {len(self._wanted)} finite values are wanted")

    def update(self, state: State, motors: Motors) -> float:
        """Write the commands of the joints."""
        rest = inf
        for follower, wanted in zip(self._followers, self._wanted.tolist(), strict=True):
            follower.follow(state, motors, follower.handle.target(wanted, state.position(follower.handle.name)))
            rest = min(rest, follower.rest())
        return rest
