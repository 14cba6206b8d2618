"""Outputs: a joint under one interface (position, velocity, effort), and how the simulated hardware obeys it.

Sources: gazebo_ros_pkgs noetic-devel, gazebo_ros_control/src/default_robot_hw_sim.cpp; gz_ros2_control, gz_system.cpp;
gazebo_ros2_control, gazebo_system.cpp.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import inf
from typing import TYPE_CHECKING, ClassVar

from urdfkit.sim.controllers.joint import NEAR, Follower, JointHandle

if TYPE_CHECKING:
    from urdfkit.sim.controllers.pid import Gains
    from urdfkit.sim.motors import Motors
    from urdfkit.sim.state import State

INTERFACES = ("position", "velocity", "effort")
"""What a joint may be commanded by."""


class Output(ABC):
    """One interface of one joint.

    Args:
        handle: the joint.
        period: of the control loop [s].
    """

    interface: ClassVar[str]

    def __init__(self, handle: JointHandle, period: float) -> None:
        self.handle = handle
        self.period = period
        self.command = 0.0

    @property
    def claim(self) -> tuple[str, str]:
        """Joint and interface."""
        return self.handle.name, self.interface

    def start(self, state: State) -> None:
        """Make the present the command: standing where it stands, or doing nothing."""
        self.command = 0.0

    @abstractmethod
    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Obey a command; return how long that needs no attention [s]: 0 is until the next control period.

        Args:
            state: the present.
            motors: what to write to.
            command: [rad] or [m], [rad/s] or [m/s], [N·m] or [N].
            velocity: the rate of change of a position command.
        """

    def keep(self, state: State, motors: Motors) -> float:
        """Obey the last command once more; see `write`."""
        return self.write(state, motors, self.command)


class EffortOutput(Output):
    """Efforts are exerted, within ``<limit effort>``."""

    interface = "effort"

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Obey a command; return how long that needs no attention [s]."""
        self.command = command
        self.handle.exert(motors, command)
        return inf


class VelocityOutput(Output):
    """Velocities: by a motor as strong as ``<limit effort>``, or by PID where there are gains."""

    interface = "velocity"

    def __init__(self, handle: JointHandle, period: float, gains: Gains | None = None) -> None:
        super().__init__(handle, period)
        self._follower = Follower(handle, gains) if gains is not None else None

    def start(self, state: State) -> None:
        """Command zero."""
        super().start(state)
        if self._follower is not None:
            self._follower.integral.reset()

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Obey a command; return how long that needs no attention [s]."""
        self.command = command
        if self._follower is None:
            self.handle.turn(motors, command)
            return inf
        self._follower.chase(state, motors, command, self.period)
        return 0.0 if self._follower.gains.d else self._follower.rest()


class PositionOutput(Output):
    """Positions: set whatever that takes, or by PID where there are gains."""

    interface = "position"

    def __init__(self, handle: JointHandle, period: float, gains: Gains | None = None) -> None:
        super().__init__(handle, period)
        self._follower = Follower(handle, gains) if gains is not None else None

    @property
    def has_gains(self) -> bool:
        """Whether positions are reached by PID."""
        return self._follower is not None

    def start(self, state: State) -> None:
        """Command standing where it stands."""
        self.command = state.position(self.handle.name)
        if self._follower is not None:
            self._follower.integral.reset()

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Obey a command; return how long that needs no attention [s]."""
        self.command = command
        if self._follower is None:
            return inf if self.handle.place(motors, state, command, self.period) else 0.0
        now = state.position(self.handle.name)
        self._follower.follow(state, motors, self.handle.target(command, now), velocity)
        return self._follower.rest()


class ProportionalOutput(Output):
    """Positions as gz_ros2_control goes there: velocity = error · gain · update rate, as strong as the effort limit."""

    interface = "position"

    def __init__(self, handle: JointHandle, period: float, gain: float) -> None:
        super().__init__(handle, period)
        self._rate = gain / period

    def start(self, state: State) -> None:
        """Command standing where it stands."""
        self.command = state.position(self.handle.name)

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Obey a command; return how long that needs no attention [s]."""
        self.command = command
        now = state.position(self.handle.name)
        error = self.handle.target(command, now) - now
        near = abs(error) < NEAR
        self.handle.turn(motors, 0.0 if near else self._rate * error)
        return 1.0 if near and abs(state.velocity(self.handle.name)) < NEAR else 0.0
