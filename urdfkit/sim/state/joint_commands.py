"""Commands of drives and controllers to the engine: joint motors, joint servos, joint efforts and the base velocity."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import copysign, inf, isfinite, sqrt
from typing import Any

import numpy as np

from urdfkit.description.urdf.robot import Joint
from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array
from urdfkit.sim.engine.scalar_views import numbers
from urdfkit.sim.state.pid import Gains

APPROACH = 10.0
"""Rate at which a joint approaches its position target [1/s]: the error falls to 5e-5 of its value in a second."""


@dataclass(frozen=True)
class Servos:
    """The engine's servos. They are implicit, hence stable at any stiffness. All arrays have the shape (nv,).

    Attributes:
        position: targets [rad] or [m].
        velocity: targets [rad/s] or [m/s].
        stiffness: [N·m/rad] or [N/m].
        damping: [N·m·s/rad] or [N·s/m].
        effort: effort limits [N·m] or [N].
        integral_gain: gain of the integral of the error.
        least_integral: lower bound of the integral's effort.
        most_integral: upper bound of the integral's effort.
        antiwindup: 1 to stop integrating at these bounds.
        feedforward: effort added to the servo's.
        integral: integral of the error so far.
    """

    position: Array
    velocity: Array
    stiffness: Array
    damping: Array
    effort: Array
    integral_gain: Array
    least_integral: Array
    most_integral: Array
    antiwindup: Array
    feedforward: Array
    integral: Array


class Motors:
    """Velocity motors with effort limits, and servos: one of each for every joint with one degree of freedom.

    Args:
        kinematics: the robot's model.
        velocity: the engine's motor velocities [rad/s] or [m/s]; shape (nv,).
        effort: the engine's effort limits [N·m] or [N], zero for a joint without a motor; shape (nv,).
        applied: the engine's applied efforts, added to those of motors [N·m] or [N]; shape (nv,).
        servos: the engine's servos.
        set_base_velocity: sets the twist of the floating base in the base frame, linear first.

    Attributes:
        invalidate: called when a joint gets a position target, so that `approach` is called in the following steps.
    """

    def __init__(
        self,
        kinematics: Kinematics,
        velocity: Array,
        effort: Array,
        applied: Array,
        servos: Servos,
        set_base_velocity: Callable[[Sequence[float]], None],
    ) -> None:
        self._kinematics = kinematics
        self.attach(velocity, effort, applied, servos, set_base_velocity)
        names = (*kinematics.joint_names, *kinematics.mimic_names)
        self._index = {name: kinematics.velocity_index(name) for name in names}
        self._limits = {name: effort_limit(joint) for name, joint in kinematics.robot.joint_by_name.items()}
        self._goals: dict[str, float] = {}
        self.invalidate: Callable[[], None] = lambda: None

    def attach(
        self,
        velocity: Array,
        effort: Array,
        applied: Array,
        servos: Servos,
        set_base_velocity: Callable[[Sequence[float]], None],
    ) -> None:
        """Write to another engine from now on, which simulates the same robot in a changed world."""
        self._velocity, self._effort, self._applied = numbers(velocity), numbers(effort), numbers(applied)
        self._servos = servos
        self._set_base_velocity = set_base_velocity

    def drive(self, joint: str, velocity: float, effort: float | None = None) -> None:
        """Turn a joint at `velocity` [rad/s] or [m/s] with at most `effort` [N·m] or [N].

        Args:
            joint: name of the joint.
            velocity: target, valid until the next call.
            effort: limit. None means the joint's ``<limit effort>``, or no limit if the joint has none.

        Raises:
            SimulationError: unknown joint, or a value is not finite.
        """
        self._goals.pop(joint, None)
        self._set(joint, velocity, self.limit(joint) if effort is None else effort)

    def hold(self, joint: str, position: float, effort: float | None = None) -> None:
        """Move a joint to `position` [rad] or [m] and hold it there.

        The motion stays within the limits of effort, velocity, acceleration and deceleration in ``<limit>``.

        Raises:
            SimulationError: unknown joint, or a value is not finite or outside the joint's limits.
        """
        before = self._velocity[self._checked(joint)]
        self._set(joint, 0.0, self.limit(joint) if effort is None else effort)
        unit = "m" if self._kinematics.robot.joint_by_name[joint].type == "prismatic" else "rad"
        if not isfinite(position):
            raise SimulationError(f"joint `{joint}` cannot go to {position} {unit}: it must be a finite number")
        lower, upper = self._kinematics.limits(joint)
        if not lower <= position <= upper:
            raise SimulationError(
                f"joint `{joint}` cannot go to {position:g} {unit}: its limits are {lower:g} … {upper:g} {unit}"
            )
        limit = self._kinematics.robot.joint_by_name[joint].limit
        if joint in self._goals and limit is not None and (limit.acceleration or limit.deceleration):
            self._velocity[self._index[joint]] = before  # a new target does not stop the joint
        self._goals[joint] = position
        self.invalidate()

    def exert(self, joint: str, effort: float) -> None:
        """Apply an effort [N·m] or [N] to a joint, in addition to its motor, until the next call.

        Raises:
            SimulationError: unknown joint, or a value is not finite.
        """
        index = self._checked(joint)
        if not isfinite(effort):
            raise SimulationError(f"joint `{joint}`: invalid effort {effort}; it must be a finite number")
        self._applied[index] = effort

    def servo(
        self,
        joint: str,
        *,
        stiffness: float,
        damping: float,
        position: float = 0.0,
        velocity: float = 0.0,
        effort: float | None = None,
        integral: Gains | None = None,
        feedforward: float = 0.0,
        reset_integral: bool = False,
    ) -> None:
        """Exert stiffness·(position − q) + damping·(velocity − q̇), at most `effort` [N·m] or [N], until the next call.

        This disables the joint's motor: a joint has a motor or a servo. Zero stiffness and damping disable the servo.

        Args:
            joint: name of the joint.
            stiffness: [N·m/rad] or [N/m].
            damping: [N·m·s/rad] or [N·s/m].
            position: target [rad] or [m].
            velocity: target [rad/s] or [m/s].
            effort: limit of the total effort [N·m] or [N]; the joint's ``<limit effort>`` when None.
            integral: gain and bounds of the integral term. It integrates the velocity error if the stiffness is zero.
            feedforward: effort added to the servo's [N·m] or [N].
            reset_integral: reset the integral first.

        Raises:
            SimulationError: unknown joint, a value is not finite, or a stiffness, damping or effort limit is negative.
        """
        index = self._checked(joint)
        effort = self.limit(joint) if effort is None else effort
        values = (stiffness, damping, position, velocity)
        if not all(map(isfinite, values)) or stiffness < 0 or damping < 0 or not effort >= 0:
            raise SimulationError(f"joint `{joint}`: no servo can do {values} with effort {effort}")
        self._goals.pop(joint, None)
        self._velocity[index] = self._effort[index] = 0.0
        servos = self._servos
        servos.position[index], servos.velocity[index] = position, velocity
        servos.stiffness[index], servos.damping[index], servos.effort[index] = stiffness, damping, effort
        servos.feedforward[index] = feedforward
        servos.integral_gain[index] = 0.0 if integral is None else integral.i
        if integral is not None:
            servos.least_integral[index], servos.most_integral[index] = integral.i_min, integral.i_max
            servos.antiwindup[index] = integral.antiwindup
        if reset_integral or integral is None:
            servos.integral[index] = 0.0

    def integral(self, joint: str) -> float:
        """Return the integral of the error of a joint's servo so far [rad·s], [m·s], [rad] or [m]."""
        return float(self._servos.integral[self._checked(joint)])

    def move_base(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Set the velocity of the floating base once, in the base frame [m/s, rad/s]; the next step may change it.

        Raises:
            SimulationError: the robot has a fixed base, or a value is not finite.
        """
        self._set_base_velocity((*linear, *angular))

    def limit(self, joint: str) -> float:
        """Return the ``<limit effort>`` of a joint [N·m] or [N]; infinite if the joint has none."""
        return self._limits.get(joint, inf)

    def release(self, joint: str) -> None:
        """Disable the motor, servo and applied effort of a joint, so that it moves freely."""
        self._goals.pop(joint, None)
        self._set(joint, 0.0, 0.0)
        self._applied[self._index[joint]] = 0.0

    def release_all(self) -> None:
        """Disable the motors, servos and applied efforts of all joints, so that they move freely."""
        self._goals.clear()
        for values in (self._velocity, self._effort, self._applied):
            np.asarray(values)[:] = 0.0
        self._servos.stiffness[:] = self._servos.damping[:] = self._servos.integral_gain[:] = 0.0

    @property
    def has_goals(self) -> bool:
        """Whether a joint has a position target."""
        return bool(self._goals)

    def approach(self, positions: Any, period: float) -> None:
        """Set the motor velocities of joints with a position target from their present positions.

        Args:
            positions: function that returns the position of a joint [rad] or [m] for its name.
            period: time until the next call [s].
        """
        for joint, goal in self._goals.items():
            limit, index = self._kinematics.robot.joint_by_name[joint].limit, self._index[joint]
            fastest = limit.velocity if limit is not None and limit.velocity else inf
            error = goal - positions(joint)
            if limit is None or not (limit.acceleration or limit.deceleration):
                self._velocity[index] = max(-fastest, min(fastest, APPROACH * error))
                continue
            rates = limit.acceleration or inf, limit.deceleration or limit.acceleration or inf
            wanted = max(-fastest, min(fastest, _braked(error, rates[1])))
            self._velocity[index] = _gradual(wanted, self._velocity[index], *rates, period)

    def _set(self, joint: str, velocity: float, effort: float) -> None:
        index = self._checked(joint)
        if not isfinite(velocity) or effort != effort or effort < 0:
            raise SimulationError(f"joint `{joint}`: invalid motor target: velocity {velocity} with effort {effort}")
        self._velocity[index] = velocity
        self._effort[index] = effort
        self._servos.stiffness[index] = self._servos.damping[index] = self._servos.integral_gain[index] = 0.0

    def _checked(self, joint: str) -> int:
        index = self._index.get(joint)
        if index is None:
            self._kinematics.velocity_index(joint)  # raises, with the nearest name
            raise SimulationError(f"joint `{joint}` has more than one degree of freedom: it has no motor")
        return index


def _braked(error: float, deceleration: float) -> float:
    """Return the velocity of an approach to a target that stops there with a limited deceleration.

    Far from the target the deceleration is constant; near it the velocity is `APPROACH` times the error, as without a
    limit. Velocity and deceleration are continuous where both meet.

    Args:
        error: distance to the target, with its sign [rad] or [m].
        deceleration: limit [rad/s²] or [m/s²].
    """
    near = deceleration / APPROACH**2
    if not abs(error) > near:
        return APPROACH * error
    return copysign(sqrt(deceleration * (2.0 * abs(error) - near)), error)


def _gradual(wanted: float, before: float, acceleration: float, deceleration: float, period: float) -> float:
    """Return the velocity that follows `before` within the limits of its change."""
    up, down = (acceleration, deceleration) if before >= 0.0 else (deceleration, acceleration)
    if before == 0.0:
        down = acceleration
    return max(before - down * period, min(before + up * period, wanted))


def effort_limit(joint: Joint) -> float:
    """Return the ``<limit effort>`` of a joint [N·m] or [N]; infinite if the joint has none."""
    return inf if joint.limit is None or joint.limit.effort is None else joint.limit.effort
