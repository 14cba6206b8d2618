"""Client: connects commands and other programs to the server of a running page; see docs/protocol.md."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections import deque
from typing import Any
from urllib.parse import urlsplit

from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.httputil import HTTPHeaders
from tornado.simple_httpclient import SimpleAsyncHTTPClient
from tornado.websocket import WebSocketClientConnection, WebSocketClosedError, websocket_connect

from urdfkit.errors import ResourceError, UrdfkitError, UsageError
from urdfkit.view.protocol import websocket_messages as protocol

MAX_FRAME = 256 * 1024 * 1024
"""Longest frame accepted from the server [byte], such as a scene or a message with all its entries."""
TIMEOUT = 20.0
"""Seconds to wait for a connection and for an answer."""
CLOSE_TIMEOUT = 2.0
"""Seconds to wait for the close frame of the server."""


class Client:
    """One connection. It returns JSON messages and drops binary frames.

    Created by `connect`; ``async with`` closes it.
    """

    def __init__(self, line: WebSocketClientConnection) -> None:
        self._line = line
        self._number = 0
        self._ended = False
        self._waiting: deque[dict[str, Any]] = deque()
        self._reading: asyncio.Future[str | bytes | None] | None = None

    async def __aenter__(self) -> Client:
        return self

    async def __aexit__(self, *_: object) -> None:
        self._line.close()
        with contextlib.suppress(ResourceError, WebSocketClosedError):
            end = asyncio.get_running_loop().time() + CLOSE_TIMEOUT
            while (
                not self._ended and (left := end - asyncio.get_running_loop().time()) > 0
            ):  # frames sent before the close frame arrive first
                await self.text(left)
        if self._reading is not None:
            self._reading.cancel()

    async def subscribe(self, *keys: str) -> None:
        """Subscribe to exactly these keys."""
        await self._line.write_message(protocol.write("subscribe", keys=list(keys)))

    async def request(self, name: str, /, **values: Any) -> dict[str, Any]:
        """Send a request and return the values of its answer.

        Raises:
            UsageError: the server rejected the request, or the request is too long.
            ResourceError: no answer arrived.
        """
        self._number += 1
        frame = protocol.write("request", number=self._number, name=name, values=values)
        if len(frame.encode()) > protocol.MAX_INBOUND:
            raise UsageError(
                f"the message is {len(frame.encode())} bytes long; at most {protocol.MAX_INBOUND} are accepted"
            )
        await self._line.write_message(frame)
        others: list[dict[str, Any]] = []
        try:
            while (text := await self.text(TIMEOUT)) is not None:
                if text["type"] == "answer" and text["number"] == self._number:
                    if text["error"] is not None:
                        raise UsageError(text["error"])
                    return dict(text["values"])
                others.append(text)
        finally:
            self._waiting.extendleft(reversed(others))
        raise ResourceError(f"no answer from the simulation within {TIMEOUT:g} s")

    async def text(self, seconds: float | None = None) -> dict[str, Any] | None:
        """Return the next JSON message; None if none arrives in time.

        Args:
            seconds: time to wait; None to wait without limit.

        Raises:
            ResourceError: the simulation has ended.
        """
        if self._waiting:
            return self._waiting.popleft()
        loop = asyncio.get_running_loop()
        end = None if seconds is None else loop.time() + seconds
        while True:
            if self._reading is None:
                self._reading = asyncio.ensure_future(self._line.read_message())
            left = None if end is None else max(0.0, end - loop.time())
            # The read is never cancelled, because a cancelled read could lose a frame.
            await asyncio.wait({self._reading}, timeout=left)
            if not self._reading.done():
                return None
            frame, self._reading = self._reading.result(), None
            if frame is None:
                self._ended = True
                raise ResourceError("the simulation has ended")
            if isinstance(frame, str):
                return dict(json.loads(frame))


async def connect(url: str) -> Client:
    """Return a connection to a page.

    Args:
        url: its URL with the token.

    Raises:
        ResourceError: no server responds, or the token is wrong.
    """
    parts = urlsplit(url)
    place = f"http://{parts.netloc}"
    http = SimpleAsyncHTTPClient(force_instance=True)
    try:
        answer = await http.fetch(
            HTTPRequest(f"{place}/?{parts.query}", follow_redirects=False, request_timeout=TIMEOUT), raise_error=False
        )
        cookies = [each.split(";")[0] for each in answer.headers.get_list("Set-Cookie")]
        if answer.code != 303 or not cookies:
            raise ResourceError(f"{place}: {_refusal(answer.code)}")
        headers = HTTPHeaders({"Cookie": "; ".join(cookies), "Origin": place})
        line = await websocket_connect(
            HTTPRequest(f"ws://{parts.netloc}/ws", headers=headers, request_timeout=TIMEOUT), max_message_size=MAX_FRAME
        )
    except UrdfkitError:
        raise
    except HTTPClientError as error:
        raise ResourceError(f"{place}: {_refusal(error.code)}") from error
    except OSError as error:
        raise ResourceError(f"{place}: cannot connect: {error.strerror or error}") from error
    finally:
        http.close()
    return Client(line)


def _refusal(code: int) -> str:
    if code == 403:
        return "wrong token; open the address that this simulation printed"
    if code == 599:
        return f"no response within {TIMEOUT:g} s"
    return f"the server is not a page of urdfkit (HTTP {code})"
