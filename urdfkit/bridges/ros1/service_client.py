"""Calls of ROS 1 services by TCPROS."""

import socket
from urllib.parse import urlsplit

from urdfkit.bridges.node.node import RESPONSE
from urdfkit.bridges.ros1.ros1_types import ANY, full_name
from urdfkit.bridges.ros1.tcpros import LENGTH, TIMEOUT, TcprosError, read_block, read_bytes, read_header, write_header
from urdfkit.errors import ResourceError


def service_type(node: str, service: str, address: str) -> str:
    """Return the type of a service, e.g. ``std_srvs/srv/Empty``.

    Args:
        node: name of this node.
        service: its name.
        address: of its server, ``rosrpc://HOST:PORT``, as the master reports it.

    Raises:
        ResourceError: the server does not respond.
    """
    try:
        with _connected(address) as connection:
            write_header(connection, {"callerid": node, "service": service, "md5sum": ANY, "probe": "1"})
            return full_name(read_header(connection).get("type", ""), "srv")
    except (OSError, TcprosError) as error:
        raise ResourceError(f"{service}: the server at {address} does not respond ({error})") from error


def call_service(node: str, service: str, address: str, checksum: str, request: bytes) -> bytes:
    """Return the encoded response of a service.

    Args:
        node: name of this node.
        service: its name.
        address: of its server.
        checksum: of its type.
        request: the encoded request.

    Raises:
        ResourceError: the server does not respond, has another type, or reports a failure.
    """
    try:
        with _connected(address) as connection:
            write_header(connection, {"callerid": node, "service": service, "md5sum": checksum})
            read_header(connection)
            connection.settimeout(RESPONSE)
            connection.sendall(LENGTH.pack(len(request)) + request)
            (succeeded,) = read_bytes(connection, 1)
            content = read_block(connection)
    except (OSError, TcprosError) as error:
        raise ResourceError(f"{service}: {error}") from error
    if not succeeded:
        raise ResourceError(f"{service}: {content.decode('utf-8', 'replace')}")
    return content


def _connected(address: str) -> socket.socket:
    parts = urlsplit(address)
    return socket.create_connection((parts.hostname or "", parts.port or 0), TIMEOUT)
