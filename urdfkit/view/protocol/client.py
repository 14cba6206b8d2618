"""Client: a program's own line to a running page's server, as docs/protocol.md tells it; for commands, not browsers."""

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

LONGEST = 256 * 1024 * 1024
"""Longest frame taken from the server [byte]: a scene with its meshes named, or a message with all its entries."""
PATIENCE = 20.0
"""Seconds to wait for a connection and for an answer."""
GOODBYE = 2.0
"""Seconds to wait for the other side's goodbye."""


class Client:
    """One connection. Frames of poses and scenes are dropped; texts are returned.

    Made by `connect`; an ``async with`` closes it.
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
            end = asyncio.get_running_loop().time() + GOODBYE
            while (
                not self._ended and (left := end - asyncio.get_running_loop().time()) > 0
            ):  # what is on its way comes before the end
                await self.text(left)
        if self._reading is not None:
            self._reading.cancel()

    async def watch(self, *keys: str) -> None:
        """Want these keys from now on, and no others."""
        await self._line.write_message(protocol.write("watch", wanted=list(keys)))

    async def order(self, name: str, /, **values: Any) -> dict[str, Any]:
        """Have an order done and return the values of its answer.

        Raises:
            UsageError: it was not done, or is too long to be sent; says why.
            ResourceError: no answer came.
        """
        self._number += 1
        frame = protocol.write("do", number=self._number, order=name, values=values)
        if len(frame.encode()) > protocol.MAX_INBOUND:
            raise UsageError(
                f"the message is {len(frame.encode())} bytes long; at most {protocol.MAX_INBOUND} are taken"
            )
        await self._line.write_message(frame)
        others: list[dict[str, Any]] = []
        try:
            while (text := await self.text(PATIENCE)) is not None:
                if text["type"] == "answer" and text["number"] == self._number:
                    if text["error"] is not None:
                        raise UsageError(text["error"])
                    return dict(text["values"])
                others.append(text)
        finally:
            self._waiting.extendleft(reversed(others))
        raise ResourceError(f"the simulation has not answered for {PATIENCE:g} s")

    async def text(self, seconds: float | None = None) -> dict[str, Any] | None:
        """Return the next text; None when none comes in time.

        Args:
            seconds: to wait; None for ever.

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
            # Waited for from outside: a read that is cancelled could take a frame along.
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
        url: its address with the key.

    Raises:
        ResourceError: nobody answers there, or the key does not fit.
    """
    parts = urlsplit(url)
    place = f"http://{parts.netloc}"
    http = SimpleAsyncHTTPClient(force_instance=True)
    try:
        answer = await http.fetch(
            HTTPRequest(f"{place}/?{parts.query}", follow_redirects=False, request_timeout=PATIENCE), raise_error=False
        )
        cookies = [each.split(";")[0] for each in answer.headers.get_list("Set-Cookie")]
        if answer.code != 303 or not cookies:
            raise ResourceError(f"{place}: {_refusal(answer.code)}")
        headers = HTTPHeaders({"Cookie": "; ".join(cookies), "Origin": place})
        line = await websocket_connect(
            HTTPRequest(f"ws://{parts.netloc}/ws", headers=headers, request_timeout=PATIENCE),
            max_message_size=LONGEST,
        )
    except UrdfkitError:
        raise
    except HTTPClientError as error:
        raise ResourceError(f"{place}: {_refusal(error.code)}") from error
    except OSError as error:
        raise ResourceError(f"{place}: no simulation answers: {error.strerror or error}") from error
    finally:
        http.close()
    return Client(line)


def _refusal(code: int) -> str:
    if code == 403:
        return "the key in the address does not fit; it is another one for every simulation"
    if code == 599:
        return f"no simulation answers within {PATIENCE:g} s"
    return f"what answers there is no simulation of ours (HTTP {code})"
