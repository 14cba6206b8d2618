"""JointHandle: converts a controller's commands for one joint into motor and servo targets of the engine.

A PID runs as an implicit servo of the engine, so it is stable for any gain and time step. The effort limit applies to
the sum of all terms.
"""

from math import inf, isfinite, pi, remainder

from urdfkit.description.urdf.robot import Joint
from urdfkit.kinematics import Kinematics
from urdfkit.sim.plugins.controllers.joint_limits import JointLimits
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.pid import Gains, Integral
from urdfkit.sim.state.robot_state import State

FASTEST = 20.0
"""Greatest velocity at which a joint without ``<limit velocity>`` moves to a commanded position [rad/s] or [m/s]."""


LOOK = 0.01
"""Interval between checks of an effort against the velocity limit while the joint is well below the limit [s]."""

STANDING = 1e-3
"""A joint slower than this [rad/s] or [m/s] is at rest, for the interval between checks of a PID's effort."""

NEAR = 1e-9
"""Position error [rad] or [m] and velocity [rad/s] or [m/s] below which a joint has reached its target."""


class JointHandle:
    """Command interface to one joint, with its limits.

    Args:
        kinematics: the robot's model.
        joint: the joint of the URDF.

    Attributes:
        name: name of the joint.
        limit: effort limit [N·m] or [N].
        fastest: ``<limit velocity>`` [rad/s] or [m/s]; infinite if the joint has none.
    """

    def __init__(self, kinematics: Kinematics, joint: Joint) -> None:
        self.name = joint.name
        limit = joint.limit
        self.limit = limit.effort if limit is not None and limit.effort is not None else inf
        self.fastest = limit.velocity if limit is not None and limit.velocity else inf
        self._turns = joint.type == "continuous"
        self.lower, self.upper = (-inf, inf) if self._turns else kinematics.limits(joint.name)
        self._driven = False

    def reset(self) -> None:
        """Clear the last command."""
        self._driven = False

    def within(self, position: float) -> float:
        """Return the nearest position [rad] or [m] within the limits."""
        return min(self.upper, max(self.lower, position))

    def target(self, position: float, now: float) -> float:
        """Return the target [rad] or [m]: within the limits; for a continuous joint the nearest equivalent angle."""
        if self._turns:
            return now + remainder(position - now, 2 * pi)
        return self.within(position)

    # Commands

    def exert(self, motors: Motors, effort: float) -> None:
        """Exert a constant effort [N·m] or [N] within the limit, in addition to a drive's motor on the same joint."""
        if self._driven:
            motors.drive(self.name, 0.0, 0.0)
            self._driven = False
        motors.exert(self.name, min(self.limit, max(-self.limit, effort)))

    def turn(self, motors: Motors, velocity: float, effort: float | None = None) -> None:
        """Move the joint at a velocity [rad/s] or [m/s] within the limits."""
        self._driven = True
        motors.exert(self.name, 0.0)
        motors.drive(
            self.name, min(self.fastest, max(-self.fastest, velocity)), self.limit if effort is None else effort
        )

    def place(self, motors: Motors, state: State, position: float, period: float) -> bool:
        """Move the joint to a position [rad] or [m] with unlimited effort, within its velocity limit; True if reached.

        gazebo_ros_control without gains sets the position directly, against gravity and any load; ros_control's joint
        limits move the command at ``<limit velocity>`` at most.

        Args:
            motors: receives the joint command.
            state: present state.
            position: target [rad] or [m].
            period: time until the next call [s].
        """
        now = state.position(self.name)
        fastest = self.fastest if isfinite(self.fastest) else FASTEST
        velocity = (self.target(position, now) - now) / period
        near = abs(velocity) * period < NEAR
        self.turn(motors, 0.0 if near else min(fastest, max(-fastest, velocity)), inf)
        return near and abs(state.velocity(self.name)) < NEAR

    def servo(
        self,
        motors: Motors,
        gains: Gains,
        *,
        position: float,
        velocity: float = 0.0,
        feedforward: float = 0.0,
        limit: float = inf,
        reset_integral: bool = False,
    ) -> None:
        """Exert p·(position − q) + d·(velocity − q̇) + i·∫(position − q) + `feedforward`, within the limit.

        Args:
            motors: receives the joint command.
            gains: p, i and d.
            position: target [rad] or [m].
            velocity: target [rad/s] or [m/s].
            feedforward: effort added to the PID's [N·m] or [N].
            limit: effort limit in addition to the joint's own [N·m] or [N].
            reset_integral: reset the integral first.
        """
        most = min(self.limit, limit)
        integral = gains if gains.integrates else None
        if gains.p == gains.d == 0.0 and integral is None:
            self.exert(motors, min(most, max(-most, feedforward)))
            return
        self._driven = True
        motors.exert(self.name, 0.0)
        motors.servo(
            self.name, stiffness=gains.p, damping=gains.d, position=position, velocity=velocity, effort=most,
            integral=integral, feedforward=feedforward, reset_integral=reset_integral,
        )  # fmt: skip

    def chase(
        self,
        motors: Motors,
        gains: Gains,
        *,
        now: float,
        velocity: float,
        integral: float,
        period: float,
        limit: float = inf,
        reset_integral: bool = False,
    ) -> None:
        """Exert p·e + d·ė + `integral` with the error e = velocity − q̇, within the limit.

        The derivative of the error is (q̇ at the start − q̇ at the end of the step)/period, so both terms are implicit
        dampers.

        Args:
            motors: receives the joint command.
            gains: gains of the velocity error.
            now: the joint's velocity [rad/s] or [m/s].
            velocity: target [rad/s] or [m/s].
            integral: integral term [N·m] or [N] if the D gain is not zero; otherwise the engine integrates.
            period: time until the next call [s].
            limit: effort limit in addition to the joint's own [N·m] or [N].
            reset_integral: reset the integral first.
        """
        inertia = gains.d / period
        damping = gains.p + inertia
        if damping <= 0.0:
            self.exert(motors, integral)
            return
        wanted = min(self.fastest, max(-self.fastest, velocity))
        goal = wanted if inertia == 0.0 else (gains.p * wanted + inertia * now) / damping
        self._driven = True
        motors.exert(self.name, 0.0)
        motors.servo(
            self.name, stiffness=0.0, damping=damping, velocity=goal, effort=min(self.limit, limit),
            integral=gains if inertia == 0.0 and gains.integrates else None, feedforward=integral,
            reset_integral=reset_integral,
        )  # fmt: skip

    def release(self, motors: Motors) -> None:
        """Disable the joint's motor and servo."""
        motors.release(self.name)


