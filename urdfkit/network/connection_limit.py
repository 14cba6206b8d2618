"""Limits of open connections, below the number of files that a process may open: others could use them up otherwise."""

import asyncio
import contextlib
from typing import Any, cast

from tornado.http1connection import HTTP1ServerConnection
from tornado.httpserver import HTTPServer
from tornado.httputil import HTTPConnection, HTTPMessageDelegate

MOST_PAGES = 512
"""Pages that may be open at once."""
MOST_REQUESTS = 256
"""Other connections that may be open at once, such as those with an unfinished request."""
REQUEST_TIMEOUT = 20.0
"""Seconds to send the headers, and the body, of a request, and to keep an idle connection."""


def limits() -> tuple[int, int]:
    """Return the number of pages and of other connections that may be open: at most 3/4 of all open files."""
    try:
        import resource
    except ImportError:  # not on Windows, which has no such limit for sockets
        return MOST_PAGES, MOST_REQUESTS
    files = resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    if files == resource.RLIM_INFINITY:
        return MOST_PAGES, MOST_REQUESTS
    return min(MOST_PAGES, files // 2), min(MOST_REQUESTS, files // 4)


class LimitedHTTPServer(HTTPServer):
    """Server that closes the connection that has waited longest for a request when too many are open.

    A new connection is always served. Pages do not count: a WebSocket leaves the server once it is open.
    """

    most = limits()[1]

    def initialize(self, *arguments: Any, **options: Any) -> None:
        """Store the arguments; tornado calls this method instead of a constructor."""
        super().initialize(*arguments, **options)
        self._by_age: dict[object, None] = {}  # the connection whose last request began first is the first

    def start_request(self, server_conn: object, request_conn: HTTPConnection) -> HTTPMessageDelegate:
        """Begin to read a request of a connection."""
        self._by_age.pop(server_conn, None)
        self._by_age[server_conn] = None
        if len(self._by_age) > self.most:
            oldest = next(iter(self._by_age))
            del self._by_age[oldest]
            cast("HTTP1ServerConnection", oldest).stream.close()
        return super().start_request(server_conn, request_conn)

    def on_close(self, server_conn: object) -> None:
        """Forget a connection that was closed or has become a WebSocket."""
        self._by_age.pop(server_conn, None)
        super().on_close(server_conn)

    async def close(self) -> None:
        """Stop accepting requests, close all connections within a second, and cancel all other tasks of the loop."""
        self.stop()
        tasks = [task for task in asyncio.all_tasks() if task is not asyncio.current_task()]
        with contextlib.suppress(TimeoutError, asyncio.TimeoutError):
            await asyncio.wait_for(self.close_all_connections(), timeout=1.0)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
