"""The http and websocket side: which request gets what."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import itertools
import logging
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tornado.iostream import StreamClosedError
from tornado.web import Application, HTTPError, RequestHandler
from tornado.websocket import (
    WebSocketClosedError,
    WebSocketHandler,
    WebSocketProtocol,
    WebSocketProtocol13,
)

from urdfkit.errors import MissingDependencyError
from urdfkit.view import protocol
from urdfkit.view.channel import Channel, Frame
from urdfkit.view.hub import CLEAR
from urdfkit.view.security import Gate, headers

if TYPE_CHECKING:
    from urdfkit.view.server import Server

PING = 5.0
"""Seconds between pings; a browser that does not answer one before the next is gone."""
COMPLAINTS = 10
"""Dropped messages reported per page."""

APP = Path(__file__).parent / "app"
TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
MESHCAT = "meshcat.js"
OFFLINE = "offline.js"
"""The module that only a page in one file begins with."""

log = logging.getLogger("urdfkit.view")

REFUSED = """<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>urdfkit: not let in</title><link rel="stylesheet" href="/app/refused.css">
<main><h1>This page needs its key</h1>
<p>{reason}</p>
<p>Open the full address that urdfkit printed in the terminal, the one with <code>?token=…</code> at its end.
If you just did, <a href="/">go on</a>.</p></main></html>"""


def application(server: Server) -> Application:
    """Return the tornado application of a server."""
    files = {path.name: path for path in APP.iterdir() if path.suffix in TYPES}
    files[MESHCAT] = meshcat_bundle()
    return Application(
        [
            (r"/", Page, {"server": server}),
            (r"/app/([\w.-]+)", AppFile, {"server": server}),
            (r"/geometry/([0-9a-f]{64})", Geometry, {"server": server}),
            (r"/ws", Socket, {"server": server}),
        ],
        default_handler_class=Nothing,
        default_handler_args={"server": server},
        files=files,
        compress_response=True,
        websocket_max_message_size=protocol.MAX_INBOUND,
        websocket_ping_interval=PING,
        log_function=lambda handler: None,
    )


def meshcat_bundle() -> Path:
    """Return meshcat's JavaScript, without importing meshcat.

    Raises:
        MissingDependencyError: meshcat is not installed.
    """
    spec = find_spec("meshcat")
    if spec is None or not spec.submodule_search_locations:
        raise MissingDependencyError("view needs meshcat: pip install 'urdfkit[view]'")
    return Path(spec.submodule_search_locations[0]) / "viewer" / "dist" / "main.min.js"


class Guarded(RequestHandler):
    """Lets nobody in without the cookie, under a foreign Host, or from a foreign page."""

    open_to_all = False

    def initialize(self, server: Server) -> None:
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
        elif not self.open_to_all and not self.gate.session_fits(self.get_cookie(self.gate.cookie)):
            self.refuse("This browser has not shown the key yet, or urdfkit was started anew since.")

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


class Nothing(Guarded):
    """Every other path."""

    def prepare(self) -> None:
        """Answer 404, but only to those let in."""
        super().prepare()
        if not self._finished:
            raise HTTPError(404)


class Page(Guarded):
    """The page. With the token in the address it sets the cookie and sends the browser to the bare address."""

    open_to_all = True

    def get(self) -> None:
        """Serve the page."""
        tokens = self.get_query_arguments("token")
        if tokens:
            if len(tokens) != 1 or not self.gate.token_fits(tokens[0]):
                self.refuse("The key in the address is wrong: it changes whenever urdfkit is started.")
                return
            self.set_cookie(
                self.gate.cookie, self.gate.session, expires_days=None, path="/", httponly=True, samesite="Strict"
            )
            self.redirect("/", status=303)
        elif not self.gate.session_fits(self.get_cookie(self.gate.cookie)):
            self.refuse("This browser has not shown the key yet, or urdfkit was started anew since.")
        else:
            self.set_header("Content-Type", "text/html; charset=utf-8")
            self.finish(page())


def page() -> str:
    """Return the page, with all its modules named at the top, so that a browser need not find one through another."""
    text = (APP / "index.html").read_text("utf-8")
    modules = sorted(path.name for path in APP.glob("*.js") if path.name != OFFLINE)
    links = "".join(f'  <link rel="modulepreload" href="/app/{name}">\n' for name in modules)
    return text.replace("</head>", f"{links}</head>", 1)


@lru_cache(maxsize=256)
def packed(path: Path, _changed: int) -> bytes:
    """Return a file as gzip packs it; the second argument is when it was changed, so that an old one is not kept."""
    return gzip.compress(path.read_bytes(), 6, mtime=0)


class AppFile(Guarded):
    """The page's own files, from a list made at the start: nothing is looked up by the path in a request."""

    open_to_all = True  # nothing in them is anybody's secret, and the refusal page wants its style

    @property
    def files(self) -> dict[str, Path]:
        """File name → file."""
        found: dict[str, Path] = self.settings["files"]
        return found

    def get(self, name: str) -> None:
        """Serve one file."""
        path = self.files.get(name)
        if path is None:
            raise HTTPError(404)
        self.set_header("Content-Type", f"{TYPES[path.suffix]}; charset=utf-8")
        if "gzip" in self.request.headers.get("Accept-Encoding", ""):
            self.set_header("Content-Encoding", "gzip")
            self.finish(packed(path, path.stat().st_mtime_ns))
        else:
            self.finish(path.read_bytes())


