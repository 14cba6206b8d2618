"""joint_trajectory_controller: follows trajectories from a topic or from goals of ``follow_joint_trajectory``.

Sources: ros_controllers noetic, joint_trajectory_controller; ros2_controllers, joint_trajectory_controller.
"""

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np

from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.linear_algebra import Array
from urdfkit.messages import TRAJECTORY, TRAJECTORY_STATE, from_fields, header
from urdfkit.sim.plugins.controllers.actions.action_goal import ABORTED, SUCCEEDED, Action, RefusalError
from urdfkit.sim.plugins.controllers.command_output import INTERFACES, Output
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.controllers.joint_handle import JointPid
from urdfkit.sim.plugins.controllers.trajectory.spline import ROUNDING, Trajectory, Waypoint
from urdfkit.sim.plugins.controllers.trajectory.tolerances import Tolerances
from urdfkit.sim.plugins.controllers.trajectory.trajectory_message import INVALID_JOINTS, TrajectoryReader, point_of
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.pid import Gains, read_gains
from urdfkit.sim.state.robot_state import State

ACTION = "control_msgs/msg/FollowJointTrajectory"
OFF_PATH, OFF_GOAL = -4, -5
"""Error codes of FollowJointTrajectory: PATH_TOLERANCE_VIOLATED, GOAL_TOLERANCE_VIOLATED."""