class JointPid:
    """PID of one joint: joint handle, gains and integral.

    Args:
        handle: the joint.
        gains: gains of the PID.
        limits: limits of the effort, where they are enforced (ROS 1). While they reduce the effort, a constant effort
            replaces the servo for one control period at a time.
    """

    def __init__(self, handle: JointHandle, gains: Gains, limits: JointLimits | None = None) -> None:
        self.handle = handle
        self.gains = gains
        self.limits = limits if limits is not None and limits.cut_efforts else None
        self.integral = Integral(gains)
        self._of_velocity = False
        self._look = inf
        self._seen: tuple[float, float] | None = None

    def follow(
        self,
        state: State,
        motors: Motors,
        position: float,
        velocity: float = 0.0,
        feedforward: float = 0.0,
        limit: float = inf,
    ) -> None:
        """Follow a position [rad] or [m] and velocity [rad/s] or [m/s]."""
        self._of_velocity = False
        if self.limits is not None:
            now, speed, gains = state.position(self.handle.name), state.velocity(self.handle.name), self.gains
            effort = gains.p * (position - now) + gains.d * (velocity - speed) + feedforward
            if self._cut(motors, effort, now, speed, limit, target=position):
                return
        self.handle.servo(
            motors, self.gains, position=position, velocity=velocity, feedforward=feedforward, limit=limit,
            reset_integral=self.integral.begins(),
        )  # fmt: skip

    def chase(self, state: State, motors: Motors, velocity: float, period: float, limit: float = inf) -> None:
        """Follow a velocity [rad/s] or [m/s]."""
        now = state.velocity(self.handle.name)
        if self.limits is not None:
            effort = self.gains.p * (velocity - now)
            if self._cut(motors, effort, state.position(self.handle.name), now, limit, target=velocity):
                return
        reset_integral, self._of_velocity = self.integral.begins(), True
        integral = (
            self.integral.update(state.t, velocity - now) if self.gains.integrates and not self._by_engine else 0.0
        )
        self.handle.chase(
            motors,
            self.gains,
            now=now,
            velocity=velocity,
            integral=integral,
            period=period,
            limit=limit,
            reset_integral=reset_integral,
        )

    def rest(self) -> float:
        """Return the time until the next update is needed [s]."""
        return self._look if self._by_engine or not self.gains.integrates else 0.0

    def _cut(
        self, motors: Motors, effort: float, position: float, speed: float, limit: float, *, target: float
    ) -> bool:
        """If the limits reduce an effort, exert the reduced effort; return whether they do.

        Args:
            motors: receives the effort.
            effort: effort of the PID without its integral term [N·m] or [N].
            position: the joint's position [rad] or [m].
            speed: the joint's velocity [rad/s] or [m/s].
            limit: effort limit in addition to the joint's own [N·m] or [N].
            target: target position or velocity of the PID.
        """
        limits, most = self.limits, min(self.handle.limit, limit)
        assert limits is not None
        if self.gains.integrates:
            effort += min(self.gains.i_max, max(self.gains.i_min, self.gains.i * motors.integral(self.handle.name)))
        wanted = min(most, max(-most, effort))
        granted = min(most, max(-most, limits.exerting(wanted, position, speed)))
        # Check less often only if the joint is at rest and the command is the same as in the last call.
        stands = limits.soft is None and abs(speed) < STANDING and self._seen == (target, limit)
        self._look, self._seen = LOOK if stands else 0.0, (target, limit)
        if granted == wanted:
            return False
        self.handle.exert(motors, granted)
        return True

    @property
    def _by_engine(self) -> bool:
        """Whether the engine integrates the error; a velocity PID needs a positive P gain and no D gain for that."""
        return self.gains.p > 0.0 and self.gains.d == 0.0 if self._of_velocity else True
