"""Guarded: what every request has to show before anything else is done with it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tornado.web import RequestHandler

from urdfkit.view.server.access_control import Gate, headers

if TYPE_CHECKING:
    from urdfkit.view.server.page_server import PageServer

REFUSED = """<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>urdfkit: not let in</title><link rel="stylesheet" href="/app/styles/refused.css">
<main><h1>This page needs its key</h1>
<p>{reason}</p>
<p>Open the full address that urdfkit printed in the terminal, the one with <code>?token=…</code> at its end.
If you just did, <a href="/">go on</a>.</p></main></html>"""


class Guarded(RequestHandler):
    """Refuses requests without the cookie or the token, under an unknown Host, or from a page of another site.

    A page in a frame sends the token with each request, because browsers keep cookies from frames of other sites.
    """

    open_to_all = False

    def initialize(self, server: PageServer) -> None:
        """Take what the route hands over."""
        self.server = server

    @property
    def gate(self) -> Gate:
        """The rules."""
        return self.server.gate

    @property
    def host(self) -> str:
        """The Host header, empty when there is none."""
        return self.request.headers.get("Host", "")

    def set_default_headers(self) -> None:
        """Set the headers of every answer, errors included."""
        self.clear_header("Server")
        for name, value in headers(self.host).items():
            self.set_header(name, value)

    def prepare(self) -> None:
        """Refuse before any handler runs."""
        origin = self.request.headers.get("Origin")
        if not self.gate.host_fits(self.host):
            self.refuse("The address in the browser's address bar is not one this server answers to.")
        elif origin is not None and not self.gate.origin_fits(origin, self.host):
            self.refuse("The request came from a page of another site.")
        elif not (self.open_to_all or self.gate.session_fits(self.get_cookie(self.gate.cookie)) or self.has_token):
            self.refuse("This browser has not sent the token yet, or urdfkit has been restarted since.")

    @property
    def has_token(self) -> bool:
        """Whether the address has the token."""
        tokens = self.get_query_arguments("token")
        return len(tokens) == 1 and self.gate.token_fits(tokens[0])

    def refuse(self, reason: str) -> None:
        """Answer 403 with a page that says what to do."""
        self.server.refusals.tell(str(self.request.remote_ip), f"{self.request.method} {self.request.path}", reason)
        self.set_status(403)
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.finish(REFUSED.format(reason=reason))

    def write_error(self, status_code: int, **_: Any) -> None:
        """Answer errors in one plain line."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code} {self._reason}\n")
