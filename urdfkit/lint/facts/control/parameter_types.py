"""Types of the numbers in ROS 2 parameter files, which rclcpp and rcl do not convert.

Sources: ros2_controllers, *_parameters.yaml (Humble to Rolling); rcl, rcl_yaml_param_parser/src/parse.c.
"""

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, walk

_GRIPPER = r"goal_tolerance|max_effort|max_velocity|stall_velocity_threshold|stall_timeout|action_monitor_rate"
_STEERING = r"wheelbase|(?:front_|rear_)?wheel_track|(?:traction|steering)_track_width|\w+_radius|reference_timeout"
_DOUBLES = {
    "joint_trajectory_controller/JointTrajectoryController": (
        r"state_publish_rate|action_monitor_rate|cmd_timeout|constraints\.(?:stopped_velocity_tolerance|goal_time)"
        r"|constraints\..+\.(?:trajectory|goal)|gains\..+\.(?:p|i|d|i_clamp|ff_velocity_scale)"
    ),
    "diff_drive_controller/DiffDriveController": (
        r"wheel_separation|wheel_radius|\w+_multiplier|cmd_vel_timeout|publish_rate"
        r"|(?:linear\.x|angular\.z)\.(?:max|min)_\w+"
    ),
    "tricycle_controller/TricycleController": r"wheelbase|wheel_radius",
    **{
        f"{name}_steering_controller/{name.title()}SteeringController": _STEERING
        for name in ("ackermann", "bicycle", "tricycle")
    },
    **{
        f"{name}/GripperActionController": _GRIPPER
        for name in ("position_controllers", "effort_controllers", "parallel_gripper_action_controller")
    },
}
"""Controller type → pattern of its parameters with the type double."""

_INTEGER = r"[-+]?\d+"
_DOUBLE = r"[-+]?(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][-+]?\d+)?"


def integers_for_doubles(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield the integers in double parameters of ROS 2 controllers: value, name of the parameter, controller."""
    if PARAMETERS not in source.text:
        return
    for one in settings(source):
        pattern = _DOUBLES.get(one.kind)
        for name, value in _parameters(one.group) if pattern is not None else ():
            if value.is_plain and re.fullmatch(_INTEGER, value.text) and re.fullmatch(pattern or "", name):
                yield value, name, one.name


def mixed_lists(source: Source) -> Iterator[tuple[Node, Node]]:
    """Yield the lists of integers and doubles in ROS 2 parameters: name, first integer."""
    for document in documents(source) if PARAMETERS in source.text else ():
        sections = [node.find(PARAMETERS) for node in walk(document)]
        for node in (node for section in sections if section is not None for node in walk(section)):
            for key, value in node.entries:
                types = [_type_of(item) for item in value.items]
                if set(types) == {int, float}:
                    yield key, value.items[types.index(int)]


def _type_of(node: Node) -> type | None:
    """Return the type that rcl gives a number; None for other values."""
    if node.is_plain and re.fullmatch(_INTEGER, node.text):
        return int
    return float if node.is_plain and re.fullmatch(_DOUBLE, node.text) else None


def _parameters(group: Node, prefix: str = "", depth: int = 0) -> Iterator[tuple[str, Node]]:
    """Yield the scalars below a node with their names, joined with dots."""
    for key, value in group.entries:
        if value.kind == "group" and depth < 4:
            yield from _parameters(value, f"{prefix}{key.text}.", depth + 1)
        else:
            yield f"{prefix}{key.text}", value
