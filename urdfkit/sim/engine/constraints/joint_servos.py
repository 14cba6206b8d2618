"""What acts without rows: applied efforts, damping, and position servos that no stiffness makes unstable."""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.constraints.constraint_rows import friction_with_motor
from urdfkit.sim.engine.constraints.position_goals import RIGIDITY, has_rigid_motor
from urdfkit.sim.engine.dynamics.mass_matrix import factor, solve_transposed
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.elementary_functions import exponential

NO_SERVO, RIGID_MOTORS, SERVOS = range(3)
"""Result of `smooth_motion`: what acts on a tree without rows. `SERVOS` also if rigid motors move all its joints."""
SERVO_ATTEMPTS = 8
"""How often servos taken to be at their limit are released again within a step."""


@inlined
def servo_effort_at(w: KernelWorld, d: int, position: float, velocity: float, dt: float) -> float:
    """Return the effort of a dof's servo if the step ends with `velocity` [N·m or N]."""
    effort: float = w.kp[d] * (w.position_target[d] - position - dt * velocity) + w.i_part[d]
    effort += w.kd[d] * (w.velocity_target[d] - velocity)
    return effort


@inlined
def is_servo(w: KernelWorld, d: int) -> bool:
    """Return whether a dof has a servo."""
    return bool(w.kp[d] != 0.0 or w.kd[d] != 0.0 or w.ki[d] != 0.0)


@inlined
def rigid_effort(w: KernelWorld, d: int) -> float:
    """Return the effort of a rigid motor if the step changes the velocity by ``u`` [N·m or N]."""
    return float(w.i_part[d] + w.rigid_kd[d] * ((w.motor_velocity[d] - w.v_start[d]) - w.u[d]))


@inlined
def servo_error(w: KernelWorld, d: int, velocity: float) -> float:
    """Return the error that a servo integrates: of position [rad or m], or of velocity without stiffness."""
    if w.kp[d] != 0.0 or w.kd[d] == 0.0:
        # Halfway through the step, where coordinates are now, is the mean over it, to second order.
        return float(w.position_target[d] - w.s[w.dof_s[d]])
    return float(w.velocity_target[d] - velocity)


@inlined
def set_integral_part(w: KernelWorld, d: int, dt: float) -> None:
    """Compute the effort of a servo's integral at the middle of the step, and its feed-forward effort [N·m or N]."""
    w.i_part[d] = w.feedforward[d]
    if w.ki[d] != 0.0:
        part = w.ki[d] * (w.integral[d] + 0.5 * dt * servo_error(w, d, w.v_start[d]))
        w.i_part[d] += min(w.i_max[d], max(w.i_min[d], part))


@inlined
def grow_integral(w: KernelWorld, d: int, dt: float) -> None:
    """Integrate a servo's error over the step; with anti-windup only as far as it has an effect.

    Source: control_toolbox (ROS noetic), src/pid.cpp, computeCommand.
    """
    w.integral[d] += dt * servo_error(w, d, 0.5 * (w.v_start[d] + w.v[d]))
    if w.antiwindup[d] != 0.0:
        one, other = w.i_min[d] / w.ki[d], w.i_max[d] / w.ki[d]
        w.integral[d] = min(max(one, other), max(min(one, other), w.integral[d]))


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
def smooth_motion(w: KernelWorld, first: int, beyond: int, dt: float, factored: bool) -> int:
    """Factor M + dt·D + dt²·K = LᵀL and leave L⁻ᵀ·(impulse) in u; the change of v without rows is L⁻¹·u.

    Damping and servos act on the velocity at the end of the step, so no stiffness makes them unstable. Returns
    `NO_SERVO`, `RIGID_MOTORS` or `SERVOS`. With `factored`, only velocities have changed since L was computed.
    """
    servos = rigid = 0
    for d in range(first, beyond):
        row = w.dof_row[d]
        if not factored:
            for e in range(first, d + 1):
                w.L[row + e] = w.M[row + e]
        effort = w.applied[d] - w.bias[d] + friction_with_motor(w, d, w.v_start)
        softness = 0.0
        if w.damping[d] != 0.0:
            effort -= w.damping[d] * w.v_start[d]
            softness = w.damping[d] * late_share(dt * w.damping[d] / w.M[row + d])
        if has_rigid_motor(w, d):
            rigid += 1
            # It balances all other efforts on the joint, which leaves little to the difference of velocities.
            w.i_part[d] = -effort
            w.rigid_kd[d] = RIGIDITY * w.M[row + d] / dt
            effort = w.rigid_kd[d] * (w.motor_velocity[d] - w.v_start[d])
            softness += w.rigid_kd[d]
        elif is_servo(w, d):
            servos += 1
            set_integral_part(w, d, dt)
            if w.saturated[d] == 0:
                effort += servo_effort_at(w, d, w.s[w.dof_s[d]], w.v_start[d], dt)
                softness += w.kd[d] + dt * w.kp[d]
            else:
                effort += w.saturated[d] * w.servo_effort[d]
        if not factored:
            w.L[row + d] += dt * softness
        w.u[d] = dt * effort
    if not factored:
        factor(w, first, beyond)
    solve_transposed(w, first, beyond, w.u, 0)
    if servos > 0 or (rigid > 0 and rigid == beyond - first):
        return SERVOS
    return RIGID_MOTORS if rigid > 0 else NO_SERVO


