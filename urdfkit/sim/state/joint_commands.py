"""What drives and controllers may write: the joints' motors and servos, efforts beside them, the base's velocity."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, isfinite
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.sim.engine.scalar_views import numbers

if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Joint
    from urdfkit.sim.state.pid import Gains

Array = NDArray[np.float64]

APPROACH = 10.0
"""A joint on its way to a position target closes the gap at this rate [1/s]: to 5e-5 of it in a second."""


@dataclass(frozen=True)
class Servos:
    """The engine's servos, which act on where the step ends, so that no stiffness makes them unstable; all (nv,).

    Attributes:
        position: targets [rad] or [m].
        velocity: targets [rad/s] or [m/s].
        stiffness: [N·m/rad] or [N/m].
        damping: [N·m·s/rad] or [N·s/m].
        effort: what they can do [N·m] or [N].
        integral_gain: of the integral of the error.
        least_integral: least effort that the integral may have.
        most_integral: most effort.
        antiwindup: 1 where the integral stops growing there.
        feedforward: effort beside all that.
        integral: of the error, up to now.
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
    """Velocity motors with effort limits and servos, one of each per joint of one degree of freedom.

    Args:
        kinematics: the robot's model.
        velocity: the engine's motor velocities [rad/s] or [m/s]; shape (nv,).
        effort: the engine's effort limits [N·m] or [N], zero where there is no motor; shape (nv,).
        applied: the engine's efforts beside motors [N·m] or [N]; shape (nv,).
        servos: the engine's.
        set_base_velocity: sets the floating base's twist in the base's own axes, linear first.

    Attributes:
        invalidate: called when a joint is sent somewhere, so that somebody looks after it on its way.
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
        """Write to another engine from now on: one for the same robot in a world that has changed."""
        self._velocity, self._effort, self._applied = numbers(velocity), numbers(effort), numbers(applied)
        self._servos = servos
        self._set_base_velocity = set_base_velocity

    def drive(self, joint: str, velocity: float, effort: float | None = None) -> None:
        """Turn a joint at `velocity` [rad/s] or [m/s] with at most `effort` [N·m] or [N].

        Args:
            joint: its name.
            velocity: target; stays until the next call.
            effort: limit; the joint's ``<limit effort>`` when None, unlimited where there is none.

        Raises:
            SimulationError: no such joint, or a value that is no finite number.
        """
        self._goals.pop(joint, None)
        self._set(joint, velocity, self.limit(joint) if effort is None else effort)

    def hold(self, joint: str, position: float, effort: float | None = None) -> None:
        """Bring a joint to `position` [rad] or [m] and keep it there, within its velocity and effort limits.

        Raises:
            SimulationError: no such joint, a value that is no finite number or outside the joint's limits.
        """
        self._set(joint, 0.0, self.limit(joint) if effort is None else effort)
        unit = "m" if self._kinematics.robot.joint_by_name[joint].type == "prismatic" else "rad"
        if not isfinite(position):
            raise SimulationError(f"joint `{joint}` cannot go to {position} {unit}: it must be a finite number")
        lower, upper = self._kinematics.limits(joint)
        if not lower <= position <= upper:
            raise SimulationError(
                f"joint `{joint}` cannot go to {position:g} {unit}: its limits are {lower:g} … {upper:g} {unit}"
            )
        self._goals[joint] = position
        self.invalidate()

    def exert(self, joint: str, effort: float) -> None:
        """Apply an effort [N·m] or [N] to a joint, beside its motor, until the next call.

        Raises:
            SimulationError: no such joint, or a value that is no finite number.
        """
        index = self._checked(joint)
        if not isfinite(effort):
            raise SimulationError(f"joint `{joint}`: {effort} is no effort; it must be a finite number")
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
        anew: bool = False,
    ) -> None:
        """Exert stiffness·(position − q) + damping·(velocity − q̇), at most `effort` [N·m] or [N], until the next call.

        The joint's motor is switched off: a joint has one or the other. Zero stiffness and damping is no servo.

        Args:
            joint: its name.
            stiffness: [N·m/rad] or [N/m].
            damping: [N·m·s/rad] or [N·s/m].
            position: [rad] or [m].
            velocity: [rad/s] or [m/s].
            effort: limit of the whole [N·m] or [N]; the joint's ``<limit effort>`` when None.
            integral: gain and bounds of the integral part; of the error of velocity where there is no stiffness.
            feedforward: a further part [N·m] or [N].
            anew: forget the integral up to now.

        Raises:
            SimulationError: no such joint, or a value that is no finite number or negative where that makes no sense.
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
        if anew or integral is None:
            servos.integral[index] = 0.0

    def integral(self, joint: str) -> float:
        """Return the integral of the error of a joint's servo up to now [rad·s], [m·s], [rad] or [m]."""
        return float(self._servos.integral[self._checked(joint)])

    def move_base(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Give the floating base a velocity, once, in its own axes [m/s, rad/s]; the step that follows may change it.

        Raises:
            SimulationError: the robot is bolted down, or a value is not finite.
        """
        self._set_base_velocity((*linear, *angular))

    def limit(self, joint: str) -> float:
        """Return the joint's ``<limit effort>`` [N·m] or [N], infinite where there is none."""
        return self._limits.get(joint, inf)

    def release(self, joint: str) -> None:
        """Let a joint turn freely."""
        self._goals.pop(joint, None)
        self._set(joint, 0.0, 0.0)
        self._applied[self._index[joint]] = 0.0

    def release_all(self) -> None:
        """Let every joint turn freely."""
        self._goals.clear()
        for values in (self._velocity, self._effort, self._applied):
            np.asarray(values)[:] = 0.0
        self._servos.stiffness[:] = self._servos.damping[:] = self._servos.integral_gain[:] = 0.0

    @property
    def has_goals(self) -> bool:
        """Whether a joint has a position target."""
        return bool(self._goals)

    def approach(self, positions: Any) -> None:
        """Set the velocities of joints with a position target from where they are.

        Args:
            positions: joint name → position [rad] or [m], a function.
        """
        for joint, goal in self._goals.items():
            limit = self._kinematics.robot.joint_by_name[joint].limit
            fastest = limit.velocity if limit is not None and limit.velocity else inf
            self._velocity[self._index[joint]] = max(-fastest, min(fastest, APPROACH * (goal - positions(joint))))

    def _set(self, joint: str, velocity: float, effort: float) -> None:
        index = self._checked(joint)
        if not isfinite(velocity) or effort != effort or effort < 0:
            raise SimulationError(f"joint `{joint}`: {velocity} with effort {effort} is no motor target")
        self._velocity[index] = velocity
        self._effort[index] = effort
        self._servos.stiffness[index] = self._servos.damping[index] = self._servos.integral_gain[index] = 0.0

    def _checked(self, joint: str) -> int:
        index = self._index.get(joint)
        if index is None:
            self._kinematics.velocity_index(joint)  # raises, with the nearest name
            raise SimulationError(f"joint `{joint}` has more than one degree of freedom: it has no motor")
        return index


def effort_limit(joint: Joint) -> float:
    """Return the ``<limit effort>`` of a joint [N·m] or [N], infinite where there is none."""
    return inf if joint.limit is None or joint.limit.effort is None else joint.limit.effort
