"""Joints that Gazebo puts where they shall be, instead of turning them there."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from urdfkit.sim.plugins.setup import Setup
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


def put(joint: str, position: float, period: float, *, setup: Setup, state: State, motors: Motors) -> None:
    """Bring a joint to a position [rad], within its limits, in `period` [s] and whatever it takes.

    Gazebo's Joint::SetPosition puts it there at once, which tears at what it is in contact with. A step moves half its
    way with the velocity it began with, so a joint told to stop goes on for half a step.
    """
    lower, upper = setup.kinematics.limits(joint)
    wanted = max(lower, min(upper, position))
    now = state.position(joint) + state.velocity(joint) * setup.dt / 2
    motors.drive(joint, (wanted - now) / period, inf)
