"""joint_trajectory_controller: follows JointTrajectory messages.

Sources: ros_controllers noetic, joint_trajectory_controller; ros2_controllers, joint_trajectory_controller. There are
no actions on the bus: trajectories come by topic.
"""

from __future__ import annotations

from math import isfinite, pi
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.messages import TRAJECTORY, TRAJECTORY_STATE, from_fields, header, message_type
from urdfkit.sim.controllers.joint import Follower
from urdfkit.sim.controllers.law import Law
from urdfkit.sim.controllers.output import INTERFACES, Output
from urdfkit.sim.controllers.pid import Gains, read_gains
from urdfkit.sim.controllers.spline import Array, Trajectory, Waypoint

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.sim.motors import Motors
    from urdfkit.sim.state import State


class TrajectoryFollower(Law):
    """Several joints along a trajectory: ``command`` (ROS 1) or ``joint_trajectory`` (ROS 2).

    Positions are handed on to the hardware; velocities and efforts come from a PID with feedforward. A trajectory
    begins where the last one has led to. After its end the last positions are held.
    """

    types: ClassVar[dict[str, str]] = {
        "position_controllers/JointTrajectoryController": "position",
        "velocity_controllers/JointTrajectoryController": "velocity",
        "effort_controllers/JointTrajectoryController": "effort",
        "joint_trajectory_controller/JointTrajectoryController": "",
    }

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: no joints, or one that cannot be commanded so.
        """
        hardware, settings = self.hardware, self.settings
        joints = settings.texts("joints")
        if not joints:
            settings.text("joints")
        self._interface = self.types[self.type] or self._chosen()
        self.outputs = tuple(hardware.output(entry, self._interface) for entry in joints)
        self._names = [output.handle.name for output in self.outputs]
        self._followers = [self._follower(output) for output in self.outputs]
        self._turning = np.array([
            hardware.setup.kinematics.robot.joint_by_name[name].type == "continuous" for name in self._names
        ])  # fmt: skip
        self._partial = settings.flag("allow_partial_joints_goal", False)
        ros1 = hardware.ros == 1
        self.listen(self.topic("command" if ros1 else "joint_trajectory"), TRAJECTORY, self._take)
        topic = hardware.setup.bus.advertise(self.topic("state" if ros1 else "controller_state"), TRAJECTORY_STATE)
        self.report(topic, settings.number("state_publish_rate", 50.0), self._state)

    def _chosen(self) -> str:
        """Return the interface that ``command_interfaces`` asks for: positions where they are among them."""
        asked = self.settings.texts("command_interfaces")
        if not asked:
            self.settings.text("command_interfaces")
        for entry in asked:
            if entry.value not in (*INTERFACES, "acceleration"):
                raise DescriptionError(
                    f"no interface `{entry.value}`{did_you_mean(entry.value or '', INTERFACES)}",
                    position=entry.position,
                )
        named = [entry.value for entry in asked]
        chosen = next((kind for kind in INTERFACES if kind in named), None)
        if chosen is None:
            raise DescriptionError("accelerations cannot be commanded alone", position=asked[0].position)
        return chosen

    def _follower(self, output: Output) -> Follower | None:
        if self._interface == "position":
            return None
        name = output.handle.name
        gains = read_gains(self.settings, f"gains/{name}", self.hardware.setup.note)
        if gains is None:
            if self._interface == "effort":
                raise DescriptionError(
                    f"`{self.name}` has no `gains/{name}`, which it needs", position=self.settings.place
                )
            gains = Gains(0.0)
        return Follower(output.handle, gains)

    def start(self, state: State) -> None:
        """Hold where the robot is."""
        super().start(state)
        positions = np.array([state.position(name) for name in self._names])
        self._trajectory = Trajectory([Waypoint(state.t, positions)])
        self._present = state
        for follower in self._followers:
            if follower is not None:
                follower.integral.reset()

    # Messages

    def _take(self, message: Any) -> None:
        try:
            self._trajectory = self._read(message)
        except ValueError as error:
            self.note(f"dropped a trajectory: {error}")

    def _read(self, message: Any) -> Trajectory:
        """Return the trajectory of a message, from where the present one leads.

        Raises:
            ValueError: it cannot be followed; says why.
        """
        now = self._present.t
        names = list(message.joint_names)
        for name in names:
            if name not in self._names:
                raise ValueError(f"no joint `{name}` here{did_you_mean(name, self._names)}")
        missing = [name for name in self._names if name not in names]
        if len(set(names)) != len(names) or (missing and not self._partial):
            raise ValueError(f"it must name each joint once; `{(missing or names)[0]}` is not")
        start = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
        start = start or now
        position, velocity, acceleration = self._trajectory.at(now)
        order = [self._names.index(name) for name in names]
        points = [Waypoint(now, position, velocity, acceleration)]
        turns = np.zeros(len(self._names))
        last = -1.0
        for number, point in enumerate(message.points):
            after = point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec
            if after <= last and number:
                raise ValueError(f"point {number + 1} is not later than the one before")
            last = after
            given = _row(point.positions, len(names))
            if given is None:
                raise ValueError(f"point {number + 1} has no positions")
            target = position.copy()
            target[order] = given
            if number == 0:  # continuous joints go the short way round
                turns = np.where(self._turning, 2 * pi * np.round((position - target) / (2 * pi)), 0.0)
            rates = []
            for row in (_row(point.velocities, len(names)), _row(point.accelerations, len(names))):
                if row is not None:
                    whole = np.zeros(len(self._names))
                    whole[order] = row
                    row = whole
                rates.append(row)
            if start + after > now:  # ros_controllers drops what is past
                points.append(Waypoint(start + after, target + turns, *rates))
        if len(points) == 1:
            raise ValueError("it has no point that is not past")
        return Trajectory(points)

    # At work

    def update(self, state: State, motors: Motors) -> float:
        """Command the outputs."""
        # What is commanded now has to be reached at the end of this control period.
        goal = self._trajectory.at(state.t + self.hardware.period)
        rest = max(0.0, self._trajectory.waypoints[0].t - state.t)
        if state.t >= self._trajectory.end:
            rest = float("inf")
        for k, output in enumerate(self.outputs):
            position, velocity = float(goal[0][k]), float(goal[1][k])
            rest = min(rest, self._command(output, self._followers[k], state, motors, position, velocity))
        return rest

    def _command(
        self, output: Output, follower: Follower | None, state: State, motors: Motors, position: float, velocity: float
    ) -> float:
        if follower is None:
            return output.write(state, motors, position, velocity)
        wanted = output.handle.within(position)
        if self._interface == "effort":
            follower.follow(state, motors, wanted, velocity)
            return follower.rest()
        gains, name = follower.gains, output.handle.name
        error = wanted - state.position(name)
        part = follower.integral.update(state.t, error)
        command = velocity + gains.p * error + part + gains.d * (velocity - state.velocity(name))
        output.write(state, motors, command)
        return 0.0

    def _state(self, state: State) -> Callable[[], Any]:
        t = state.t
        wanted = self._trajectory.at(t)
        positions = np.array([state.position(name) for name in self._names])
        velocities = np.array([state.velocity(name) for name in self._names])
        efforts = np.array([state.effort(name) for name in self._names])

        def build() -> Any:
            desired = _point(wanted[0], wanted[1], wanted[2])
            actual = _point(positions, velocities, effort=efforts)
            message = from_fields(TRAJECTORY_STATE, None)
            message.header, message.joint_names = header(t, ""), list(self._names)
            message.reference = message.desired = desired
            message.feedback = message.actual = actual
            message.error = _point(wanted[0] - positions, wanted[1] - velocities)
            return message

        return build


def _row(values: Any, count: int) -> Array | None:
    """Return the numbers of a point, None for none.

    Raises:
        ValueError: not one for each joint, or not finite.
    """
    found = np.asarray(values, dtype=float)
    if found.size == 0:
        return None
    if found.shape != (count,) or not all(map(isfinite, found.tolist())):
        raise ValueError(f"a point needs {count} finite numbers")
    return found


def _point(positions: Array, velocities: Array, accelerations: Array | None = None, effort: Array | None = None) -> Any:
    none = np.zeros(0)
    point = from_fields("trajectory_msgs/msg/JointTrajectoryPoint", None)
    return type(point)(
        positions,
        velocities,
        none if accelerations is None else accelerations,
        none if effort is None else effort,
        message_type("builtin_interfaces/msg/Duration")(0, 0),
    )
