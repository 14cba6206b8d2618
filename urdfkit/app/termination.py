"""Termination by signals: undo unfinished work as after Ctrl-C, then exit with the signal's exit code."""

from __future__ import annotations

import _thread
import inspect
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

REPEAT_DELAY = 0.05
"""Seconds until a signal that cannot interrupt now is raised again."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C.

    When a plain KeyboardInterrupt leaves code run by `exec` or `eval`, as in dataclasses, Python exits by SIGINT
    whatever the exit code, even if the exception was caught.
    """


class _Ended(SystemExit):
    """SIGTERM or SIGHUP, by its number."""

    def __init__(self, number: int) -> None:
        super().__init__(128 + number)
        self.number = number


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """Run a block that SIGTERM and SIGHUP interrupt as Ctrl-C does, so that unfinished work is undone.

    A signal that was ignored before stays ignored, such as SIGHUP under ``nohup``. A signal during an import takes
    effect after it, since packages import optional packages inside ``except BaseException``. A signal during a
    finalizer or a callback of a weak reference, where Python ignores exceptions, is raised again.

    Raises:
        SystemExit: 128 plus the number of the signal, as shells report it.
        KeyboardInterrupt: Ctrl-C.
    """
    before = {}
    ended: list[int] = []
    hook = sys.unraisablehook
    imports = _imports(inspect.currentframe())

    def interrupt(number: int, frame: FrameType | None) -> None:
        if _imports(frame) > imports:
            _repeat(number)
        else:
            raise Interrupted

    def end(number: int, frame: FrameType | None) -> None:
        if not ended and _imports(frame) > imports:
            _repeat(number)
            return
        ended.append(number)
        if len(ended) != 2:  # a shell may send the signal twice; the second must not interrupt the cleanup
            raise _Ended(number)

    def report(ignored: sys.UnraisableHookArgs) -> None:
        if isinstance(ignored.exc_value, Interrupted):
            _repeat(signal.SIGINT)
        elif isinstance(ignored.exc_value, _Ended):
            ended.clear()  # also if the shell sent the signal twice
            _repeat(ignored.exc_value.number)
        else:
            hook(ignored)

    if threading.current_thread() is threading.main_thread():
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            before[signal.SIGINT] = signal.signal(signal.SIGINT, interrupt)
        for name in ("SIGTERM", "SIGHUP"):  # SIGHUP is missing on Windows
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) == signal.SIG_DFL:
                before[number] = signal.signal(number, end)
    if before:
        sys.unraisablehook = report
    try:
        yield
    finally:
        if before:
            sys.unraisablehook = hook
        for number, handler in before.items():
            signal.signal(number, handler)


def _imports(frame: FrameType | None) -> int:
    """Return the number of frames of the import system that a frame was called from."""
    count = 0
    while frame is not None:
        count += frame.f_code.co_filename == "<frozen importlib._bootstrap>"
        frame = frame.f_back
    return count


def _repeat(number: int) -> None:
    """Raise a signal again in the main thread in a moment."""
    main = threading.main_thread().ident

    def send() -> None:
        if hasattr(signal, "pthread_kill") and main is not None:
            signal.pthread_kill(main, number)  # unlike `interrupt_main`, ends a system call that waits
        else:
            _thread.interrupt_main(signal.Signals(number))

    timer = threading.Timer(REPEAT_DELAY, send)
    timer.daemon = True
    timer.start()
