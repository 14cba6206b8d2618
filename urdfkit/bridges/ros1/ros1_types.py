"""Messages of ROS 1: their definitions, checksums and bytes.

The definitions are those of Noetic where rosbags has them, else ours, in the notation of ROS 1. Messages are converted
by the names of their fields: some are upper case in ROS 1 (``CameraInfo.K``), and headers have a number ``seq``.
"""

from functools import cache
from hashlib import md5
from typing import Any, NamedTuple

from urdfkit.bridges.node.node import UnknownTypeError
from urdfkit.messages import register_in, register_types, typestore
from urdfkit.messages.conversion import converted

ANY = "*"
"""Checksum of a subscriber that accepts every type."""

NOETIC = {
    "control_msgs/msg/JointTrajectoryControllerState": "std_msgs/Header header\nstring[] joint_names\n"
    + "".join(f"trajectory_msgs/JointTrajectoryPoint {role}\n" for role in ("desired", "actual", "error"))
}
"""Definitions of Noetic that rosbags lacks and that differ from ours."""


class Definition(NamedTuple):
    """A message type as ROS 1 names it: its name, its definition with those of its fields, and its checksum."""

    name: str
    text: str
    checksum: str


@cache
def ros1_typestore() -> Any:
    """Return rosbags' types of Noetic, with ours that it lacks."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    for name, text in NOETIC.items():
        register_in(store, get_types_from_msg(text, name))
    register_in(store, {name: layout for name, layout in typestore().fielddefs.items() if name not in store.fielddefs})
    return store


@cache
def definition(type: str) -> Definition:
    """Return the definition of a type.

    Args:
        type: e.g. ``sensor_msgs/msg/LaserScan``.

    Raises:
        UnknownTypeError: the type is unknown, or cannot be expressed in ROS 1.
    """
    try:
        text, checksum = ros1_typestore().generate_msgdef(type, ros_version=1)
    except Exception as error:  # of several classes
        raise UnknownTypeError(f"no definition of {type} for ROS 1") from error
    return Definition(ros1_name(type), text, checksum)


def service_checksum(type: str) -> str:
    """Return the checksum of a service: that of the texts of its request and its response.

    Raises:
        UnknownTypeError: the type is unknown.
    """
    if f"{type}_Request" not in ros1_typestore().fielddefs:
        raise UnknownTypeError(f"no definition of {type}")
    texts = (_hashed_text(f"{type}_Request"), _hashed_text(f"{type}_Response"))
    return md5("".join(texts).encode(), usedforsecurity=False).hexdigest()


def _hashed_text(type: str) -> str:
    """Return the text from which a checksum is computed: types of messages are replaced by their checksums.

    https://wiki.ros.org/ROS/Technical%20Overview#Message_serialization_and_msg_MD5_sums
    """
    constants, fields = ros1_typestore().fielddefs[type]
    lines = [f"{base} {name}={value}" for name, base, value in constants]
    for name, (node, details) in fields:
        if name != "structure_needs_at_least_one_member":
            lines.append(f"{_hashed_type(int(node), details)} {name}")
    return "\n".join(lines)


def _hashed_type(node: int, details: Any) -> str:
    if node == 1:
        return str(details[0])
    if node == 2:
        moments = {"builtin_interfaces/msg/Time": "time", "builtin_interfaces/msg/Duration": "duration"}
        return moments.get(details) or definition(details).checksum
    inner, length = details
    if int(inner[0]) == 2 and not inner[1].startswith("builtin_interfaces/"):
        return definition(inner[1]).checksum
    return f"{_hashed_type(int(inner[0]), inner[1])}[{length if node == 3 else ''}]"


def register(type: str, text: str) -> None:
    """Learn an unknown type from the definition that its publisher sends.

    Raises:
        UsageError: the text is no definition.
    """
    found, store = register_types(type, text), ros1_typestore()
    register_in(store, {name: layout for name, layout in found.items() if name not in store.fielddefs})
    definition.cache_clear()


def encode(message: Any, type: str) -> bytes:
    """Return the bytes of a message."""
    store = ros1_typestore()
    return bytes(store.serialize_ros1(converted(message, type, store), type))


def decode(data: bytes, type: str) -> Any:
    """Return the message of its bytes, of our types."""
    return converted(ros1_typestore().deserialize_ros1(data, type), type, typestore())


def ros1_name(type: str) -> str:
    """Return ``geometry_msgs/Twist`` for ``geometry_msgs/msg/Twist``."""
    parts = type.split("/")
    return f"{parts[0]}/{parts[-1]}"


def full_name(name: str, kind: str = "msg") -> str:
    """Return ``geometry_msgs/msg/Twist`` for ``geometry_msgs/Twist``; ``tf/tfMessage`` is that of tf2."""
    package, _, message = name.partition("/")
    return "tf2_msgs/msg/TFMessage" if name == "tf/tfMessage" else f"{package}/{kind}/{message}"
