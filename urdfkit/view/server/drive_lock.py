"""Driver: whose hands are on the wheel, and the dead man's switch."""

from __future__ import annotations

import time
from collections.abc import Callable
from threading import Lock

from urdfkit.view.protocol.websocket_messages import Axes

DEADMAN = 0.4
"""Seconds of silence after which the robot is stopped; pages repeat what is held twenty times a second."""


class Driver:
    """One page drives, the others watch.

    The first page that holds something has the wheel until it lets go, closes, or is silent for `deadman` seconds;
    then whoever holds something next. Called from the server's thread and from the simulation's.

    Args:
        deadman: [s].
        clock: monotonic clock [s].
    """

    def __init__(self, *, deadman: float = DEADMAN, clock: Callable[[], float] = time.monotonic) -> None:
        self._deadman = deadman
        self._clock = clock
        self._lock = Lock()
        self._holder: int | None = None
        self._axes: Axes | None = None
        self._heard = 0.0

    def offer(self, client: int, axes: Axes) -> bool:
        """Take what a page holds; returns whether that page has the wheel now."""
        with self._lock:
            self._expire()
            if self._holder not in (None, client):
                return False
            if axes.is_zero:
                self._let_go()
                return False
            self._holder, self._axes, self._heard = client, axes, self._clock()
            return True

    def may(self, client: int) -> bool:
        """Whether a page may change something: not while another one drives."""
        with self._lock:
            self._expire()
            return self._holder in (None, client)

    def touch(self, client: int) -> None:
        """Count a page that holds something other than the wheel, such as an arm, as driving for a while."""
        with self._lock:
            self._expire()
            if self._holder is None or (self._holder == client and self._axes is None):
                self._holder, self._heard = client, self._clock()

    def stop(self) -> None:
        """Take the wheel out of whoever's hands."""
        with self._lock:
            self._let_go()

    def leave(self, client: int) -> None:
        """Forget a page that closed or lost its connection; if it drove, the robot stops now."""
        with self._lock:
            if self._holder == client:
                self._let_go()

    @property
    def holder(self) -> int | None:
        """The page that has the wheel."""
        with self._lock:
            self._expire()
            return self._holder

    @property
    def axes(self) -> Axes | None:
        """What the driver holds now; None when nobody holds anything."""
        with self._lock:
            self._expire()
            return self._axes

    def _expire(self) -> None:
        if self._holder is not None and self._clock() - self._heard > self._deadman:
            self._let_go()

    def _let_go(self) -> None:
        self._holder = self._axes = None
