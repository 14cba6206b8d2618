"""The ROS messages that urdfkit publishes and reads, without ROS: a type name and values in, a message out.

Definitions that rosbags lacks are in the other modules, one per family of ROS packages.
"""

from urdfkit.messages.constructors import header, stamp, transform, twist, vector
from urdfkit.messages.field_values import from_fields
from urdfkit.messages.point_cloud import read_points
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
    full_type_name,
    message_type,
    register_in,
    register_layouts,
    register_types,
    require_message_types,
    typestore,
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
    "read_points",
    "register_in",
    "register_layouts",
    "register_types",
    "require_message_types",
    "stamp",
    "transform",
    "twist",
    "typestore",
    "vector",
]