class Geometry(Guarded):
    """A mesh by the hash of its content."""

    def get(self, name: str) -> None:
        """Serve one mesh."""
        packed = self.server.geometries.get(name)
        if packed is None:
            raise HTTPError(404)
        self.set_header("Content-Type", "application/octet-stream")
        self.set_header("Cache-Control", "private, max-age=31536000, immutable")  # its name is its content
        self.finish(packed)


class Socket(Guarded, WebSocketHandler):
    """The websocket of one page."""

    _numbers = itertools.count(1)

    def initialize(self, server: Server) -> None:
        """Take what the route hands over."""
        super().initialize(server)
        self.client = next(Socket._numbers)
        self.channel = Channel()
        self._sender: asyncio.Task[None] | None = None
        self._dropped = 0

    def check_origin(self, origin: str) -> bool:
        """Whether the page is one this server handed out."""
        return self.gate.origin_fits(origin, self.host)

    def prepare(self) -> None:
        """Refuse as every handler does; here the Origin is not optional."""
        super().prepare()
        if not self._finished and not self.gate.origin_fits(self.request.headers.get("Origin"), self.host):
            self.refuse("A websocket needs an Origin.")

    def get_websocket_protocol(self) -> WebSocketProtocol | None:
        """Return tornado's own, which cuts the line at a frame that is too long or makes no sense, and say so."""
        line = super().get_websocket_protocol()
        if isinstance(line, WebSocketProtocol13):
            receive = line._receive_frame

            async def receive_and_tell() -> None:
                await receive()
                if line.stream.closed():
                    why = f"a frame was malformed, or longer than {protocol.MAX_INBOUND} bytes; the line is cut"
                    self.server.refusals.tell(str(self.request.remote_ip), f"page {self.client}", why)

            line._receive_frame = receive_and_tell  # type: ignore[method-assign]
        return line

    def open(self, *_: str, **__: str) -> None:
        """Bring the page up to date and start sending."""
        self.set_nodelay(True)
        self.channel.line(protocol.write("you", client=self.client))
        self.channel.line(CLEAR)  # it may have been here before, and show what is no more
        self.server.hub.join(self.channel, self.client)
        self._sender = asyncio.ensure_future(self._send())

    async def _send(self) -> None:
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            await self.channel.run(self._write)
            self.close(1013, "too slow; connect again")

    async def _write(self, frame: Frame) -> None:
        await self.write_message(frame, binary=isinstance(frame, bytes))

    def on_message(self, message: str | bytes) -> None:
        """Check and pass on what the page sends; nonsense is dropped and said so in the log."""
        try:
            self.server.heard(self.client, self.channel, message)
        except protocol.ProtocolError as error:
            self._complain(error)

    def _complain(self, error: protocol.ProtocolError) -> None:
        self._dropped += 1
        if self._dropped < COMPLAINTS:
            log.warning("dropped a message of page %d: %s", self.client, error)
        elif self._dropped == COMPLAINTS:
            log.warning("dropped %d messages of page %d; no more of them are reported", self._dropped, self.client)

    def on_close(self) -> None:
        """Stop sending; if this page drove, the robot stops."""
        self.server.driver.leave(self.client)
        self.server.hub.leave(self.channel)
        if self._sender is not None:
            self._sender.cancel()
