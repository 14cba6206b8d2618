"""Binary frames of the Foxglove protocol.

https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md
"""

import struct
from typing import NamedTuple

from urdfkit.errors import UsageError

MESSAGE, TIME, SERVICE_RESPONSE, ASSET = 1, 2, 3, 4
"""First bytes of frames of the server."""
CLIENT_MESSAGE, SERVICE_REQUEST = 1, 2
"""First bytes of frames of a client."""


class ClientMessage(NamedTuple):
    """A message that a client publishes on one of its channels."""

    channel: int
    content: bytes


class ServiceRequest(NamedTuple):
    """A call of a service."""

    service: int
    call: int
    encoding: str
    content: bytes


def message_frame(subscription: int, nanoseconds: int, content: list[bytes | memoryview]) -> list[bytes | memoryview]:
    """Return a message of a subscription."""
    return [struct.pack("<BIQ", MESSAGE, subscription, nanoseconds), *content]


def time_frame(nanoseconds: int) -> bytes:
    """Return the time of the server."""
    return struct.pack("<BQ", TIME, nanoseconds)


def response_frame(request: ServiceRequest, content: bytes) -> bytes:
    """Return the response to a call, in the encoding of the request."""
    encoding = request.encoding.encode()
    return struct.pack("<BIII", SERVICE_RESPONSE, request.service, request.call, len(encoding)) + encoding + content


def asset_frame(request: int, content: bytes | None, error: str = "") -> bytes:
    """Return a file, or the reason why there is no content."""
    reason = error.encode()
    return struct.pack("<BIBI", ASSET, request, int(content is None), len(reason)) + reason + (content or b"")


def read_frame(frame: bytes) -> ClientMessage | ServiceRequest:
    """Return the content of a frame of a client.

    Raises:
        UsageError: the frame is too short, or its kind is unknown.
    """
    try:
        if frame[0] == CLIENT_MESSAGE:
            return ClientMessage(struct.unpack_from("<I", frame, 1)[0], frame[5:])
        if frame[0] == SERVICE_REQUEST:
            service, call, length = struct.unpack_from("<III", frame, 1)
            return ServiceRequest(service, call, frame[13 : 13 + length].decode(), frame[13 + length :])
    except (IndexError, UnicodeDecodeError, struct.error):
        raise UsageError("a binary frame is too short") from None
    raise UsageError(f"unknown type {frame[0]} of a binary frame")
