"""Messages of rclpy from those of urdfkit, by the names of their fields: versions of ROS packages differ in these."""

from importlib import import_module
from typing import Any

import numpy as np

from urdfkit.messages import typestore


def rclpy_type(name: str) -> Any:
    """Return the class of a message, service or action such as ``std_srvs/srv/Empty``; None without its package."""
    package, kind, message = name.split("/")
    try:
        return getattr(import_module(f"{package}.{kind}"), message, None)
    except ImportError:
        return None


def rclpy_message(kind: Any, source: Any) -> Any:
    """Return a message of a class of rclpy with the fields of another message; fields that it lacks are zero or empty.

    Args:
        kind: class of rclpy.
        source: a message of any class.
    """
    made = kind()
    for name, slot in zip(made.get_fields_and_field_types(), made.SLOT_TYPES, strict=True):
        if hasattr(source, name):
            setattr(made, name, _value(slot, getattr(source, name)))
    return made


def further_fields(message: Any, type: str) -> list[str]:
    """Return the fields of a message of rclpy that urdfkit's type lacks, if they are not zero or empty.

    Args:
        message: of rclpy.
        type: of urdfkit, e.g. ``control_msgs/msg/FollowJointTrajectoryGoal``.
    """
    layouts, found = dict(typestore().fielddefs[type][1]), []
    for name in message.get_fields_and_field_types():
        value = getattr(message, name)
        if name not in layouts:
            if not np.array_equal(value, getattr(message.__class__(), name)):
                found.append(name)
            continue
        node, details = layouts[name]
        is_array = int(node) > 2
        inner, kind = details[0] if is_array else (node, details)
        if int(inner) == 2:
            for each in value if is_array else [value]:
                found += [f"{name}.{field}" for field in further_fields(each, kind)]
    return list(dict.fromkeys(found))


def _value(slot: Any, value: Any) -> Any:
    if hasattr(slot, "value_type"):
        if hasattr(slot.value_type, "namespaces"):
            return [_value(slot.value_type, each) for each in value]
        return value.tolist() if isinstance(value, np.ndarray) else value
    if hasattr(slot, "namespaces"):
        return rclpy_message(rclpy_type("/".join((*slot.namespaces, slot.name))), value)
    return value.item() if isinstance(value, np.generic) else value
