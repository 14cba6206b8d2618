"""Short constructors of common messages. Twists are linear first; quaternions x, y, z, w."""

from collections.abc import Iterable, Sequence
from typing import Any

from urdfkit.messages.types import TWIST, message_type


def stamp(t: float) -> Any:
    """Return a ``builtin_interfaces/msg/Time`` of simulated time `t` [s], rounded to the nanosecond.

    Examples:
        >>> from urdfkit.messages import stamp
        >>> stamp(2.25).sec
        2
    """
    nanoseconds = round(t * 1e9)
    return message_type("builtin_interfaces/msg/Time")(nanoseconds // 1_000_000_000, nanoseconds % 1_000_000_000)


def header(t: float, frame_id: str) -> Any:
    """Return a ``std_msgs/msg/Header``.

    Examples:
        >>> from urdfkit.messages import header
        >>> header(1.5, "odom").stamp.nanosec
        500000000
    """
    return message_type("std_msgs/msg/Header")(stamp(t), frame_id)


def vector(xyz: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/Vector3``.

    Examples:
        >>> from urdfkit.messages import vector
        >>> vector((1.0, 2.0, 3.0)).z
        3.0
    """
    return message_type("geometry_msgs/msg/Vector3")(float(xyz[0]), float(xyz[1]), float(xyz[2]))


def twist(linear: Sequence[float], angular: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/Twist`` [m/s, rad/s].

    Examples:
        >>> from urdfkit.messages import twist
        >>> twist((0.5, 0.0, 0.0), (0.0, 0.0, 1.0)).angular.z
        1.0
    """
    return message_type(TWIST)(vector(linear), vector(angular))


def pose(position: Iterable[float], quaternion: Iterable[float]) -> Any:
    """Return a ``geometry_msgs/msg/Pose`` [m; x y z w]."""
    point = message_type("geometry_msgs/msg/Point")(*map(float, position))
    return message_type("geometry_msgs/msg/Pose")(
        point, message_type("geometry_msgs/msg/Quaternion")(*map(float, quaternion))
    )


def transform(t: float, frame: str, child: str, position: Sequence[float], quaternion: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/TransformStamped``: where `child` is in `frame` [m; x y z w].

    Examples:
        >>> from urdfkit.messages import transform
        >>> transform(0.0, "odom", "base_link", (1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)).transform.translation.x
        1.0
    """
    rotation = message_type("geometry_msgs/msg/Quaternion")(*(float(part) for part in quaternion))
    placement = message_type("geometry_msgs/msg/Transform")(vector(position), rotation)
    return message_type("geometry_msgs/msg/TransformStamped")(header(t, frame), child, placement)
