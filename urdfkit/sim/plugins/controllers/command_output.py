"""Command interfaces (position, velocity, effort) of joints, as the simulated hardware implements them.

Sources: gazebo_ros_pkgs noetic-devel, gazebo_ros_control/src/default_robot_hw_sim.cpp; gz_ros2_control, gz_system.cpp;
gazebo_ros2_control, gazebo_system.cpp.
"""

from abc import ABC, abstractmethod
from math import inf
from typing import ClassVar

from urdfkit.sim.plugins.controllers.joint_handle import LOOK, NEAR, JointHandle, JointPid
from urdfkit.sim.plugins.controllers.joint_limits import JointLimits
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.pid import Gains
from urdfkit.sim.state.robot_state import State

INTERFACES = ("position", "velocity", "effort")
"""Command interfaces of a joint."""


BRISK = 0.5
"""Fraction of the velocity limit above which an effort command is checked in every control period."""


class Output(ABC):
    """One command interface of one joint.

    Args:
        handle: the joint.
        period: period of the control loop [s].
        limits: limits of the commands, where they are enforced (ROS 1).
        gains: gains of the PID that follows the command; None for an interface without PID.

    Attributes:
        joint_pid: PID that follows the command; None for an interface without PID.
    """

    interface: ClassVar[str]

    def __init__(
        self, handle: JointHandle, period: float, limits: JointLimits | None = None, gains: Gains | None = None
    ) -> None:
        self.handle = handle
        self.period = period
        self.limits = limits
        self.command = 0.0
        self.joint_pid = JointPid(handle, gains) if gains is not None else None

    @property
    def claim(self) -> tuple[str, str]:
        """Name of the joint and of the interface."""
        return self.handle.name, self.interface

    def start(self, state: State) -> None:
        """Set the initial command: the present position, or zero velocity or effort."""
        self.command = 0.0
        if self.joint_pid is not None:
            self.joint_pid.integral.reset()

    @abstractmethod
    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Apply a command; return the time until the next update is needed [s]; 0 means the next control period.

        Args:
            state: present state.
            motors: receives the joint commands.
            command: [rad] or [m], [rad/s] or [m/s], [N·m] or [N].
            velocity: rate of change of a position command.
        """

    def keep(self, state: State, motors: Motors) -> float:
        """Apply the last command again; see `write`."""
        return self.write(state, motors, self.command)


class EffortOutput(Output):
    """Effort commands, limited by ``<limit effort>`` and, in ROS 1, by ``<limit velocity>``."""

    interface = "effort"

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Apply a command; return the time until the next update is needed [s]."""
        self.command = command
        limits, name = self.limits, self.handle.name
        if limits is None or (command == 0.0 and limits.soft is None):
            self.handle.exert(motors, command)
            return inf
        speed = state.velocity(name)
        position = state.position(name)
        granted = limits.exerting(command, position, speed)
        if limits.soft is None or granted == command:
            self.handle.exert(motors, granted)
        else:  # k_velocity is a damping: as a servo of the engine it is stable for any inertia and period
            slowest, fastest = limits.velocities(position)
            self.handle.servo(
                motors,
                Gains(0.0, d=limits.soft.k_velocity),
                position=position,
                velocity=fastest if granted < command else slowest,
                limit=limits.effort,
            )
        if limits.soft is None and limits.velocity == inf:
            return inf
        return LOOK if limits.soft is None and abs(speed) < BRISK * limits.velocity else 0.0


class VelocityOutput(Output):
    """Velocity commands, followed by a motor with at most ``<limit effort>``, or by a PID if gains are configured."""

    interface = "velocity"

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Apply a command; return the time until the next update is needed [s]."""
        self.command = command
        soft = self.limits is not None and self.limits.soft is not None
        if self.limits is not None:
            command = self.limits.turning(command, state.position(self.handle.name))
        if self.joint_pid is None:
            self.handle.turn(motors, command)
            return 0.0 if soft else inf
        self.joint_pid.chase(state, motors, command, self.period)
        return 0.0 if self.joint_pid.gains.d or soft else self.joint_pid.rest()


class PositionOutput(Output):
    """Position commands, reached with unlimited effort, or by a PID if gains are configured.

    In ROS 1 the command is limited to the joint's velocity and position limits.
    """

    interface = "position"

    def start(self, state: State) -> None:
        """Set the command to the present position."""
        super().start(state)
        self.command = self._granted = state.position(self.handle.name)

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Apply a command; return the time until the next update is needed [s]."""
        self.command = command
        now, moving = state.position(self.handle.name), False
        command = self.handle.target(command, now)
        if self.limits is not None:
            before, self._granted = self._granted, self.limits.position(command, self._granted, self.period)
            # While the velocity limit delays the command, its rate of change is the velocity target.
            if moving := abs(self._granted - command) > NEAR and abs(self._granted - before) > NEAR:
                command, velocity = self._granted, (self._granted - before) / self.period
            elif abs(self._granted - command) > NEAR:
                command = self._granted
        if self.joint_pid is None:
            return inf if self.handle.place(motors, state, command, self.period) and not moving else 0.0
        self.joint_pid.follow(state, motors, command, velocity)
        return 0.0 if moving else self.joint_pid.rest()


class ProportionalOutput(Output):
    """Position commands as in gz_ros2_control: velocity = error · gain · update rate, within the effort limit."""

    interface = "position"

    def __init__(self, handle: JointHandle, period: float, gain: float) -> None:
        super().__init__(handle, period)
        self._rate = gain / period

    def start(self, state: State) -> None:
        """Set the command to the present position."""
        self.command = state.position(self.handle.name)

    def write(self, state: State, motors: Motors, command: float, velocity: float = 0.0) -> float:
        """Apply a command; return the time until the next update is needed [s]."""
        self.command = command
        now = state.position(self.handle.name)
        error = self.handle.target(command, now) - now
        near = abs(error) < NEAR
        self.handle.turn(motors, 0.0 if near else self._rate * error)
        return 1.0 if near and abs(state.velocity(self.handle.name)) < NEAR else 0.0
