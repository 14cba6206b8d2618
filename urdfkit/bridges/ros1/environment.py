"""Variables of ROS 1: the address of the master, and the address by which other nodes reach this one."""

import os
from collections.abc import Mapping
from urllib.parse import urlsplit

from urdfkit.errors import UsageError
from urdfkit.network.access_control import is_loopback

MASTER, IP, HOSTNAME = "ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME"
DEFAULT_MASTER = "http://localhost:11311"


def master_uri(environment: Mapping[str, str] = os.environ) -> str:
    """Return the address of the master: that of ``ROS_MASTER_URI``, else the usual one.

    Raises:
        UsageError: it is not ``http://HOST:PORT``.
    """
    text = environment.get(MASTER) or DEFAULT_MASTER
    try:
        parts = urlsplit(text)
        valid = parts.scheme == "http" and bool(parts.hostname) and parts.port is not None
    except ValueError:
        valid = False
    if not valid:
        raise UsageError(f"{MASTER} is `{text}`; use http://HOST:PORT, such as {DEFAULT_MASTER}")
    return text


def own_host(environment: Mapping[str, str] = os.environ) -> str:
    """Return the name or address that other nodes use: ``ROS_HOSTNAME``, else ``ROS_IP``, else the loopback address."""
    return environment.get(HOSTNAME) or environment.get(IP) or "127.0.0.1"


def bind_host(environment: Mapping[str, str] = os.environ) -> str:
    """Return the address to listen on: all interfaces if this machine has a name in the network, else the loopback."""
    return "127.0.0.1" if is_loopback(own_host(environment)) else "0.0.0.0"


def is_remote(master: str) -> bool:
    """Return whether a master is on another machine."""
    return not is_loopback(urlsplit(master).hostname or "")
