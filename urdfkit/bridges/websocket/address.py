"""Addresses of bridges: ``PORT`` or ``HOST:PORT``."""

from typing import NamedTuple

from urdfkit.errors import UsageError
from urdfkit.network.access_control import is_loopback

LOOPBACK = "127.0.0.1"


class Address(NamedTuple):
    """Address that a bridge listens on; port 0 is any free port."""

    host: str
    port: int

    @property
    def is_private(self) -> bool:
        """Whether only this machine can connect."""
        return is_loopback(self.host)


def parse_address(text: str) -> Address:
    """Return the address in ``PORT`` or ``HOST:PORT``; without a host, the loopback interface.

    Raises:
        UsageError: the text is neither.
    """
    host, colon, port = text.rpartition(":")
    if not (port.isascii() and port.isdigit() and int(port) <= 65535 and (host or not colon)):
        raise UsageError(f"`{text}` is not an address; use PORT or HOST:PORT, such as 9090 or 0.0.0.0:9090")
    return Address(host.removeprefix("[").removesuffix("]") or LOOPBACK, int(port))
