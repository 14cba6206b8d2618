"""Reference: last commanded twist of a wheeled robot, valid until a timeout."""

from math import inf
from typing import Any

from urdfkit.messages import TWIST, TWIST_STAMPED
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.setup import LARGEST, is_command
from urdfkit.sim.plugins.wheel_odometry import Twist


class Reference:
    """Subscribes to a topic and stores the last twist, which is valid until a timeout.

    Args:
        controller: the controller.
        timeout: greatest age of a twist [s].
        topic: name of the topic, relative to the controller's.
        stamped: whether messages are of type TwistStamped.
        dated: measure the age from the message's stamp if it has one, not from its receipt.
        once: a reference is valid for one control period.

    Attributes:
        timeout: greatest age of a twist [s].
    """

    def __init__(
        self,
        controller: RosController,
        timeout: float,
        *,
        topic: str,
        stamped: bool,
        dated: bool = False,
        once: bool = False,
    ) -> None:
        self._controller, self._dated, self._once = controller, dated, once
        self.timeout = timeout
        name = controller.topic(topic)
        controller.commands[name] = TWIST_STAMPED if stamped else TWIST
        controller.listen(name, controller.commands[name], self._receive)
        self.clear()

    def clear(self) -> None:
        """Clear the reference."""
        self._target: Twist | None = None
        self._sent: float | None = None
        self._fresh = False

    def _receive(self, message: Any) -> None:
        stamp = getattr(message, "header", None)
        plain = getattr(message, "twist", message)
        target = (float(plain.linear.x), float(plain.linear.y), float(plain.angular.z))
        if not is_command(target):
            self._controller.note(f"dropped a command that is not finite, or above {LARGEST:g}")
            return
        sent = stamp.stamp.sec + 1e-9 * stamp.stamp.nanosec if self._dated and stamp is not None else 0.0
        self._target, self._sent, self._fresh = target, sent or None, True

    def at(self, t: float) -> Twist | None:
        """Return the reference at a time [s]; None without a reference or after the timeout."""
        if self._target is None:
            return None
        if self._sent is None:
            self._sent = t
        if self._once:
            target = self._target if self._fresh else None
            self._fresh = False
            return target
        if t - self._sent > self.timeout + 1e-9:
            self._target = None
        return self._target

    def left(self, t: float) -> float:
        """Return the time until the reference expires [s]."""
        if self._target is None:
            return inf
        if self._once or self._sent is None:
            return 0.0
        return max(0.0, self._sent + self.timeout - t)


def usual_reference(controller: RosController, timeout: float) -> Reference:
    """Return the reference on ``reference`` (ROS 2) or ``cmd_vel`` (ROS 1).

    In ROS 2, the age is measured from the message's stamp, and a timeout of 0 limits the validity to one control period
    (steering_controllers_library.cpp, mecanum_drive_controller.cpp).
    """
    ros2 = controller.hardware.ros == 2
    if once := ros2 and timeout == 0.0:
        controller.note("`reference_timeout` is 0: a reference is valid for one control period")
    if ros2 and not controller.settings.flag("use_stamped_vel", True):
        return Reference(controller, timeout, topic="reference_unstamped", stamped=False, dated=True, once=once)
    return Reference(controller, timeout, topic="reference" if ros2 else "cmd_vel", stamped=ros2, dated=True, once=once)
