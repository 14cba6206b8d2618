"""Reference: the twist that a controller of a wheeled robot was sent last, for as long as it counts."""

from __future__ import annotations

from math import inf, isfinite
from typing import TYPE_CHECKING, Any

from urdfkit.messages import TWIST, TWIST_STAMPED

if TYPE_CHECKING:
    from urdfkit.sim.plugins.controllers.controller import Law

Velocity = tuple[float, float, float]
"""Forward [m/s], to the left [m/s], turning [rad/s]."""


class Reference:
    """Listens to ``reference`` (ROS 2) or ``cmd_vel`` (ROS 1) and holds the last twist until it is too old.

    In ROS 2 the age is that of the message's stamp where it has one; a timeout of 0 lets a reference count for one
    control period (steering_controllers_library.cpp, mecanum_drive_controller.cpp).

    Args:
        law: the controller.
        timeout: [s].

    Attributes:
        timeout: [s].
    """

    def __init__(self, law: Law, timeout: float) -> None:
        self._law = law
        self.timeout = timeout
        stamped = law.hardware.ros == 2
        name = "reference" if stamped else "cmd_vel"
        if stamped and not law.settings.flag("use_stamped_vel", True):
            stamped, name = False, "reference_unstamped"
        self._once = law.hardware.ros == 2 and timeout == 0.0
        if self._once:
            law.note("`reference_timeout` is 0: a reference counts for one control period")
        topic = law.topic(name)
        law.commands[topic] = TWIST_STAMPED if stamped else TWIST
        law.listen(topic, law.commands[topic], self._take)
        self.clear()

    def clear(self) -> None:
        """Want nothing."""
        self._wanted: Velocity | None = None
        self._given: float | None = None
        self._fresh = False

    def _take(self, message: Any) -> None:
        stamp = getattr(message, "header", None)
        plain = getattr(message, "twist", message)
        wanted = (float(plain.linear.x), float(plain.linear.y), float(plain.angular.z))
        if not all(map(isfinite, wanted)):
            self._law.note("dropped a command that is not finite")
            return
        given = 0.0 if stamp is None else stamp.stamp.sec + 1e-9 * stamp.stamp.nanosec
        self._wanted, self._given, self._fresh = wanted, given or None, True

    def at(self, t: float) -> Velocity | None:
        """Return what is wanted at a time [s]; None for nothing, or nothing any more."""
        if self._wanted is None:
            return None
        if self._given is None:
            self._given = t
        if self._once:
            wanted = self._wanted if self._fresh else None
            self._fresh = False
            return wanted
        if t - self._given > self.timeout + 1e-9:
            self._wanted = None
        return self._wanted

    def left(self, t: float) -> float:
        """Return how long what is wanted goes on counting [s]."""
        if self._wanted is None:
            return inf
        if self._once or self._given is None:
            return 0.0
        return max(0.0, self._given + self.timeout - t)
