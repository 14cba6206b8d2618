"""Messages of ROS 2 in CDR."""

from __future__ import annotations

from typing import Any

from urdfkit.messages import typestore
from urdfkit.messages.conversion import converted


def encode(message: Any, type: str) -> bytes:
    """Return a message in CDR, with its header of four bytes."""
    store = typestore()
    return bytes(store.serialize_cdr(converted(message, type, store), type))


def decode(data: bytes, type: str) -> Any:
    """Return the message of its bytes; raises errors of several classes if they are malformed."""
    return typestore().deserialize_cdr(data, type)
