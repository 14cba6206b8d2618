"""Options of the commands that serve a page, and the address they print."""

from __future__ import annotations

import argparse
import atexit
import json
import os
import sys
import threading
import webbrowser
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import Page, note
from urdfkit.errors import UsageError
from urdfkit.missing_files import missing_path

if TYPE_CHECKING:
    from urdfkit.view.server.server import Server

LARGEST_LAYOUT = 1_000_000
"""Maximum size of a layout [byte]."""
REDIRECTION = """<!doctype html><html lang="en"><meta charset="utf-8"><title>urdfkit</title>
<meta name="referrer" content="no-referrer"><meta http-equiv="refresh" content="0; url={url}">
<p><a href="{url}">Continue to urdfkit</a></p></html>
"""


def add_page_options(parser: argparse.ArgumentParser) -> None:
    """Add --port, --host, --no-browser and --layout."""
    parser.add_argument("--port", type=int, metavar="N", help="serve on this port (0: any; default: 7007 or the next)")
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        metavar="H",
        help="listen on this address; 0.0.0.0 accepts connections from other machines, which need the token in the "
        "address",
    )
    parser.add_argument("--no-browser", action="store_true", help="do not open a browser, only print the address")
    parser.add_argument(
        "--layout",
        metavar="FILE",
        help='open the page with the layout in FILE, saved with "Save layout" in the View panel',
    )


def read_layout(arguments: argparse.Namespace) -> dict[str, Any] | None:
    """Return the layout of ``--layout``; None without the option.

    Raises:
        UsageError: the file cannot be read, or is not a layout.
    """
    if arguments.layout is None:
        return None
    path = Path(arguments.layout)
    try:
        if path.stat().st_size > LARGEST_LAYOUT:
            raise UsageError(f"--layout {path}: larger than {LARGEST_LAYOUT // 1000} kB; this is not a urdfkit layout")
        layout = json.loads(path.read_text("utf-8"))
    except FileNotFoundError as error:
        raise UsageError(f"--layout: {missing_path(path)}") from error
    except OSError as error:
        raise UsageError(f"--layout {path}: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise UsageError(f"--layout {path}: not JSON: {error}") from error
    if not isinstance(layout, dict) or layout.get("version") != 1:
        raise UsageError(f"--layout {path}: not a urdfkit layout; save one with Save layout in the View panel")
    return layout


def page_of(
    mode: str, arguments: argparse.Namespace, layout: dict[str, Any] | None, watchers_may: Sequence[str] = ()
) -> Page:
    """Return a page that, when it opens, prints its address on standard output and opens a browser.

    Args:
        mode: ``view`` or ``sim``.
        arguments: with the options of `add_page_options`.
        layout: the one of `read_layout`, which is read before the robot is loaded.
        watchers_may: see `Page`.

    Raises:
        UsageError: the port is busy or the address cannot be bound.
    """
    host, port, opened = arguments.host, arguments.port, announce(arguments)
    return Page(mode, host=host, port=port, opened=opened, watchers_may=watchers_may, layout=layout)


def announce(arguments: argparse.Namespace) -> Callable[[Server], None]:
    """Return a function that prints the address of a page on standard output and opens a browser."""

    def opened(server: Server) -> None:
        from urdfkit.network.access_control import is_loopback

        print(server.url, flush=True)
        if not is_loopback(arguments.host):
            for url in server.urls[1:]:
                print(url, flush=True)
            note("warning: everyone with this address can watch and drive; the connection is not encrypted")
        if opens_browser(arguments):
            # Some browsers block the caller until they are closed.
            threading.Thread(
                target=webbrowser.open, args=(_private_address(server),), daemon=True, name="open-browser"
            ).start()
        elif not arguments.no_browser:
            note("no screen found: open the address in a browser")

    return opened


def opens_browser(arguments: argparse.Namespace) -> bool:
    """Whether a page opens a browser: the command line permits it and there is a screen."""
    return not arguments.no_browser and _has_screen()


def _private_address(server: Server) -> str:
    """Return the address of a private file that redirects to the page; the address of the page if it cannot be written.

    Every user of the machine can read the command line of the browser, which must not contain the token.
    """
    from urdfkit.view.server.saved_tokens import private_folder, write_private

    if sys.platform == "win32":  # only the user and administrators can read command lines
        return server.url
    try:
        path = private_folder() / f"open-{server.port}.html"
        write_private(path, REDIRECTION.format(url=server.url))
    except OSError:
        return server.url
    atexit.register(path.unlink, missing_ok=True)
    return path.as_uri()


def _has_screen() -> bool:
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.environ.get("BROWSER"))
