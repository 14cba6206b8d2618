"""Frames of a WebSocket server; RFC 6455, section 5.2."""

import struct
from collections.abc import Sequence

BINARY, TEXT = 0x82, 0x81
"""First bytes of the only frame of a message."""
SHORT = 4096
"""Length of parts that are not copied [bytes]."""


def framed(message: str | bytes) -> bytes:
    """Return a message as one unmasked frame of a server."""
    first, content = (BINARY, message) if isinstance(message, bytes) else (TEXT, message.encode())
    return frame_header(first, len(content)) + content


def framed_parts(parts: Sequence[bytes | memoryview]) -> list[bytes | memoryview]:
    """Return a binary message of several parts as one unmasked frame; parts that are not short are not copied."""
    found: list[bytes | memoryview] = []
    short = [frame_header(BINARY, sum(map(len, parts)))]
    for part in parts:
        if len(part) < SHORT:
            short.append(bytes(part))
        else:
            found += (b"".join(short), part)
            short = []
    return [*found, b"".join(short)] if short else found


def frame_header(first: int, size: int) -> bytes:
    """Return what precedes the content of an unmasked frame.

    Args:
        first: `BINARY` or `TEXT`.
        size: length of the content [bytes].
    """
    if size < 126:
        return struct.pack("!BB", first, size)
    if size < 1 << 16:
        return struct.pack("!BBH", first, 126, size)
    return struct.pack("!BBQ", first, 127, size)
