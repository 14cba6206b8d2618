"""What `view` and `sim teleop` share: the options of the server, saying where the page is, ending cleanly."""

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
"""Module → package, beside Pinocchio."""
LAST_WORDS = 0.3
"""Seconds that pages have to hear why the server ends."""


def add_page_options(parser: argparse.ArgumentParser) -> None:
    """Add --port, --host and --no-browser."""
    parser.add_argument("--port", type=int, metavar="N", help="serve on this port (0: any; default: 7007 or the next)")
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        metavar="H",
        help="listen on this address; 0.0.0.0 lets other machines in, who still need the key in the address",
    )
    parser.add_argument("--no-browser", action="store_true", help="do not open a browser, only print the address")


def require_page(command: str, extra: str, *, beside: Sequence[str] = ()) -> None:
    """Check that what the page needs is installed.

    Args:
        command: the subject of the message, e.g. ``view``.
        extra: the extra that has it all.
        beside: further modules.

    Raises:
        MissingDependencyError: naming what is missing and the command to run.
    """
    from importlib.util import find_spec

    needed = NEEDED | {module: module for module in beside}
    missing = [package for module, package in needed.items() if find_spec(module) is None]
    if find_spec("pinocchio") is None:
        missing.append("pinocchio")
    if not missing:
        return
    if "pinocchio" in missing and sys.platform != "linux":
        from urdfkit.kinematics.pinocchio_requirement import require_pinocchio

        require_pinocchio(command)  # knows the platforms it has no wheels for, and says what to do there
    names = " and ".join([", ".join(missing[:-1]), missing[-1]] if len(missing) > 1 else missing)
    raise MissingDependencyError(f"{command} needs {names}: pip install 'urdfkit[{extra}]'")


class Page:
    """Starts a server and says where it is, once.

    Args:
        server: not started yet.
        host: the address asked for.
        browser: open one, if this machine has a screen.
    """

    def __init__(self, server: Server, *, host: str, browser: bool) -> None:
        self._server = server
        self._host = host
        self._browser = browser
        self._opened = False

    def open(self) -> None:
        """Start, print the address on standard output, open it in a browser; the second time do nothing."""
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
            note("warning: anybody on the network who has the address can watch and drive; it is not encrypted")
        if self._browser and _has_screen():
            # Some browsers keep the caller waiting until they are closed.
            threading.Thread(target=webbrowser.open, args=(server.url,), daemon=True, name="open-browser").start()
        elif self._browser:
            note("no screen here: open the address in a browser")


@contextmanager
def told_of_faults(server: Board) -> Iterator[None]:
    """Run a block whose error a page that is open already is told too, before the server ends."""
    try:
        yield
    except UrdfkitError as error:
        server.declare("fault", message=str(error))
        time.sleep(LAST_WORDS)
        raise


def note(text: str) -> None:
    """Print one line on standard error."""
    print(text, file=sys.stderr, flush=True)


@contextmanager
def until_interrupted() -> Iterator[None]:
    """Run a block that Ctrl-C, SIGTERM and a closed terminal end quietly, as a server's way to be done."""
    try:
        with ended_by_signals():
            yield
    except (KeyboardInterrupt, SystemExit):
        note("")  # the terminal shows ^C


def _has_screen() -> bool:
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.environ.get("BROWSER"))
