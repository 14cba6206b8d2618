"""ServerThread: an HTTP server of tornado in a thread of its own."""

import asyncio
import contextlib
import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from tornado.web import Application

from urdfkit.network.connection_limit import REQUEST_TIMEOUT, LimitedHTTPServer


class ServerThread:
    """Thread with an event loop that serves one application on a bound socket.

    Args:
        name: name of the thread.
        socket: the bound socket, which `stop` closes.
        application: creates the application, in the thread.
        options: further arguments of the HTTP server.
    """

    def __init__(self, name: str, socket: Any, application: Callable[[], Application], **options: Any) -> None:
        self.loop = asyncio.new_event_loop()
        self._socket, self._application, self._options = socket, application, options
        self._started: Future[None] = Future()
        self._thread = threading.Thread(target=self._serve, name=name, daemon=True)

    def start(self) -> None:
        """Start the thread; return when it serves."""
        self._thread.start()
        self._started.result()

    def post(self, function: Callable[..., None], *arguments: Any) -> None:
        """Call a function in the thread, unless it has ended."""
        with contextlib.suppress(RuntimeError):  # the loop is closed, so no client is connected
            self.loop.call_soon_threadsafe(function, *arguments)

    def stop(self) -> None:
        """Close all connections and end the thread; may be called twice."""
        if self._thread.is_alive():
            self.loop.call_soon_threadsafe(self.loop.stop)
            self._thread.join()
        self._socket.close()
        if not self.loop.is_closed():
            self.loop.close()

    def _serve(self) -> None:
        asyncio.set_event_loop(self.loop)
        try:
            http = self.loop.run_until_complete(self._open())
        except BaseException as error:
            self._started.set_exception(error)
            return
        self._started.set_result(None)
        try:
            self.loop.run_forever()
        finally:
            self.loop.run_until_complete(self._close(http))

    async def _open(self) -> LimitedHTTPServer:
        http = LimitedHTTPServer(
            self._application(),
            max_header_size=16 * 1024,
            idle_connection_timeout=REQUEST_TIMEOUT,
            body_timeout=REQUEST_TIMEOUT,
            **self._options,
        )
        http.add_socket(self._socket)
        return http

    async def _close(self, http: LimitedHTTPServer) -> None:
        await http.close()
        await self.loop.shutdown_default_executor()
