"""AuthenticatedHandler: base class of all handlers; checks host, origin and cookie before a request is processed.

It sets the headers of every response.
"""

from typing import Any

from tornado.web import RequestHandler

from urdfkit.network.access_control import AccessControl, host_name
from urdfkit.view.server.server_interface import PageServer

EMPTY_STYLE = "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='"
"""Hash of the empty string: meshcat's bundle creates an empty style element and fills it through the DOM."""

DAT_GUI_STYLES = ("'sha256-K7kXOYqP8pf16L5/PaLZ4u9Lt5q3nTyjCvyGtO/Af2k='",)
"""Hashes of the style sheets that meshcat's bundle injects for its own control panel, which is hidden here."""


def headers(host: str, *, framed: bool = False) -> dict[str, str]:
    """Return the headers of every response.

    Args:
        host: the Host header, for the address of the WebSocket (older Safari does not count it as 'self').
        framed: whether another page, such as a notebook, may show the response in a frame.
    """
    policy = {
        "default-src": "'none'",
        "script-src": "'self'",
        "style-src": " ".join(("'self'", EMPTY_STYLE, *DAT_GUI_STYLES)),
        "img-src": "'self' data: blob:",
        "connect-src": f"'self' ws://{host}" if host_name(host) else "'self'",
        "manifest-src": "'self'",
        "base-uri": "'none'",
        "form-action": "'none'",
        "frame-ancestors": "*" if framed else "'none'",
    }
    framing = {} if framed else {"X-Frame-Options": "DENY"}
    return framing | {
        "Content-Security-Policy": "; ".join(f"{name} {value}" for name, value in policy.items()),
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "no-referrer",
        "Cross-Origin-Opener-Policy": "same-origin",
        "Cross-Origin-Resource-Policy": "same-origin",
        "Permissions-Policy": "camera=(), microphone=(), geolocation=(), gamepad=(self), fullscreen=(self)",
        "Cache-Control": "no-store",
    }


NO_COOKIE = "This browser has not sent the token yet, or urdfkit was restarted with a new token."

REJECTED = """<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>urdfkit: access denied</title><link rel="stylesheet" href="/app/styles/refused.css">
<main><h1>This page requires its token</h1>
<p>{reason}</p>
<p>Open the full address that urdfkit printed in the terminal. It ends with <code>?token=…</code>.
If you have just opened it, <a href="/">continue</a>.</p></main></html>"""


class AuthenticatedHandler(RequestHandler):
    """Rejects requests without the cookie or the token, with an unknown Host, and from pages of other origins.

    A page in a frame sends the token with each request, because browsers keep cookies from frames of other sites.
    """

    open_to_all = False

    def initialize(self, server: PageServer) -> None:
        """Store the arguments of the route."""
        self.server = server

    @property
    def access(self) -> AccessControl:
        """The access rules."""
        return self.server.access

    @property
    def host(self) -> str:
        """The Host header; empty if the request has none."""
        return self.request.headers.get("Host", "")

    def set_default_headers(self) -> None:
        """Set the headers of every response, including errors."""
        self.clear_header("Server")
        for name, value in headers(self.host).items():
            self.set_header(name, value)

    def prepare(self) -> None:
        """Reject the request before any handler runs."""
        origin = self.request.headers.get("Origin")
        if not self.access.accepts_host(self.host):
            self.reject("The host name in the browser's address bar is not accepted by this server.")
        elif origin is not None and not self.access.accepts_origin(origin, self.host):
            self.reject("The request came from a page of another site.")
        elif not (
            self.open_to_all or self.access.accepts_session(self.get_cookie(self.access.cookie)) or self.has_token
        ):
            self.reject(NO_COOKIE)

    @property
    def has_token(self) -> bool:
        """Whether the address has the token."""
        tokens = self.get_query_arguments("token")
        return len(tokens) == 1 and self.access.accepts_token(tokens[0])

    def reject(self, reason: str, *, status: int = 403) -> None:
        """Respond with an error and a page that explains what to do."""
        self.server.rejections.add(str(self.request.remote_ip), f"{self.request.method} {self.request.path}", reason)
        self.set_status(status)
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish(REJECTED.format(reason=reason))

    def write_error(self, status_code: int, **_: Any) -> None:
        """Respond with the error as one line of text."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code} {self._reason}\n")
