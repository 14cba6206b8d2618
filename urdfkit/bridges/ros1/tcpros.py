"""TCPROS: connection headers and messages on a socket.

https://wiki.ros.org/ROS/TCPROS, https://wiki.ros.org/ROS/Connection%20Header
"""

import socket
import struct
from collections.abc import Mapping

LENGTH = struct.Struct("<I")
MAX_HEADER = 1024 * 1024
"""Bytes of the longest header that is accepted; it contains the definition of a message."""
MAX_MESSAGE = 256 * 1024 * 1024
"""Bytes of the longest message that is accepted."""
TIMEOUT = 5.0
"""Seconds for a connection and its headers."""


class TcprosError(Exception):
    """A peer sent something else than TCPROS, refused the connection, or closed it."""


def write_header(connection: socket.socket, fields: Mapping[str, str]) -> None:
    """Send a connection header."""
    entries = [f"{name}={value}".encode() for name, value in fields.items()]
    content = b"".join(LENGTH.pack(len(entry)) + entry for entry in entries)
    connection.sendall(LENGTH.pack(len(content)) + content)


def read_header(connection: socket.socket) -> dict[str, str]:
    """Return the connection header of a peer.

    Raises:
        TcprosError: it is malformed, or reports an error.
    """
    content = read_block(connection, MAX_HEADER)
    found: dict[str, str] = {}
    at = 0
    while at < len(content):
        if at + 4 > len(content):
            raise TcprosError("the header is truncated")
        (size,) = LENGTH.unpack_from(content, at)
        entry = content[at + 4 : at + 4 + size]
        name, equals, value = entry.partition(b"=")
        if len(entry) < size or not equals:
            raise TcprosError("the header is malformed")
        found[name.decode("utf-8", "replace")] = value.decode("utf-8", "replace")
        at += 4 + size
    if "error" in found:
        raise TcprosError(found["error"])
    return found


def read_block(connection: socket.socket, limit: int = MAX_MESSAGE) -> bytes:
    """Return the bytes of a length and as many bytes.

    Raises:
        TcprosError: the connection is closed, or the length exceeds the limit.
    """
    (size,) = LENGTH.unpack(read_bytes(connection, 4))
    if size > limit:
        raise TcprosError(f"{size} bytes are more than the limit, {limit}")
    return read_bytes(connection, size)


def read_bytes(connection: socket.socket, size: int) -> bytes:
    """Return a number of bytes.

    Raises:
        TcprosError: the connection is closed.
    """
    content = bytearray()
    while len(content) < size:
        part = connection.recv(min(size - len(content), 1 << 20))
        if not part:
            raise TcprosError("the connection is closed")
        content += part
    return bytes(content)
