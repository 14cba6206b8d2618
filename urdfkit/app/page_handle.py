"""PageHandle: a page that is served in the background, for scripts and notebooks."""

from __future__ import annotations

import atexit
import threading
from collections.abc import Callable
from contextlib import ExitStack
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

if TYPE_CHECKING:
    from typing_extensions import Self

    from urdfkit.view.server.server import Server

HEIGHT = 600
"""Height of the page in a notebook, in pixels."""


class PageHandle:
    """Handle to a page that this process serves in the background until `close` is called or the process ends.

    Use it as a context manager, or keep it and call `close`. The last value of a notebook cell shows the page there.

    Args:
        server: the server of the page, started.
        run: serves the page until the event is set, in a thread of its own.
        stack: closed after `run`; stops the server.
    """

    def __init__(self, server: Server, run: Callable[[threading.Event], None], stack: ExitStack) -> None:
        self._server = server
        self._stack = stack
        self._stop = threading.Event()
        self._error: BaseException | None = None
        self._closing = threading.Lock()
        self._thread = threading.Thread(target=self._run, args=(run,), name="urdfkit-page", daemon=True)
        self._thread.start()
        atexit.register(self.close)

    @property
    def url(self) -> str:
        """Address of the page, with its token."""
        return self._server.url

    @property
    def closed(self) -> bool:
        """Whether the page is no longer served."""
        return self._stop.is_set()

    def close(self) -> None:
        """Stop serving the page and end its threads; closing twice is harmless."""
        self._stop.set()
        with self._closing:
            self._thread.join()
            self._stack.close()
        atexit.unregister(self.close)

    def wait(self) -> None:
        """Serve the page until Ctrl-C, for scripts that would end otherwise; close it then.

        Raises:
            UrdfkitError: the page stopped because of this error.
        """
        try:
            while self._thread.is_alive():
                self._thread.join(1.0)  # a join without a limit cannot be interrupted on Windows
        except KeyboardInterrupt:
            pass
        finally:
            self.close()
        if self._error is not None:
            raise self._error

    def _run(self, run: Callable[[threading.Event], None]) -> None:
        try:
            run(self._stop)
        except Exception as error:
            self._error = error
            self._server.publish_latched("fault", message=str(error))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {'closed' if self.closed else self.url}>"

    def _repr_html_(self) -> str:
        """Return the page as a frame of a notebook."""
        if self.closed:
            return "<p>This page is closed.</p>"
        parts = urlsplit(self.url)
        frame = f"{parts.scheme}://{parts.netloc}/frame?{parts.query}"
        style = f"width: 100%; height: {HEIGHT}px; border: 0"
        return f'<iframe src="{frame}" style="{style}" allow="fullscreen; gamepad"></iframe>'
