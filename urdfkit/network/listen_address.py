"""Bind a free port and return the URLs of the page."""

import errno
import os
import socket

from urdfkit.errors import UsageError
from urdfkit.network.access_control import is_loopback

DEFAULT_PORT = 7007
TRIES = 50
_ADVICE = "use 127.0.0.1 for this machine alone, or 0.0.0.0 to accept others"
WILDCARDS = ("0.0.0.0", "::", "")


def bind(host: str, port: int | None) -> tuple[socket.socket, int]:
    """Bind an address.

    Args:
        host: address or host name.
        port: exactly this port, 0 for any free port; None for the first free one starting at `DEFAULT_PORT`.

    Returns:
        The listening socket and the port.

    Raises:
        UsageError: the port is in use (the message names a free one) or the address does not belong to this machine.
    """
    if port is not None and not 0 <= port <= 65535:
        raise UsageError(f"port {port} is outside 0..65535")
    candidates = [port] if port is not None else [*range(DEFAULT_PORT, DEFAULT_PORT + TRIES), 0]
    for candidate in candidates:
        try:
            listening = _bind(host, candidate)
        except OSError as error:
            if error.errno == errno.EADDRINUSE:
                continue
            if error.errno == errno.EACCES:
                free = _free_port(host, DEFAULT_PORT)
                raise UsageError(f"port {candidate} requires privileges; use {free}") from error
            raise UsageError(f"cannot listen on `{host}`: {_reason(host, error)}; {_ADVICE}") from error
        return listening, int(listening.getsockname()[1])
    raise UsageError(f"port {port} is in use; {_free_port(host, (port or 0) + 1)} is free")


def _bind(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # No SO_REUSEPORT: a second server must fail to bind, not share the port.
    listening = socket.create_server((host, port), family=family, backlog=128, reuse_port=False)
    listening.setblocking(False)
    return listening


def _free_port(host: str, start: int) -> int:
    for port in (*range(start, min(start + TRIES, 65536)), 0):
        try:
            listening = _bind(host, port)
        except OSError:
            continue
        with listening:
            return int(listening.getsockname()[1])
    return DEFAULT_PORT


def _reason(host: str, error: OSError) -> str:
    try:
        socket.getaddrinfo(host, None)
    except OSError:
        return "unknown host name"
    if error.errno == errno.EADDRNOTAVAIL:
        return "not an address of this machine"
    return os.strerror(error.errno) if error.errno is not None else str(error)


def urls(host: str, port: int, token: str) -> list[str]:
    """Return the URLs of the page; the first one is for a browser on this machine."""
    if is_loopback(host):
        names = ["[::1]" if ":" in host else "127.0.0.1"]
    elif host in WILDCARDS:
        names = ["127.0.0.1", *_network_addresses()]
    else:
        names = [f"[{host}]" if ":" in host else host]
    return [f"http://{name}:{port}/?token={token}" for name in dict.fromkeys(names)]


def _network_addresses() -> list[str]:
    """Return the network address of this machine from its routing table; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # TEST-NET-1, RFC 5737
        except OSError:
            return []
        return [str(probe.getsockname()[0])]
