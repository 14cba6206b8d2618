"""Common parts of the viewer and of a driven simulation: required packages, the server, errors, termination."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from urdfkit.app.termination import ended_by_signals
from urdfkit.errors import MissingDependencyError, UrdfkitError

if TYPE_CHECKING:
    from urdfkit.view.content.display_interface import StatusDisplay
    from urdfkit.view.server.server import Server

NEEDED = {"meshcat": "meshcat", "tornado": "tornado", "umsgpack": "u-msgpack-python", "trimesh": "trimesh"}
"""Module → package, in addition to Pinocchio."""
FAULT_DELAY = 0.3
"""Seconds for pages to receive the last error before the server stops."""


def require_page(command: str, extra: str, *, modules: Sequence[str] = ()) -> None:
    """Check that the packages of the page are installed.

    Args:
        command: the subject of the message, e.g. ``view``.
        extra: the extra with all packages.
        modules: further modules.

    Raises:
        MissingDependencyError: a package is missing; names it and the command that installs it.
    """
    require_packages(command, extra, NEEDED | {module: module for module in modules})


def require_packages(command: str, extra: str, needed: Mapping[str, str]) -> None:
    """Check that packages and Pinocchio are installed.

    Args:
        command: the subject of the message, e.g. ``sim run``.
        extra: the extra with all packages.
        needed: module → package, in addition to Pinocchio.

    Raises:
        MissingDependencyError: a package is missing; names it and the command that installs it.
    """
    from importlib.util import find_spec

    missing = [package for module, package in needed.items() if find_spec(module) is None]
    if find_spec("pinocchio") is None:
        missing.append("pinocchio")
    if not missing:
        return
    if "pinocchio" in missing and sys.platform != "linux":
        from urdfkit.kinematics.pinocchio_requirement import require_pinocchio

        require_pinocchio(command)  # reports what to do on platforms without wheels
    names = " and ".join([", ".join(missing[:-1]), missing[-1]] if len(missing) > 1 else missing)
    raise MissingDependencyError(f"{command} needs {names}: pip install 'urdfkit[{extra}]'")


class Page:
    """A server with its page, which is opened once.

    Args:
        mode: ``view`` or ``sim``.
        host: the address to listen on.
        port: the port to listen on, 0 for any; None for the usual one or the next free one.
        opened: called with the server when it serves the page.
        watchers_may: see `Server`.
        layout: layout of panels, displays and camera that the page saved.

    Attributes:
        kept: `close` leaves the server running while this is set.

    Raises:
        UsageError: the port is busy or the address cannot be bound.
    """

    def __init__(
        self,
        mode: str,
        *,
        host: str = "127.0.0.1",
        port: int | None = None,
        opened: Callable[[Server], None] = lambda _: None,
        watchers_may: Sequence[str] = (),
        layout: Mapping[str, Any] | None = None,
    ) -> None:
        from urdfkit.view.server.server import Server

        self.host = host
        settings = {} if layout is None else {"layout": dict(layout)}
        self.server = Server(mode, host=host, port=port, watchers_may=watchers_may, settings=settings)
        self._opened = opened
        self._is_open = False
        self.kept = False

    def open(self) -> None:
        """Start the server; later calls do nothing."""
        if not self._is_open:
            self._is_open = True
            self.server.start()
            self._opened(self.server)

    def close(self) -> None:
        """Stop the server, unless another mode of the page follows."""
        if not self.kept:
            self.server.stop()


@contextmanager
def faults_on_page(server: StatusDisplay) -> Iterator[None]:
    """Run a block; show its error on open pages too, before the server stops."""
    try:
        yield
    except UrdfkitError as error:
        server.publish_latched("fault", message=str(error))
        time.sleep(FAULT_DELAY)
        raise


def note(text: str) -> None:
    """Print one line on standard error."""
    print(text, file=sys.stderr, flush=True)


@contextmanager
def until_interrupted() -> Iterator[None]:
    """Run a block that Ctrl-C, SIGTERM and a closed terminal end without an error message."""
    try:
        with ended_by_signals():
            yield
    except (KeyboardInterrupt, SystemExit):
        note("")  # the terminal shows ^C
