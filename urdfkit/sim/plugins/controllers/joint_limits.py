"""Limits of the joint commands of ROS 1 controllers, enforced in every control period.

Sources: ros_control noetic, joint_limits_interface.h (saturation and soft limits), joint_limits_rosparam.h and
joint_limits_urdf.h; gazebo_ros_pkgs noetic-devel, default_robot_hw_sim.cpp, registerJointLimits.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf

from urdfkit.description.control import Settings
from urdfkit.description.urdf.robot import Joint
from urdfkit.errors import DescriptionError


@dataclass(frozen=True)
class Soft:
    """Soft limits of a ``<safety_controller>``.

    Attributes:
        lower: ``soft_lower_limit`` [rad] or [m].
        upper: ``soft_upper_limit`` [rad] or [m].
        k_position: greatest velocity towards a soft limit, per distance from it [1/s].
        k_velocity: greatest effort, per velocity below the greatest velocity [N·m·s/rad] or [N·s/m].
    """

    lower: float
    upper: float
    k_position: float
    k_velocity: float


@dataclass(frozen=True)
class JointLimits:
    """Limits of the commands of one joint.

    Attributes:
        lower: lower position limit [rad] or [m].
        upper: upper position limit [rad] or [m].
        velocity: velocity limit [rad/s] or [m/s].
        effort: effort limit [N·m] or [N].
        soft: soft limits; None for a joint without.
    """

    lower: float = -inf
    upper: float = inf
    velocity: float = inf
    effort: float = inf
    soft: Soft | None = None

    @property
    def cut_efforts(self) -> bool:
        """Whether `exerting` can reduce an effort below ``<limit effort>``."""
        return self.soft is not None or self.velocity < inf

    def position(self, wanted: float, before: float, period: float) -> float:
        """Return the limited position command, for the command `before` of the last control period."""
        least, most = self.velocities(before)
        low, high = max(before + least * period, self.lower), min(before + most * period, self.upper)
        return min(high, max(low, wanted)) if low <= high else min(self.upper, max(self.lower, wanted))

    def turning(self, wanted: float, position: float) -> float:
        """Return the limited velocity command at a position."""
        least, most = self.velocities(position)
        return min(most, max(least, wanted))

    def exerting(self, wanted: float, position: float, velocity: float) -> float:
        """Return the limited effort command: zero if it accelerates a joint above its velocity limit."""
        least, most = -self.effort, self.effort
        if self.soft is not None:
            slowest, fastest = self.velocities(position)
            k = self.soft.k_velocity
            least = min(most, max(least, -k * (velocity - slowest)))
            most = min(self.effort, max(-self.effort, -k * (velocity - fastest)))
        else:
            least = 0.0 if velocity < -self.velocity else least
            most = 0.0 if velocity > self.velocity else most
        return min(most, max(least, wanted))

    def velocities(self, position: float) -> tuple[float, float]:
        """Return the lower and the upper velocity limit at a position [rad/s] or [m/s]."""
        if self.soft is None:
            return -self.velocity, self.velocity
        soft, v = self.soft, self.velocity
        return (
            min(v, max(-v, -soft.k_position * (position - soft.lower))),
            min(v, max(-v, -soft.k_position * (position - soft.upper))),
        )


def read_limits(joint: Joint, settings: Settings, note: Callable[[str], None]) -> JointLimits:
    """Return the limits of a joint from ``<limit>``, ``<safety_controller>`` and the parameters ``joint_limits/JOINT``.

    Raises:
        DescriptionError: a parameter is missing, not a finite number or out of range.
    """
    found = JointLimits()
    if (limit := joint.limit) is not None:
        found = JointLimits(velocity=limit.velocity or inf, effort=inf if limit.effort is None else limit.effort)
        if joint.type != "continuous":
            found = replace(found, lower=limit.lower or 0.0, upper=limit.upper or 0.0)
        if (safety := joint.safety_controller) is not None and safety.k_velocity is not None:
            soft = Soft(safety.soft_lower_limit, safety.soft_upper_limit, safety.k_position, safety.k_velocity)
            found = replace(found, soft=soft)
    group = settings.group(f"joint_limits/{joint.name}")
    if group.flag("has_position_limits", False) and joint.type != "continuous":
        found = replace(found, lower=group.number("min_position"), upper=group.number("max_position"))
    if group.flag("has_velocity_limits", False):
        found = replace(found, velocity=group.number("max_velocity"))
    for kind in ("acceleration", "jerk"):
        if group.flag(f"has_{kind}_limits", False):
            note(f"{group.place}: {kind} limits of joint `{joint.name}` are not simulated")
    if group.flag("has_effort_limits", False):
        found = replace(found, effort=group.number("max_effort"))
    if group.flag("has_soft_limits", False):
        soft = Soft(
            *(group.number(name) for name in ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"))
        )
        found = replace(found, soft=soft)
    for name, value in (("max_velocity", found.velocity), ("max_effort", found.effort)):
        if value < 0.0:
            raise DescriptionError(f"`{name}` is {value:g}; it must be zero or greater", position=group.position)
    if found.upper < found.lower:
        raise DescriptionError(
            f"positions from {found.lower:g} to {found.upper:g} are an empty range", position=group.position
        )
    return found
