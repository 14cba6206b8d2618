"""Access control of a server: token, cookie, and the rules for Host and Origin."""

import hmac
import ipaddress
import re
import secrets
from dataclasses import dataclass, field

LOOPBACK_NAMES = ("localhost", "127.0.0.1", "::1")

_HOST = re.compile(r"(?:(?P<name>[A-Za-z0-9._-]+)|\[(?P<address>[0-9A-Fa-f:.]+)\])(?::[0-9]{1,5})?", re.ASCII)


@dataclass(frozen=True)
class AccessControl:
    """Rules that decide whether a request is accepted.

    Attributes:
        port: the port served.
        names: accepted host names; IP literals are accepted as well when `open_to_network`.
        open_to_network: whether the server is bound to more than the loopback interface.
        token: the secret in the printed URL; a request with it gets the cookie.
        session: value of the cookie.
    """

    port: int
    names: tuple[str, ...] = LOOPBACK_NAMES
    open_to_network: bool = False
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24), repr=False)
    session: str = field(default_factory=lambda: secrets.token_urlsafe(24), repr=False)

    @property
    def cookie(self) -> str:
        """Name of the cookie. Browsers share cookies between ports, so the name contains the port."""
        return f"urdfkit-{self.port}"

    def accepts_token(self, token: str) -> bool:
        """Whether this is the token; compared in constant time."""
        return hmac.compare_digest(token.encode("utf-8", "surrogatepass"), self.token.encode())

    def accepts_session(self, cookie: str | None) -> bool:
        """Whether this is the value of the cookie; compared in constant time."""
        return cookie is not None and hmac.compare_digest(
            cookie.encode("utf-8", "surrogatepass"), self.session.encode()
        )

    def accepts_host(self, host: str) -> bool:
        """Whether the Host header names this server: the defence against DNS rebinding.

        Any port is accepted, so that a port forwarded by ssh works; the Origin rule rejects pages of other ports.
        An IP literal cannot be rebound, so it is accepted if the server is open to the network.
        """
        name = host_name(host)
        if name is None:
            return False
        return name in self.names or (self.open_to_network and is_ip_literal(name))

    def accepts_origin(self, origin: str | None, host: str) -> bool:
        """Whether the Origin header is exactly the origin of the page that this server sent under `host`."""
        return origin is not None and origin.lower() == f"http://{host.lower()}"


def host_name(host: str) -> str | None:
    """Return the name in a Host header without port and brackets, in lower case; None if the header is invalid."""
    found = _HOST.fullmatch(host)
    return (found["name"] or found["address"]).lower() if found else None


def is_ip_literal(name: str) -> bool:
    """Whether `name` is an IPv4 or IPv6 address rather than a name."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def is_loopback(host: str) -> bool:
    """Whether binding to `host` keeps the server on this machine."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
