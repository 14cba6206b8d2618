"""Keys of a terminal, read one by one without echo; the terminal is restored afterwards."""

import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

if sys.platform != "win32":
    import select
    import termios
    import tty

ARROW_ENDINGS = {"A": "ArrowUp", "B": "ArrowDown", "C": "ArrowRight", "D": "ArrowLeft"}
"""Last character of the escape sequence of an arrow key (ECMA-48 cursor movements) → name of the key in browsers."""
_LONGEST = 4096
"""Largest number of bytes read at once."""


def can_read_keys() -> bool:
    """Whether standard input is a terminal, and this process may read from it: it does not run in the background."""
    if sys.platform == "win32" or sys.stdin is None or not sys.stdin.isatty():
        return False
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except OSError:
        return False


class KeyInput:
    """Reads the pressed keys of a terminal.

    Args:
        descriptor: file descriptor of the terminal.
    """

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._unfinished = ""

    def read(self) -> list[str]:
        """Return the keys since the last call: characters, and the names of `ARROW_ENDINGS`."""
        text = self._unfinished
        while select.select([self._descriptor], [], [], 0.0)[0]:
            try:
                found = os.read(self._descriptor, _LONGEST)
            except OSError:  # the terminal was closed
                break
            if not found:
                break
            text += found.decode("utf-8", "replace")
        keys, self._unfinished = split_keys(text)
        return keys


def split_keys(text: str) -> tuple[list[str], str]:
    """Return the keys of a terminal's input, and the begin of an escape sequence at its end.

    Escape sequences other than those of arrow keys are ignored.
    """
    keys = []
    i = 0
    while i < len(text):
        if text[i] != "\x1b":
            keys.append(text[i])
            i += 1
            continue
        if i + 1 < len(text) and text[i + 1] not in "[O":
            i += 1  # the escape key alone
            continue
        end = i + 2
        while end < len(text) and not "@" <= text[end] <= "~":
            end += 1
        if end >= len(text):
            return keys, text[i:] if end - i < 16 else ""
        if text[end] in ARROW_ENDINGS:
            keys.append(ARROW_ENDINGS[text[end]])
        i = end + 1
    return keys, ""


@contextmanager
def key_input() -> Iterator[KeyInput]:
    """Read single keys of standard input inside the context; restore the terminal at its end and when stopped.

    Ctrl-C and Ctrl-Z keep their meaning. `can_read_keys` must be true.
    """
    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)

    def restore() -> None:
        with suppress(termios.error, OSError):  # the terminal was closed
            termios.tcsetattr(descriptor, termios.TCSADRAIN, before)

    def stop(_number: int, _frame: FrameType | None) -> None:
        restore()
        os.kill(os.getpid(), signal.SIGSTOP)
        tty.setcbreak(descriptor)

    handler: Any = None
    if threading.current_thread() is threading.main_thread():
        handler = signal.signal(signal.SIGTSTP, stop)
    try:
        tty.setcbreak(descriptor)
        yield KeyInput(descriptor)
    finally:
        restore()
        if handler is not None:
            signal.signal(signal.SIGTSTP, handler)
