"""The WebSocket of a page: sends the frames of its channel and receives messages."""

import asyncio
import contextlib
import itertools
import logging
from collections.abc import Awaitable
from typing import cast

from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError, WebSocketHandler, WebSocketProtocol, WebSocketProtocol13

from urdfkit.network.connection_limit import limits
from urdfkit.network.websocket_frame import framed
from urdfkit.view.protocol import websocket_messages as protocol
from urdfkit.view.server.authenticated_handler import AuthenticatedHandler
from urdfkit.view.server.broadcast import CLEAR
from urdfkit.view.server.send_queue import Channel, Frame
from urdfkit.view.server.server_interface import PageServer

MAX_LOGGED = 10
"""Number of dropped messages that are logged per page."""

log = logging.getLogger("urdfkit.view")


class PageSocket(AuthenticatedHandler, WebSocketHandler):
    """The WebSocket of one page."""

    _numbers = itertools.count(1)
    most = limits()[0]

    def initialize(self, server: PageServer) -> None:
        """Store the arguments of the route."""
        super().initialize(server)
        self.client = next(PageSocket._numbers)
        self.channel = Channel()
        self._sender: asyncio.Task[None] | None = None
        self._dropped = 0

    def check_origin(self, origin: str) -> bool:
        """Whether the page was sent by this server."""
        return self.access.accepts_origin(origin, self.host)

    def prepare(self) -> None:
        """Check the request as every handler does; here the Origin header is mandatory."""
        super().prepare()
        if not self._finished and not self.access.accepts_origin(self.request.headers.get("Origin"), self.host):
            self.reject("A WebSocket connection requires an Origin header.")
        if not self._finished and self.server.hub.watchers >= self.most:
            self.reject(f"{self.most} pages are open already; close one of them.", status=503)

    def get_websocket_protocol(self) -> WebSocketProtocol | None:
        """Return the protocol of tornado, extended by a log line when it closes a connection for an invalid frame."""
        line = super().get_websocket_protocol()
        if isinstance(line, WebSocketProtocol13):
            receive, abort = line._receive_frame, line._abort
            aborted = False

            def record_and_abort() -> None:
                nonlocal aborted
                aborted = True
                abort()

            async def receive_and_log() -> None:
                await receive()  # raises when the page has disconnected
                if aborted:  # not when the page closed the connection itself
                    why = f"a frame was malformed or longer than {protocol.MAX_INBOUND} bytes; connection closed"
                    self.server.rejections.add(str(self.request.remote_ip), f"page {self.client}", why)

            line._receive_frame = receive_and_log  # type: ignore[method-assign]
            line._abort = record_and_abort  # type: ignore[method-assign]
        return line

    def open(self, *_: str, **__: str) -> None:
        """Send the current state to the page, then all changes."""
        self.set_nodelay(True)
        self.channel.line(protocol.write("you", client=self.client))
        self.channel.line(CLEAR)  # a page that reconnects may show an old scene
        self.server.hub.join(self.channel, self.client)
        self._sender = asyncio.ensure_future(self._send())

    async def _send(self) -> None:
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            await self.channel.run(self._write)
            self.close(1013, "too slow; reconnect")

    def _write(self, frame: Frame) -> Awaitable[None]:
        line = self.ws_connection
        if line is None or line.is_closing():
            raise WebSocketClosedError
        # `write_message` creates a task for each frame, half of the cost of sixty pose frames a second.
        return cast("WebSocketProtocol13", line).stream.write(framed(frame))

    def on_message(self, message: str | bytes) -> None:
        """Check and process a message of the page; an invalid one is dropped and logged."""
        try:
            self.server.receive(self.client, self.channel, message)
        except protocol.ProtocolError as error:
            self._log_dropped(error)

    def _log_dropped(self, error: protocol.ProtocolError) -> None:
        self._dropped += 1
        if self._dropped < MAX_LOGGED:
            log.warning("dropped a message of page %d: %s", self.client, error)
        elif self._dropped == MAX_LOGGED:
            log.warning("dropped %d messages of page %d; further ones are not logged", self._dropped, self.client)

    def on_close(self) -> None:
        """Stop sending; if this page was driving, the robot stops."""
        self.server.drive_lock.leave(self.client)
        self.server.hub.leave(self.channel)
        if self._sender is not None:
            self._sender.cancel()
