"""Termination by signals: undo unfinished work as after Ctrl-C, then exit with the signal's exit code."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class Interrupted(KeyboardInterrupt):
    """Ctrl-C.

    When a plain KeyboardInterrupt leaves code run by `exec` or `eval`, as in dataclasses, Python exits by SIGINT
    whatever the exit code, even if the exception was caught.
    """


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    raise Interrupted


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """Run a block that SIGTERM and SIGHUP interrupt as Ctrl-C does, so that unfinished work is undone.

    A signal that was ignored before stays ignored, such as SIGHUP under ``nohup``.

    Raises:
        SystemExit: 128 plus the number of the signal, as shells report it.
        KeyboardInterrupt: Ctrl-C.
    """
    before = {}
    ended: list[int] = []

    def end(number: int, _frame: FrameType | None) -> None:
        ended.append(number)
        if len(ended) != 2:  # a shell may send the signal twice; the second must not interrupt the cleanup
            raise SystemExit(128 + number)

    if threading.current_thread() is threading.main_thread():
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            before[signal.SIGINT] = signal.signal(signal.SIGINT, _interrupt)
        for name in ("SIGTERM", "SIGHUP"):  # SIGHUP is missing on Windows
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) == signal.SIG_DFL:
                before[number] = signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
