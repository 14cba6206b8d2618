"""WebSocket server of a bridge: tornado in a thread of its own, one peer object for each connection."""

import asyncio
import contextlib
import logging
from collections.abc import Callable, Sequence
from typing import Any, Protocol, cast
from urllib.parse import urlsplit

from tornado.iostream import StreamClosedError
from tornado.web import Application
from tornado.websocket import WebSocketClosedError, WebSocketHandler, WebSocketProtocol13

from urdfkit.bridges.graph import Graph
from urdfkit.bridges.websocket.address import Address
from urdfkit.bridges.websocket.send_queue import Frame, SendQueue
from urdfkit.network.access_control import LOOPBACK_NAMES, AccessControl, is_ip_literal
from urdfkit.network.listen_address import bind, urls
from urdfkit.network.rejection_log import RejectionLog
from urdfkit.network.server_thread import ServerThread
from urdfkit.network.websocket_frame import framed, framed_parts

MAX_INBOUND = 32 * 1024 * 1024
"""Length of the longest frame of a peer that is accepted [bytes]."""
MAX_PEERS = 64
"""Peers that may be connected at once."""
PING = 20.0
"""Seconds between pings; a peer that does not answer is disconnected."""

log = logging.getLogger("urdfkit.bridges")


class Peer(Protocol):
    """State of one connection; its methods run in the thread of the server."""

    def receive(self, frame: str | bytes) -> None:
        """Process a frame of the peer."""

    def close(self) -> None:
        """End the subscriptions of the peer."""


class WebSocketServer:
    """Server of one bridge.

    Args:
        graph: the topics and services that peers use.
        address: to listen on.
        connect: returns the state of a new connection, whose frames are put into the queue.
        subprotocols: WebSocket subprotocols; peers must offer one of them, if any.
        origins: origins of web pages that may connect, in addition to pages of this machine.

    Raises:
        UsageError: the port is in use or the address cannot be bound.

    Attributes:
        access: the access rules; peers from other machines need its token.
        url: address of the server for clients on this machine.
    """

    def __init__(
        self,
        graph: Graph,
        address: Address,
        connect: Callable[[SendQueue], Peer],
        *,
        subprotocols: Sequence[str] = (),
        origins: Sequence[str] = (),
    ) -> None:
        socket, port = bind(*address)
        self.graph, self.connect, self.subprotocols = graph, connect, tuple(subprotocols)
        self.needs_token = not address.is_private
        self.access = AccessControl(port, names=(*LOOPBACK_NAMES, address.host), open_to_network=self.needs_token)
        self.origins = frozenset(origins)
        self.rejections = RejectionLog()
        self.peers = 0
        base = [url.replace("http", "ws", 1) for url in urls(address.host, port, self.access.token)]
        self.urls = base if self.needs_token else [url.partition("/?")[0] for url in base]
        self._thread = ServerThread(f"urdfkit-bridge-{port}", socket, self._application)
        graph.post = self._thread.post
        self._thread.start()

    def accepts_origin(self, origin: str | None) -> bool:
        """Whether a page of this origin may connect; programs send no origin, and files of this machine ``file://``."""
        if origin in (None, "file://") or origin in self.origins:
            return True
        return urlsplit(origin or "").hostname in LOOPBACK_NAMES

    def accepts_host(self, host: str) -> bool:
        """Whether the Host header names this server."""
        return self.access.accepts_host(host) or (self.needs_token and is_ip_literal(host.rpartition(":")[0]))

    def update(self) -> None:
        """Peers request new topics themselves."""

    def close(self) -> None:
        """Disconnect all peers and end the thread; closing twice is harmless."""
        self._thread.stop()
        self.graph.close()

    def _application(self) -> Application:
        return Application(
            [(r"/.*", PeerSocket, {"server": self})],
            websocket_max_message_size=MAX_INBOUND,
            websocket_ping_interval=PING,
            websocket_ping_timeout=PING,
            log_function=lambda handler: None,
        )


class PeerSocket(WebSocketHandler):
    """The WebSocket of one peer."""

    def initialize(self, server: WebSocketServer) -> None:
        """Store the arguments of the route."""
        self.server = server
        self._queue = SendQueue()
        self._peer: Peer | None = None
        self._sender: asyncio.Task[None] | None = None

    def check_origin(self, origin: str) -> bool:
        """Accept every origin that `prepare` has accepted."""
        return self.server.accepts_origin(origin)

    def set_default_headers(self) -> None:
        """Remove the name of the server."""
        self.clear_header("Server")

    def prepare(self) -> None:
        """Reject pages of other sites, unknown hosts, and peers of other machines without the token."""
        server, request = self.server, self.request
        tokens = self.get_query_arguments("token")
        if not server.accepts_host(request.headers.get("Host", "")):
            self._reject("This server does not accept the host name.")
        elif not server.accepts_origin(request.headers.get("Origin")):
            self._reject("Web pages of other sites may not connect; see --allow-origin.")
        elif server.needs_token and not (len(tokens) == 1 and server.access.accepts_token(tokens[0])):
            self._reject("The address needs its token, ?token=…, which urdfkit printed.")
        elif server.peers >= MAX_PEERS:
            self._reject(f"{MAX_PEERS} peers are connected already.", status=503)
        elif server.subprotocols and not set(self._offered()) & set(server.subprotocols):
            self._reject(f"Use the WebSocket subprotocol {server.subprotocols[0]}.", status=400)

    def _offered(self) -> list[str]:
        return [each.strip() for each in self.request.headers.get("Sec-WebSocket-Protocol", "").split(",")]

    def _reject(self, reason: str, *, status: int = 403) -> None:
        self.server.rejections.add(str(self.request.remote_ip), f"{self.request.method} {self.request.path}", reason)
        self.set_status(status)
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(reason + "\n")

    def select_subprotocol(self, subprotocols: list[str]) -> str | None:
        """Return the first subprotocol of the server that the peer offers."""
        return next((each for each in self.server.subprotocols if each in subprotocols), None)

    def open(self, *_: str, **__: str) -> None:
        """Begin to send to the peer."""
        self.set_nodelay(True)
        self.server.peers += 1
        self._peer = self.server.connect(self._queue)
        self._sender = asyncio.ensure_future(self._send())

    async def _send(self) -> None:
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            await self._queue.run(self._write)
            self.close(1013, "too slow")

    async def _write(self, frame: Frame) -> None:
        line = self.ws_connection
        if line is None or line.is_closing():
            raise WebSocketClosedError
        stream = cast("WebSocketProtocol13", line).stream  # `write_message` creates a task and copies
        for part in framed_parts(frame) if isinstance(frame, list) else [framed(frame)]:
            written = stream.write(part)
        await written

    def on_message(self, message: str | bytes) -> None:
        """Process a frame of the peer."""
        if self._peer is not None:
            self._peer.receive(message)

    def on_close(self) -> None:
        """End the subscriptions of the peer."""
        if self._sender is not None:
            self._sender.cancel()
        if self._peer is not None:
            self.server.peers -= 1
            self._peer.close()

    def write_error(self, status_code: int, **_: Any) -> None:
        """Respond with the error as one line of text."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code} {self._reason}\n")
