"""Common parts of `view` and `sim teleop`: server options, the address of the page, termination."""

from __future__ import annotations

import argparse
import os
import sys
import threading
import time
import webbrowser
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from urdfkit.app.termination import ended_by_signals
from urdfkit.errors import MissingDependencyError, UrdfkitError

if TYPE_CHECKING:
    from urdfkit.view.content.display import Board
    from urdfkit.view.server.server import Server

NEEDED = {"meshcat": "meshcat", "tornado": "tornado", "umsgpack": "u-msgpack-python", "trimesh": "trimesh"}
"""Module → package, in addition to Pinocchio."""
FAULT_DELAY = 0.3
"""Seconds for pages to receive the last error before the server stops."""


def add_page_options(parser: argparse.ArgumentParser) -> None:
    """Add --port, --host and --no-browser."""
    parser.add_argument("--port", type=int, metavar="N", help="serve on this port (0: any; default: 7007 or the next)")
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        metavar="H",
        help="listen on this address; 0.0.0.0 accepts other machines, which need the token in the address",
    )
    parser.add_argument("--no-browser", action="store_true", help="do not open a browser, only print the address")


def require_page(command: str, extra: str, *, modules: Sequence[str] = ()) -> None:
    """Check that the packages of the page are installed.

    Args:
        command: the subject of the message, e.g. ``view``.
        extra: the extra with all packages.
        modules: further modules.

    Raises:
        MissingDependencyError: a package is missing; names it and the command that installs it.
    """
    from importlib.util import find_spec

    needed = NEEDED | {module: module for module in modules}
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
    """Starts a server and prints its address, once.

    Args:
        server: the server, not started yet.
        host: the address to listen on.
        browser: open a browser, if this machine has a screen.
    """

    def __init__(self, server: Server, *, host: str, browser: bool) -> None:
        self._server = server
        self._host = host
        self._browser = browser
        self._opened = False

    def open(self) -> None:
        """Start the server, print its address on standard output, open a browser; do nothing the second time."""
        from urdfkit.view.server.access_control import is_loopback

        if self._opened:
            return
        self._opened = True
        server = self._server
        server.start()
        print(server.url, flush=True)
        if not is_loopback(self._host):
            for url in server.urls[1:]:
                print(url, flush=True)
            note("warning: everyone with this address can watch and drive; the connection is not encrypted")
        if self._browser and _has_screen():
            # Some browsers block the caller until they are closed.
            threading.Thread(target=webbrowser.open, args=(server.url,), daemon=True, name="open-browser").start()
        elif self._browser:
            note("no screen found: open the address in a browser")


@contextmanager
def faults_on_page(server: Board) -> Iterator[None]:
    """Run a block; show its error on open pages too, before the server stops."""
    try:
        yield
    except UrdfkitError as error:
        server.declare("fault", message=str(error))
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


def _has_screen() -> bool:
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.environ.get("BROWSER"))
