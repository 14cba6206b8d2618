"""Joints whose position Gazebo sets directly, instead of driving them there."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from urdfkit.sim.plugins.setup import Setup
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


def put(joint: str, position: float, period: float, *, setup: Setup, state: State, motors: Motors) -> None:
    """Bring a joint to a position [rad], within its limits, in `period` [s] with unlimited effort.

    Gazebo's Joint::SetPosition sets it at once, which disturbs contacts. A step moves half its way with the velocity
    it began with, so a joint that is stopped still moves for half a step.
    """
    lower, upper = setup.kinematics.limits(joint)
    target = max(lower, min(upper, position))
    now = state.position(joint) + state.velocity(joint) * setup.dt / 2
    motors.drive(joint, (target - now) / period, inf)
