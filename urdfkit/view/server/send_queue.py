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


MAX_UNSEEN = 2
"""Frames of one source sent but not yet shown."""
MAX_STREAM = 120
"""Frames of one stream that may wait; the oldest are lost first."""
MAX_STREAM_BYTES = 16 * 1024 * 1024
"""Bytes of one stream that may wait, of frames beside the newest."""


class ChannelFullError(Exception):
    """A browser does not read what it must not miss."""


class Channel:
    """Outgoing frames of one browser, in five grades.

    Lines that must all arrive (scene commands) queue up; streams (curves) do, up to `MAX_STREAM` and
    `MAX_STREAM_BYTES` of each; news (status)
    is kept per topic, newest wins; poses are kept newest wins too, and at most `MAX_IN_FLIGHT` of them are
    unacknowledged; so are pictures and points, `MAX_UNSEEN` of each source. Lives in the server's loop.

    Attributes:
        wanted: keys of what this browser wants beside what everybody gets.
    """

    def __init__(self) -> None:
        self._lines: deque[Frame] = deque()
        self._waiting = 0
        self._news: dict[str, Frame] = {}
        self._poses: tuple[int, bytes] | None = None
        self._in_flight: deque[int] = deque()
        self._streams: dict[str, deque[Frame]] = {}
        self._views: dict[str, tuple[int, bytes]] = {}
        self._unseen: dict[str, deque[int]] = {}
        self.wanted: frozenset[str] = frozenset()
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

    def stream(self, key: str, frame: Frame) -> None:
        """Send this in order, unless the browser is so slow that newer ones push it out."""
        stream = self._streams.setdefault(key, deque(maxlen=MAX_STREAM))
        stream.append(frame)
        while len(stream) > 1 and sum(map(len, stream)) > MAX_STREAM_BYTES:
            stream.popleft()
        self._ready.set()

    def view(self, key: str, sequence: int, frame: bytes) -> None:
        """Send this picture or these points unless newer ones of this source come first."""
        self._views[key] = (sequence, frame)
        self._ready.set()

    def takes(self, key: str) -> bool:
        """Whether this browser wants a source, and has shown what it was sent of it."""
        return key in self.wanted and len(self._unseen.get(key, ())) < MAX_UNSEEN and key not in self._views

    def seen(self, key: str, sequence: int) -> None:
        """Note that a frame of a source was shown; older ones count as shown too, unknown ones are ignored."""
        unseen = self._unseen.get(key)
        if unseen and sequence in unseen:
            while unseen.popleft() != sequence:
                pass
            self._ready.set()

    def want(self, wanted: frozenset[str]) -> None:
        """Take note of what the browser wants from now on; what waits of anything else is dropped."""
        self.wanted = wanted
        for waiting in (self._streams, self._views, self._unseen):
            for key in [key for key in waiting if key not in wanted]:
                del waiting[key]

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
        for key, stream in self._streams.items():
            chunk = stream.popleft()
            if not stream:
                del self._streams[key]
            return chunk
        if self._poses is not None and len(self._in_flight) < MAX_IN_FLIGHT:
            sequence, packed = self._poses
            self._poses = None
            self._in_flight.append(sequence)
            return packed
        for key, (number, seen) in self._views.items():
            unseen = self._unseen.setdefault(key, deque())
            if len(unseen) < MAX_UNSEEN:
                del self._views[key]
                unseen.append(number)
                return seen
        return None
