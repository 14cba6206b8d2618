"""Messages of rclpy from those of urdfkit, by the names of their fields: versions of ROS packages differ in these."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np


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


def _value(slot: Any, value: Any) -> Any:
    if hasattr(slot, "value_type"):
        if hasattr(slot.value_type, "namespaces"):
            return [_value(slot.value_type, each) for each in value]
        return value.tolist() if isinstance(value, np.ndarray) else value
    if hasattr(slot, "namespaces"):
        return rclpy_message(rclpy_type("/".join((*slot.namespaces, slot.name))), value)
    return value.item() if isinstance(value, np.generic) else value
