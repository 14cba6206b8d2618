"""Steering joints whose position Gazebo sets directly."""

from math import inf

from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State


def put(joint: str, position: float, period: float, *, setup: Setup, state: State, motors: Motors) -> None:
    """Move a joint to a position [rad] within its limits, in `period` [s] and with unlimited effort.

    Gazebo's Joint::SetPosition sets the position directly, which disturbs contacts. A step integrates with the mean of
    the velocities at its start and end, so a joint still moves for half a step when its motor stops it.
    """
    lower, upper = setup.kinematics.limits(joint)
    target = max(lower, min(upper, position))
    now = state.position(joint) + state.velocity(joint) * setup.dt / 2
    motors.drive(joint, (target - now) / period, inf)
