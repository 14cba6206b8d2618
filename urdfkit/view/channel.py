"""Channel: what is on its way to one browser. Bounded, and a slow browser holds up nobody but itself."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable

Frame = str | bytes

MAX_IN_FLIGHT = 3
"""Pose frames sent but not yet acknowledged."""
MAX_WAITING = 64 * 1024 * 1024
"""Bytes of scene commands that may wait for one browser before it is cut off (it reconnects and starts afresh)."""


class ChannelFullError(Exception):
    """A browser does not read what it must not miss."""


class Channel:
    """Outgoing frames of one browser, in three grades.

    Lines that must all arrive (scene commands) queue up; news (status) is kept per topic, newest wins; poses are kept
    newest wins too, and at most `MAX_IN_FLIGHT` of them are unacknowledged. Lives in the server's loop.
    """

    def __init__(self) -> None:
        self._lines: deque[Frame] = deque()
        self._waiting = 0
        self._news: dict[str, Frame] = {}
        self._poses: tuple[int, bytes] | None = None
        self._in_flight: deque[int] = deque()
        self._ready = asyncio.Event()
        self._cut = False

    def line(self, frame: Frame) -> None:
        """Send this, in order, without fail.

        Raises:
            ChannelFullError: too much is waiting already.
        """
        self._waiting += len(frame)
        if self._waiting > MAX_WAITING and self._lines:
            raise ChannelFullError(f"{self._waiting} bytes wait for the browser")
        self._lines.append(frame)
        self._ready.set()

    def news(self, topic: str, frame: Frame) -> None:
        """Send this unless something newer on the same topic comes first."""
        self._news[topic] = frame
        self._ready.set()

    def poses(self, sequence: int, frame: bytes) -> None:
        """Send this pose frame unless a newer one comes first."""
        self._poses = (sequence, frame)
        self._ready.set()

    def acknowledge(self, sequence: int) -> None:
        """Note that a pose frame was applied; older ones count as applied too, unknown ones are ignored."""
        if sequence in self._in_flight:
            while self._in_flight.popleft() != sequence:
                pass
            self._ready.set()

    def cut(self) -> None:
        """End `run`: what waits is lost."""
        self._cut = True
        self._ready.set()

    @property
    def in_flight(self) -> int:
        """Pose frames sent and not yet acknowledged."""
        return len(self._in_flight)

    async def run(self, write: Callable[[Frame], Awaitable[None]]) -> None:
        """Write frames as they come, one at a time, until `write` raises, `cut` or the task is cancelled."""
        while not self._cut:
            frame = self._next()
            if frame is None:
                self._ready.clear()
                await self._ready.wait()
            else:
                await write(frame)

    def _next(self) -> Frame | None:
        if self._lines:
            frame = self._lines.popleft()
            self._waiting -= len(frame)
            return frame
        if self._news:
            return self._news.pop(next(iter(self._news)))
        if self._poses is not None and len(self._in_flight) < MAX_IN_FLIGHT:
            sequence, packed = self._poses
            self._poses = None
            self._in_flight.append(sequence)
            return packed
        return None
