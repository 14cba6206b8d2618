"""Motors with a position goal: the velocity that approaches the goal within the limits of the joint."""

import math

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld

RIGIDITY = 1e10
"""Inertia that a motor with a goal adds to its joint, as a multiple of the joint's own.

The velocity at the end of a step differs from the motor's by the load's change of it divided by this number. Contacts
between bodies that only such motors connect count as redundant, as they are (`sliding_contacts.REDUNDANT`).
"""
REACHED = 1e-12
"""Velocity below which a motor with a goal stands still, so that its robot may sleep [rad/s or m/s]."""


@inlined
def has_rigid_motor(w: KernelWorld, d: int) -> bool:
    """Return whether the motor of a dof acts without a row.

    It has a goal, the joint has no dry friction, and no motor of the tree is at its limit of effort.
    """
    has_goal = w.approach_rate[d] != 0.0 and w.motor_effort[d] > 0.0
    return bool(has_goal and w.friction[d] == 0.0 and w.motor_row[d] == 0)


@inlined
def approach_speed(error: float, rate: float, deceleration: float, dt: float) -> float:
    """Return the speed of an approach at the end of the step, in the middle of which the goal is `error` away.

    The speed is `rate` times the distance at the end of the step. Farther away it is such that the joint stops with a
    constant deceleration; speed and deceleration are continuous where both meet.
    """
    speed = rate * error / (1.0 + 0.5 * rate * dt)
    if not speed * rate > deceleration:
        return speed
    lost = deceleration * dt
    return 0.5 * (math.sqrt(lost * lost + 4.0 * deceleration * (2.0 * error - deceleration / rate**2)) - lost)


@inlined
def gradual(wanted: float, before: float, acceleration: float, deceleration: float, dt: float) -> float:
    """Return the velocity that follows `before` within the limits of its change."""
    up, down = acceleration, deceleration
    if before < 0.0:
        up, down = deceleration, acceleration
    elif before == 0.0:
        down = acceleration
    return max(before - down * dt, min(before + up * dt, wanted))


@inlined
def approach_goals(w: KernelWorld, first: int, beyond: int, dt: float) -> None:
    """Set the velocities of motors with a goal, in the middle of a step."""
    for d in range(first, beyond):
        rate = w.approach_rate[d]
        if rate == 0.0:
            continue
        error = w.position_target[d] - w.s[w.dof_s[d]]
        speed = min(w.fastest[d], approach_speed(abs(error), rate, w.deceleration[d], dt))
        wanted = math.copysign(speed if speed > REACHED else 0.0, error)
        w.motor_velocity[d] = gradual(wanted, w.motor_velocity[d], w.acceleration[d], w.deceleration[d], dt)
