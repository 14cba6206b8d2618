"""Commands of drives and controllers to the engine: joint motors, joint servos, joint efforts and the base velocity."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, isfinite

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
    """The engine's servos and position goals. All arrays have the shape (nv,).

    Servos are implicit, hence stable at any stiffness. A goal sets the velocity of a joint's motor in every step.

    Attributes:
        position: targets and goals [rad] or [m].
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
        approach_rate: rate of the approach to a goal [1/s]; zero for a joint without a goal.
        fastest: speed limits of approaches [rad/s] or [m/s].
        acceleration: acceleration limits of approaches [rad/s²] or [m/s²].
        deceleration: deceleration limits of approaches [rad/s²] or [m/s²].
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
    approach_rate: Array
    fastest: Array
    acceleration: Array
    deceleration: Array


class Motors:
    """Velocity motors with effort limits, and servos: one of each for every joint with one degree of freedom.

    Args:
        kinematics: the robot's model.
        velocity: the engine's motor velocities [rad/s] or [m/s]; shape (nv,).
        effort: the engine's effort limits [N·m] or [N], zero for a joint without a motor; shape (nv,).
        applied: the engine's applied efforts, added to those of motors [N·m] or [N]; shape (nv,).
        servos: the engine's servos.
        set_base_velocity: sets the twist of the floating base in the base frame, linear first.
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
        self._set(joint, velocity, self.limit(joint) if effort is None else effort)

    def hold(self, joint: str, position: float, effort: float | None = None) -> None:
        """Move a joint to `position` [rad] or [m] and hold it there.

        The motion stays within the limits of effort, velocity, acceleration and deceleration in ``<limit>``.

        Raises:
            SimulationError: unknown joint, or a value is not finite or outside the joint's limits.
        """
        index, servos = self._checked(joint), self._servos
        before = self._velocity[index] if servos.approach_rate[index] else 0.0
        self._set(joint, 0.0, self.limit(joint) if effort is None else effort)
        unit = "m" if self._kinematics.robot.joint_by_name[joint].type == "prismatic" else "rad"
        if not isfinite(position):
            raise SimulationError(f"joint `{joint}` cannot move to {position} {unit}: it must be a finite number")
        lower, upper = self._kinematics.limits(joint)
        if not lower <= position <= upper:
            raise SimulationError(
                f"joint `{joint}` cannot move to {position:g} {unit}: its limits are {lower:g} … {upper:g} {unit}"
            )
        limit = self._kinematics.robot.joint_by_name[joint].limit
        self._velocity[index] = before  # a new target does not stop the joint
        servos.position[index], servos.approach_rate[index] = position, APPROACH
        servos.fastest[index] = servos.acceleration[index] = servos.deceleration[index] = inf
        if limit is not None:
            servos.fastest[index] = limit.velocity or inf
            servos.acceleration[index] = limit.acceleration or inf
            servos.deceleration[index] = limit.deceleration or limit.acceleration or inf

    def approach(self, joint: str, position: float, *, rate: float, fastest: float) -> None:
        """Move a joint at `rate` times its distance to a position, and hold it there, within its limit of effort.

        Args:
            joint: name of the joint.
            position: goal [rad] or [m]; the nearest position within the joint's limits replaces it.
            rate: [1/s].
            fastest: greatest velocity [rad/s] or [m/s].

        Raises:
            SimulationError: unknown joint, or a value is not finite.
        """
        self._set(joint, position, self.limit(joint))
        index, servos = self._index[joint], self._servos
        lower, upper = self._kinematics.limits(joint)
        self._velocity[index] = 0.0
        servos.position[index], servos.approach_rate[index] = min(upper, max(lower, position)), rate
        servos.fastest[index], servos.acceleration[index], servos.deceleration[index] = fastest, inf, inf

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
            raise SimulationError(f"joint `{joint}`: invalid servo values {values} with effort {effort}")
        servos = self._servos
        self._velocity[index] = self._effort[index] = servos.approach_rate[index] = 0.0
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
        self._set(joint, 0.0, 0.0)
        self._applied[self._index[joint]] = 0.0

    def release_all(self) -> None:
        """Disable the motors, servos and applied efforts of all joints, so that they move freely."""
        for values in (self._velocity, self._effort, self._applied):
            np.asarray(values)[:] = 0.0
        servos = self._servos
        servos.stiffness[:] = servos.damping[:] = servos.integral_gain[:] = servos.approach_rate[:] = 0.0

    @property
    def has_goals(self) -> bool:
        """Whether a joint has a position target."""
        return bool(self._servos.approach_rate.any())

    def _set(self, joint: str, velocity: float, effort: float) -> None:
        index = self._checked(joint)
        if not isfinite(velocity) or effort != effort or effort < 0:
            raise SimulationError(f"joint `{joint}`: invalid motor target: velocity {velocity} with effort {effort}")
        self._velocity[index] = velocity
        self._effort[index] = effort
        servos = self._servos
        servos.stiffness[index] = servos.damping[index] = servos.integral_gain[index] = 0.0
        servos.approach_rate[index] = 0.0

    def _checked(self, joint: str) -> int:
        index = self._index.get(joint)
        if index is None:
            self._kinematics.velocity_index(joint)  # raises, with the nearest name
            raise SimulationError(f"joint `{joint}` has more than one degree of freedom: it has no motor")
        return index


def effort_limit(joint: Joint) -> float:
    """Return the ``<limit effort>`` of a joint [N·m] or [N]; infinite if the joint has none."""
    return inf if joint.limit is None or joint.limit.effort is None else joint.limit.effort
