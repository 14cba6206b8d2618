"""MessageBuilder: builds messages that take long, such as images, while the simulation continues."""

from __future__ import annotations

import sys
from collections import Counter, deque
from collections.abc import Callable, Hashable
from contextlib import suppress
from threading import Condition, Thread
from typing import Any

from urdfkit.bus import Build

WAITING = 2
"""Messages of one subscription that may wait; a renderer that is slower than its sensor omits the oldest."""
SWITCH = 0.0005
"""Seconds after which a thread gives the lock of Python to a waiting thread; Python's 5 ms would delay commands."""


class MessageBuilder:
    """Thread that builds messages, in the order of their publication.

    Args:
        report: receives a line if a message cannot be built, each once.
    """

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report = report
        self._reported: set[str] = set()
        self._jobs: deque[tuple[Hashable, Build, Callable[[Any], None]]] = deque()
        self._waiting: Counter[Hashable] = Counter()
        self._changed, self._closed = Condition(), False
        self._interval = sys.getswitchinterval()
        self._thread: Thread | None = None

    def add(self, subscription: Hashable, build: Build, receive: Callable[[Any], None]) -> None:
        """Build a message and hand it to `receive`, both in the thread of the builder."""
        with self._changed:
            if self._closed:
                return
            if self._thread is None:
                sys.setswitchinterval(SWITCH)
                self._thread = Thread(target=self._run, name="urdfkit-messages", daemon=True)
                self._thread.start()
            self._waiting[subscription] += 1
            if self._waiting[subscription] > WAITING:
                self._waiting[subscription] -= 1
                self._jobs.remove(next(job for job in self._jobs if job[0] == subscription))
            self._jobs.append((subscription, build, receive))
            self._changed.notify()

    def close(self) -> None:
        """End the thread, after the message that it builds; closing twice is harmless."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        if self._thread is not None:
            self._thread.join()
            sys.setswitchinterval(self._interval)
            self._thread = None

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._jobs or self._closed)
                if self._closed:
                    return
                subscription, build, receive = self._jobs.popleft()
                self._waiting[subscription] -= 1
            try:
                receive(build())
            except Exception as error:  # of a driver or a middleware; the simulation continues
                with suppress(IndexError):
                    self._fail(str(error).splitlines()[0])

    def _fail(self, reason: str) -> None:
        if reason not in self._reported:
            self._reported.add(reason)
            self._report(f"a message is not sent: {reason}")
