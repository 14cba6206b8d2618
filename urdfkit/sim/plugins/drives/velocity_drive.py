"""Base class of drives: velocity command, its limits, and odometry from the wheels or from the true pose."""

from collections.abc import Callable
from copy import copy
from math import isfinite
from typing import Any

from urdfkit.errors import SimulationError
from urdfkit.messages import TWIST
from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.odometry import Estimate, OdometryTopics, Pose, from_world, planar
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.speed_limits import SpeedLimits
from urdfkit.sim.plugins.wheel_odometry import WheelOdometry
from urdfkit.sim.state.robot_state import State

ZERO = (0.0, 0.0, 0.0)


class Command:
    """Last Twist on a topic. A Twist that is not finite is dropped with a warning.

    Args:
        setup: setup of the drive.
        topic: absolute name of the topic.
        arrived: called after each command.

    Attributes:
        topic: absolute name of the topic.
        linear: linear velocity [m/s]; shape (3,).
        angular: angular velocity [rad/s]; shape (3,).
        count: number of commands so far.
    """

    def __init__(self, setup: Setup, topic: str, arrived: Callable[[], None]) -> None:
        self.topic = topic
        self._note = setup.note
        self._arrived = arrived
        self.linear: tuple[float, float, float] = ZERO
        self.angular: tuple[float, float, float] = ZERO
        self.count = 0
        setup.bus.subscribe(topic, TWIST, self._receive)

    def _receive(self, message: Any) -> None:
        linear, angular = (
            (float(vector.x), float(vector.y), float(vector.z)) for vector in (message.linear, message.angular)
        )
        if not all(isfinite(part) for part in (*linear, *angular)):
            self._note(
                f"dropped a command on {self.topic}: {linear[0]:g} {linear[1]:g} {linear[2]:g} m/s, "
                f"{angular[0]:g} {angular[1]:g} {angular[2]:g} rad/s is not finite"
            )
            return
        self.linear, self.angular = linear, angular
        self.count += 1
        self._arrived()

    def clear(self) -> None:
        """Set the command to zero."""
        self.linear = self.angular = ZERO


class VelocityDrive(Drive):
    """Drive with Twist commands and odometry.

    A subclass sets the attributes in `configure`.

    Attributes:
        command: last velocity command; None for a drive without commands.
        limits: limits of the commanded velocities.
        odometry: wheel odometry; None to publish the true pose.
        topics: topics of the odometry; None for a drive without odometry.
    """

    command: Command
    limits: SpeedLimits = SpeedLimits()
    odometry: WheelOdometry | None = None
    topics: OdometryTopics | None = None

    def subscribe(self, setup: Setup, topic: str) -> None:
        """Subscribe to the velocity commands on a topic."""
        self.command = Command(setup, topic, self.wake)
        self.commands = (topic,)

    def wake(self) -> None:
        """Resume calls of `write` from the next step on."""
        self.resting = False

    def rolled(self, state: State) -> tuple[float, ...]:
        """Return the arguments of the odometry: the rolled distances of the wheels and steering angles."""
        raise NotImplementedError

    def start_odometry(self, state: State) -> None:
        """Store the positions of the wheels before the first step."""
        if self.odometry is not None and not self.odometry.started:
            self.odometry.update(state.t, *self.rolled(state))

    def measure(self, state: State, odometry: WheelOdometry | None) -> Estimate:
        """Return the estimate of the present state.

        Args:
            state: state of the robot.
            odometry: wheel odometry to update; None for the true pose.
        """
        if odometry is None:
            return from_world(state.base_pose, state.base_velocity)
        odometry.update(state.t, *self.rolled(state))
        return planar(odometry.x, odometry.y, odometry.heading, odometry.velocity)

    def read(self, state: State) -> None:
        """Publish the odometry."""
        now = self.measure(state, self.odometry)
        if self.topics is not None:
            self.topics.publish(state.t, now)

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose of the base in that frame, whether or not it is published."""
        return {} if self.topics is None else {self.topics.frame: self.measure(state, copy(self.odometry)).pose}

    def reset(self) -> None:
        """Clear commands and odometry."""
        if self.commands:
            self.command.clear()
        self.resting = False
        self.limits.reset()
        if self.odometry is not None:
            self.odometry.reset()


def joints_of(setup: Setup, read: Parameters, meaning: str) -> tuple[str, ...]:
    """Return the joints that a parameter names.

    Raises:
        SimulationError: no joint, or an unknown joint, with its position.
    """
    names = read.texts(meaning)
    if not names:
        message = f"no <{read.tag(meaning)}>; this drive needs at least one"
        raise SimulationError(message, position=read.place(meaning), code="Z831")
    return tuple(setup.joint(name, read.place(meaning, index)) for index, name in enumerate(names))
