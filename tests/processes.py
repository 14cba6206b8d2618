"""Programs that tests start: signals handled as in a terminal, and nothing left running when the test is over."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any

IN_A_TERMINAL = {
    signal.SIGINT: signal.default_int_handler,
    signal.SIGTERM: signal.SIG_DFL,
    signal.SIGHUP: signal.SIG_DFL,
}
"""How Python handles signals in a program that a terminal starts. Under ``nohup`` SIGHUP is ignored, and in the
background of a script SIGINT; programs that are started from there inherit it."""


@contextmanager
def signals(handlers: dict[signal.Signals, Any] = IN_A_TERMINAL) -> Iterator[None]:
    """Handle signals in this way within the block, whichever way pytest was started."""
    before = {number: signal.signal(number, handler) for number, handler in handlers.items()}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def running(
    command: Sequence[object], *, ignored: Sequence[signal.Signals] = (), **options: Any
) -> Iterator[subprocess.Popen[Any]]:
    """Run a program within the block; at its end the program and all that it has started are killed.

    Args:
        command: program and arguments.
        ignored: signals that the program is started with as ignored; it handles all others as in a terminal.
        options: of `subprocess.Popen`.
    """
    words = [str(word) for word in command]
    with signals(IN_A_TERMINAL | dict.fromkeys(ignored, signal.SIG_IGN)):
        process = subprocess.Popen(words, start_new_session=True, **options)
    try:
        yield process
    finally:
        kill_group(process)


def kill_group(process: subprocess.Popen[Any]) -> None:
    """Kill a program that leads a group, and the rest of the group; close the pipes to it."""
    with suppress(ProcessLookupError):  # all of them have ended
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    for pipe in (process.stdin, process.stdout, process.stderr):
        if pipe is not None:
            pipe.close()
