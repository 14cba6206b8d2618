"""The ROS message types in use, taken from rosbags' typestore (ROS 2 definitions), and short constructors.

rosbags and numpy are imported on first use, not with this module. Twists are linear first; quaternions x, y, z, w.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

TWIST = "geometry_msgs/msg/Twist"
ODOMETRY = "nav_msgs/msg/Odometry"
JOINT_STATE = "sensor_msgs/msg/JointState"
TF = "tf2_msgs/msg/TFMessage"
CLOCK = "rosgraph_msgs/msg/Clock"
BOOL = "std_msgs/msg/Bool"


@cache
def message_type(name: str) -> Any:
    """Return the class of a message type such as ``geometry_msgs/msg/Twist``.

    Raises:
        UsageError: no such type, with the nearest one.
        MissingDependencyError: rosbags is not installed.
    """
    from urdfkit.errors import MissingDependencyError, UsageError, did_you_mean

    types = _types()
    if types is None:
        raise MissingDependencyError("messages need rosbags: pip install 'urdfkit[sim]'")
    full = full_type_name(name)
    if full not in types:
        raise UsageError(f"no message type `{name}`{did_you_mean(full, types)}")
    return types[full]


@cache
def _types() -> dict[str, Any] | None:
    try:
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        return None
    return dict(get_typestore(Stores.ROS2_HUMBLE).types)


def full_type_name(name: str) -> str:
    """Turn ``geometry_msgs/Twist`` into ``geometry_msgs/msg/Twist``; leave full names alone."""
    parts = name.split("/")
    return f"{parts[0]}/msg/{parts[1]}" if len(parts) == 2 else name


def stamp(t: float) -> Any:
    """Return a ``builtin_interfaces/msg/Time`` of simulated time `t` [s], rounded to the nanosecond."""
    nanoseconds = round(t * 1e9)
    return message_type("builtin_interfaces/msg/Time")(nanoseconds // 1_000_000_000, nanoseconds % 1_000_000_000)


def header(t: float, frame_id: str) -> Any:
    """Return a ``std_msgs/msg/Header``."""
    return message_type("std_msgs/msg/Header")(stamp(t), frame_id)


def vector(xyz: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/Vector3``."""
    return message_type("geometry_msgs/msg/Vector3")(float(xyz[0]), float(xyz[1]), float(xyz[2]))


def twist(linear: Sequence[float], angular: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/Twist`` [m/s, rad/s]."""
    return message_type(TWIST)(vector(linear), vector(angular))


def transform(t: float, frame: str, child: str, position: Sequence[float], quaternion: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/msg/TransformStamped``: where `child` is in `frame` [m; x y z w]."""
    rotation = message_type("geometry_msgs/msg/Quaternion")(*(float(part) for part in quaternion))
    placement = message_type("geometry_msgs/msg/Transform")(vector(position), rotation)
    return message_type("geometry_msgs/msg/TransformStamped")(header(t, frame), child, placement)
