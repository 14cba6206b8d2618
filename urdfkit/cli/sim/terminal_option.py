"""``--terminal``: drive by the keys of the terminal."""

from __future__ import annotations

import argparse
import sys
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING

from urdfkit.app.page import note
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.simulation.loop import DriveLoop


def add_terminal(parser: argparse.ArgumentParser) -> None:
    """Add ``--terminal``."""
    parser.add_argument(
        "--terminal",
        action=argparse.BooleanOptionalAction,
        help="drive with the keys of teleop_twist_keyboard in this terminal, without a browser "
        "(default: if no browser can be opened)",
    )


def check_terminal(arguments: argparse.Namespace, *, browser: bool) -> bool:
    """Return whether the keys of the terminal drive.

    Args:
        arguments: with the option.
        browser: whether a browser is opened.

    Raises:
        UsageError: the option is given, and standard input is no terminal.
    """
    from urdfkit.app.simulation.terminal.key_input import can_read_keys

    if not arguments.terminal:
        return arguments.terminal is None and not browser and can_read_keys()
    if not can_read_keys():
        where = "Windows is not supported" if sys.platform == "win32" else "standard input is not a terminal"
        raise UsageError(f"--terminal reads the keys of a terminal, but {where}")
    return True


def terminal_driving(loop: DriveLoop, *, active: bool) -> AbstractContextManager[None]:
    """Print the keys, and return a context in which they drive; a context without effect if not active."""
    if not active or not loop.simulator.command_topics:
        return nullcontext()
    from urdfkit.app.simulation.terminal.terminal_driver import HELP, driven_from_terminal

    note(HELP)
    return driven_from_terminal(loop)
