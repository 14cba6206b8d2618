"""Being told to end while files are written: undone as Ctrl-C undoes it, then gone with the signal's exit code."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import FrameType


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """Run a block that SIGTERM and SIGHUP, of a terminal that is closed, end as Ctrl-C does: what it began is undone.

    What was ignored before, as SIGHUP under ``nohup``, stays ignored.

    Raises:
        SystemExit: 128 and the number of the signal, as a shell reports a program that one has ended.
    """
    before = {}
    ended: list[int] = []

    def end(number: int, _frame: FrameType | None) -> None:
        ended.append(number)
        if len(ended) == 1:  # a shell says it again, and that must not interrupt the undoing
            raise SystemExit(128 + number)

    if threading.current_thread() is threading.main_thread():
        for name in ("SIGTERM", "SIGHUP"):  # the second is not everywhere
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) == signal.SIG_DFL:
                before[number] = signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
