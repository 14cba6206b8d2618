"""Base class of drives: velocity command, its limits, and odometry from the wheels or from the true pose."""

from collections.abc import Callable
from copy import copy
from math import inf
from typing import Any

from urdfkit.bus import Topic
from urdfkit.errors import SimulationError
from urdfkit.messages import TWIST
from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.drives.wheel_messages import Wheels
from urdfkit.sim.plugins.odometry import Estimate, OdometryTopics, Pose, from_world, planar
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import LARGEST, Setup, is_command
from urdfkit.sim.plugins.speed_limits import SpeedLimits
from urdfkit.sim.plugins.wheel_odometry import EncoderOdometry, WheelOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.periodic_steps import PeriodicSteps
from urdfkit.sim.state.robot_state import State

ZERO = (0.0, 0.0, 0.0)


class Command:
    """Last Twist on a topic. A Twist that is not finite, or too large, is dropped with a warning.

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
        if not is_command((*linear, *angular)):
            self._note(
                f"dropped a command on {self.topic}: {linear[0]:g} {linear[1]:g} {linear[2]:g} m/s, "
                f"{angular[0]:g} {angular[1]:g} {angular[2]:g} rad/s is not finite, or above {LARGEST:g}"
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
        wheels: topics of the wheels; None for a drive without.
    """

    command: Command
    limits: SpeedLimits = SpeedLimits()
    odometry: EncoderOdometry | None = None
    topics: OdometryTopics | None = None
    wheels: Wheels | None = None
    _in_engine = False

    def subscribe(self, setup: Setup, topic: str) -> None:
        """Subscribe to the velocity commands on a topic."""
        self.command = Command(setup, topic, self.wake)
        self.commands = (topic,)

    def wake(self) -> None:
        """Resume calls of `write` from the next step on."""
        self.resting = False

    def start_odometry(self, state: State) -> None:
        """Store the positions of the wheels before the first step, and let the engine integrate from there on.

        The engine integrates the odometry of one drive per robot.
        """
        odometry, odometer = self.odometry, state.odometer
        if odometry is None or odometry.started:
            return
        odometry.update(state.t, *_positions(odometry, state))
        self._in_engine = self._in_engine or not odometer.runs
        if self._in_engine:
            coordinates = [state.coordinate(encoder.joint) for encoder in odometry.encoders]
            odometer.start(
                state.step, odometry.encoders, coordinates, PeriodicSteps(self.read_rate, self._dt),
                axles=odometry.axles, follows_arc=odometry.exact,
            )  # fmt: skip

    def schedule(self, dt: float, motors: Motors) -> None:
        """Set the simulation's step [s] and the motors of the robot, after `configure`."""
        super().schedule(dt, motors)
        self._dt = dt

    def measure(self, state: State, odometry: WheelOdometry | None) -> Estimate:
        """Return the estimate of the present state.

        Args:
            state: state of the robot.
            odometry: updated wheel odometry; None for the true pose.
        """
        if odometry is None:
            return from_world(state.base_pose, state.base_velocity)
        return planar(odometry.x, odometry.y, odometry.heading, odometry.velocity)

    @property
    def published(self) -> tuple[Topic, ...] | None:
        """Topics of odometry and wheels; None if `read` integrates the odometry."""
        if self.odometry is not None and not self._in_engine:
            return None
        return (*(self.topics.topics if self.topics else ()), *(self.wheels.topics if self.wheels else ()))

    def read(self, state: State) -> None:
        """Publish odometry and wheels."""
        odometry = self.odometry
        if odometry is not None:
            self._update(odometry, state)
        if self.topics is not None:
            self.topics.publish(state.t if odometry is None else odometry.t, self.measure(state, odometry))
        if self.wheels is not None:
            self.wheels.publish(state)

    def _update(self, odometry: EncoderOdometry, state: State) -> None:
        """Update odometry to its last due step."""
        if self._in_engine and odometry.started:
            odometry.take(state.odometer.read(), self._dt)
        else:
            odometry.update(state.t, *_positions(odometry, state))

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose of the base in that frame, whether or not it is published."""
        if self.topics is None:
            return {}
        odometry = copy(self.odometry)
        if odometry is not None:
            self._update(odometry, state)
            odometry.update(state.t, *_positions(odometry, state))
        return {self.topics.frame: self.measure(state, odometry).pose}

    def reset(self) -> None:
        """Clear commands and odometry."""
        if self.commands:
            self.command.clear()
        self.resting = False
        self.limits.reset()
        if self.odometry is not None:
            self.odometry.reset()


def _positions(odometry: EncoderOdometry, state: State) -> list[float]:
    return [state.position(encoder.joint) for encoder in odometry.encoders]


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


def put(joint: str, position: float, period: float, *, setup: Setup, state: State, motors: Motors) -> None:
    """Move a joint to a position [rad] within its limits, in `period` [s] and with unlimited effort.

    Gazebo's Joint::SetPosition sets the position directly, which disturbs contacts. A step integrates with the mean of
    the velocities at its start and end, so a joint still moves for half a step when its motor stops it.
    """
    lower, upper = setup.kinematics.limits(joint)
    target = max(lower, min(upper, position))
    now = state.position(joint) + state.velocity(joint) * setup.dt / 2
    motors.drive(joint, (target - now) / period, inf)
