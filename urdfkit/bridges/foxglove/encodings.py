"""Messages in the encodings of clients, CDR and JSON, and the definitions of their types."""

import json
import struct
from functools import cache
from typing import Any

from urdfkit.bridges.json_messages import from_json, to_json
from urdfkit.errors import UsageError
from urdfkit.messages import typestore

ENCODINGS = ("cdr", "json")


@cache
def definition(type: str) -> str:
    """Return the definition of a message type with those of its fields, as ``ros2 bag`` stores it."""
    text: str = typestore().generate_msgdef(type, ros_version=2)[0]
    return text


def decode(type: str, encoding: str, content: bytes) -> Any:
    """Return a message.

    Raises:
        UsageError: the content is not such a message, or the encoding is unknown.
    """
    if encoding == "json":
        try:
            return from_json(type, json.loads(content or b"{}") or None)
        except ValueError as error:
            raise UsageError(f"the message is not JSON: {error}") from error
    if encoding != "cdr":
        raise UsageError(f"unknown encoding `{encoding}`; use {' or '.join(ENCODINGS)}")
    if type not in typestore().fielddefs:
        from_json(type, None)  # raises, with the most similar type
    from rosbags.serde import SerdeError

    try:
        return typestore().deserialize_cdr(content, type)
    except (ArithmeticError, AssertionError, LookupError, SerdeError, TypeError, ValueError, struct.error) as error:
        raise UsageError(f"the message is not a {type} in CDR: {error or 'wrong length'}") from error


def encode(type: str, encoding: str, message: Any) -> bytes:
    """Return a message as bytes."""
    return to_json(message).encode() if encoding == "json" else bytes(typestore().serialize_cdr(message, type))