@inlined
def is_undamped(w: KernelWorld, first: int, beyond: int) -> bool:
    """Return whether `smooth_motion` factors M alone."""
    for d in range(first, beyond):  # noqa: SIM110
        if w.damping[d] != 0.0 or w.approach_rate[d] != 0.0 or is_servo(w, d):
            return False
    return True


@inlined
def limited(w: KernelWorld, rows: int, dofs: int) -> bool:
    """Return whether one of the rows is a joint limit."""
    for k in range(rows):  # noqa: SIM110
        if dofs <= w.slot[k] < 2 * dofs:
            return True
    return False


@inlined
def overloaded(w: KernelWorld, first: int, beyond: int, dt: float, release: bool) -> bool:
    """Mark the servos that would exert more than they can; return whether that changed anything.

    The effort of a servo decreases with the velocity at the end of the step, so this is Newton's method on a monotone
    law. Without `release`, servos once marked stay so, and repeating it comes to an end.

    Where a rigid motor is overloaded, all of the tree become rows, which bound their efforts, see `account`.
    """
    changed = False
    for d in range(first, beyond):
        if has_rigid_motor(w, d) and abs(rigid_effort(w, d)) > w.motor_effort[d]:
            changed = True
    if changed:
        for d in range(first, beyond):
            w.motor_row[d] = 1
        return True
    for d in range(first, beyond):
        if is_servo(w, d):
            needed = servo_effort_at(w, d, w.s[w.dof_s[d]], w.v[d], dt)
            most = w.servo_effort[d] * (1.0 + 1e-12)
            now = 1 if needed > most else (-1 if needed < -most else 0)
            if w.saturated[d] != 0 and not release:
                now = w.saturated[d]
            if now != w.saturated[d]:
                w.saturated[d] = now
                changed = True
    return changed


@inlined
def account(w: KernelWorld, first: int, beyond: int, dt: float) -> None:
    """Write what motors and servos exerted (`effort`), and with damping, friction and `applied` (`tau`).

    Motors with goals that became rows in this step or before stay so as long as one of them is at its limit.
    """
    at_limit = False
    for d in range(first, beyond):
        row = w.memory[d] / dt
        most = w.motor_effort[d]
        friction = friction_with_motor(w, d, w.v)
        if most == 0.0:
            motor = 0.0
        elif w.friction[d] > 0.0 and most <= w.friction[d] and w.motor_velocity[d] != 0.0:
            motor = friction
        else:
            motor = min(most, max(-most, row))
        servo = 0.0
        if has_rigid_motor(w, d):
            motor, servo = 0.0, rigid_effort(w, d)
        elif is_servo(w, d):
            if w.saturated[d] != 0:
                servo = w.saturated[d] * w.servo_effort[d]
            else:
                servo = servo_effort_at(w, d, w.s[w.dof_s[d]], w.v[d], dt)
            if w.ki[d] != 0.0:
                grow_integral(w, d, dt)
        w.effort[d] = motor + servo
        w.tau[d] = row + friction + servo + w.applied[d] - w.damping[d] * w.v[d]
        at_limit = at_limit or (w.motor_row[d] != 0 and abs(row) > most * (1.0 - 1e-9))
    if not at_limit:
        for d in range(first, beyond):
            w.motor_row[d] = 0
