"""MessageBuilder: builds messages that take long, such as images, while the simulation continues."""

import sys
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from threading import Condition, Thread
from typing import Any

from urdfkit.bus import Build
from urdfkit.scene.gl.drawing_threads import leave_a_core

WAITING = 2
"""Messages of one topic that may wait; a renderer that is slower than its sensor omits the oldest."""
SWITCH = 0.0005
"""Seconds after which a thread gives the lock of Python to a waiting thread; Python's 5 ms would delay commands."""


Receive = Callable[[Any], None]


class MessageBuilder:
    """Thread that builds messages: those of one topic in order, the topics in turns.

    Args:
        report: receives a line if a message cannot be built, each once.
    """

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report = report
        self._reported: set[str] = set()
        self._topics: OrderedDict[str, dict[Build, list[Receive]]] = OrderedDict()
        self._changed, self._closed = Condition(), False
        self._interval = sys.getswitchinterval()
        self._thread: Thread | None = None

    def add(self, topic: str, build: Build, receive: Receive) -> None:
        """Build a message and hand it to `receive`, both in the thread of the builder; all bridges share a message."""
        with self._changed:
            if self._closed:
                return
            if self._thread is None:
                sys.setswitchinterval(SWITCH)
                leave_a_core()
                self._thread = Thread(target=self._run, name="urdfkit-messages", daemon=True)
                self._thread.start()
            jobs = self._topics.setdefault(topic, {})
            jobs.setdefault(build, []).append(receive)
            if len(jobs) > WAITING:
                del jobs[next(iter(jobs))]
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
                self._changed.wait_for(lambda: self._topics or self._closed)
                if self._closed:
                    return
                topic, jobs = self._topics.popitem(last=False)
                build = next(iter(jobs))
                receivers = jobs.pop(build)
                if jobs:
                    self._topics[topic] = jobs  # behind the other topics
            try:
                message = build()
                for receive in receivers:
                    receive(message)
            except Exception as error:  # of a driver or a middleware; the simulation continues
                with suppress(IndexError):
                    self._fail(str(error).splitlines()[0])

    def _fail(self, reason: str) -> None:
        if reason not in self._reported:
            self._reported.add(reason)
            self._report(f"a message is not sent: {reason}")
