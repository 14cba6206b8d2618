"""Conversion of JointTrajectory messages to trajectories, with the checks of joint_trajectory_controller.

Sources: ros_controllers noetic, init_joint_trajectory.h; ros2_controllers, joint_trajectory_controller.cpp.
"""

from collections.abc import Sequence
from math import pi
from typing import Any

import numpy as np

from urdfkit.errors import did_you_mean
from urdfkit.linear_algebra import Array
from urdfkit.messages import from_fields, message_type
from urdfkit.sim.plugins.controllers.actions.action_goal import RefusalError
from urdfkit.sim.plugins.controllers.trajectory.spline import ROUNDING, Trajectory, Waypoint
from urdfkit.sim.plugins.setup import LARGEST, is_command

INVALID_GOAL, INVALID_JOINTS, OLD_STAMP = -1, -2, -3
"""Error codes of FollowJointTrajectory."""


class TrajectoryReader:
    """Converts JointTrajectory messages for the joints of a controller.

    Args:
        names: names of the joints.
        turning: whether each joint is continuous and moves to the nearest equivalent angle.
        partial: accept messages without some of the joints; these joints keep their positions.
        waits: move to the first point from the start time on (ROS 1), not from the receipt of the message on.
        ends_at_rest: reject trajectories with a final velocity other than zero.
    """

    def __init__(
        self, names: Sequence[str], turning: Sequence[bool], *, partial: bool, waits: bool, ends_at_rest: bool
    ) -> None:
        self.names, self.turning = list(names), np.array(turning)
        self.partial, self.waits, self.ends_at_rest = partial, waits, ends_at_rest

    def read(self, message: Any, now: float, present: Trajectory) -> Trajectory:
        """Return the trajectory of a JointTrajectory message, which continues from the desired state of `present`.

        Args:
            message: the JointTrajectory message.
            now: time of receipt [s].
            present: trajectory that is followed at present.

        Raises:
            RefusalError: the trajectory is invalid; with the reason.
        """

        def refuse(text: str, code: int = INVALID_GOAL) -> RefusalError:
            return RefusalError(text, error_code=code, error_string=text)

        names = list(message.joint_names)
        for name in names:
            if name not in self.names:
                raise refuse(f"unknown joint `{name}`" + did_you_mean(name, self.names), INVALID_JOINTS)
        missing = [name for name in self.names if name not in names]
        if len(set(names)) != len(names) or (missing and not self.partial):
            raise refuse(f"it must name each joint exactly once, unlike `{(missing or names)[0]}`", INVALID_JOINTS)
        if not len(message.points):
            raise refuse("it has no points")
        start = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
        start = start or now
        leave = max(start, now) if self.waits else now
        if present.waypoints[0].t <= now:
            present.before = None
        position, velocity, acceleration = present.at(leave)
        order = [self.names.index(name) for name in names]
        points = [Waypoint(leave, position, velocity, acceleration)]
        turns = np.zeros(len(self.names))
        last = -1.0
        for number, point in enumerate(message.points):
            after = point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec
            if after <= last and number:
                raise refuse(f"point {number + 1} must be later than the previous point")
            last = after
            try:
                positions, *derivatives = (
                    _row(row, len(names)) for row in (point.positions, point.velocities, point.accelerations)
                )
            except ValueError as error:
                raise refuse(str(error)) from None
            if positions is None:
                raise refuse(f"point {number + 1} has no positions")
            target = position.copy()
            target[order] = positions
            if number == 0:  # continuous joints move to the nearest equivalent angle
                turns = np.where(self.turning, 2 * pi * np.round((position - target) / (2 * pi)), 0.0)
            rates = []
            for row in derivatives:
                if row is not None:
                    whole = np.zeros(len(self.names))
                    whole[order] = row
                    row = whole
                rates.append(row)
            if start + after > now:  # ros_controllers drops points of the past
                points.append(Waypoint(start + after, target + turns, *rates))
        if len(points) == 1:
            raise refuse("all of its points are in the past", OLD_STAMP)
        if self.ends_at_rest and rates[0] is not None and np.abs(rates[0]).max() > ROUNDING:
            raise refuse("it is not at rest at its end (see allow_nonzero_velocity_at_trajectory_end)")
        return Trajectory(points, present if leave > now else None)


def _row(values: Any, count: int) -> Array | None:
    """Return the values of a point as an array; None if the list is empty.

    Raises:
        ValueError: the number of values differs from the number of joints, or a value is not finite.
    """
    found = np.asarray(values, dtype=float)
    if found.size == 0:
        return None
    if found.shape != (count,) or not is_command(found.tolist()):
        raise ValueError(f"a point needs {count} finite numbers, at most {LARGEST:g}")
    return found


def point_of(
    positions: Array, velocities: Array, accelerations: Array | None = None, effort: Array | None = None
) -> Any:
    """Return a ``JointTrajectoryPoint``."""
    none = np.zeros(0)
    point = from_fields("trajectory_msgs/msg/JointTrajectoryPoint", None)
    return type(point)(
        positions,
        velocities,
        none if accelerations is None else accelerations,
        none if effort is None else effort,
        message_type("builtin_interfaces/msg/Duration")(0, 0),
    )
