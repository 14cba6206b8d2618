"""The websocket of a page: frames out by its channel, checked messages in."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import logging
import struct
from collections.abc import Awaitable
from typing import TYPE_CHECKING, cast

from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError, WebSocketHandler, WebSocketProtocol, WebSocketProtocol13

from urdfkit.view.protocol import websocket_messages as protocol
from urdfkit.view.server.authenticated_handler import Guarded
from urdfkit.view.server.broadcast import CLEAR
from urdfkit.view.server.send_queue import Channel, Frame

if TYPE_CHECKING:
    from urdfkit.view.server.page_server import PageServer

COMPLAINTS = 10
"""Dropped messages reported per page."""
TEXT, BINARY = 0x81, 0x82
"""First byte of a whole message in one frame; RFC 6455, section 5.2."""

log = logging.getLogger("urdfkit.view")


class Socket(Guarded, WebSocketHandler):
    """The websocket of one page."""

    _numbers = itertools.count(1)

    def initialize(self, server: PageServer) -> None:
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
            receive, abort = line._receive_frame, line._abort
            cut = False

            def note_and_abort() -> None:
                nonlocal cut
                cut = True
                abort()

            async def receive_and_tell() -> None:
                await receive()  # raises where the other side has gone: that is no frame
                if cut:  # not where a page said goodbye, which closes the line too
                    why = f"a frame was malformed, or longer than {protocol.MAX_INBOUND} bytes; the line is cut"
                    self.server.refusals.tell(str(self.request.remote_ip), f"page {self.client}", why)

            line._receive_frame = receive_and_tell  # type: ignore[method-assign]
            line._abort = note_and_abort  # type: ignore[method-assign]
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

    def _write(self, frame: Frame) -> Awaitable[None]:
        line = self.ws_connection
        if line is None or line.is_closing():
            raise WebSocketClosedError
        # Not by `write_message`, which makes a task of every frame: half of what sixty pose frames a second cost.
        return cast("WebSocketProtocol13", line).stream.write(framed(frame))

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


def framed(frame: Frame) -> bytes:
    """Return a message as it goes over the line from a server: whole, unmasked; RFC 6455, section 5.2."""
    first, content = (BINARY, frame) if isinstance(frame, bytes) else (TEXT, frame.encode())
    size = len(content)
    if size < 126:
        return struct.pack("!BB", first, size) + content
    if size < 1 << 16:
        return struct.pack("!BBH", first, 126, size) + content
    return struct.pack("!BBQ", first, 127, size) + content
