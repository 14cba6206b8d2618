"""Being told to end while files are written: undone as Ctrl-C undoes it, then gone with the signal's exit code."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import FrameType


class Interrupted(KeyboardInterrupt):
    """Ctrl-C.

    When a plain KeyboardInterrupt leaves text that `exec` or `eval` runs, as dataclasses have it, Python ends by SIGINT
    whatever exit code it is given, although somebody has caught the exception.
    """


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    raise Interrupted


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """Run a block that SIGTERM and SIGHUP, of a terminal that is closed, end as Ctrl-C does: what it began is undone.

    What was ignored before stays ignored: SIGHUP under ``nohup``, and Ctrl-C in a job that a script starts in the
    background. SIGTERM ends these, too.

    Raises:
        SystemExit: 128 and the number of the signal, as a shell reports a program that one has ended.
        KeyboardInterrupt: Ctrl-C.
    """
    before = {}
    ended: list[int] = []

    def end(number: int, _frame: FrameType | None) -> None:
        ended.append(number)
        if len(ended) != 2:  # a shell sends it twice, and the second must not interrupt the cleanup of the first
            raise SystemExit(128 + number)

    if threading.current_thread() is threading.main_thread():
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            before[signal.SIGINT] = signal.signal(signal.SIGINT, _interrupt)
        for name in ("SIGTERM", "SIGHUP"):  # the second is not everywhere
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) == signal.SIG_DFL:
                before[number] = signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