class TrajectoryFollower(RosController):
    """Moves joints along a trajectory from ``command`` (ROS 1), ``joint_trajectory`` (ROS 2) or a goal.

    Position interfaces receive the desired positions. Velocity and effort interfaces use a PID with feedforward. A new
    trajectory continues from the desired state of the previous one: in ROS 1 at the new start time, in ROS 2
    immediately. After the end, the controller holds the last positions. In ROS 1 a trajectory without points stops the
    joints. A violation of ``constraints`` aborts the goal; in ROS 2 it also stops the joints, with or without a goal.
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
            DescriptionError: no joints, or a joint without the command interface.
        """
        hardware, settings = self.hardware, self.settings
        joints = settings.texts("joints", required=True)
        self._interface = self.types[self.type] or self._chosen()
        named = (each.position for each in settings.texts("command_interfaces") if each.value == self._interface)
        place = next(named, None)
        self.outputs = tuple(hardware.output(entry, self._interface, place) for entry in joints)
        self._names = [output.handle.name for output in self.outputs]
        self._joint_pids = [self._joint_pid(output) for output in self.outputs]
        self._ros1 = ros1 = hardware.ros == 1
        self._stop_time = settings.number("stop_trajectory_duration", 0.0) if ros1 else 0.0
        newest = hardware.setup.distro.name not in ("foxy", "galactic", "humble", "iron")
        robot = hardware.setup.kinematics.robot
        self._reader = TrajectoryReader(
            self._names,
            [robot.joint_by_name[name].type == "continuous" for name in self._names],
            partial=settings.flag("allow_partial_joints_goal", False),
            waits=ros1,
            ends_at_rest=not ros1 and not settings.flag("allow_nonzero_velocity_at_trajectory_end", not newest),
        )
        if settings.text("interpolation_method", "splines") != "splines":
            self.note("`interpolation_method` is not simulated: trajectories are splines")
        self._usual = self._tolerances = Tolerances.read(settings, self._names)
        self._action = Action(
            self,
            "follow_joint_trajectory",
            ACTION,
            pursue=self._pursue,
            stop=self._hold,
            feedback=self._feedback,
            rate=settings.number("action_monitor_rate", 20.0),
            clock=lambda: self._present.t,
        )
        self.listen(self.topic("command" if ros1 else "joint_trajectory"), TRAJECTORY, self._take)
        topic = hardware.setup.bus.advertise(self.topic("state" if ros1 else "controller_state"), TRAJECTORY_STATE)
        self.report(topic, settings.number("state_publish_rate", 50.0), self._state)

    def _chosen(self) -> str:
        """Return the interface to use of ``command_interfaces``: position if it is one of them."""
        entries = self.settings.texts("command_interfaces", required=True)
        for entry in entries:
            if entry.value not in (*INTERFACES, "acceleration"):
                message = f"unknown interface `{entry.value}`" + did_you_mean(entry.value or "", INTERFACES)
                raise DescriptionError(message, position=entry.position)
        named = [entry.value for entry in entries]
        chosen = next((kind for kind in INTERFACES if kind in named), None)
        if chosen is None:
            raise DescriptionError("accelerations cannot be commanded alone", position=entries[0].position)
        return chosen

    def _joint_pid(self, output: Output) -> JointPid | None:
        if self._interface == "position":
            return None
        name = output.handle.name
        gains = read_gains(self.settings, f"gains/{name}", self.hardware.setup.note)
        if gains is None:
            if self._interface == "effort":
                message = f"`{self.name}` has no `gains/{name}`, which the effort interface needs"
                raise DescriptionError(message, position=self.settings.place)
            gains = Gains(0.0)
        return JointPid(output.handle, gains, output.limits if self._interface == "effort" else None)

    @property
    def joint_pids(self) -> tuple[JointPid, ...]:
        """The PIDs of the joints, in order; empty for position interfaces."""
        return tuple(joint_pid for joint_pid in self._joint_pids if joint_pid is not None)

    def start(self, state: State) -> None:
        """Hold the present position."""
        super().start(state)
        positions = np.array([state.position(name) for name in self._names])
        self._trajectory = Trajectory([Waypoint(state.t, positions)])
        self._present, self._watched = state, False
        self._action.give_up("the controller was restarted")
        for joint_pid in self._joint_pids:
            if joint_pid is not None:
                joint_pid.integral.reset()

    def stop(self) -> None:
        """Cancel the goal."""
        self._action.give_up("the controller was stopped")

    # Messages

    def _take(self, message: Any) -> None:
        if self._ros1 and not len(message.points):
            self._hold()
        else:
            try:
                self._trajectory = self._read(message)
            except RefusalError as error:
                self.note(f"dropped a trajectory: {error}")
                return
        self._tolerances, self._watched = self._usual, not self._ros1
        self._action.give_up("a trajectory was received on the topic")

    def _pursue(self, goal: Any) -> None:
        """Accept a goal.

        Raises:
            RefusalError: the trajectory is invalid; with the reason.
        """
        try:
            tolerances = self._usual.of(goal)
        except ValueError as error:
            raise RefusalError(str(error), error_code=INVALID_JOINTS, error_string=str(error)) from None
        if self._ros1 and not len(goal.trajectory.points):
            self._hold()
        else:
            self._trajectory = self._read(goal.trajectory)
        self._tolerances, self._watched = tolerances, True

    def _hold(self) -> None:
        """Stop immediately, or in ROS 1 within ``stop_trajectory_duration``; see setHoldPosition."""
        state = self._present
        t, T = state.t, self._stop_time
        positions, velocities, _ = self._measured(state)
        here = Waypoint(t, positions, velocities, np.zeros(len(positions)))
        self._watched = False
        if T <= 0.0:
            self._trajectory = Trajectory([Waypoint(t, positions)])
            return
        # A symmetric trajectory of twice the duration is at rest in its middle; use its first half.
        back = Waypoint(t + 2 * T, positions, -velocities, np.zeros(len(positions)))
        self._trajectory = Trajectory([here, Waypoint(t + T, *Trajectory([here, back]).at(t + T))])

    def _read(self, message: Any) -> Trajectory:
        return self._reader.read(message, self._present.t, self._trajectory)

    # Control

    def update(self, state: State, motors: Motors) -> float:
        """Write the commands of the joints, and check the goal."""
        if self._watched:
            self._watch(state)
        # The command is the desired state at the end of this control period.
        goal = self._trajectory.at(state.t + self.hardware.period)
        rest = max(0.0, self._trajectory.waypoints[0].t - state.t)
        if self._trajectory.before is not None and state.t < self._trajectory.before.end:
            rest = 0.0
        if state.t >= self._trajectory.end:
            rest = 0.0 if self._watched else float("inf")
        for k, output in enumerate(self.outputs):
            position, velocity = float(goal[0][k]), float(goal[1][k])
            rest = min(rest, self._command(output, self._joint_pids[k], state, motors, position, velocity))
        return rest

    def _command(
        self, output: Output, joint_pid: JointPid | None, state: State, motors: Motors, position: float, velocity: float
    ) -> float:
        if joint_pid is None:
            return output.write(state, motors, position, velocity)
        wanted = output.handle.within(position)
        if self._interface == "effort":
            joint_pid.follow(state, motors, wanted, velocity)
            return joint_pid.rest()
        gains, name = joint_pid.gains, output.handle.name
        error = wanted - state.position(name)
        part = joint_pid.integral.update(state.t, error)
        command = velocity + gains.p * error + part + gains.d * (velocity - state.velocity(name))
        output.write(state, motors, command)
        return 0.0

    # The goal

    def _watch(self, state: State) -> None:
        """Check the tolerances; end the goal when it is reached or a tolerance is violated."""
        t, end = state.t, self._trajectory.end
        wanted, (positions, velocities, _) = self._trajectory.at(min(t, end)), self._measured(state)
        off, speed = wanted[0] - positions, wanted[1] - velocities
        if t < end - ROUNDING:
            if (violation := self._tolerances.strays(off)) is not None:
                self._lose(violation, OFF_PATH)
            return
        if t > end + ROUNDING:
            speed = velocities
        missed, most = self._tolerances.misses(off, speed), self._tolerances.time
        if missed is None:
            self._watched = False
            self._action.end(SUCCEEDED)
        elif t > end + most - ROUNDING and (self._ros1 or most > 0.0):  # zero: no time limit in ROS 2
            self._lose(missed, OFF_GOAL)

    def _lose(self, text: str, code: int) -> None:
        if self._action.goal is None:
            self.note(f"stopped: {text}")
        self._action.end(ABORTED, text, error_code=code, error_string=text)
        self._watched = False
        if not self._ros1:
            self._hold()

    # Publications

    def _measured(self, state: State) -> tuple[Array, Array, Array]:
        positions = np.array([state.position(name) for name in self._names])
        velocities = np.array([state.velocity(name) for name in self._names])
        return positions, velocities, np.array([state.effort(name) for name in self._names])

    def _feedback(self, state: State) -> Callable[[], dict[str, Any]]:
        t, wanted, (positions, velocities, efforts) = state.t, self._trajectory.at(state.t), self._measured(state)
        return lambda: {
            "header": header(t, ""),
            "joint_names": list(self._names),
            "desired": point_of(wanted[0], wanted[1], wanted[2]),
            "actual": point_of(positions, velocities, effort=efforts),
            "error": point_of(wanted[0] - positions, wanted[1] - velocities),
        }

    def _state(self, state: State) -> Callable[[], Any]:
        fields = self._feedback(state)

        def build() -> Any:
            message = from_fields(TRAJECTORY_STATE, None)
            for name, value in fields().items():
                setattr(message, name, value)
            message.reference, message.feedback = message.desired, message.actual
            return message

        return build
