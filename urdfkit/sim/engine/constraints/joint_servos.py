"""What acts without rows: applied efforts, damping, and position servos that no stiffness makes unstable."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined
from urdfkit.sim.engine.constraints.constraint_rows import friction_with_motor
from urdfkit.sim.engine.dynamics.mass_matrix import factor, solve_transposed
from urdfkit.sim.engine.math.elementary_functions import exponential

SERVO_ATTEMPTS = 8
"""How often servos taken to be at their limit are released again within a step."""


@inlined
def servo_effort_at(floats: Any, integers: Any, d: int, position: float, velocity: float, dt: float) -> float:
    """Return the effort of a dof's servo if the step ends with `velocity` [N·m or N]."""
    position_target = field(floats, integers, At.position_target)
    velocity_target = field(floats, integers, At.velocity_target)
    kp = field(floats, integers, At.kp)
    kd = field(floats, integers, At.kd)
    i_part = field(floats, integers, At.i_part)
    effort: float = kp[d] * (position_target[d] - position - dt * velocity) + i_part[d]
    effort += kd[d] * (velocity_target[d] - velocity)
    return effort


@inlined
def is_servo(floats: Any, integers: Any, d: int) -> bool:
    """Return whether a dof has a servo."""
    kp = field(floats, integers, At.kp)
    kd = field(floats, integers, At.kd)
    ki = field(floats, integers, At.ki)
    return bool(kp[d] != 0.0 or kd[d] != 0.0 or ki[d] != 0.0)


@inlined
def servo_error(floats: Any, integers: Any, d: int, velocity: float) -> float:
    """Return the error that a servo integrates: of position [rad or m], or of velocity without stiffness."""
    dof_s = field(integers, integers, At.dof_s)
    s = field(floats, integers, At.s)
    kp = field(floats, integers, At.kp)
    kd = field(floats, integers, At.kd)
    position_target = field(floats, integers, At.position_target)
    velocity_target = field(floats, integers, At.velocity_target)
    if kp[d] != 0.0 or kd[d] == 0.0:
        # Halfway through the step, where coordinates are now, is the mean over it, to second order.
        return float(position_target[d] - s[dof_s[d]])
    return float(velocity_target[d] - velocity)


@inlined
def set_integral_part(floats: Any, integers: Any, d: int, dt: float) -> None:
    """Compute the effort of a servo's integral at the middle of the step, and its feed-forward effort [N·m or N]."""
    v = field(floats, integers, At.v_start)
    ki = field(floats, integers, At.ki)
    i_min = field(floats, integers, At.i_min)
    i_max = field(floats, integers, At.i_max)
    feedforward = field(floats, integers, At.feedforward)
    integral = field(floats, integers, At.integral)
    i_part = field(floats, integers, At.i_part)
    i_part[d] = feedforward[d]
    if ki[d] != 0.0:
        part = ki[d] * (integral[d] + 0.5 * dt * servo_error(floats, integers, d, v[d]))
        i_part[d] += min(i_max[d], max(i_min[d], part))


@inlined
def grow_integral(floats: Any, integers: Any, d: int, dt: float) -> None:
    """Integrate a servo's error over the step; with anti-windup only as far as it has an effect.

    Source: control_toolbox (ROS noetic), src/pid.cpp, computeCommand.
    """
    v = field(floats, integers, At.v)
    v_start = field(floats, integers, At.v_start)
    ki = field(floats, integers, At.ki)
    i_min = field(floats, integers, At.i_min)
    i_max = field(floats, integers, At.i_max)
    antiwindup = field(floats, integers, At.antiwindup)
    integral = field(floats, integers, At.integral)
    integral[d] += dt * servo_error(floats, integers, d, 0.5 * (v_start[d] + v[d]))
    if antiwindup[d] != 0.0:
        one, other = i_min[d] / ki[d], i_max[d] / ki[d]
        integral[d] = min(max(one, other), max(min(one, other), integral[d]))


@inlined
def late_share(z: float) -> float:
    """Return how much of a damper acts on the velocity at the end of a step, the rest on that at its start.

    So much that a joint alone is braked just right, v·exp(-z), where z is damping·dt/inertia: 1/(1 - exp(-z)) - 1/z. It
    is one half for a weak damper (second order) and one for a stiff one (stable).
    """
    if z < 0.1:
        return 0.5 + z / 12.0 - z**3 / 720.0 + z**5 / 30240.0
    return 1.0 / (1.0 - exponential(-z)) - 1.0 / z


