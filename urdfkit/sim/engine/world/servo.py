"""What acts without rows: applied efforts, damping, and position servos that no stiffness makes unstable."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.world.dynamics import factor, solve_transposed
from urdfkit.sim.engine.world.rows import friction_beside_motor

SERVO_ATTEMPTS = 8
"""How often servos taken to be at their limit are released again within a step."""


@inlined
def servo_effort_at(
    d: int, position: float, velocity: float, position_target: Any, velocity_target: Any, kp: Any, kd: Any, dt: float
) -> float:
    """Return what the servo of a dof exerts when the step ends at `velocity` [N·m or N]."""
    effort: float = kp[d] * (position_target[d] - position - dt * velocity) + kd[d] * (velocity_target[d] - velocity)
    return effort


@inlined
def smooth_motion(
    first: int,
    beyond: int,
    dof_row: Any,
    dof_parent: Any,
    dof_s: Any,
    s: Any,
    v: Any,
    M: Any,
    bias: Any,
    damping: Any,
    friction: Any,
    applied: Any,
    motor_velocity: Any,
    motor_effort: Any,
    position_target: Any,
    velocity_target: Any,
    kp: Any,
    kd: Any,
    servo_effort: Any,
    saturated: Any,
    dt: float,
    L: Any,
    inverse_diagonal: Any,
    u: Any,
) -> bool:
    """Factor M + dt·D + dt²·K = LᵀL and leave L⁻ᵀ·(impulse) in u; the change of v without rows is L⁻¹·u.

    Damping and servos act on the velocity at the end of the step, so no stiffness makes them unstable. Returns whether
    there is a servo.
    """
    has_servo = False
    for d in range(first, beyond):
        row = dof_row[d]
        for e in range(first, d + 1):
            L[row + e] = M[row + e]
        effort = applied[d] - bias[d] - damping[d] * v[d]
        effort += friction_beside_motor(d, v, friction, motor_velocity, motor_effort)
        softness = damping[d]
        if kp[d] != 0.0 or kd[d] != 0.0:
            has_servo = True
            if saturated[d] == 0:
                effort += servo_effort_at(d, s[dof_s[d]], v[d], position_target, velocity_target, kp, kd, dt)
                softness += kd[d] + dt * kp[d]
            else:
                effort += saturated[d] * servo_effort[d]
        L[row + d] += dt * softness
        u[d] = dt * effort
    factor(first, beyond, dof_row, dof_parent, L, inverse_diagonal)
    solve_transposed(first, beyond, dof_row, dof_parent, L, inverse_diagonal, u, 0)
    return has_servo


@inlined
def limited(rows: int, dofs: int, slot: Any) -> bool:
    """Return whether one of the rows is a joint limit."""
    for k in range(rows):  # noqa: SIM110
        if dofs <= slot[k] < 2 * dofs:
            return True
    return False


@inlined
def overloaded(
    first: int,
    beyond: int,
    dof_s: Any,
    s: Any,
    v: Any,
    position_target: Any,
    velocity_target: Any,
    kp: Any,
    kd: Any,
    servo_effort: Any,
    saturated: Any,
    dt: float,
    release: bool,
) -> bool:
    """Mark the servos that would exert more than they can; return whether that changed anything.

    What a servo exerts falls with the velocity the step ends at, so repeating this is Newton's method on a monotone
    law. Without `release`, servos once marked stay so, and repeating it comes to an end.
    """
    changed = False
    for d in range(first, beyond):
        if kp[d] != 0.0 or kd[d] != 0.0:
            needed = servo_effort_at(d, s[dof_s[d]], v[d], position_target, velocity_target, kp, kd, dt)
            most = servo_effort[d] * (1.0 + 1e-12)
            now = 1 if needed > most else (-1 if needed < -most else 0)
            if saturated[d] != 0 and not release:
                now = saturated[d]
            if now != saturated[d]:
                saturated[d] = now
                changed = True
    return changed


@inlined
def account(
    first: int,
    beyond: int,
    dof_s: Any,
    s: Any,
    v: Any,
    damping: Any,
    friction: Any,
    applied: Any,
    motor_velocity: Any,
    motor_effort: Any,
    position_target: Any,
    velocity_target: Any,
    kp: Any,
    kd: Any,
    servo_effort: Any,
    saturated: Any,
    memory: Any,
    dt: float,
    effort: Any,
    tau: Any,
) -> None:
    """Write what motors and servos exerted (`effort`), and with damping, friction and `applied` (`tau`)."""
    for d in range(first, beyond):
        row = memory[d] / dt
        most = motor_effort[d]
        beside = friction_beside_motor(d, v, friction, motor_velocity, motor_effort)
        if most == 0.0:
            motor = 0.0
        elif friction[d] > 0.0 and most <= friction[d] and motor_velocity[d] != 0.0:
            motor = beside
        else:
            motor = min(most, max(-most, row))
        if saturated[d] != 0:
            servo = saturated[d] * servo_effort[d]
        else:
            servo = servo_effort_at(d, s[dof_s[d]], v[d], position_target, velocity_target, kp, kd, dt)
        effort[d] = motor + servo
        tau[d] = row + beside + servo + applied[d] - damping[d] * v[d]
