"""Conversion of messages between two sets of types, such as those of ROS 1 and ROS 2, by the names of their fields."""

import struct
from array import array
from dataclasses import fields, is_dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from urdfkit.messages import typestore

ZERO: dict[str, Any] = {"string": "", "wstring": "", "bool": False, "float32": 0.0, "float64": 0.0}
"""Base type → value of a missing field; 0 for others."""


LONG = 16_384
"""Bytes of an array that is not copied."""
AFTER_DATA = {"sensor_msgs/msg/Image": 0, "sensor_msgs/msg/CompressedImage": 0, "sensor_msgs/msg/PointCloud2": 1}
"""Type with an array of bytes → number of the bytes after it."""

UNUSED = "structure_needs_at_least_one_member"
"""The field of messages without fields."""


def fields_of(message: Any) -> tuple[str, ...]:
    """Return the names of the fields of a message, without its constants; none for a value that is no message."""
    return field_names(message.__class__)


@cache
def field_names(kind: Any) -> tuple[str, ...]:
    """Return the names of the fields of a class of messages, without its constants; none for other classes."""
    if not is_dataclass(kind):
        return ()
    constant = "ClassVar"  # as a text, in classes that rosbags makes of registered types
    return tuple(each.name for each in fields(kind) if each.name != UNUSED and not str(each.type).startswith(constant))


def encode_cdr(message: Any, type: str) -> bytes:
    """Return a message in CDR, the encoding of ROS 2, with its header of four bytes."""
    return b"".join(cdr_parts(message, type))


def cdr_parts(message: Any, type: str) -> list[bytes | memoryview]:
    """Return the parts of a message in CDR; a long array at its end is not copied, which takes long for an image."""
    if type not in AFTER_DATA or not isinstance(message.data, np.ndarray) or len(message.data) < LONG:
        store = typestore()
        return [bytes(store.serialize_cdr(converted(message, type, store), type))]
    data, start = message.data, len(message.data) % 8  # the remainder, so that the alignment of the fields is the same
    short = encode_cdr(replace(message, data=data[:start]), type)
    end = len(short) - AFTER_DATA[type]
    length = struct.pack("<I", len(data))
    return [short[: end - start - 4] + length, np.ascontiguousarray(data).data, short[end:]]


def decode_cdr(data: bytes, type: str) -> Any:
    """Return the message of its bytes in CDR; raises errors of several classes if they are malformed."""
    return typestore().deserialize_cdr(data, type)


def converted(message: Any, type: str, store: Any) -> Any:
    """Return a message as the class that a typestore has for its type; arrays of numbers are not copied.

    Upper and lower case of fields do not matter; missing fields are zero or empty, and further ones are
    dropped.

    Args:
        message: of any class with the fields.
        type: e.g. ``sensor_msgs/msg/CameraInfo``.
        store: a typestore of rosbags.
    """
    kind = store.types[type]
    if isinstance(message, kind):
        return message
    values = {}
    for name, (node, details) in store.fielddefs[type][1]:
        value = getattr(message, name, None)
        if value is None:
            value = getattr(message, name.swapcase(), None)
        values[name] = _value(value, int(node), details, store)
    return kind(**values)


def _value(value: Any, node: int, details: Any, store: Any) -> Any:
    """Return the value of a field by rosbags' description of it: (node type, details)."""
    if node == 2:
        return converted(value, details, store)
    if node == 1:
        return ZERO.get(details[0], 0) if value is None else value
    inner, length = details
    if int(inner[0]) == 2:
        entries = [None] * (length if node == 3 else 0) if value is None else value
        return [converted(each, inner[1], store) for each in entries]
    if value is None:
        base = inner[1][0]
        return [] if base == "string" else np.zeros(length if node == 3 else 0, dtype=base)
    return np.asarray(value) if isinstance(value, array) else value  # rclpy has arrays of Python's own