@inlined
def smooth_motion(floats: Any, integers: Any, first: int, beyond: int, dt: float) -> bool:
    """Factor M + dt·D + dt²·K = LᵀL and leave L⁻ᵀ·(impulse) in u; the change of v without rows is L⁻¹·u.

    Damping and servos act on the velocity at the end of the step, so no stiffness makes them unstable. Returns whether
    there is a servo.
    """
    dof_row = field(integers, integers, At.dof_row)
    dof_s = field(integers, integers, At.dof_s)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v_start)
    M = field(floats, integers, At.M)
    bias = field(floats, integers, At.bias)
    damping = field(floats, integers, At.damping)
    applied = field(floats, integers, At.applied)
    kp = field(floats, integers, At.kp)
    kd = field(floats, integers, At.kd)
    servo_effort = field(floats, integers, At.servo_effort)
    saturated = field(integers, integers, At.saturated)
    L = field(floats, integers, At.L)
    u = field(floats, integers, At.u)
    has_servo = False
    for d in range(first, beyond):
        row = dof_row[d]
        for e in range(first, d + 1):
            L[row + e] = M[row + e]
        effort = applied[d] - bias[d] + friction_with_motor(floats, integers, d, v)
        softness = 0.0
        if damping[d] != 0.0:
            effort -= damping[d] * v[d]
            softness = damping[d] * late_share(dt * damping[d] / M[row + d])
        if is_servo(floats, integers, d):
            has_servo = True
            set_integral_part(floats, integers, d, dt)
            if saturated[d] == 0:
                effort += servo_effort_at(floats, integers, d, s[dof_s[d]], v[d], dt)
                softness += kd[d] + dt * kp[d]
            else:
                effort += saturated[d] * servo_effort[d]
        L[row + d] += dt * softness
        u[d] = dt * effort
    factor(floats, integers, first, beyond)
    solve_transposed(floats, integers, first, beyond, u, 0)
    return has_servo


@inlined
def limited(floats: Any, integers: Any, rows: int, dofs: int) -> bool:
    """Return whether one of the rows is a joint limit."""
    slot = field(integers, integers, At.slot)
    for k in range(rows):  # noqa: SIM110
        if dofs <= slot[k] < 2 * dofs:
            return True
    return False


@inlined
def overloaded(floats: Any, integers: Any, first: int, beyond: int, dt: float, release: bool) -> bool:
    """Mark the servos that would exert more than they can; return whether that changed anything.

    The effort of a servo decreases with the velocity at the end of the step, so this is Newton's method on a monotone
    law. Without `release`, servos once marked stay so, and repeating it comes to an end.
    """
    dof_s = field(integers, integers, At.dof_s)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    servo_effort = field(floats, integers, At.servo_effort)
    saturated = field(integers, integers, At.saturated)
    changed = False
    for d in range(first, beyond):
        if is_servo(floats, integers, d):
            needed = servo_effort_at(floats, integers, d, s[dof_s[d]], v[d], dt)
            most = servo_effort[d] * (1.0 + 1e-12)
            now = 1 if needed > most else (-1 if needed < -most else 0)
            if saturated[d] != 0 and not release:
                now = saturated[d]
            if now != saturated[d]:
                saturated[d] = now
                changed = True
    return changed


@inlined
def account(floats: Any, integers: Any, first: int, beyond: int, dt: float) -> None:
    """Write what motors and servos exerted (`effort`), and with damping, friction and `applied` (`tau`)."""
    dof_s = field(integers, integers, At.dof_s)
    s = field(floats, integers, At.s)
    v = field(floats, integers, At.v)
    damping = field(floats, integers, At.damping)
    friction = field(floats, integers, At.friction)
    applied = field(floats, integers, At.applied)
    motor_velocity = field(floats, integers, At.motor_velocity)
    motor_effort = field(floats, integers, At.motor_effort)
    servo_effort = field(floats, integers, At.servo_effort)
    saturated = field(integers, integers, At.saturated)
    memory = field(floats, integers, At.memory)
    effort = field(floats, integers, At.effort)
    tau = field(floats, integers, At.tau)
    ki = field(floats, integers, At.ki)
    for d in range(first, beyond):
        row = memory[d] / dt
        most = motor_effort[d]
        beside = friction_with_motor(floats, integers, d, v)
        if most == 0.0:
            motor = 0.0
        elif friction[d] > 0.0 and most <= friction[d] and motor_velocity[d] != 0.0:
            motor = beside
        else:
            motor = min(most, max(-most, row))
        servo = 0.0
        if is_servo(floats, integers, d):
            if saturated[d] != 0:
                servo = saturated[d] * servo_effort[d]
            else:
                servo = servo_effort_at(floats, integers, d, s[dof_s[d]], v[d], dt)
            if ki[d] != 0.0:
                grow_integral(floats, integers, d, dt)
        effort[d] = motor + servo
        tau[d] = row + beside + servo + applied[d] - damping[d] * v[d]
