"""DriveLock: the page that drives the robot, and the deadman timeout."""

import time
from collections.abc import Callable
from threading import Lock

from urdfkit.view.protocol.websocket_messages import Axes

DEADMAN = 0.4
"""Seconds without input after which the robot stops; pages repeat their input twenty times a second."""


class DriveLock:
    """Lets one page drive at a time.

    The first page with an input other than zero holds the lock until its input is zero, it closes, or it sends nothing
    for `deadman` seconds. Called from the thread of the server and from the thread of the simulation.

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
        self._received = 0.0

    def update(self, client: int, axes: Axes) -> bool:
        """Store the input of a page; return whether the page holds the lock now."""
        with self._lock:
            self._expire()
            if self._holder not in (None, client):
                return False
            if axes.is_zero:
                self._free()
                return False
            self._holder, self._axes, self._received = client, axes, self._clock()
            return True

    def allows(self, client: int) -> bool:
        """Whether a page may change the simulation: not while another page drives."""
        with self._lock:
            self._expire()
            return self._holder in (None, client)

    def claim(self, client: int) -> None:
        """Give the lock for `deadman` seconds to a page that moves something else, such as an arm."""
        with self._lock:
            self._expire()
            if self._holder is None or (self._holder == client and self._axes is None):
                self._holder, self._received = client, self._clock()

    def release(self) -> None:
        """Release the lock, whichever page holds it."""
        with self._lock:
            self._free()

    def leave(self, client: int) -> None:
        """Remove a page that closed or lost its connection; if it was driving, the robot stops now."""
        with self._lock:
            if self._holder == client:
                self._free()

    @property
    def holder(self) -> int | None:
        """The page that holds the lock."""
        with self._lock:
            self._expire()
            return self._holder

    @property
    def axes(self) -> Axes | None:
        """The current input of the page that drives; None if no page does."""
        with self._lock:
            self._expire()
            return self._axes

    def _expire(self) -> None:
        if self._holder is not None and self._clock() - self._received > self._deadman:
            self._free()

    def _free(self) -> None:
        self._holder = self._axes = None
