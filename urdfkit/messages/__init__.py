"""The ROS messages that urdfkit publishes and reads, without ROS: a type name and values in, a message out.

Definitions that rosbags lacks are in the other modules, one per family of ROS packages.
"""

from urdfkit.messages.types import (
    BOOL,
    CLOCK,
    FLOAT,
    FLOATS,
    JOINT_CONTROLLER_STATE,
    JOINT_STATE,
    ODOMETRY,
    TF,
    TRAJECTORY,
    TRAJECTORY_STATE,
    TWIST,
    TWIST_STAMPED,
    from_fields,
    full_type_name,
    header,
    message_type,
    require_message_types,
    stamp,
    transform,
    twist,
    typestore,
    vector,
)

__all__ = [
    "BOOL",
    "CLOCK",
    "FLOAT",
    "FLOATS",
    "JOINT_CONTROLLER_STATE",
    "JOINT_STATE",
    "ODOMETRY",
    "TF",
    "TRAJECTORY",
    "TRAJECTORY_STATE",
    "TWIST",
    "TWIST_STAMPED",
    "from_fields",
    "full_type_name",
    "header",
    "message_type",
    "require_message_types",
    "stamp",
    "transform",
    "twist",
    "typestore",
    "vector",
]
