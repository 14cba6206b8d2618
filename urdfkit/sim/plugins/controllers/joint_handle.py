"""JointHandle: one joint as controllers see it; it turns their commands into motor and servo targets.

A PID law runs as a servo of the engine, which acts on where the step ends: no gain makes it unstable at any step. The
effort limit holds for the sum of all parts.
"""

from __future__ import annotations

from math import inf, isfinite, pi, remainder
from typing import TYPE_CHECKING

from urdfkit.sim.state.pid import Gains, Integral

if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Joint
    from urdfkit.kinematics import Kinematics
    from urdfkit.sim.plugins.controllers.joint_limits import JointLimits
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State

FASTEST = 20.0
"""How fast a joint without ``<limit velocity>`` is brought to a commanded position [rad/s] or [m/s]."""


LOOK = 0.01
"""How often an effort is looked after that may make a joint too fast [s], while it is well below."""

STANDING = 1e-3
"""A joint slower than this [rad/s] or [m/s] stands, as far as a PID's effort has to be looked after."""

NEAR = 1e-9
"""A joint this near to where it should be [rad] or [m], and this slow [rad/s] or [m/s], is there."""


class JointHandle:
    """What one joint can be told.

    Args:
        kinematics: the robot's model.
        joint: the joint as written.

    Attributes:
        name: the joint's.
        limit: what it can exert [N·m] or [N].
        fastest: its ``<limit velocity>`` [rad/s] or [m/s]; infinite where there is none.
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
        """Forget what was commanded."""
        self._driven = False

    def within(self, position: float) -> float:
        """Return the nearest position [rad] or [m] within the limits."""
        return min(self.upper, max(self.lower, position))

    def target(self, position: float, now: float) -> float:
        """Return where to go for a commanded position [rad] or [m]: within limits, and the short way round."""
        if self._turns:
            return now + remainder(position - now, 2 * pi)
        return self.within(position)

    # Commands

    def exert(self, motors: Motors, effort: float) -> None:
        """Exert a constant effort [N·m] or [N], within the limit; beside the motor of a drive, if there is one."""
        if self._driven:
            motors.drive(self.name, 0.0, 0.0)
            self._driven = False
        motors.exert(self.name, min(self.limit, max(-self.limit, effort)))

    def turn(self, motors: Motors, velocity: float, effort: float | None = None) -> None:
        """Turn at a velocity [rad/s] or [m/s], within the limits."""
        self._driven = True
        motors.exert(self.name, 0.0)
        motors.drive(
            self.name, min(self.fastest, max(-self.fastest, velocity)), self.limit if effort is None else effort
        )

    def place(self, motors: Motors, state: State, position: float, period: float) -> bool:
        """Bring the joint to a position [rad] or [m] whatever that takes, no faster than it may; True when it is there.

        gazebo_ros_control without gains sets the position and so overcomes gravity and any load; ros_control's joint
        limits let the command move at ``<limit velocity>``.

        Args:
            motors: what to write to.
            state: the present.
            position: where it should be [rad] or [m].
            period: until the next call [s].
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
        anew: bool = False,
    ) -> None:
        """Exert p·(position − q) + d·(velocity − q̇) + i·∫(position − q) + `feedforward`, within the limit.

        Args:
            motors: what to write to.
            gains: p, i and d.
            position: where it should be [rad] or [m].
            velocity: how fast it should be [rad/s] or [m/s].
            feedforward: a further part [N·m] or [N].
            limit: besides the joint's own [N·m] or [N].
            anew: forget the integral up to now.
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
            integral=integral, feedforward=feedforward, anew=anew,
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
        anew: bool = False,
    ) -> None:
        """Exert p·(velocity − q̇) + d·(its rate of change) + `integral`, within the limit.

        The derivative is taken over `period` up to where the step ends, (q̇ now − q̇ then)/period, which makes it a
        damper too: implicit like the rest.

        Args:
            motors: what to write to.
            gains: of the velocity error.
            now: the joint's velocity [rad/s] or [m/s].
            velocity: the one it should have.
            integral: the integral part [N·m] or [N], where there is a derivative; the engine finds it otherwise.
            period: until the next call [s].
            limit: besides the joint's own [N·m] or [N].
            anew: forget the integral up to now.
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
            integral=gains if inertia == 0.0 and gains.integrates else None, feedforward=integral, anew=anew,
        )  # fmt: skip

    def release(self, motors: Motors) -> None:
        """Let the joint go."""
        motors.release(self.name)


class Follower:
    """A handle with gains and their integral: what PID controllers hold for each joint.

    Args:
        handle: the joint.
        gains: of the law.
        limits: of the efforts it commands, where they are enforced (ROS 1): what they take away is taken away for a
            control period at a time, in which a constant effort takes the servo's place.
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
        """Servo towards a position [rad] or [m] and velocity [rad/s] or [m/s]."""
        self._of_velocity = False
        if self.limits is not None:
            now, speed, gains = state.position(self.handle.name), state.velocity(self.handle.name), self.gains
            effort = gains.p * (position - now) + gains.d * (velocity - speed) + feedforward
            if self._cut(motors, effort, now, speed, limit, target=position):
                return
        self.handle.servo(
            motors, self.gains, position=position, velocity=velocity, feedforward=feedforward, limit=limit,
            anew=self.integral.begins(),
        )  # fmt: skip

    def chase(self, state: State, motors: Motors, velocity: float, period: float, limit: float = inf) -> None:
        """Servo towards a velocity [rad/s] or [m/s]."""
        now = state.velocity(self.handle.name)
        if self.limits is not None:
            effort = self.gains.p * (velocity - now)
            if self._cut(motors, effort, state.position(self.handle.name), now, limit, target=velocity):
                return
        anew, self._of_velocity = self.integral.begins(), True
        integral = (
            self.integral.update(state.t, velocity - now) if self.gains.integrates and not self._by_engine else 0.0
        )
        self.handle.chase(
            motors, self.gains, now=now, velocity=velocity, integral=integral, period=period, limit=limit, anew=anew
        )

    def rest(self) -> float:
        """Return how long the joint needs no attention [s]."""
        return self._look if self._by_engine or not self.gains.integrates else 0.0

    def _cut(
        self, motors: Motors, effort: float, position: float, speed: float, limit: float, *, target: float
    ) -> bool:
        """Exert what the limits grant of an effort, where that is less; return whether it is.

        Args:
            motors: what to write to.
            effort: of the law but for its integral [N·m] or [N].
            position: of the joint [rad] or [m].
            speed: [rad/s] or [m/s].
            limit: of the effort, besides the joint's own.
            target: what the law is after.
        """
        limits, most = self.limits, min(self.handle.limit, limit)
        assert limits is not None
        if self.gains.integrates:
            effort += min(self.gains.i_max, max(self.gains.i_min, self.gains.i * motors.integral(self.handle.name)))
        wanted = min(most, max(-most, effort))
        granted = min(most, max(-most, limits.exerting(wanted, position, speed)))
        # Only what stands, and was seen before with the same command, may be left alone for a while.
        stands = limits.soft is None and abs(speed) < STANDING and self._seen == (target, limit)
        self._look, self._seen = LOOK if stands else 0.0, (target, limit)
        if granted == wanted:
            return False
        self.handle.exert(motors, granted)
        return True

    @property
    def _by_engine(self) -> bool:
        """Whether the engine integrates: not where a velocity servo is none, or its target moves by a derivative."""
        return self.gains.p > 0.0 and self.gains.d == 0.0 if self._of_velocity else True
